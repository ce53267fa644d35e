#include "experiments/chart/chart.hpp"

#include "domain/mwm/test_surfaces.hpp"
#include "domain/response/curve.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/theory/theory.hpp"

#include <numbers>

namespace app {

using Eigen::VectorXd;
using rough::Index;
using rough::Profile;

namespace {

using std::numbers::pi;
constexpr double longest_wave = 0.84942; ///< mm
constexpr std::size_t counted = ChartScene::counted;
constexpr double slope = 0.1; ///< rms slope of the self-affine scenes

/// Loads over two decades.
std::vector<double> decades(double last) {
    std::vector<double> pressures;
    for (std::size_t j = 0; j < counted; ++j)
        pressures.push_back(last * std::pow(10, -2 + 2.0 * static_cast<double>(j) / (counted - 1)));
    return pressures;
}

/// A line over 1 mm with an exact solution for each half-width of the contact (mm), at most 0.4.
ChartScene exact_scene(const std::string& name, const std::string& words, rough::Kernel kernel,
                       const std::function<double(double)>& height, const std::function<double(double)>& width,
                       const std::function<rough::LoadStep(double)>& contact) {
    ChartScene scene{name, words, {}, false, {}, decades(contact(0.4).pressure)};
    scene.body.kernel = kernel;
    scene.body.datum = 1;
    scene.on = [kernel, height](Index nodes) {
        return rough::sampled({nodes, 1, kernel == rough::Kernel::periodic}, height);
    };
    scene.exact = [width, contact](double pressure) { return contact(width(pressure)); };
    return scene;
}

ChartScene of_waves(const std::string& name, const std::string& words, const std::vector<rough::Wave>& waves) {
    ChartScene scene{name, words, {}, false, {}, {}};
    scene.body.datum = longest_wave;
    scene.on = [waves](Index nodes) {
        return rough::sampled({nodes, longest_wave, false}, [&](double x) { return height_at(waves, x); });
    };
    const Profile coarse = scene.on(513);
    const double last = 0.6 * (coarse.heights.maxCoeff() - coarse.heights.minCoeff());
    scene.pressures = decades(solve_contact(coarse, scene.body, {last}).steps[0].pressure);
    return scene;
}

/// A self-affine line or map over 1 mm.
Profile self_affine(Index side, bool is_map, double longest, double shortest, std::uint64_t seed) {
    rough::Grid grid{.nodes = side, .length = 1, .periodic = true};
    if (is_map) grid.rows = side, grid.width = 1;
    return realised({.hurst = 0.8, .longest = longest, .shortest = shortest, .rms_slope = slope, .is_2d = is_map}, grid,
                    seed);
}
Profile map_on(Index side) { return self_affine(side, true, 0.25, 1.0 / 16, 1); }

/// A random periodic surface, pressed to 0.1 to 99.9 % in contact by Persson's theory. Loads of 1 to 90 % count.
ChartScene random_scene(const std::string& name, const std::string& words, bool is_map,
                        const std::function<Profile(Index)>& on) {
    ChartScene scene{name, words, {}, is_map, on, {}, 2};
    scene.body.kernel = rough::Kernel::periodic;
    const Profile surface = on(is_map ? 128 : 4096);
    const double gradient = rms_slope(random_surface(surface, true));
    for (const double contact : {0.001, 0.003, 0.01, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 0.97, 0.99, 0.999}) {
        const double pressure = persson_load(contact, gradient);
        if (scene.pressures.size() < scene.first + counted || pressure < 0.99 * full_contact_load(surface, scene.body))
            scene.pressures.push_back(pressure);
    }
    return scene;
}

/// The answers of load steps, followed by NaN up to this number of loads.
ChartCurve curve_of(const std::vector<rough::LoadStep>& steps, std::size_t loads) {
    const VectorXd none = VectorXd::Constant(static_cast<Index>(loads), NAN);
    ChartCurve curve{none, none, none};
    for (std::size_t j = 0; j < steps.size(); ++j) {
        const auto at = static_cast<Index>(j);
        curve.displacement[at] = steps[j].displacement;
        curve.contact_fraction[at] = steps[j].contact_fraction;
        curve.stiffness[at] = steps[j].tangent_stiffness;
    }
    return curve;
}

/// Solves a surface at pressures. Those beyond full contact have no answer, and neither have those after them.
ChartCurve solved(const Profile& surface, const rough::Body& body, const std::vector<double>& pressures,
                  const rough::ContactOptions& options, long* iterations = nullptr) {
    std::vector<double> loads = pressures;
    if (body.kernel == rough::Kernel::periodic)
        std::erase_if(loads, [full = full_contact_load(surface, body)](double load) { return load >= full; });
    if (loads.empty()) return curve_of({}, pressures.size());
    const rough::ContactCurve found = solve_contact_at_pressures(surface, body, loads, options);
    if (iterations) *iterations = found.iterations;
    return curve_of(found.steps, pressures.size());
}

/// Values at the loads `at`, interpolated linearly in the logarithms of loads and values.
VectorXd between(const std::vector<double>& loads, const VectorXd& values, const std::vector<double>& at) {
    const VectorXd x = VectorXd::Map(loads.data(), values.size()).array().log();
    const rough::Curve curve{x, values.array().log(), x[0], x.tail(1)[0]};
    VectorXd result(static_cast<Index>(at.size()));
    for (std::size_t j = 0; j < at.size(); ++j) result[static_cast<Index>(j)] = std::exp(curve.at(std::log(at[j])));
    return result;
}

double root_mean_square(const VectorXd& values) {
    return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

/// The relative differences of two curves at the loads that count; 1 without an answer.
VectorXd differences(const ChartScene& scene, const VectorXd& found, const VectorXd& right) {
    const auto from = static_cast<Index>(scene.first), count = static_cast<Index>(counted);
    const VectorXd off = found.segment(from, count).array() / right.segment(from, count).array() - 1;
    return off.unaryExpr([](double one) { return std::isfinite(one) ? one : 1; });
}

/// The reference of a scene from at least three grids. Each has twice the nodes of the last one along each
/// side, on a line four times. A further grid is solved only if it is useful and its time is within a limit.
/// This time is at most eight times that of the last grid.
ChartReference refined_reference(const ChartScene& scene, const rough::ContactOptions& options, double limit) {
    ChartReference reference;
    std::vector<ChartCurve> curves;
    double seconds = 0;
    const auto is_worth = [&] {
        return reference.side < (scene.is_map ? 1024 : 131072) && 8 * seconds < limit &&
               std::max(reference.floor_stiffness, reference.floor_contact) > 1e-4;
    };
    while (curves.size() < 3 || is_worth()) {
        const ga::Stopwatch clock;
        reference.side = curves.empty() ? (scene.is_map ? 32 : 512) : reference.side * (scene.is_map ? 2 : 4);
        curves.push_back(solved(scene.on(reference.side), scene.body, scene.pressures, options));
        if (const std::size_t n = curves.size(); n > 2) {
            const auto change = [&](std::size_t grid, auto value) {
                return root_mean_square(differences(scene, curves[grid].*value, curves[grid + 1].*value));
            };
            const auto remaining = [&](auto value) {
                return remaining_error(change(n - 3, value), change(n - 2, value), scene.is_map ? 0.5 : 0.25);
            };
            reference.floor_stiffness = remaining(&ChartCurve::stiffness);
            reference.floor_contact = remaining(&ChartCurve::contact_fraction);
        }
        seconds = clock.seconds();
    }
    reference.curve = curves.back();
    return reference;
}

} // namespace

ChartReference exact_reference(const ChartScene& scene) {
    std::vector<rough::LoadStep> steps;
    std::ranges::transform(scene.pressures, std::back_inserter(steps), scene.exact);
    return {curve_of(steps, steps.size())};
}

double remaining_error(double before, double last, double min_ratio) {
    const double ratio = before > 0 ? std::clamp(last / before, min_ratio, 0.75) : 0.75;
    return last * ratio / (1 - ratio);
}

std::vector<ChartScene> chart_scenes() {
    const auto mwm = [](double hurst, double gamma, int count) {
        return rough::self_affine_waves(longest_wave, 0.05, hurst, gamma, count);
    };
    return {
        random_scene("self-affine-map", "an isotropic self-affine map, H = 0.8, waves from L/4 to L/16", true, map_on),
        random_scene("ground-map",
                     "a ground map: ridges along y, with a tenth of the isotropic map's roughness on them", true,
                     [](Index side) {
                         Profile map = map_on(side);
                         const Profile ridges = self_affine(side, false, 0.25, 1.0 / 16, 2);
                         map.heights = 0.1 * map.heights + ridges.heights.replicate(side, 1);
                         return map;
                     }),
        random_scene("self-affine-line", "a periodic self-affine profile, H = 0.8, waves from L/32 to L/256", false,
                     [](Index nodes) { return self_affine(nodes, false, 1.0 / 32, 1.0 / 256, 1); }),
        of_waves("mwm-smooth", "a smooth Weierstrass-Mandelbrot profile, H = 1.2, γ = 1.7, 8 waves", mwm(1.2, 1.7, 8)),
        of_waves("mwm-rough", "a rough Weierstrass-Mandelbrot profile, H = 0.6, γ = 1.5, 11 waves", mwm(0.6, 1.5, 11)),
        of_waves("fractional-brownian", "a fractional-Brownian profile, H = 0.8, 64 waves",
                 rough::brownian_waves(longest_wave, 0.05, 0.8, 64)),
        exact_scene(
            "hertz", "a Hertz parabola, contact growing to 80 % of the length", rough::Kernel::free,
            [](double x) { return -(x - 0.5) * (x - 0.5) / 2; },
            [](double pressure) { return std::sqrt(4 * pressure / pi); },
            [](double a) { // R = 1 mm, E* = 1 MPa, d = 1 mm (Johnson 1985, ch. 4)
                const double ratio = std::log(2 / a);
                return rough::LoadStep{.displacement = a * a / 2 * (ratio + 0.5),
                                       .pressure = pi * a * a / 4,
                                       .tangent_stiffness = pi / (2 * ratio),
                                       .contact_fraction = 2 * a};
            }),
        exact_scene(
            "westergaard", "Westergaard's wave, periodic, contact growing to 80 %", rough::Kernel::periodic,
            [](double x) { return std::cos(2 * pi * (x - 0.5)) - 1; },
            [](double pressure) { return std::asin(std::sqrt(pressure / pi)) / pi; },
            [](double a) { // amplitude 1 mm, E* = 1 MPa (Westergaard 1939)
                const double s = std::sin(pi * a), log_s = std::log(s);
                return rough::LoadStep{.displacement = 2 * s * s * (0.5 - log_s),
                                       .pressure = pi * s * s,
                                       .tangent_stiffness = -pi / (2 * log_s),
                                       .contact_fraction = 2 * a};
            })};
}

void measure_errors(const ChartScene& scene, const ChartReference& reference, ChartRun& run) {
    const ChartCurve &found = run.curve, &right = reference.curve;
    const auto from = static_cast<Index>(scene.first), count = static_cast<Index>(counted);
    run.error_stiffness =
        root_mean_square(differences(scene, found.stiffness, right.stiffness)) + reference.floor_stiffness;
    run.error_contact =
        root_mean_square(differences(scene, found.contact_fraction, right.contact_fraction)) + reference.floor_contact;
    run.answered = static_cast<int>(
        (found.contact_fraction.array() + found.stiffness.array()).segment(from, count).isFinite().count());
    if (scene.first > 0) // displacements of random surfaces depend on their single highest node
        return;
    // To first order, a displacement that is off by d changes the pressure at the right one by K d.
    const VectorXd pressure = VectorXd::Map(scene.pressures.data() + scene.first, count);
    run.error_pressure = root_mean_square(
        ((found.displacement - right.displacement).array() * right.stiffness.array()).segment(from, count) /
        pressure.array());
}

ChartRun run_chart(const ChartScene& scene, const ChartReference& reference, const ChartSetting& setting,
                   const Stop& stop) {
    ChartRun run;
    run.setting = setting;
    const auto begin = scene.pressures.begin() + static_cast<std::ptrdiff_t>(scene.first);
    const std::vector<double> loads(begin, begin + static_cast<std::ptrdiff_t>(counted));
    Profile surface = scene.on(setting.side);
    const auto [columns, rows] = surface.shape();
    if (setting.method == "section")
        surface = {VectorXd(surface.heights.head(columns)), surface.spacing};
    else if (setting.method == "mean-line")
        surface = {VectorXd(surface.heights.reshaped(columns, rows).rowwise().mean()), surface.spacing};
    const bool is_theory = setting.family == "theory";
    const auto& names = is_theory ? rough::theory_names() : rough::solver_names();
    const auto which = std::ranges::find(names, setting.method) - names.begin();
    rough::ContactOptions options;
    options.stop = stop;
    if (!is_theory && setting.method != "section" && setting.method != "mean-line")
        options.solver = static_cast<rough::Solver>(which);
    if (setting.tolerance > 0) options.tolerance = setting.tolerance;
    const auto answer = [&](const std::vector<double>& at) {
        if (!is_theory) return solved(surface, scene.body, at, options, &run.iterations);
        const auto found =
            predicted_curve(static_cast<rough::Theory>(which), random_surface(surface, true),
                            scene.body.effective_modulus, VectorXd::Map(at.data(), static_cast<Index>(at.size())));
        return ChartCurve{VectorXd::Constant(found.pressure.size(), NAN), found.contact_fraction, found.stiffness};
    };
    std::vector<double> at;
    for (std::size_t j = 0; j < counted; j += (counted - 1) / static_cast<std::size_t>(setting.loads - 1))
        at.push_back(loads[j]);
    try {
        run.curve = curve_of({}, scene.pressures.size());
        if (scene.is_map && setting.loads == counted && setting.tolerance == 0 &&
            (setting.method == "auto" || setting.family != "map"))
            run.curve = answer(scene.pressures); // lighter and heavier loads, too
        ChartCurve curve;
        run.seconds = lowest_seconds([&] { curve = answer(at); });
        for (VectorXd ChartCurve::*value :
             {&ChartCurve::displacement, &ChartCurve::contact_fraction, &ChartCurve::stiffness})
            (run.curve.*value).segment(static_cast<Index>(scene.first), counted) =
                setting.loads == counted ? curve.*value : between(at, curve.*value, loads);
        measure_errors(scene, reference, run);
    } catch (const rough::InputError& error) {
        run.outcome = Outcome::refused, run.message = error.what();
    } catch (const rough::NotConverged& error) {
        run.outcome = Outcome::not_converged, run.message = error.what();
    }
    return run;
}

namespace {

/// All settings of a scene whose reference has `side` nodes along each side (0: exact).
std::vector<ChartSetting> chart_plan(const ChartScene& scene, std::size_t index, Index side) {
    std::vector<ChartSetting> plan;
    const std::string family = scene.is_map ? "map" : "profile";
    const auto add = [&](const std::string& of, const std::string& method, Index nodes, int loads = counted,
                         double tolerance = 0) {
        plan.push_back({index, of, method, nodes, loads, tolerance});
    };
    const Index middle = scene.is_map ? 64 : 512, theory_side = scene.is_map ? 128 : 4096,
                finest = side == 0 ? 16384 : side / (scene.is_map ? 2 : 4);
    for (const std::string& theory : rough::theory_names())
        if (scene.first > 0 &&
            holds_for(static_cast<rough::Theory>(&theory - rough::theory_names().data()), scene.is_map))
            add("theory", theory, theory_side);
    if (scene.is_map)
        for (const char* line : {"section", "mean-line"}) add("profile", line, finest);
    for (Index nodes = scene.is_map ? 32 : 128; nodes <= finest; nodes *= 2) {
        add(family, "auto", nodes);
        if (nodes != middle && nodes != (scene.is_map ? 2 : 4) * middle) continue;
        for (const int loads : {5, 3}) add(family, "auto", nodes, loads);
        for (const rough::Solver solver :
             {rough::Solver::nested, rough::Solver::active_set, rough::Solver::polonsky_keer, rough::Solver::nnls})
            if (nodes == middle && !(scene.is_map && solver == rough::Solver::nnls))
                add(family, name_of(solver), nodes);
    }
    add(family, scene.is_map ? "auto" : "active-set", middle, counted, 1e-3);
    return plan;
}

/// Refines the reference of each scene for at most half of `seconds` of wall time, then measures settings
/// from coarse to fine on all scenes. Three coarse grids of a reference are always solved, and the first
/// setting is always measured. `watch` gets the results so far and words about the next step.
ChartData charted(const std::vector<ChartScene>& scenes, double seconds, const Stop& stop, int threads,
                  const std::function<void(const ChartData&, const std::string&)>& watch) {
    const ga::Stopwatch clock;
    ChartData data;
    const auto tell = [&](const std::string& what) {
        watch(data, "at most " + duration_words(std::max(0.0, seconds - clock.seconds())) + " left: " + what);
    };
    rough::ContactOptions options;
    options.threads = threads;
    options.stop = stop;
    for (std::size_t s = scenes.size(); s-- > 0 && !stop();) { // maps last: they take what lines leave
        tell("reference of " + scenes[s].name);
        ChartReference reference;
        try {
            const double limit =
                (0.5 * seconds - clock.seconds()) / static_cast<double>(std::min<std::size_t>(s + 1, 3));
            reference = scenes[s].exact ? exact_reference(scenes[s]) : refined_reference(scenes[s], options, limit);
        } catch (const rough::NotConverged&) {
            break; // stopped
        }
        data.scenes.insert(data.scenes.begin(), scenes[s]);
        data.references.insert(data.references.begin(), std::move(reference));
    }
    std::vector<ChartSetting> plan; // in turns, one setting of each scene
    for (std::size_t turn = 0, left = 1; left > 0; ++turn) {
        left = 0;
        for (std::size_t s = 0; s < data.scenes.size(); ++s)
            if (const auto own = chart_plan(data.scenes[s], s, data.references[s].side); turn < own.size())
                plan.push_back(own[turn]), ++left;
    }
    const auto is_over = [&] { return stop() || (!data.runs.empty() && clock.seconds() > seconds); };
    for (const ChartSetting& setting : plan) {
        tell(data.scenes[setting.scene].name + ", " + setting.method + ", " + std::to_string(setting.side));
        ChartRun run;
        if (!is_over()) run = run_chart(data.scenes[setting.scene], data.references[setting.scene], setting, is_over);
        if (std::isnan(run.seconds) && (run.outcome == Outcome::solved || is_over()))
            ++data.not_measured;
        else
            data.runs.push_back(std::move(run));
    }
    data.interrupted = stop();
    return data;
}

Findings run_chart_experiment(const Settings& settings, const RunConditions& conditions) {
    ga::Stopwatch since_written;
    const auto watch = [&](const ChartData& so_far, const std::string& where) {
        conditions.progress.show(where);
        if (so_far.runs.empty() || since_written.seconds() < 3) return;
        rough::write_atomically(conditions.folder / "chart.csv", chart_table(so_far).text());
        since_written = {};
    };
    const double minutes = settings.is_on("chart.quick") ? std::min(1.0, settings.number("chart.minutes"))
                                                         : settings.number("chart.minutes");
    const ChartData data = charted(
        chart_scenes(), 60 * minutes, [&] { return conditions.stop.load(); }, conditions.origin.threads, watch);
    return data.runs.empty() ? Findings() : findings_of(data);
}

} // namespace

Experiment chart_experiment() {
    return {.kind = "chart",
            .settings = {positive("chart.minutes", "5", "no setting starts after this time"),
                         {"chart.quick", "", "at most one minute: coarser references and fewer grids", true}},
            .files = {"chart.csv", "points.csv", "axes.csv", "loads.csv"},
            .run = run_chart_experiment};
}

} // namespace app
