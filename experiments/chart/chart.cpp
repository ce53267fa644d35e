#include "experiments/chart/chart.hpp"

#include "apps/prompt/units.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/response/curve.hpp"
#include "domain/text/atomic_file.hpp"

#include <numbers>

namespace app {

using Eigen::VectorXd;
using rough::Index;
using rough::Solver;

namespace {

using std::numbers::pi;
constexpr double longest_wave = 0.84942; ///< mm

bool is_iterative(Solver method) { return method != Solver::automatic && !is_direct(method); }

/// A scene over 1 mm with an exact solution, given for each half-width of the contact (mm) up to 0.4.
ChartScene exact_scene(const std::string& name, const std::string& words, rough::Kernel kernel,
                       const std::function<double(double)>& height,
                       const std::function<rough::LoadStep(double)>& contact) {
    constexpr double widest = 0.4;
    ChartScene scene{name, words, {}, 1, height, contact(widest).displacement, {}};
    scene.body.kernel = kernel;
    scene.body.datum = 1;
    scene.exact = [contact] {
        constexpr int points = 20000;
        std::vector<rough::LoadStep> steps(points + 1);
        for (int k = 1; k <= points; ++k)
            steps[static_cast<std::size_t>(k)] = contact(widest * k / points);
        return ChartTruth{rough::response_of(steps, Solver::automatic, 0), "the exact solution",
                          std::numeric_limits<Index>::max()};
    };
    return scene;
}

ChartScene of_waves(const std::string& name, const std::string& words, std::vector<rough::Wave> waves) {
    ChartScene scene{name, words, {}, longest_wave, {}, 0, {}};
    scene.height = [waves = std::move(waves)](double x) { return height_at(waves, x); };
    const VectorXd heights = scene.profile(65537).heights;
    scene.last = 0.6 * (heights.maxCoeff() - heights.minCoeff());
    return scene;
}

ChartTruth refined(const ChartScene& scene, Index nodes, int steps, const Stop& stop) {
    rough::ContactOptions options;
    options.stop = stop;
    rough::ContactCurve curve =
        solve_contact(scene.profile(nodes), scene.body, even_steps(scene.last, steps), options);
    curve.steps.insert(curve.steps.begin(), {.tangent_stiffness = curve.steps[0].tangent_stiffness});
    return {rough::response_of(curve.steps, curve.solver, 0), {}};
}

/// The reason to leave a setting out, or "". The time of a curve grows at least like the number of nodes.
/// @param coarser  the run on the next coarser grid, or one of 0 s on 0 nodes
std::string reason_to_leave_out(const ChartSetting& setting, const ChartRun& coarser, double limit) {
    if (coarser.outcome != Outcome::solved && !coarser.late)
        return "refused or not converged on a coarser grid";
    if (coarser.seconds * static_cast<double>(setting.nodes) >
        limit * static_cast<double>(coarser.setting.nodes))
        return "one curve takes more than " + brief(limit, 3) + " s";
    return "";
}

Findings run_chart_experiment(const Settings& settings, const RunConditions& conditions) {
    static const ChartExtent quick{{128, 512, 2048}, {512, 2048}, {5, 80}, {1e-3, 1e-6}, 8193, 1, 128},
        whole{{128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768, 65536},
              {512, 2048},
              {5, 10, 40, 80, 160},
              {1e-3, 1e-4, 1e-6, 1e-8},
              65537,
              5,
              256};
    ga::Stopwatch since_written;
    const auto watch = [&](const ChartData& so_far, const std::string& where) {
        conditions.progress.show(where);
        if (so_far.runs.empty() || since_written.seconds() < 3)
            return;
        rough::write_atomically(conditions.folder / "chart.csv", chart_table(so_far).text());
        since_written = {};
    };
    const ChartData data = charted(
        chart_scenes(), settings.is_on("chart.quick") ? quick : whole, 60 * settings.number("chart.minutes"),
        [&] { return conditions.stop.load(); }, watch);
    return data.runs.empty() ? Findings() : findings_of(data);
}

} // namespace

ChartSetting usual_setting(std::size_t scene, Solver method, Index nodes) {
    return {scene, method, nodes, usual_steps, is_iterative(method) ? 1e-6 : 0};
}

std::vector<ChartSetting> chart_plan(const ChartExtent& extent) {
    std::vector<ChartSetting> plan;
    for (const Index nodes : extent.nodes)
        for (std::size_t m = 0; m < rough::solver_names().size(); ++m) {
            ChartSetting setting = usual_setting(0, static_cast<Solver>(m), nodes);
            for (const double tolerance :
                 is_iterative(setting.method) ? extent.tolerances : std::vector<double>{0}) {
                plan.push_back(setting);
                plan.back().tolerance = tolerance;
            }
            if (std::ranges::count(extent.nodes_with_steps, nodes))
                for (const int steps : extent.steps) {
                    plan.push_back(setting);
                    plan.back().steps = steps;
                }
        }
    return plan;
}

rough::Profile ChartScene::profile(Index nodes) const {
    return rough::sampled({nodes, length, body.kernel == rough::Kernel::periodic}, height);
}

std::vector<ChartScene> chart_scenes() {
    const auto mwm = [](double hurst, double gamma, int count) {
        return rough::self_affine_waves(longest_wave, 0.05, hurst, gamma, count);
    };
    return {exact_scene(
                "hertz", "a Hertz parabola, contact growing to 80 % of the length", rough::Kernel::free,
                [](double x) { return -(x - 0.5) * (x - 0.5) / 2; },
                [](double a) { // R = 1 mm, E* = 1 MPa, d = 1 mm (Johnson 1985, ch. 4)
                    const double ratio = std::log(2 / a);
                    return rough::LoadStep{.displacement = a * a / 2 * (ratio + 0.5),
                                           .pressure = pi * a * a / 4,
                                           .tangent_stiffness = pi / (2 * ratio),
                                           .contact_fraction = 2 * a};
                }),
            exact_scene(
                "westergaard", "Westergaard's wave, periodic, contact growing to 80 %",
                rough::Kernel::periodic, [](double x) { return std::cos(2 * pi * (x - 0.5)) - 1; },
                [](double a) { // amplitude 1 mm, E* = 1 MPa (Westergaard 1939)
                    const double s = std::sin(pi * a), log_s = std::log(s);
                    return rough::LoadStep{.displacement = 2 * s * s * (0.5 - log_s),
                                           .pressure = pi * s * s,
                                           .tangent_stiffness = -pi / (2 * log_s),
                                           .contact_fraction = 2 * a};
                }),
            of_waves("mwm-smooth", "a smooth MWM profile, H = 1.2, gamma = 1.7, 8 waves", mwm(1.2, 1.7, 8)),
            of_waves("mwm-rough", "a rough MWM profile, H = 0.6, gamma = 1.5, 11 waves", mwm(0.6, 1.5, 11)),
            of_waves("fractional-brownian", "a fractional-Brownian profile, H = 0.8, 64 waves",
                     rough::brownian_waves(longest_wave, 0.05, 0.8, 64))};
}

ChartTruth truth_of(const ChartScene& scene, Index max_nodes, const Stop& stop) {
    if (scene.exact)
        return scene.exact();
    constexpr int steps = 160;
    constexpr double still = 1e-6;
    Index nodes = (max_nodes - 1) / 16 + 1;
    ChartTruth truth = refined(scene, nodes, steps, stop);
    double moved = 1;
    while (moved > still && 4 * (nodes - 1) + 1 <= max_nodes) {
        nodes = 4 * (nodes - 1) + 1;
        ChartTruth finer = refined(scene, nodes, steps, stop);
        moved = root_mean_square(truth.pressure.tail(steps).array() / finer.pressure.tail(steps).array() - 1);
        truth = std::move(finer);
    }
    truth.origin = "a grid of " + std::to_string(nodes) + " nodes and " + std::to_string(steps) +
                   " load steps, whose pressures a grid of a quarter of the nodes misses by " +
                   brief(100 * moved) + " %";
    truth.finest_verified = (nodes - 1) / 4;
    return truth;
}

void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run) {
    const rough::Response found = rough::response_of(curve.steps, curve.solver, 0);
    const auto read = [](const VectorXd& x, const VectorXd& y, const VectorXd& at) -> VectorXd {
        const rough::Curve through{x, y, -HUGE_VAL, HUGE_VAL};
        return at.unaryExpr([&](double where) { return through.at(where); });
    };
    const VectorXd pressure = read(truth.displacement, truth.pressure, found.displacement),
                   fraction = read(truth.displacement, truth.contact_fraction, found.displacement);
    run.error_pressure = root_mean_square(found.pressure.array() / pressure.array() - 1);
    run.error_contact = root_mean_square(found.contact_fraction - fraction);
    constexpr int samples = 20;
    const double last = truth.pressure.tail(1)[0];
    const VectorXd at = VectorXd::LinSpaced(samples, last / samples, last);
    run.error_stiffness = root_mean_square(read(found.pressure, found.tangent_stiffness, at).array() /
                                               read(truth.pressure, truth.tangent_stiffness, at).array() -
                                           1);
}

ChartRun run_chart(const ChartScene& scene, const ChartTruth& truth, const ChartSetting& setting,
                   double limit, const Stop& stop) {
    const ContactScene contact{scene.name, scene.profile(setting.nodes), scene.body,
                               even_steps(scene.last, setting.steps)};
    rough::ContactOptions options;
    options.solver = setting.method;
    if (setting.tolerance > 0)
        options.tolerance = setting.tolerance;
    ChartRun run;
    run.setting = setting;
    double start = 0;
    options.stop = [&] {
        run.late = processor_seconds() - start > limit;
        return run.late || stop();
    };
    ContactTrial trial;
    run.seconds = lowest_seconds([&] {
        start = processor_seconds();
        trial = try_contact(contact, options);
    });
    run.iterations = trial.curve.iterations;
    run.outcome = trial.outcome;
    if (trial.outcome == Outcome::solved) {
        run.contact_fraction = trial.curve.steps.back().contact_fraction;
        if (setting.nodes <= truth.finest_verified)
            measure_errors(trial.curve, truth, run);
    }
    return run;
}

ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent, double seconds,
                  const Stop& stop, const std::function<void(const ChartData&, const std::string&)>& watch) {
    const ga::Stopwatch clock;
    const std::vector<ChartSetting> plan = chart_plan(extent);
    ChartData data;
    data.limit = extent.limit;
    const auto tell = [&](const std::string& what) {
        watch(data, std::to_string(data.runs.size() + data.left_out.size()) + " of " +
                        std::to_string(plan.size() * scenes.size()) + ", at most " +
                        duration_words(std::max(0.0, seconds - clock.seconds())) + " left: " + what);
    };
    if (extent.finest_map > 0) {
        tell("theories, profiles and maps");
        chart_models(data, extent.finest_map, stop);
    }
    std::vector<ChartTruth> truths;
    for (const ChartScene& scene : scenes) {
        tell("reference of " + scene.name);
        try {
            truths.push_back(truth_of(scene, extent.max_for_truth, stop));
        } catch (const rough::NotConverged&) {
            if (!stop())
                throw;
            truths.emplace_back(); // not used: the chart ends
        }
        data.scenes.push_back(scene);
        data.scenes.back().reference = truths.back().origin;
    }
    std::map<ChartSetting, ChartRun> last; // the run on the last grid, by the setting without its nodes
    for (ChartSetting setting : plan) {
        const bool is_late = setting.nodes > plan.front().nodes && clock.seconds() > seconds;
        for (setting.scene = 0; setting.scene < scenes.size(); ++setting.scene) {
            ChartSetting key = setting;
            key.nodes = 0;
            std::string why = reason_to_leave_out(setting, last[key], extent.limit);
            if (why.empty() && is_late)
                why = time_over;
            ChartRun run;
            if (why.empty() && !stop())
                run = run_chart(scenes[setting.scene], truths[setting.scene], setting, extent.limit, stop);
            if (stop())
                why = interrupted;
            if (!why.empty()) {
                data.left_out.push_back({setting, why});
                continue;
            }
            last[key] = run;
            data.runs.push_back(run);
            tell(scenes[setting.scene].name + ", " + name_of(setting.method) +
                 ", N = " + std::to_string(setting.nodes));
        }
    }
    return data;
}

Experiment chart_experiment() {
    return {.kind = "chart",
            .settings = {positive("chart.minutes", "10",
                                  "no setting starts after this time, except on the coarsest grid"),
                         {"chart.quick", "", "fewer and smaller grids: under a minute", true}},
            .files = {"chart.csv", "points.csv", "models.csv", "model_errors.csv"},
            .run = run_chart_experiment};
}

} // namespace app
