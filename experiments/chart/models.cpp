#include "domain/profile/roughness.hpp"
#include "domain/theory/theory.hpp"
#include "experiments/chart/chart.hpp"

namespace app {

namespace {

using Eigen::VectorXd;
using nlohmann::json;
using rough::Index;
using rough::Profile;

/// A self-affine line or map over 1 mm. The waves of a map have 8 nodes of 128 at least; those of a line are
/// shorter, as it has to be longer.
Profile self_affine(Index nodes, bool is_map, double longest, double shortest, std::uint64_t seed) {
    rough::Grid grid{.nodes = nodes, .length = 1, .periodic = true};
    if (is_map)
        grid.rows = nodes, grid.width = 1;
    return realised(
        {.hurst = 0.8, .longest = longest, .shortest = shortest, .rms_slope = 0.1, .is_2d = is_map}, grid,
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
rough::TheoryCurve solved_curve(const Profile& surface, const VectorXd& pressures) {
    rough::Body body;
    body.kernel = rough::Kernel::periodic;
    const VectorXd none = VectorXd::Constant(pressures.size(), std::nan(""));
    rough::TheoryCurve answer{pressures, none, none};
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

constexpr double fair = 0.2; ///< a model holds up to this error

/// The range of contact fractions around the lowest error in which errors stay fair; null if it is empty.
json fair_range(const VectorXd& errors, const VectorXd& fractions) {
    Index best = -1;
    for (Index j = 0; j < errors.size(); ++j)
        if (std::isfinite(errors[j]) && (best < 0 || std::abs(errors[j]) < std::abs(errors[best])))
            best = j;
    if (best < 0 || !(std::abs(errors[best]) <= fair))
        return {};
    Index from = best, to = best;
    while (from > 0 && std::abs(errors[from - 1]) <= fair)
        --from;
    while (to + 1 < errors.size() && std::abs(errors[to + 1]) <= fair)
        ++to;
    return {{"from", fractions[from]}, {"to", fractions[to]}};
}

/// Adds a scene and every model of it.
void add_scene(ChartData& data, const Stop& stop, const std::string& name, const std::string& words,
               Profile (*on)(Index), Index finest, const std::vector<Index>& coarser) {
    Csv &loads = data.models.table("models.csv",
                                   "scene,model,nodes,seconds,pressure_MPa,contact_fraction,"
                                   "stiffness_MPa_per_mm,error_contact,error_stiffness",
                                   6),
        &errors = data.models.table("model_errors.csv",
                                    "scene,family,model,nodes,answers,loads,area,stiffness,seconds", 6);
    if (stop())
        return;
    const Profile surface = on(finest);
    const bool is_map = surface.is_2d();
    const rough::RandomSurface random = random_surface(surface, true);
    const double slope = rms_slope(random); // for a map the rms gradient
    json& facts = data.models.result;
    facts["model_scenes"].push_back(
        {{"name", name},
         {"words", words},
         {"reference", "this surface on " + std::to_string(finest) +
                           (is_map ? " x " + std::to_string(finest) : "") + " nodes"},
         {"rms_slope", slope}});
    constexpr int load_count = 12;
    constexpr double lightest = 0.005, heaviest = 1.6; // erf of it over sqrt 2 is what touches
    const VectorXd pressure =
        slope / 2 * VectorXd::LinSpaced(load_count, std::log(lightest), std::log(heaviest)).array().exp();
    const rough::TheoryCurve exact = solved_curve(surface, pressure);
    json line{{"scene", name}}; // the line along the lay, one section, and the coarsest grid within 3 %
    double grid_error = HUGE_VAL;
    const auto measure = [&](const std::string& family, const std::string& model, Index nodes, auto work) {
        if (stop())
            return;
        rough::TheoryCurve curve; // NaN without an answer
        const double seconds = lowest_seconds([&] { curve = work(); });
        const VectorXd area = curve.contact_fraction.array() / exact.contact_fraction.array() - 1,
                       stiffness = curve.stiffness.array() / exact.stiffness.array() - 1;
        const double area_error = root_mean_square(area), stiffness_error = root_mean_square(stiffness);
        for (Index j = 0; j < load_count; ++j)
            loads.row(name, model, nodes, seconds, pressure[j], curve.contact_fraction[j], curve.stiffness[j],
                      area[j], stiffness[j]);
        errors.row(name, family, model, nodes, curve.contact_fraction.array().isFinite().count(), load_count,
                   area_error, stiffness_error, seconds);
        const double fraction_error = root_mean_square(curve.contact_fraction - exact.contact_fraction);
        data.model_runs.push_back({{"scene", name},
                                   {"kernel", name_of(rough::Kernel::periodic)},
                                   {"method", model},
                                   {"nodes", nodes},
                                   {"steps", load_count},
                                   {"tolerance", 0.0},
                                   {"seconds", seconds},
                                   {"error_stiffness", stiffness_error},
                                   {"error_contact", fraction_error}, // not relative, as for solvers
                                   {"iterations", 0},
                                   {"outcome", name_of(Outcome::solved)}});
        const json row{
            {"area", area_error}, {"stiffness", stiffness_error}, {"seconds", seconds}, {"nodes", nodes}};
        const double error = std::max(area_error, stiffness_error);
        if (family == "theories")
            facts["theories"].push_back({{"scene", name},
                                         {"theory", model},
                                         {"seconds", seconds},
                                         {"area", fair_range(area, exact.contact_fraction)},
                                         {"stiffness", fair_range(stiffness, exact.contact_fraction)}});
        else if (model == "section")
            line["section"] = row;
        else if (model == "mean-line")
            line.update({{"line", row}, {"line_is_enough", error <= fair}});
        else if (grid_error >= 0.03)
            line["map"] = row, grid_error = error;
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
        measure("one line", "section", finest, [&] { return solved_curve(section, pressure); });
        measure("one line", "mean-line", finest, [&] { return solved_curve(mean_line, pressure); });
    }
    for (const Index nodes : coarser) {
        const Profile coarse = on(nodes);
        measure("solved", is_map ? "map" : "profile", coarse.nodes(),
                [&] { return solved_curve(coarse, pressure); });
    }
    if (line.contains("line") && line.contains("section") && line.contains("map")) {
        line["aspect_ratio"] = texture(surface, true).Str;
        facts["lines"].push_back(line);
    }
}

} // namespace

void chart_models(ChartData& data, Index finest, const Stop& stop) {
    data.models.result = {{"theories", json::array()}, {"lines", json::array()}};
    add_scene(data, stop, "self-affine-line", "a self-affine profile, H = 0.8, waves from L/32 to L/256",
              line_on, 4096, {512, 1024, 2048});
    std::vector<Index> sides;
    for (Index side = 32; side < finest; side *= 2)
        sides.push_back(side);
    add_scene(data, stop, "self-affine-map", "an isotropic self-affine map, H = 0.8, waves from L/4 to L/16",
              map_on, finest, sides);
    add_scene(data, stop, "ground-map",
              "ridges along y, self-affine across, with a tenth of the isotropic map's roughness on them",
              ground_on, finest, sides);
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
