#pragma once

#include "apps/experiments/solvers/trial.hpp"
#include "apps/report/csv.hpp"

#include <compare>
#include <functional>
#include <optional>

/// Time against error for every contact solver, grid, number of load steps and tolerance, and for theories
/// and simpler models.
namespace app {

/// What a chart tries once: a curve of a scene by a method.
struct ChartSetting {
    std::size_t scene = 0; ///< among chart_scenes()
    rough::Solver method = rough::Solver::nested;
    rough::Index nodes = 0;
    int steps = 0;
    double tolerance = 0; ///< 0 for the direct methods, which have none, and for auto, which takes 1e-6

    auto operator<=>(const ChartSetting&) const = default;
};

/// How fine and how patient a chart is.
struct ChartExtent {
    std::vector<rough::Index> nodes;            ///< with 20 load steps, increasing
    std::vector<rough::Index> nodes_with_steps; ///< of these, with other numbers of load steps too
    std::vector<int> steps;                     ///< those others
    std::vector<double> tolerances;             ///< of the iterative methods, 1e-6 among them
    rough::Index most_for_truth;                ///< nodes of a reference
    double limit;                               ///< s that one curve may take
};

constexpr int usual_steps = 20;
/// 20 load steps, and the tolerance 1e-6 for a method that has one.
ChartSetting usual_setting(std::size_t scene, rough::Solver method, rough::Index nodes);

/// Everything that a chart tries on each scene, from the coarsest grid to the finest.
std::vector<ChartSetting> chart_plan(const ChartExtent& extent);

/// A curve so fine that other curves are measured against it: between its points it is linear.
struct ChartTruth {
    Eigen::VectorXd displacement;     ///< mm, increasing from 0
    Eigen::VectorXd pressure;         ///< MPa
    Eigen::VectorXd stiffness;        ///< tangent, MPa/mm
    Eigen::VectorXd fraction;         ///< of the length in contact
    std::string origin;               ///< "the exact solution", or how far it was refined
    rough::Index finest_verified = 0; ///< grids of more nodes are too close to it to be verified by it
};

/// A profile known everywhere, to be sampled on any grid and pressed to a last displacement.
struct ChartScene {
    std::string name;
    std::string words; ///< what it is
    rough::Body body;
    double length = 1; ///< mm
    std::function<double(double)> height;
    double last = 0;                   ///< mm
    std::function<ChartTruth()> exact; ///< where there is an exact solution
    std::string reference = {};        ///< what it is measured against, once that is known

    rough::Profile profile(rough::Index nodes) const;
};

/// hertz, westergaard, mwm-smooth, mwm-rough and fractional-brownian.
std::vector<ChartScene> chart_scenes();

/// The exact curve, or that of ever finer grids (four times the nodes, at most `most_nodes`) until pressures
/// move by less than 1e-6 of themselves (root mean square). Throws rough::NotConverged when `stop` says so.
ChartTruth truth_of(const ChartScene& scene, rough::Index most_nodes, const std::function<bool()>& stop = {});

/// What became of a setting: a row of chart.csv.
struct ChartRun {
    ChartSetting setting;
    double seconds = 0; ///< of one curve, on one core: the least of a few
    double error_pressure = unknown, error_stiffness = unknown, error_contact = unknown;
    long iterations = 0;
    Outcome outcome = Outcome::solved;
    bool late = false;           ///< given up at the limit
    double contact_fraction = 0; ///< at the last step

    static constexpr double unknown = -1;
};

/// Pressure: relative errors at the curve's own displacements. Stiffness: relative errors of the tangent,
/// linear in between, at 20 pressures. Contact: errors of the contact fraction at the displacements. Root
/// mean squares.
void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run);

/// Solves a few times; gives up after `limit` seconds of processor time, or when `stop` says so. Errors are
/// known on grids that the truth resolves.
ChartRun run_chart(const ChartScene& scene, const ChartTruth& truth, const ChartSetting& setting,
                   double limit, const std::function<bool()>& stop = {});

/// What a model predicts of a scene: a theory, one line in place of the map, or a coarser grid.
struct ModelRun {
    std::string family;     ///< theories, one line or solved
    std::string model;      ///< its name
    rough::Index nodes = 0; ///< 0 of a theory
    double seconds = 0;     ///< of the whole curve on one core, the least of a few
    Eigen::VectorXd contact_fraction = {}, stiffness = {};   ///< at the loads; NaN where it has no answer
    Eigen::VectorXd area_errors = {}, stiffness_errors = {}; ///< relative, at each load
    double area_error = 0, stiffness_error = 0;              ///< root mean squares of these
};

/// A random surface that repeats, its exact curve and the models measured against it.
struct ModelScene {
    std::string name, words;
    std::string reference;                                 ///< what it is measured against
    double rms_slope = 0;                                  ///< h', rms gradient of a map
    double rms_height = 0;                                 ///< mm
    double aspect_ratio = 0;                               ///< Str; 0: a line
    Eigen::VectorXd pressure = {};                         ///< of the loads, MPa; E* is 1 MPa
    Eigen::VectorXd contact_fraction = {}, stiffness = {}; ///< exact, MPa/mm
    std::vector<ModelRun> runs = {};
};

/// The scenes self-affine-line (a profile), self-affine-map (isotropic) and ground-map (ridges along y with a
/// tenth of roughness of every direction on them), H = 0.8, pressed from 0.5 % to nearly full contact. Exact
/// is a map of `finest` nodes a side; shorter waves than 8 nodes of 128 a side there are none. Ends early
/// where `stop` says so, with what there is.
std::vector<ModelScene> charted_models(rough::Index finest, const std::function<bool()>& stop = {});

/// Of the errors that are known; NaN of none.
double root_mean_square(const Eigen::VectorXd& errors);

/// Why a setting was not tried.
enum class LeftOutFor {
    limit,    ///< one curve takes too long, to go by a coarser grid
    unsolved, ///< a coarser grid was refused or did not converge
    time,     ///< the chart's own time was over
    interrupt
};

struct LeftOut {
    ChartSetting setting;
    LeftOutFor why;
};

/// All that a chart shows.
struct ChartData {
    std::vector<ChartScene> scenes; ///< a setting's scene is its place here
    std::vector<ChartRun> runs;     ///< in the order of the plan
    std::vector<LeftOut> left_out;  ///< the rest of the plan
    double limit = 0;               ///< s that one curve might take
    std::vector<ModelScene> models; ///< theories, lines and maps

    /// The run at a setting, or none.
    const ChartRun* at(const ChartSetting& setting) const;
    /// A scene's contact fraction at its last step on the finest grid that was solved; 0 of none.
    double contact(std::size_t scene) const;
};

/// What bounds a chart besides its extent, and who watches it.
struct ChartBounds {
    double seconds = 0;          ///< of the wall's clock
    rough::Index finest_map = 0; ///< nodes a side of the maps that models are measured on; 0: none
    std::function<bool()> stop;  ///< asked often where set; true ends the chart with what there is
    /// After each setting and reference: what there is, and words such as "12 of 740, at most 3 min left".
    std::function<void(const ChartData&, const std::string&)> watch;
};

/// Works through the plan, one setting on all scenes before the next. The references and the coarsest grid
/// are always done; past its time no setting begins. What would take more than the limit, to go by the
/// coarser grid, or was not solved there, is left out.
ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent,
                  const ChartBounds& bounds);

/// chart.csv: a row a run, of solvers and of models.
Csv chart_table(const ChartData& data);
/// models.csv: a row a load of each run.
Csv models_table(const std::vector<ModelScene>& scenes);
/// points.csv: each run that has an error, by kind; `best` is 1 if no run of its method is faster and more
/// accurate, 2 if no run of any method is. Errors that differ by less than a twentieth count as equal.
Csv points_table(const ChartData& data);
/// model_errors.csv: the errors of each model over the loads, and its time.
Csv model_errors_table(const std::vector<ModelScene>& scenes);
/// What was left out and why, in one line; "" if all were tried.
std::string left_out_in_a_line(const ChartData& data);
/// Everything else that the page says: scenes, failures, and where theories, a line and a map hold.
nlohmann::json chart_facts(const ChartData& data);

} // namespace app
