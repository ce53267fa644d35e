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

/// The index of a value on each axis; ours has only zeros.
using Reading = std::array<std::size_t, reading_axes_count>;
/// The number of choices that are not ours.
std::size_t deviations(const Reading& reading);

/// The claims on one target from one database.
struct ReadingCell {
    Reading reading;
    std::size_t database = 0; ///< 0: Sobol phases; others: random phases
    std::string target;
    std::string holds; ///< one sign per claim: 1, 0, or ? if it is undecidable
};

struct ReadingCross {
    std::vector<ReadingCell> cells;

    /// Share of the cells that `counts` admits in which a claim holds; NaN if it admits none. A cell in which
    /// the claim is undecidable counts as one in which it does not hold.
    double share(std::size_t claim, const std::function<bool(const ReadingCell&)>& counts) const;
    /// The readings tried on Sobol phases, each with the number of claims that hold, in the mean over the
    /// targets; most claims first, of equal ones the nearer to ours.
    std::vector<std::pair<Reading, double>> ranked() const;
};

/// The findings of one part of a run. A resumed run reads them from `checkpoints` if it can; otherwise `find`
/// computes them and they are saved. Null if the run is stopped. Throws rough::InputError if the saved part
/// is damaged or was saved under other settings.
nlohmann::json part_of(const Conditions& conditions, const std::string& name,
                       const std::function<nlohmann::json()>& find);

} // namespace app
