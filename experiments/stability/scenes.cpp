#include "domain/contact/kernel.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/theory/theory.hpp"
#include "experiments/stability/stability.hpp"

#include <numbers>

namespace app {
namespace {

using Eigen::VectorXd;
using rough::Body;
using rough::Index;
using rough::Kernel;

constexpr double length = 0.84942;
constexpr Index usual_nodes = 128;

/// A periodic self-affine profile with wavelengths down to four nodes.
VectorXd rough_heights(Index nodes) {
    const rough::Grid grid{nodes, length, true};
    const int waves = static_cast<int>(std::ceil(std::log(static_cast<double>(nodes) / 4) / std::log(1.5)));
    const auto all = rough::self_affine_waves(length, 0.05, 0.8, 1.5, waves, true);
    return sampled(grid, [&](double x) { return height_at(all, x); }).heights;
}

double range_of(const VectorXd& heights) { return heights.maxCoeff() - heights.minCoeff(); }

/// Scenes that are added on the same kernel, until another one is set.
struct SceneList {
    Kernel kernel = Kernel::free;
    std::vector<ContactScene> scenes = {};

    /// Delta_full on a periodic half-plane, otherwise the range of the heights.
    double reach_of(const VectorXd& heights) const {
        return kernel == Kernel::periodic ? (heights.maxCoeff() - heights.array()).mean() : range_of(heights);
    }

    /// Adds a scene with five steps to 0.9 of the reach, unless displacements are given.
    ContactScene& add(const std::string& name, const VectorXd& heights, const std::vector<double>& displacements = {}) {
        const Index nodes = heights.size();
        return scenes.emplace_back(ContactScene{
            .name = name,
            .profile = {heights, length / static_cast<double>(kernel == Kernel::periodic ? nodes : nodes - 1)},
            .body = completed(Body{.kernel = kernel}, length),
            .displacements = displacements.empty() ? even_steps(0.9 * reach_of(heights), 5) : displacements});
    }

    ContactScene& add_map(const std::string& name, rough::Extent shape, double contact, MapShape kind = MapShape::rough,
                          double stretch = 1) {
        return scenes.emplace_back(
            map_scene(name, {.kernel = kernel}, shape,
                      {.hurst = 0.8, .shortest = 6, .seed = 7, .shape = kind, .stretch = stretch}, contact));
    }

    /// Adds a line under loads that are shares of the load at 0.9 of the reach.
    ContactScene& add_loads(const std::string& name, const VectorXd& heights, const std::vector<double>& shares) {
        ContactScene& scene = add(name, heights, {0.9 * reach_of(heights)});
        const double heavy = solve_contact(scene.profile, scene.body, scene.displacements).steps[0].pressure;
        scene.displacements.clear();
        for (const double share : shares) scene.pressures.push_back(share * heavy);
        return scene;
    }
};

const std::pair<std::string, rough::Layering> layers[] = {
    {"hard-layer", {.layers = {{0.02 * length, 20, 0.3}}}},
    {"layer-on-rigid", {.layers = {{0.05 * length, 1, 0.3}}, .rigid_base = true}},
    {"rubber-on-rigid", {.layers = {{0.05 * length, 1, 0.499}}, .rigid_base = true}}};

/// Presses a scene to half of the load of full contact, and to a load below it by 1e-6 (relative).
void press_nearly_flat(ContactScene& scene) {
    const double full = full_contact_load(scene.profile, scene.body);
    scene.displacements.clear();
    scene.pressures = {0.5 * full, (1 - 1e-6) * full};
}

/// Lines under given loads, with layers and with a hardness.
void add_loaded_lines(SceneList& list) {
    const VectorXd rough = rough_heights(usual_nodes);
    list.add_loads("line-loads", rough, {1e-6, 1e-3, 0.1, 1});
    ContactScene& capped = list.add_loads("line-hardness", rough, {0.01, 0.1});
    capped.body.hardness = 2 * capped.pressures.back(); // half of the nodes carry the load at it
    if (list.kernel != Kernel::periodic) return;
    press_nearly_flat(list.add("line-near-full-load", rough));
    for (const auto& [layer, layering] : layers) {
        const std::string name = "line-" + layer;
        list.add_loads(name, rough, {0.01, 0.1, 0.5}).body.layering = layering;
        ContactScene& hard = list.add_loads(name + "-hardness", rough, {0.01, 0.1});
        hard.body.layering = layering;
        hard.body.hardness = 2 * hard.pressures.back();
        ContactScene& full = list.add(name + "-near-full-load", rough);
        full.body.layering = layering;
        press_nearly_flat(full);
    }
}

constexpr Kernel all_kernels[] = {Kernel::free, Kernel::periodic, Kernel::strip};

/// Light and full loads in few and in many steps.
void add_loadings(SceneList& list) {
    const VectorXd rough = rough_heights(usual_nodes);
    const double reach = list.reach_of(rough);
    list.add("first-touch", rough, {1e-12 * reach, 1e-9 * reach, 1e-6 * reach});
    list.add("zero-approach", rough, {0});
    list.add("single-step", rough, {0.9 * reach});
    std::vector<double> fine;
    for (int j = 0; j < 20; ++j) fine.push_back(reach * (0.5 + 1e-6 * j));
    list.add("step-1e-6", rough, fine);
    if (list.kernel == Kernel::periodic) {
        list.add("near-full-contact", rough, {0.9 * reach, 0.999 * reach, (1 - 1e-6) * reach});
        list.add("full-contact", rough, {0.5 * reach, reach});
    } else { // full contact needs a displacement far beyond the range of the heights
        list.add("near-full-contact", 0.02 * rough, {0.2 * reach, 0.25 * reach, 0.3 * reach});
        list.add("full-contact", 1e-3 * rough, {reach, 2 * reach});
    }
}

/// Shapes of the profile.
void add_shapes(SceneList& list) {
    const Index n = usual_nodes;
    const auto square = [](double x) { return x * x; };
    list.add("two-equal-summits", VectorXd::NullaryExpr(n, [&](Index i) {
                 const double x = 8 * static_cast<double>(i) / n;
                 return -0.05 * std::min(square(x - 2), square(x - 6));
             }));
    list.add("plateau", VectorXd::NullaryExpr(n, [](Index i) {
                 return -0.002 * static_cast<double>(std::max<Index>(0, std::abs(i - 60) - 10));
             }));
    list.add("one-node-out", VectorXd::NullaryExpr(n, [](Index i) { return i == 50 ? -0.1 : 0.0; }));
    list.add("nyquist-wave", VectorXd::NullaryExpr(n, [](Index i) { return i % 2 ? -0.01 : 0.01; }));
    list.add("beyond-nyquist", VectorXd::NullaryExpr(n, [](Index i) {
                 return 0.01 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / 1.3);
             }));
    VectorXd spike = rough_heights(n);
    spike[70] = spike.maxCoeff() + 10 * range_of(spike);
    list.add("spike", spike);
    list.add("saw-tooth", VectorXd::NullaryExpr(n, [](Index i) { return 0.004 * static_cast<double>(i % 16); }));
    const VectorXd flat = VectorXd::Constant(n, 0.3);
    list.add("flat", flat, {0.001, 0.01}).has_solution = list.kernel != Kernel::periodic;
    if (list.kernel == Kernel::periodic)
        list.add("periodic-jump", VectorXd::NullaryExpr(n, [&](Index i) {
                     return 0.05 * std::cos(10.7 * static_cast<double>(i) / n) - 0.001 * static_cast<double>(i);
                 }));
    list.add("nodes-2", Eigen::Vector2d(0, -0.01));
    list.add("nodes-3", Eigen::Vector3d(-0.02, 0, -0.01));
}

/// Very large and very small numbers, infinity and NaN.
void add_numbers(SceneList& list) {
    const VectorXd rough = rough_heights(usual_nodes);
    list.add("heights-1e-12", 1e-12 / range_of(rough) * rough);
    list.add("heights-1e12", 1e12 / range_of(rough) * rough);
    list.add("offset-1e6", (rough.array() + 1e6).matrix());
    list.add("denormal", 1e-310 * rough);
    list.add("modulus-1e-6", rough).body.effective_modulus = 1e-6;
    list.add("modulus-1e12", rough).body.effective_modulus = 1e12;
    const auto steps = even_steps(0.01, 2);
    VectorXd broken = rough;
    broken[40] = std::numeric_limits<double>::quiet_NaN();
    list.add("nan", broken, steps).has_solution = false;
    broken[40] = std::numeric_limits<double>::infinity();
    list.add("infinity", broken, steps).has_solution = false;
}

void add_bodies(SceneList& list) {
    const VectorXd rough = rough_heights(usual_nodes);
    list.kernel = Kernel::free;
    const double limit = rough::datum_limit({rough, length / (usual_nodes - 1)});
    list.add("datum-above-limit", rough).body.datum = limit * (1 + 1e-6);
    ContactScene& below = list.add("datum-below-limit", rough);
    below.body.datum = limit * (1 - 1e-6);
    below.has_solution = false;
    list.add("datum-below-L", rough).body.datum = 0.5 * length;
    list.kernel = Kernel::strip;
    ContactScene& narrow = list.add("narrow-strip", rough);
    narrow.body.strip_width = 1e-6 * narrow.profile.spacing;
    const VectorXd many = rough_heights(65536);
    for (const Kernel kernel : all_kernels) {
        list.kernel = kernel;
        const double share = kernel == Kernel::strip ? 0.9 : 0.25;
        list.add("nodes-65536", many, even_steps(share * list.reach_of(many), 2));
    }
}

/// Contact fractions of the loads, in words.
const std::pair<const char*, double> contacts[] = {{"0.1", 0.001}, {"1", 0.01},  {"10", 0.1},    {"45", 0.45},
                                                   {"90", 0.9},    {"99", 0.99}, {"99.9", 0.999}};

void add_maps(SceneList& list, bool large) {
    const auto at_loads = [&](const std::string& name, rough::Extent shape) {
        for (const auto& [percent, contact] : contacts) list.add_map(name + "-load-" + percent, shape, contact);
    };
    at_loads("map", {48, 48});
    for (const double contact : {0.1, 0.9}) {
        const std::string share = contact < 0.5 ? "-light" : "-heavy";
        list.add_map("map-odd" + share, {53, 37}, contact);
        list.add_map("map-long" + share, {16, 128}, contact);
        ContactScene& capped = list.add_map("map-hardness" + share, {40, 40}, contact);
        capped.body.hardness = 2 * capped.pressures[0]; // half of the nodes carry the load at it
        for (const auto& [shape, name] : {std::pair(MapShape::quantised, "quantised"),
                                          {MapShape::spiked, "spiked"},
                                          {MapShape::plateaued, "plateaued"},
                                          {MapShape::raised, "offset-1e6"}})
            list.add_map(std::string("map-") + name + share, {30, 30}, contact, shape);
        for (const double stretch : {0.1, 10.0})
            list.add_map((stretch > 1 ? "map-wide-cells" : "map-narrow-cells") + share, {30, 30}, contact,
                         MapShape::rough, stretch);
        if (list.kernel != Kernel::periodic) continue;
        for (const auto& layer : layers)
            list.add_map("map-" + layer.first + share, {48, 48}, contact).body.layering = layer.second;
    }
    if (list.kernel == Kernel::periodic) {
        press_nearly_flat(list.add_map("map-near-full-load", {30, 30}, 0.9));
        ContactScene& layered = list.add_map("map-hard-layer-near-full-load", {30, 30}, 0.9);
        layered.body.layering = layers[0].second;
        press_nearly_flat(layered);
    }
    if (large)
        for (const Index side : {256, 1024}) at_loads("map-" + std::to_string(side), {side, side});
}

/// Gives a map the extremes of a shape.
void reshape(VectorXd& heights, MapShape shape) {
    const double range = range_of(heights), lowest = heights.minCoeff();
    if (shape == MapShape::quantised) // as an instrument of 16 levels
        heights = (range / 16 * ((heights.array() - lowest) * 16 / range).round()).matrix();
    else if (shape == MapShape::spiked)
        heights[heights.size() / 3] += 3 * range;
    else if (shape == MapShape::plateaued) // a third of the range is worn off
        heights = heights.cwiseMin(lowest + 2 * range / 3);
    else if (shape == MapShape::raised)
        heights.array() += 1e6;
}

} // namespace

ContactScene map_scene(const std::string& name, const Body& body, rough::Extent shape, const SelfAffineMap& roughness,
                       double contact) {
    constexpr double slope = 0.1;
    const double spacing = length / static_cast<double>(shape.columns),
                 width = roughness.stretch * spacing * static_cast<double>(shape.rows);
    ContactScene scene{.name = name,
                       .profile = rough::realised(rough::SelfAffine{.hurst = roughness.hurst,
                                                                    .longest = 0.5 * length,
                                                                    .shortest = roughness.shortest * spacing,
                                                                    .rms_slope = slope},
                                                  rough::Grid{shape.columns, length, true, 0, shape.rows, width},
                                                  roughness.seed),
                       .body = body,
                       .displacements = {},
                       .pressures = {persson_load(contact, slope)}};
    reshape(scene.profile.heights, roughness.shape);
    if (body.kernel == Kernel::periodic)
        scene.pressures[0] = std::min(scene.pressures[0], 0.999 * full_contact_load(scene.profile, scene.body));
    return scene;
}

std::vector<ContactScene> stability_scenes(bool large) {
    SceneList list;
    for (const Kernel kernel : all_kernels) {
        list.kernel = kernel;
        add_loadings(list);
        add_shapes(list);
        add_numbers(list);
        add_loaded_lines(list);
    }
    add_bodies(list);
    for (const Kernel kernel : {Kernel::free, Kernel::periodic}) {
        list.kernel = kernel;
        add_maps(list, large);
    }
    return list.scenes;
}

} // namespace app
