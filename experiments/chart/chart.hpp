#pragma once

#include "apps/experiments/experiment.hpp"
#include "apps/experiments/trial.hpp"

#include <compare>

/// Time against error for every contact solver, grid, number of load steps and tolerance, and for theories
/// and simpler models.
namespace app {

/// One trial of a chart: a curve of a scene by a method.
struct ChartSetting {
    std::size_t scene = 0; ///< among chart_scenes()
    rough::Solver method = rough::Solver::nested;
    rough::Index nodes = 0;
    int steps = 0;
    double tolerance = 0; ///< 0 for direct methods and for auto, which uses 1e-6

    auto operator<=>(const ChartSetting&) const = default;
};

/// The settings and the limits of a chart.
struct ChartExtent {
    std::vector<rough::Index> nodes;            ///< grids for 20 load steps, increasing
    std::vector<rough::Index> nodes_with_steps; ///< the grids that have other numbers of load steps, too
    std::vector<int> steps;                     ///< other numbers of load steps
    std::vector<double> tolerances;             ///< for the iterative methods, including 1e-6
    rough::Index max_for_truth;                 ///< maximum number of nodes of a reference
    double limit;                               ///< maximum time of one curve, s
    rough::Index finest_map = 0;                ///< nodes along each side of the exact maps; 0: no models
};

/// Returns true if the work is to end.
using Stop = std::function<bool()>;
inline const Stop never = [] { return false; };

constexpr int usual_steps = 20;
/// A setting with 20 load steps, and with the tolerance 1e-6 if the method is iterative.
ChartSetting usual_setting(std::size_t scene, rough::Solver method, rough::Index nodes);

/// All trials of a chart on each scene, from the coarsest grid to the finest.
std::vector<ChartSetting> chart_plan(const ChartExtent& extent);

/// A fine response that curves are measured against, linear between its load steps. The first step is at 0.
struct ChartTruth : rough::Response {
    std::string origin;               ///< "the exact solution", or a description of the refinement
    rough::Index finest_verified = 0; ///< finer grids are too close to the reference to have an error
};

/// A profile given as a function, which is sampled on any grid and pressed to a last displacement.
struct ChartScene {
    std::string name;
    std::string words; ///< description
    rough::Body body;
    double length = 1; ///< mm
    std::function<double(double)> height;
    double last = 0;                   ///< mm
    std::function<ChartTruth()> exact; ///< the exact solution; empty if it is not known
    std::string reference = {};        ///< origin of the truth, set by charted()

    rough::Profile profile(rough::Index nodes) const;
};

/// hertz, westergaard, mwm-smooth, mwm-rough and fractional-brownian.
std::vector<ChartScene> chart_scenes();

/// The exact curve, or the curve of a refined grid. Each refinement has four times the nodes. It ends when
/// pressures change by less than 1e-6 (relative, root mean square), or with `most_nodes` nodes. Throws
/// rough::NotConverged if `stop` returns true.
ChartTruth truth_of(const ChartScene& scene, rough::Index max_nodes, const Stop& stop = never);

/// The result of a setting: a row of chart.csv.
struct ChartRun {
    ChartSetting setting;
    double seconds = 0; ///< time of one curve on one core, the lowest of a few
    double error_pressure = NAN, error_stiffness = NAN, error_contact = NAN; ///< NaN if unknown
    long iterations = 0;
    Outcome outcome = Outcome::solved;
    bool late = false;           ///< stopped at the limit
    double contact_fraction = 0; ///< at the last step
};

/// Sets the root mean square errors of a run. Pressure: relative errors at the curve's displacements.
/// Stiffness: relative errors of the tangent at 20 pressures, linear between the load steps. Contact: errors
/// of the contact fraction at the displacements.
void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run);

/// Solves a few times. Stops after `limit` seconds of processor time, or if `stop` returns true. Errors are
/// known on grids of at most `finest_verified` nodes.
ChartRun run_chart(const ChartScene& scene, const ChartTruth& truth, const ChartSetting& setting,
                   double limit, const Stop& stop = never);

/// Root mean square of the known errors; NaN if all are unknown.
double root_mean_square(const Eigen::VectorXd& errors);

/// A setting that was left out, and the reason in words.
struct LeftOut {
    ChartSetting setting;
    std::string why;
};
/// The reasons for which a chart ends.
inline const std::string time_over = "the chart's time was over", interrupted = "interrupted";

/// All results of a chart.
struct ChartData {
    std::vector<ChartScene> scenes;                      ///< ChartSetting::scene is an index into these
    std::vector<ChartRun> runs;                          ///< in the order of the plan
    std::vector<LeftOut> left_out;                       ///< all other settings of the plan
    double limit = 0;                                    ///< maximum time of one curve, s
    Findings models;                                     ///< tables and facts of theories, lines and maps
    nlohmann::json model_runs = nlohmann::json::array(); ///< their rows of chart.csv

    /// A scene's contact fraction at its last step on the finest solved grid; 0 without one.
    double contact(std::size_t scene) const;
};

/// Adds models of periodic random surfaces: theories, one line instead of the map, and coarser grids. The
/// scenes are self-affine-line (a profile), self-affine-map (isotropic) and ground-map. The last one has
/// ridges along y and a tenth of the isotropic roughness. H = 0.8; loads from 0.5 % to nearly full contact.
/// The exact maps have `finest` x `finest` nodes; waves have at least 8 nodes on 128 x 128. models.csv has
/// one row per load and model, model_errors.csv the errors of each model over the loads. If `stop` returns
/// true, only the finished scenes and models are added.
void chart_models(ChartData& data, rough::Index finest, const Stop& stop = never);

/// Works through the plan, one setting on all scenes before the next. The references and the coarsest grid
/// are always done; after `seconds` of wall time no setting starts. A setting is left out if the coarser grid
/// was not solved, or if its curve would take longer than the limit. `stop` is called often; true ends the
/// chart, which keeps its results. `watch` is called after each setting and reference. It gets the results so
/// far and words such as "12 of 740, at most 3 min left".
ChartData charted(
    const std::vector<ChartScene>& scenes, const ChartExtent& extent, double seconds,
    const Stop& stop = never,
    const std::function<void(const ChartData&, const std::string&)>& watch = [](const ChartData&,
                                                                                const std::string&) {});

/// chart.csv: one row per run of solvers and of models.
Csv chart_table(const ChartData& data);
/// All tables, and everything else on the page.
///
/// points.csv has each run with an error, by kind. Its `best` is 1 if no run of its method is faster and more
/// accurate, and 2 if no run of any method is. Errors that differ by less than a twentieth count as equal.
Findings findings_of(const ChartData& data);

} // namespace app
