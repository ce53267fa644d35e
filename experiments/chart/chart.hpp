#pragma once

#include "apps/experiments/experiment.hpp"
#include "apps/experiments/trial.hpp"

/// Error against time of theories, of one profile, and of solved grids, on scenes with a reference.
namespace app {

/// Returns true if the work is to end.
using Stop = std::function<bool()>;
inline const Stop never = [] { return false; };

/// A surface that is pressed to some loads.
struct ChartScene {
    std::string name;
    std::string words; ///< description
    rough::Body body;
    bool is_map = false;
    std::function<rough::Profile(rough::Index)> on;    ///< the surface, by its nodes along each side
    std::vector<double> pressures;                     ///< mean pressures, increasing, MPa
    std::size_t first = 0;                             ///< first of the loads that count in an error
    std::function<rough::LoadStep(double)> exact = {}; ///< the exact solution at a pressure, if it is known
    static constexpr std::size_t counted = 9;          ///< number of loads that count
};

/// self-affine-map, ground-map, self-affine-line, mwm-smooth, mwm-rough, fractional-brownian, hertz and westergaard.
/// The loads of the first three have 0.1 to 99.9 % in contact, those after them span two decades.
std::vector<ChartScene> chart_scenes();

/// The answer of a model at the loads of a scene. A load without an answer has NaN.
struct ChartCurve {
    Eigen::VectorXd displacement, contact_fraction, stiffness;
};

/// The reference curve with its estimated error. It is exact, or that of the finest grid of a sequence. Let d
/// be the root mean square change by the last refinement, and q the ratio of d to the change before it. If
/// further changes shrink by q, they add up to d q/(1 - q).
struct ChartReference {
    ChartCurve curve;
    rough::Index side = 0;                         ///< nodes along each side; 0: exact
    double floor_stiffness = 0, floor_contact = 0; ///< estimated root mean square errors, relative
};
ChartReference exact_reference(const ChartScene& scene); ///< that of an exact solution
/// The error beyond the finest of three grids, from the changes `before` and `last`. The ratio q is taken as
/// at least `min_ratio`, that of errors in proportion to the node spacing, and at most 3/4.
double remaining_error(double before, double last, double min_ratio);

/// A model: a theory or a solver on a grid, at some of the loads.
struct ChartSetting {
    std::size_t scene = 0;                             ///< among chart_scenes()
    std::string family;                                ///< theory, profile or map
    std::string method;                                ///< name of the theory or solver, `section` or `mean-line`
    rough::Index side = 0;                             ///< nodes along each side
    int loads = static_cast<int>(ChartScene::counted); ///< 9, 5 or 3; others are interpolated in log P
    double tolerance = 0;                              ///< 0: that of the program
};

/// The result of a setting: a row of chart.csv.
///
/// An error is the root mean square of the relative errors at the nine loads that count, plus the estimated
/// error of the reference. So it is an upper estimate. A load without an answer counts as an error of 100 %.
struct ChartRun {
    ChartSetting setting;
    double seconds = NAN; ///< time of the answers at the loads that count, on one core, the lowest of a few
    double error_pressure = NAN, error_stiffness = NAN, error_contact = NAN;
    int answered = 0; ///< number of the nine loads with an answer
    long iterations = 0;
    Outcome outcome = Outcome::solved;
    std::string message; ///< the reason if it was not solved
    ChartCurve curve;    ///< at all loads of the scene, if it has further ones
};

/// Sets the errors of a run with a curve.
void measure_errors(const ChartScene& scene, const ChartReference& reference, ChartRun& run);
/// Measures a setting of a scene. Curves that `stop` ends are not converged.
ChartRun run_chart(const ChartScene& scene, const ChartReference& reference, const ChartSetting& setting,
                   const Stop& stop = never);

/// All results of a chart. Scenes without a reference yet are not in it.
struct ChartData {
    std::vector<ChartScene> scenes;
    std::vector<ChartReference> references;
    std::vector<ChartRun> runs;
    std::size_t not_measured = 0; ///< number of settings for which the time did not suffice
    bool interrupted = false;
};

Csv chart_table(const ChartData& data); ///< chart.csv: one row per run
/// All tables, and everything else on the page.
Findings findings_of(const ChartData& data);

} // namespace app
