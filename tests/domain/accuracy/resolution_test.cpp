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
Heights made(const std::string& kind, Index nodes, bool is_map, Index times, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Index n = times * nodes, rows = is_map ? n : 1;
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
        z = every([&](double x, double y) { return 4 * std::pow(nearest(feeds * x + (aligned ? 0 : y) - 0.5), 2); });
        z += 0.02 * self_affine(0.8, 2);
    } else if (kind == "ground") { // with spikes
        z = white([&](double i, double j) {
            return i + j == 0 ? 0
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

const std::vector<std::string> crests{"waves", "pits", "bumps", "scallops", "triangles", "plateaus"};

/// A surface of 1 mm as made() with random crests of one class, which have kinks in the last three classes.
Heights with_crests(const std::string& kind, Index nodes, bool is_map, Index times, unsigned seed) {
    std::mt19937_64 random(seed + 1000);
    const Heights waves = made("fractured", nodes, is_map, times, seed);
    const double cell = 1 / double(nodes);
    const auto between = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    const auto every = [&](const auto& height) -> Heights { // height(x, y), both in periods
        return Heights::NullaryExpr(waves.rows(), waves.cols(), [&](Index i, Index j) {
            return height(double(i) / double(waves.rows()), double(j) / double(waves.rows()));
        });
    };
    const auto nearest = [](double x) { return x - std::round(x); };
    Heights z = waves;
    if (kind == "pits" || kind == "bumps") {
        z *= 0.1 / z.maxCoeff();
        for (int k = 0; k < 20; ++k) {
            const double at_x = between(0, 1), at_y = between(0, 1), width = cell * between(2, 5),
                         height = (kind == "pits" ? -1 : 1) * between(0.3, 1);
            z += height * every([&](double x, double y) {
                     const double r = std::hypot(nearest(x - at_x), is_map ? nearest(y - at_y) : 0) / width;
                     return std::exp(-r * r);
                 });
        }
    } else if (kind == "plateaus") {
        z *= 1 / z.maxCoeff();
        z = z.min(between(0, 0.7));
        if (between(0, 1) < 0.5) z += between(0, 0.01) * made("honed", nodes, is_map, times, seed) / 2e-3;
    } else if (kind != "waves") {
        const double feeds = std::floor(between(double(nodes) / 30, double(nodes) / 9)), phase = between(0, 1),
                     top = between(0.2, 0.8), scatter = between(0, 0.1);
        const int oblique = int(between(0, 3));
        std::vector<double> height;
        for (int k = 0; k < int(feeds); ++k) height.push_back(scatter * between(-1, 1));
        const auto groove = [&](double u, double of) { // one of those whose lowest is left
            const double t = u - of, h = height[std::size_t(std::fmod(of + 4 * feeds, feeds))];
            return kind == "scallops" ? 4 * t * t + h : (1 + h) * (t < 0 ? -t / top : t / (1 - top));
        };
        z *= between(0, 0.02) / z.maxCoeff();
        z += every([&](double x, double y) {
            const double u = feeds * x + phase + (is_map ? oblique * y : 0), of = std::round(u);
            return std::min({groove(u, of), groove(u, of - 1), groove(u, of + 1)});
        });
    }
    return z * (2e-3 / (z.maxCoeff() - z.minCoeff()));
}

/// Every `step`-th node of a surface. A line that is not periodic ends at its measurement's last node.
Profile measured_at(const Heights& z, Index step, Index times, bool periodic) {
    const bool is_map = z.cols() > 1, cells = is_map && !periodic;
    const Index n = is_map || periodic ? z.rows() / step : (z.rows() - times) / step + 1;
    const Index first = cells ? step / 2 : 0;
    const double spacing = double(step) / double(z.rows());
    return {z(Eigen::seqN(first, n, step), Eigen::seqN(is_map ? first : 0, is_map ? n : 1, step)).reshaped(), spacing,
            is_map ? n : 1, is_map ? spacing : 0};
}

/// Load steps whose truth a band contains, and the band's relative width at each load step.
struct Held {
    Index steps = 0, area = 0, stiffness = 0;
    std::vector<double> area_width = {}, stiffness_width = {};

    void add(const Held& other) {
        steps += other.steps, area += other.area, stiffness += other.stiffness;
        area_width.insert(area_width.end(), other.area_width.begin(), other.area_width.end());
        stiffness_width.insert(stiffness_width.end(), other.stiffness_width.begin(), other.stiffness_width.end());
    }
};

/// The band of a surface's measurement at every `times`-th node against the surface itself, at equal
/// pressures. Prints the last step if it has a `name`.
Held held_by(const Heights& z, Index times, bool periodic, const std::string& name = {}) {
    const bool is_map = z.cols() > 1;
    const Index nodes = z.rows() / times;
    const double length = double(is_map || periodic ? nodes : nodes - 1) / double(nodes);
    Model model{{nodes, length, periodic}, {periodic ? Kernel::periodic : Kernel::free}, {8, 0.4}};
    if (is_map) model.grid.rows = nodes, model.grid.width = length;
    model = completed(model);
    const Profile scan = measured_at(z, times, times, periodic);
    const Response measured = respond(scan, model);
    const ResolutionBand band = resolution_band(scan, model, measured);
    REQUIRE(band.is_computed());
    model.loading.pressures = {measured.pressure.begin(), measured.pressure.end()};
    const Response truth = respond(measured_at(z, 1, times, periodic), model);
    const auto count = [&](const Eigen::VectorXd& low, const Eigen::VectorXd& value, const Eigen::VectorXd& high) {
        return (low.array() <= value.array() && value.array() <= high.array()).count();
    };
    const auto width = [](const Eigen::VectorXd& low, const Eigen::VectorXd& value, const Eigen::VectorXd& high) {
        const Eigen::VectorXd widths = (high - low).cwiseQuotient(value);
        return std::vector<double>(widths.begin(), widths.end());
    };
    const auto counted = [&](const Response& response) {
        return Held{response.steps(),
                    count(band.contact_fraction_low, response.contact_fraction, band.contact_fraction_high),
                    count(band.tangent_stiffness_low, response.tangent_stiffness, band.tangent_stiffness_high),
                    width(band.contact_fraction_low, response.contact_fraction, band.contact_fraction_high),
                    width(band.tangent_stiffness_low, response.tangent_stiffness, band.tangent_stiffness_high)};
    };
    CHECK(counted(measured).area == measured.steps());
    CHECK(counted(measured).stiffness == measured.steps());
    if (!name.empty()) {
        const Index last = measured.steps() - 1;
        const auto cells = [&](double factor, const auto& value, const auto& low, const auto& high, const auto& right) {
            std::cout << " | " << factor * value[last] << " (" << factor * low[last] << " to " << factor * high[last]
                      << ") | " << factor * right[last];
        };
        std::cout << "| " << name << std::setprecision(3);
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
                const bool periodic = (seed + kind.size()) % 2 == 0;
                const Index times = finest(is_map, periodic);
                of_kind.add(held_by(made(kind, is_map ? map_nodes : line_nodes, is_map, times, seed), times, periodic,
                                    seeds > 1 && seed == 0 ? (is_map ? "map, " : "line, ") + kind : ""));
            }
            if (seeds > 1)
                std::cout << " | " << 100 * of_kind.area / of_kind.steps << " % | "
                          << 100 * of_kind.stiffness / of_kind.steps << " % |\n";
            all.add(of_kind);
        }
    INFO(all.steps << " steps, area in " << all.area << ", stiffness in " << all.stiffness);
    CHECK(10 * all.area >= 9 * all.steps);
    CHECK(10 * all.stiffness >= 9 * all.steps);
}

/// The bands of `surfaces` of each class of crests, every fifth a map, hold in 90 % of the load steps. The
/// truth has 17 times the nodes of a line. Prints a table for the README if there are more than 10.
void check_crests(unsigned surfaces) {
    for (const std::string& kind : crests) {
        Held all;
        for (unsigned seed = 0; seed < surfaces; ++seed) {
            const bool is_map = seed % 5 == 4, periodic = seed % 2 == 0;
            const Index times = is_map ? finest(is_map, periodic) : 17;
            all.add(held_by(with_crests(kind, is_map ? 32 : 256, is_map, times, seed), times, periodic));
        }
        const auto median = [](std::vector<double> values) {
            std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
            return values[values.size() / 2];
        };
        std::ostringstream row;
        row << "| " << kind << std::setprecision(3) << " | " << 100. * double(all.area) / double(all.steps) << " % | "
            << 100. * double(all.stiffness) / double(all.steps) << " % | " << 100 * median(all.area_width) << " % | "
            << 100 * median(all.stiffness_width) << " % |\n";
        INFO(row.str());
        if (surfaces > 10) std::cout << row.str();
        CHECK(10 * all.area >= 9 * all.steps);
        CHECK(10 * all.stiffness >= 9 * all.steps);
    }
}

Profile parabola(Index nodes) {
    return sampled({nodes, 1}, [](double x) { return -0.5 * std::pow(x - 0.487, 2); });
}

} // namespace

TEST_CASE("finer heights keep the nodes and are exact for straight lines") {
    for (const bool periodic : {false, true})
        for (const bool is_2d : {false, true}) {
            const bool cells = is_2d && !periodic;
            const Index times = cells ? 3 : 4, all = finest(is_2d, periodic);
            const Heights surface = made("fractured", 40, is_2d, all, 3);
            const Profile coarse = measured_at(surface, all, all, periodic),
                          truth = measured_at(surface, all / times, all, periodic);
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
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline, Interpolation::kinked})
        CHECK((finer(slope, 4, by).heights - Eigen::VectorXd::LinSpaced(21, 0, 5)).cwiseAbs().maxCoeff() < 1e-12);
    for (const double nodes : {3., 4., 5., 9.}) { // splines are exact for parabolas
        const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(Index(nodes), 0, nodes - 1),
                              at = Eigen::VectorXd::LinSpaced(Index(4 * nodes - 3), 0, nodes - 1);
        const Profile parabola{x.cwiseAbs2(), 0.1};
        CHECK((finer(parabola, 4, Interpolation::spline).heights - at.cwiseAbs2()).norm() < 1e-12);
    }
    // The crest of two parabolas is found between nodes, from above as from below.
    for (const double crest : {6., 6.25, 6.5, 6.9})
        for (const double bend : {0., 0.02, -0.02}) {
            const auto height = [=](double x) { return -0.5 * std::abs(x - crest) + bend * std::pow(x - crest, 2); };
            const Profile cusp{Eigen::VectorXd::LinSpaced(14, 0, 13).unaryExpr(height), 1};
            CHECK(std::abs(finer(cusp, 20, Interpolation::kinked).heights.maxCoeff()) < 1e-5);
        }
    // A plane stays a plane over all of its cells.
    const Profile plane{Eigen::VectorXd::LinSpaced(4, 0, 3).replicate(3, 1), 1, 3, 1};
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline}) {
        const Profile fine = finer(plane, 3, by);
        CHECK((fine.heights - Eigen::VectorXd::LinSpaced(12, -1. / 3, 10. / 3).replicate(9, 1)).norm() < 1e-12);
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

TEST_CASE("the bands of five surfaces of each of six classes of crests hold the truth") { check_crests(5); }

// Printed for the README.
TEST_CASE("the bands of 50 surfaces of each of six classes of crests hold the truth", "[long]") { check_crests(50); }

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
    for (Index i = 0; i < 400; ++i) clean.heights[i] += 1e-5 * std::sin(7. * double(i));
    Profile spiked = clean;
    spiked.heights[100] = 0.02;
    Model model{.grid = {400, 1}, .loading = {.to_pressure = 1e-4}};
    const Response with = respond(spiked, completed(model));
    const OutlierCost cost = outlier_cost(spiked, {100}, completed(model), with);
    CHECK(cost.matters());
    model.loading = {.pressures = {with.pressure.begin(), with.pressure.end()}};
    const Response without = respond(clean, completed(model));
    CHECK(cost.contact_fraction ==
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
