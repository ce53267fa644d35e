#pragma once

#include "apps/experiments/features/surface_features.hpp"
#include "apps/report/record.hpp"

/// Which features of a surface drive its response, as the page and the tables read it.
namespace app {

/// A surface, what it answers and how its answer hangs on its waves.
struct FeatureSample {
    std::uint64_t number = 0; ///< of its start
    double similarity = 0;
    rough::Genome genome; ///< final amplitude
    std::vector<SurfaceFeature> features;
    std::array<double, 3> stiffness{}; ///< log10 of K (MPa/mm) at the target's first, middle and last point
};

/// What the two groups say of one feature.
struct FeatureVerdict {
    std::string name, meaning;
    bool of_shape = true;
    double answers = 0, answers_width = 0; ///< median and distance of the quartiles of the answers
    double misses = 0, misses_width = 0;
    double p = 1; ///< rank sums of both groups, Holm's correction over all features
    std::array<double, 3> rank_correlation{}; ///< Spearman's with K at low, middle and high pressure
    enum class Kind { shared, shifted, open } kind = Kind::open;
};

/// Designs with some waves' genes alone, from starts that no answer came from.
struct HeldOut {
    std::string name;
    std::vector<double> similarity; ///< a start each
    double reached() const;         ///< share of 0.99 and more
};

struct FeatureTarget {
    rough::Target target;
    long starts = 0;
    std::vector<FeatureSample> answers, misses;
    std::vector<FeatureVerdict> verdicts;
    /// Of the answers' misfits, rms per rad of a phase, by octave: median over the answers; NaN without
    /// waves.
    std::array<double, wave_octaves> phase_sensitivity{};
    std::array<bool, wave_octaves> needed{};
    /// R^2 on parts left out of a linear regression of K at low, middle and high pressure on all features of
    /// shape, on those that are shared alone, on the waves by octave alone.
    std::array<std::array<double, 3>, 3> regression{};
    std::vector<HeldOut> held_out; ///< needed waves, all, the others
    double held_out_p = 1;         ///< rank sums of needed against all
    std::vector<std::pair<std::string, double>>
        control; ///< the best answer's chromosomes, the most felt first
};

struct FeatureRun {
    Origin origin;
    rough::Model model;
    double max_pressure = 0, good = 0;
    std::vector<FeatureTarget> targets;
    double seconds = 0;
};

/// Fills in what the samples say.
void judge_features(FeatureTarget& target);
/// R^2 of a ridge regression (standardised columns) on each fifth of the rows left out in turn.
double left_out_r2(const Eigen::MatrixXd& columns, const Eigen::VectorXd& wanted);
/// The rank correlation (Spearman) of two series.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// What came out, in sentences; the page's first screen.
std::vector<std::string> feature_words(const FeatureRun& run);
/// The report as a web page.
std::string features_page(const FeatureRun& run);

} // namespace app
