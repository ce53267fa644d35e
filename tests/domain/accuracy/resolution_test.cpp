#include "domain/accuracy/resolution.hpp"
#include "domain/contact/interface.hpp"
#include "domain/contact/materials.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/text/words.hpp"
#include "tests/catch.hpp"

#include <iomanip>
#include <iostream>
#include <numbers>
#include <random>

using namespace rough;

namespace {

using Heights = Eigen::ArrayXXd;
/// Elements of a surface's heights for each element of its measurement; odd on the cells of a free map.
Index finest(bool is_map, bool periodic) { return is_map && !periodic ? 9 : 8; }

/// Surfaces as workshops make them. The feed of an aligned one is a whole number of nodes; ridges run along
/// y.
const std::vector<std::string> kinds{"turned, aligned", "turned", "ground", "fractured", "honed", "plateau"};

/// The heights with their Fourier transform times a function of the numbers of waves along x and y.
Heights shaped(const Heights& z, const std::function<double(double, double)>& amplitude) {
    Eigen::ArrayXXcd half = fourier_transform(z);
    for (Index j = 0; j < half.cols(); ++j)
        for (Index i = 0; i < half.rows(); ++i)
            half(i, j) *= amplitude(double(i), double(std::min(j, half.cols() - j))) / double(z.size());
    return inverse_fourier_transform(half, z.rows());
}

/// A surface of 1 mm on a line or square map, periodic, without waves under 8 of the `nodes`' spacings.
Heights made(const std::string& kind, Index nodes, bool is_map, bool periodic, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Index n = finest(is_map, periodic) * nodes, rows = is_map ? n : 1;
    const auto white = [&](const auto& amplitude) { // normal heights of rms 1 with this spectrum
        Heights z = shaped(Heights::NullaryExpr(n, rows, [&] { return normal(random); }), amplitude);
        return Heights(z / std::sqrt(z.square().mean()));
    };
    const auto self_affine = [&](double hurst, double longest) {
        return white([&](double i, double j) {
            const double q = std::hypot(i, j);
            return q < longest ? 0 : std::pow(q, -hurst - (is_map ? 1 : 0.5));
        });
    };
    const auto every = [&](const auto& height) -> Heights { // height(x, y), both in periods
        return Heights::NullaryExpr(
            n, rows, [&](Index i, Index j) { return height(double(i) / double(n), double(j) / double(n)); });
    };
    const auto nearest = [](double x) { return x - std::round(x); };
    Heights z;
    if (kind.starts_with("turned")) {
        const bool aligned = kind != "turned";
        const double feeds = aligned ? double(nodes) / 16 : std::floor(double(nodes) / 17);
        z = every([&](double x, double y) {
            return 4 * std::pow(nearest(feeds * x + (aligned ? 0 : y) - 0.5), 2);
        });
        z += 0.02 * self_affine(0.8, 2);
    } else if (kind == "ground") { // with spikes
        z = white([&](double i, double j) {
            return i + j == 0
                       ? 0
                       : std::exp(-std::hypot(i, 4 * j) * std::hypot(i, 4 * j) * 144 / double(nodes * nodes));
        });
        for (int spike = 0; spike < 4; ++spike) {
            const double at_x = normal(random), at_y = normal(random), width = 1.5 / double(nodes);
            z += 3 * every([&](double x, double y) {
                     const double r = std::hypot(nearest(x - at_x), is_map ? nearest(y - at_y) : 0) / width;
                     return std::exp(-r * r);
                 });
        }
    } else if (kind == "fractured") {
        z = self_affine(0.8, 1);
    } else if (kind == "honed") { // crossed grooves
        z = 0.1 * self_affine(0.6, 4);
        for (int groove = 0; groove < 10; ++groove) {
            const double at = normal(random), depth = std::abs(normal(random));
            z -= depth * every([&](double x, double y) {
                     return std::exp(-std::pow(nearest(x + (groove % 2 ? y : -y) - at) / 0.02, 2));
                 });
        }
    } else { // plateau
        z = self_affine(0.8, 2).min(0.3) + 0.05 * self_affine(0.5, 8);
    }
    z = shaped(z, [&](double i, double j) { return std::hypot(i, j) <= double(nodes) / 8; });
    return z * (2e-3 / (z.maxCoeff() - z.minCoeff()));
}

/// Every `step`-th node of a surface. A line that is not periodic ends at its measurement's last node.
Profile measured_at(const Heights& z, Index step, bool periodic) {
    const bool is_map = z.cols() > 1, cells = is_map && !periodic;
    const Index n = is_map || periodic ? z.rows() / step : (z.rows() - finest(false, false)) / step + 1;
    const Index first = cells ? step / 2 : 0;
    const double spacing = double(step) / double(z.rows());
    return {z(Eigen::seqN(first, n, step), Eigen::seqN(is_map ? first : 0, is_map ? n : 1, step)).reshaped(),
            spacing, is_map ? n : 1, is_map ? spacing : 0};
}

/// Load steps whose truth a band contains.
struct Held {
    Index steps = 0, area = 0, stiffness = 0;
};

/// The band of a surface's measurement against the surface itself, at equal pressures. Prints the last step.
Held held_by(const std::string& kind, Index nodes, bool is_map, bool periodic, unsigned seed, bool prints) {
    const Heights z = made(kind, nodes, is_map, periodic, seed);
    const double length = double(is_map || periodic ? nodes : nodes - 1) / double(nodes);
    Model model{{nodes, length, periodic}, {periodic ? Kernel::periodic : Kernel::free}, {8, 0.4}};
    if (is_map)
        model.grid.rows = nodes, model.grid.width = length;
    model = completed(model);
    const Profile scan = measured_at(z, finest(is_map, periodic), periodic);
    const Response measured = respond(scan, model);
    const ResolutionBand band = resolution_band(scan, model, measured);
    REQUIRE(band.is_computed());
    model.loading.pressures = {measured.pressure.begin(), measured.pressure.end()};
    const Response truth = respond(measured_at(z, 1, periodic), model);
    const auto count = [&](const Eigen::VectorXd& low, const Eigen::VectorXd& value,
                           const Eigen::VectorXd& high) {
        return (low.array() <= value.array() && value.array() <= high.array()).count();
    };
    const auto counted = [&](const Response& response) {
        return Held{
            response.steps(),
            count(band.contact_fraction_low, response.contact_fraction, band.contact_fraction_high),
            count(band.tangent_stiffness_low, response.tangent_stiffness, band.tangent_stiffness_high)};
    };
    CHECK(counted(measured).area == measured.steps());
    CHECK(counted(measured).stiffness == measured.steps());
    if (prints) {
        const Index last = measured.steps() - 1;
        const auto cells = [&](double factor, const auto& value, const auto& low, const auto& high,
                               const auto& right) {
            std::cout << " | " << factor * value[last] << " (" << factor * low[last] << " to "
                      << factor * high[last] << ") | " << factor * right[last];
        };
        std::cout << "| " << (is_map ? "map, " : "line, ") << kind << std::setprecision(3);
        cells(100, measured.contact_fraction, band.contact_fraction_low, band.contact_fraction_high,
              truth.contact_fraction);
        cells(1, measured.tangent_stiffness, band.tangent_stiffness_low, band.tangent_stiffness_high,
              truth.tangent_stiffness);
    }
    return counted(truth);
}

/// The bands of 12 kinds of line and map, `seeds` of each on both kernels, hold in at least `share` of the
/// load steps. Prints a table for the README if there are several seeds.
void check_bands(Index line_nodes, Index map_nodes, unsigned seeds) {
    Held all;
    for (const bool is_map : {false, true})
        for (const std::string& kind : kinds) {
            Held of_kind;
            for (unsigned seed = 0; seed < 2 * seeds; ++seed) {
                const Held one = held_by(kind, is_map ? map_nodes : line_nodes, is_map,
                                         (seed + kind.size()) % 2 == 0, seed, seeds > 1 && seed == 0);
                of_kind.steps += one.steps, of_kind.area += one.area, of_kind.stiffness += one.stiffness;
            }
            if (seeds > 1)
                std::cout << " | " << 100 * of_kind.area / of_kind.steps << " % | "
                          << 100 * of_kind.stiffness / of_kind.steps << " % |\n";
            all.steps += of_kind.steps, all.area += of_kind.area, all.stiffness += of_kind.stiffness;
        }
    INFO(all.steps << " steps, area in " << all.area << ", stiffness in " << all.stiffness);
    CHECK(10 * all.area >= 9 * all.steps);
    CHECK(10 * all.stiffness >= 9 * all.steps);
}

Profile parabola(Index nodes) {
    return sampled({nodes, 1}, [](double x) { return -0.5 * std::pow(x - 0.487, 2); });
}

} // namespace

TEST_CASE("finer heights keep the nodes and are exact for straight lines") {
    for (const bool periodic : {false, true})
        for (const bool is_2d : {false, true}) {
            const Heights surface = made("fractured", 40, is_2d, periodic, 3);
            const bool cells = is_2d && !periodic;
            const Index times = cells ? 3 : 4, all = finest(is_2d, periodic);
            const Profile coarse = measured_at(surface, all, periodic),
                          truth = measured_at(surface, all / times, periodic);
            const Profile linear = finer(coarse, times, Interpolation::linear, periodic),
                          spline = finer(coarse, times, Interpolation::spline, periodic);
            REQUIRE(linear.nodes() == truth.nodes());
            CHECK(spline.spacing == Approx(truth.spacing));
            CHECK(spline.shape().rows == truth.shape().rows);
            const auto off = [&](const Profile& of) { return (of.heights - truth.heights).norm(); };
            CHECK(off(spline) < 0.25 * off(linear));
            const auto [columns, rows] = coarse.shape();
            for (const Profile* fine : {&linear, &spline})
                for (Index i = 0; i < coarse.nodes(); ++i) {
                    const Index first = cells ? times / 2 : 0,
                                at = (first + times * (i / columns)) * fine->shape().columns + first +
                                     times * (i % columns);
                    CHECK(fine->heights[at] == coarse.heights[i]);
                }
        }
    const Profile slope = profile_of({0, 1, 2, 3, 4, 5}, 0.1);
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline})
        CHECK((finer(slope, 4, by).heights - Eigen::VectorXd::LinSpaced(21, 0, 5)).cwiseAbs().maxCoeff() <
              1e-12);
    for (const double nodes : {3., 4., 5., 9.}) { // splines are exact for parabolas
        const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(Index(nodes), 0, nodes - 1),
                              at = Eigen::VectorXd::LinSpaced(Index(4 * nodes - 3), 0, nodes - 1);
        const Profile parabola{x.cwiseAbs2(), 0.1};
        CHECK((finer(parabola, 4, Interpolation::spline).heights - at.cwiseAbs2()).norm() < 1e-12);
    }
    // A plane stays a plane over all of its cells.
    const Profile plane{Eigen::VectorXd::LinSpaced(4, 0, 3).replicate(3, 1), 1, 3, 1};
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline}) {
        const Profile fine = finer(plane, 3, by);
        CHECK((fine.heights - Eigen::VectorXd::LinSpaced(12, -1. / 3, 10. / 3).replicate(9, 1)).norm() <
              1e-12);
    }
    CHECK_THROWS_WITH(finer(plane, 4, Interpolation::linear), Catch::Contains("odd"));
    // Splines do not oscillate at a jump at the ends of a periodic surface.
    CHECK(finer(slope, 4, Interpolation::spline, true).heights.maxCoeff() == Approx(5));
}

TEST_CASE("the bands of 12 band-limited surfaces hold the curves of eight times finer nodes") {
    check_bands(192, 24, 1);
}

// Printed for the README.
TEST_CASE("the bands of 96 band-limited surfaces hold the curves of eight times finer nodes", "[long]") {
    check_bands(512, 48, 4);
}

TEST_CASE("the band of a smooth cap shrinks with the spacing") {
    double before = 1;
    for (const Index nodes : {41, 161, 641}) {
        const Model model{.grid = {nodes, 1}, .loading = {.to_pressure = 0.002}};
        const Profile cap = parabola(nodes);
        const Response measured = respond(cap, completed(model));
        const ResolutionBand band = resolution_band(cap, completed(model), measured);
        const double width = (band.contact_fraction_high - band.contact_fraction_low).maxCoeff();
        CHECK(width < 0.4 * before);
        before = width;
    }
}

TEST_CASE("a map too large for the band is omitted") {
    Profile map{Eigen::VectorXd::LinSpaced(400 * 400, 0, 1), 0.01, 400, 0.01};
    CHECK(finer_responses(map, {}, {}, Resolution::automatic).empty());
    const ResolutionBand band = resolution_band(map, {}, {}, Resolution::automatic);
    CHECK(!band.is_computed());
    CHECK_THAT(band.omitted, Catch::Contains("nodes"));
}

TEST_CASE("a cap's elastic end is at the load at which Hertz reaches the hardness") {
    const Profile cap = parabola(801);
    const Model model{.grid = {801, 1}, .loading = {.steps = 40, .to_pressure = 0.004}};
    const Response response = respond(cap, completed(model));
    // Hertz, R = 1 mm: p0 = sqrt(F E*/(pi R)), F = P L.
    const double limit = 0.025, ends_at = std::numbers::pi * limit * limit;
    const ElasticEnd end = elastic_end(cap, completed(model), response, limit);
    REQUIRE(end.is_reached(response));
    CHECK(response.pressure[end.step] > 0.98 * ends_at);
    CHECK(response.pressure[end.step - 1] < 1.02 * ends_at);
    CHECK(end.largest_pressure == Approx(std::sqrt(0.004 / std::numbers::pi)).epsilon(0.01));
    CHECK(!elastic_end(cap, completed(model), response, 1).is_reached(response));
}

TEST_CASE("outliers on a flat top cost the contact that the top would have") {
    Profile clean = parabola(400);
    for (Index i = 0; i < 400; ++i)
        clean.heights[i] += 1e-5 * std::sin(7. * double(i));
    Profile spiked = clean;
    spiked.heights[100] = 0.02;
    Model model{.grid = {400, 1}, .loading = {.to_pressure = 1e-4}};
    const Response with = respond(spiked, completed(model));
    const OutlierCost cost = outlier_cost(spiked, {100}, completed(model), with);
    CHECK(cost.matters());
    model.loading = {.pressures = {with.pressure.begin(), with.pressure.end()}};
    const Response without = respond(clean, completed(model));
    CHECK(
        cost.contact_fraction ==
        Approx((without.contact_fraction.array() / with.contact_fraction.array()).maxCoeff()).epsilon(0.05));
    CHECK(!outlier_cost(clean, {0}, completed(model), without).matters());
}

TEST_CASE("every material has elastic constants, a hardness below its limit, and sources") {
    for (const Material& material : materials()) {
        INFO(material.name);
        CHECK(material.modulus > 1000);
        CHECK((material.poissons > 0 && material.poissons < 0.5));
        CHECK((material.hardness > 0 && material.hardness < largest_elastic_pressure * material.modulus));
        CHECK_FALSE((material.of.empty() || material.elastic.empty() || material.indented.empty()));
    }
    const auto names = names_of(materials());
    CHECK(names.size() >= 12);
    CHECK(std::is_sorted(names.begin(), names.end()));
}
