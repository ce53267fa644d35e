#pragma once

#include "apps/experiments/features/surface_features.hpp"
#include "apps/report/page.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/target/target.hpp"

#include <nlohmann/json.hpp>

/// Which features of a surface drive its response, as the page and the tables read it.
namespace app {

struct FeatureSample {
    std::uint64_t start = 0; ///< its number
    double similarity = 0;
    rough::Genome genome;              ///< in final amplitude
    std::vector<double> features;      ///< as features_of has them
    std::array<double, 3> stiffness{}; ///< log10 of K (MPa/mm) at the target's first, middle and last point
};

/// How far off a law is on what it has not seen, beside the mean of what it has: root mean squares.
struct Foretold {
    double error = unset, of_mean = unset;
};

using Octaves = std::array<bool, wave_octaves>;

struct FeatureTarget {
    rough::Target target;
    double max_pressure = 0; ///< MPa, of Eq. 11
    long starts = 0;
    std::vector<SurfaceFeature> features = {}; ///< their names
    std::vector<FeatureSample> answers = {}, misses = {};
    std::size_t found_blindly = 0; ///< of the answers: from starts that know nothing of the target
    std::size_t far_apart = 0;     ///< of the answers: differ from each other by rough::different
    /// Rows of features.csv, the most shared first, and of regression.csv.
    nlohmann::json verdicts = {}, laws = {};
    /// Of the answers' misfits, rms per rad of a phase, by octave: median over the answers; NaN without
    /// waves.
    std::array<double, wave_octaves> phase_sensitivity{};
    Octaves needed{};
    /// Similarities of new starts refined by phases of needed waves, of all, of the others.
    std::vector<std::pair<std::string, std::vector<double>>> held_out = {};
    /// The best answer's chromosomes, the most felt first.
    std::vector<std::pair<std::string, double>> control = {};
    const FeatureSample& best() const; ///< answer
};

/// Fills in what the samples say: verdicts and laws. A feature is shared where the answers' quartiles lie
/// closer than two thirds of the misses', shifted where the two groups differ (rank sums, Holm's correction),
/// else open.
void assess_features(FeatureTarget& target);
/// A ridge regression (standardised columns) on rows left out: row i is in fifth i mod 5.
Foretold left_out(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted);
/// The rank correlation (Spearman) of two series.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// What a start loses, start by start, where only some phases may move: the median's interval.
rough::Interval loss_of(const std::vector<double>& all, const std::vector<double>& some);
/// Whether that is at most half of what an answer of similarity 0.99 misses, for sure; and in words.
bool are_enough(const rough::Interval& loss);
std::string whether_enough(const rough::Interval& loss);
/// What came out, in sentences; the page's first screen.
std::vector<std::string> feature_words(const std::vector<FeatureTarget>& targets);
void fill_features_page(Page& page, const std::vector<FeatureTarget>& targets);

} // namespace app
