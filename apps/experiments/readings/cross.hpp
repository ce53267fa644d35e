#pragma once

#include "apps/experiments/experiment.hpp"

#include <nlohmann/json.hpp>

#include <array>

/// The paper's claims under every reading that its text allows.
namespace app {

/// A choice that the text leaves open. The first value is the one of experiments/paper.ini.
struct ReadingAxis {
    std::string name;
    std::vector<std::string> values;
};
enum ReadingAxes : std::size_t { body, correlation, dominance, reduction, reach, first_point, threshold };
constexpr std::size_t reading_axes_count = 7;
const std::array<ReadingAxis, reading_axes_count>& reading_axes();

/// A value on each axis, by its place; ours has all 0.
using Reading = std::array<std::size_t, reading_axes_count>;
/// How many of its values are not ours.
std::size_t deviations(const Reading& reading);

/// The claims on one target from one database.
struct ReadingCell {
    Reading reading;
    std::size_t database = 0; ///< 0: Sobol phases; others: phases drawn anew
    std::string target;
    std::string holds; ///< a sign a claim: 1, 0, or ? where it cannot be said
};

struct ReadingCross {
    bool quick = false;
    std::size_t databases = 0;                               ///< with other phases
    std::vector<std::pair<std::string, std::string>> claims; ///< place, what the paper says
    std::vector<std::string> targets;
    std::vector<ReadingCell> cells;
    std::string runs;              ///< rows of runs.csv
    long searches = 0, curves = 0; ///< runs of an algorithm, and the curves and gradients they asked for

    /// Share of the cells that `counts` admits in which a claim holds; NaN if it admits none. A cell in which
    /// the claim is undecidable counts as one in which it does not hold.
    double share(std::size_t claim, const std::function<bool(const ReadingCell&)>& counts) const;
    /// Claims that hold under a reading, in the mean over the targets, from Sobol phases.
    double holding(const Reading& reading) const;
    /// The readings tried on Sobol phases, most claims first.
    std::vector<Reading> ranked() const;
};

/// The columns of runs.csv.
const std::string& run_columns();

/// Tries them: all where `quick` is off, else one axis at a time. From databases with other phases one axis
/// at a time. Keeps each body and database in `checkpoints`.
ReadingCross tried_readings(const Settings& settings, const Conditions& conditions);

/// The findings of one part of a run. A resumed run reads them from `checkpoints` if it can; otherwise `find`
/// computes them and they are saved. Null if the run is stopped. Throws rough::InputError if the saved part
/// is damaged or was saved under other settings.
nlohmann::json part_of(const Conditions& conditions, const std::string& name,
                       const std::function<nlohmann::json()>& find);

} // namespace app
