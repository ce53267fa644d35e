#include "apps/experiments/solvers/chart.hpp"
#include "domain/errors.hpp"
#include "domain/profile/roughness.hpp"

#include <cmath>

namespace app {

namespace {

using Eigen::VectorXd;
using rough::Index;
using rough::Profile;

/// A self-affine line or map over 1 mm. The waves of a map have 8 nodes of 128 at least; those of a line are
/// shorter, as it has to be longer.
Profile self_affine(Index nodes, bool is_map, double longest, double shortest, std::uint64_t seed) {
    rough::Grid grid{.nodes = nodes, .length = 1, .periodic = true};
    if (is_map)
        grid.rows = nodes, grid.width = 1;
    return realised(
        {.hurst = 0.8, .longest = longest, .shortest = shortest, .rms_slope = 0.1, .is_area = is_map}, grid,
        seed);
}
Profile line_on(Index nodes) { return self_affine(nodes, false, 1.0 / 32, 1.0 / 256, 1); }
Profile map_on(Index side) { return self_affine(side, true, 0.25, 1.0 / 16, 1); }

/// Ridges along y, of the map's cut-offs, and a tenth of the map.
Profile ground_on(Index side) {
    Profile map = map_on(side);
    map.heights = 0.1 * map.heights + self_affine(side, false, 0.25, 1.0 / 16, 2).heights.replicate(side, 1);
    return map;
}

/// Contact fraction and stiffness at pressures; NaN beyond full contact.
rough::TheoryCurve pressed(const Profile& surface, const VectorXd& pressures) {
    rough::Body body;
    body.kernel = rough::Kernel::periodic;
    const VectorXd none = VectorXd::Constant(pressures.size(), std::nan(""));
    rough::TheoryCurve answer{pressures, none, none, none};
    std::vector<double> loads(pressures.begin(), pressures.end());
    rough::ContactCurve curve;
    for (; !loads.empty() && curve.steps.empty(); loads.pop_back()) // the heaviest may be beyond full contact
        try {
            curve = solve_contact_at_pressures(surface, body, loads);
        } catch (const rough::InputError&) {
        }
    for (std::size_t j = 0; j < curve.steps.size(); ++j) {
        answer.contact_fraction[static_cast<Index>(j)] = curve.steps[j].contact_fraction;
        answer.stiffness[static_cast<Index>(j)] = curve.steps[j].tangent_stiffness;
    }
    return answer;
}

/// A scene and every model of it.
ModelScene modelled(const Stop& stop, const std::string& name, const std::string& words, Profile (*on)(Index),
                    Index finest, const std::vector<Index>& coarser) {
    const Profile surface = on(finest);
    const bool is_map = surface.is_2d();
    const rough::RandomSurface random = random_surface(surface, true);
    ModelScene scene{name,
                     words,
                     "this surface on " + std::to_string(finest) +
                         (is_map ? " x " + std::to_string(finest) : "") + " nodes",
                     rms_slope(random),
                     std::sqrt(spectral_moments(random).m0),
                     is_map ? texture(surface, true).Str : 0};
    constexpr int loads = 12;
    constexpr double lightest = 0.005, heaviest = 1.6; // erf of it over sqrt 2 is what touches
    const VectorXd pressure =
        scene.rms_slope / 2 *
        VectorXd::LinSpaced(loads, std::log(lightest), std::log(heaviest)).array().exp();
    scene.exact = pressed(surface, pressure);
    const auto measure = [&](const char* family, const std::string& model, Index nodes, auto work) {
        if (stop())
            return;
        ModelRun run{.family = family, .model = model, .nodes = nodes};
        run.seconds = lowest_seconds([&] { run.curve = work(); });
        run.area_errors = run.curve.contact_fraction.array() / scene.exact.contact_fraction.array() - 1;
        run.stiffness_errors = run.curve.stiffness.array() / scene.exact.stiffness.array() - 1;
        run.area_error = root_mean_square(run.area_errors);
        run.stiffness_error = root_mean_square(run.stiffness_errors);
        scene.runs.push_back(std::move(run));
    };
    for (const std::string& theory : rough::theory_names()) {
        const auto which = static_cast<rough::Theory>(&theory - rough::theory_names().data());
        if (holds_for(which, is_map))
            measure("theories", theory, 0, [&] { return predicted_curve(which, random, 1, pressure); });
    }
    if (is_map) {
        const auto [columns, rows] = surface.shape();
        const Profile section{surface.heights.head(columns), surface.spacing},
            mean_line{surface.heights.reshaped(columns, rows).rowwise().mean(), surface.spacing};
        measure("one line", "section", finest, [&] { return pressed(section, pressure); });
        measure("one line", "mean-line", finest, [&] { return pressed(mean_line, pressure); });
    }
    for (const Index nodes : coarser) {
        const Profile coarse = on(nodes);
        measure("solved", is_map ? "map" : "profile", coarse.nodes(),
                [&] { return pressed(coarse, pressure); });
    }
    return scene;
}

} // namespace

std::vector<ModelScene> charted_models(Index finest, const Stop& stop) {
    std::vector<ModelScene> scenes;
    const auto add = [&](const char* name, const char* words, Profile (*on)(Index), Index exact,
                         const std::vector<Index>& coarser) {
        if (!stop())
            scenes.push_back(modelled(stop, name, words, on, exact, coarser));
    };
    add("self-affine-line", "a self-affine profile, H = 0.8, waves from L/32 to L/256", line_on, 4096,
        {512, 1024, 2048});
    std::vector<Index> sides;
    for (Index side = 32; side < finest; side *= 2)
        sides.push_back(side);
    add("self-affine-map", "an isotropic self-affine map, H = 0.8, waves from L/4 to L/16", map_on, finest,
        sides);
    add("ground-map",
        "ridges along y, self-affine across, with a tenth of the isotropic map's roughness on them",
        ground_on, finest, sides);
    return scenes;
}

double root_mean_square(const VectorXd& errors) {
    double sum = 0;
    int count = 0;
    for (const double error : errors)
        if (std::isfinite(error))
            sum += error * error, ++count;
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

} // namespace app
