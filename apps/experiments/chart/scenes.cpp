#include "apps/experiments/chart/scenes.hpp"

#include "apps/report/units.hpp"
#include "domain/contact/exact.hpp"
#include "domain/mwm/test_surfaces.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace app {

namespace {

using Eigen::VectorXd;
using rough::Index;

constexpr double pi = std::numbers::pi;
constexpr int points = 20000;
constexpr double wave_length = 0.84942; ///< mm, of the longest wave

ChartTruth exact_curve(const std::function<rough::exact::Contact(double)>& contact, double widest,
                       double length) {
    ChartTruth truth;
    for (VectorXd* column : {&truth.displacement, &truth.pressure, &truth.stiffness, &truth.fraction})
        *column = VectorXd::Zero(points + 1);
    for (int k = 1; k <= points; ++k) {
        const double a = widest * k / points;
        const rough::exact::Contact c = contact(a);
        truth.displacement[k] = c.displacement;
        truth.pressure[k] = c.load / length;
        truth.stiffness[k] = c.stiffness / length;
        truth.fraction[k] = 2 * a / length;
    }
    truth.origin = "the exact solution";
    truth.finest_verified = std::numeric_limits<Index>::max();
    return truth;
}

ChartScene hertz() {
    const double radius = 1, widest = 0.4;
    const rough::exact::HalfPlane body{1, 1};
    auto contact = [=](double a) { return rough::exact::parabola(radius, a, body); };
    ChartScene scene{"hertz", "a Hertz parabola, contact growing to 80 % of the length", {}, 1, {}, 0, {}};
    scene.body.datum = body.datum;
    scene.height = [=](double x) { return -(x - 0.5) * (x - 0.5) / (2 * radius); };
    scene.last = contact(widest).displacement;
    scene.exact = [=] { return exact_curve(contact, widest, 1); };
    return scene;
}

ChartScene westergaard() {
    const double widest = 0.4;
    auto contact = [](double a) { return rough::exact::wave(1, 1, a, 1); };
    ChartScene scene{
        "westergaard", "Westergaard's wave, periodic, contact growing to 80 %", {}, 1, {}, 0, {}};
    scene.body.kernel = rough::Kernel::periodic;
    scene.height = [](double x) { return std::cos(2 * pi * (x - 0.5)) - 1; };
    scene.last = contact(widest).displacement;
    scene.exact = [=] { return exact_curve(contact, widest, 1); };
    return scene;
}

ChartScene of_waves(const std::string& name, const std::string& words, std::vector<rough::Wave> waves) {
    ChartScene scene{name, words, {}, wave_length, {}, 0, {}};
    scene.height = [waves = std::move(waves)](double x) { return height_at(waves, x); };
    const VectorXd heights = scene.profile(65537).heights;
    scene.last = 0.6 * (heights.maxCoeff() - heights.minCoeff());
    return scene;
}

ChartScene weierstrass(const std::string& name, const std::string& words, double hurst, double gamma,
                       int count) {
    return of_waves(name, words, rough::self_affine_waves(wave_length, 0.05, hurst, gamma, count));
}

ChartScene brownian() {
    return of_waves("fractional-brownian", "a fractional-Brownian profile, H = 0.8, 64 waves",
                    rough::brownian_waves(wave_length, 0.05, 0.8, 64));
}

ChartTruth refined(const ChartScene& scene, Index nodes, int steps, const std::function<bool()>& stop) {
    rough::ContactOptions options;
    options.stop = stop;
    const rough::ContactCurve curve =
        solve_contact(scene.profile(nodes), scene.body, scene.displacements(steps), options);
    ChartTruth truth;
    for (VectorXd* column : {&truth.displacement, &truth.pressure, &truth.stiffness, &truth.fraction})
        *column = VectorXd::Zero(steps + 1);
    for (int j = 1; j <= steps; ++j) {
        const rough::LoadStep& step = curve.steps[static_cast<std::size_t>(j - 1)];
        truth.displacement[j] = step.displacement;
        truth.pressure[j] = step.pressure;
        truth.stiffness[j] = step.tangent_stiffness;
        truth.fraction[j] = step.contact_fraction;
    }
    truth.stiffness[0] = truth.stiffness[1];
    return truth;
}

} // namespace

rough::Profile ChartScene::profile(Index nodes) const {
    return rough::sampled({nodes, length, body.kernel == rough::Kernel::periodic}, height);
}

std::vector<double> ChartScene::displacements(int steps) const {
    std::vector<double> displacements;
    for (int j = 1; j <= steps; ++j)
        displacements.push_back(last * j / steps);
    return displacements;
}

std::vector<ChartScene> chart_scenes() {
    return {hertz(), westergaard(),
            weierstrass("mwm-smooth", "a smooth MWM profile, H = 1.2, gamma = 1.7, 8 waves", 1.2, 1.7, 8),
            weierstrass("mwm-rough", "a rough MWM profile, H = 0.6, gamma = 1.5, 11 waves", 0.6, 1.5, 11),
            brownian()};
}

ChartTruth truth_of(const ChartScene& scene, Index most_nodes, const std::function<bool()>& stop) {
    if (scene.exact)
        return scene.exact();
    constexpr int steps = 160;
    constexpr double still = 1e-6;
    Index nodes = (most_nodes - 1) / 16 + 1;
    ChartTruth truth = refined(scene, nodes, steps, stop);
    double moved = 1;
    while (moved > still && 4 * (nodes - 1) + 1 <= most_nodes) {
        nodes = 4 * (nodes - 1) + 1;
        ChartTruth finer = refined(scene, nodes, steps, stop);
        moved = std::sqrt(
            (truth.pressure.tail(steps).array() / finer.pressure.tail(steps).array() - 1).square().mean());
        truth = std::move(finer);
    }
    truth.origin = "a grid of " + std::to_string(nodes) + " nodes and " + std::to_string(steps) +
                   " load steps, whose pressures a grid of a quarter of the nodes misses by " +
                   brief(100 * moved) + " %";
    truth.finest_verified = (nodes - 1) / 4;
    return truth;
}

} // namespace app
