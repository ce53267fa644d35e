#include "domain/accuracy/resolution.hpp"
#include "domain/contact/materials.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace rough;

namespace {

/// A sum of cosines with random phases over 1 mm, on a line or a square map. Wavelengths go from 1 mm to
/// `shortest` spacings of the coarse grid.
struct Cosines {
    struct Wave {
        double kx, ky, height, phase;
    };
    std::vector<Wave> waves;
    Index nodes; ///< along an axis of the coarse grid
    bool is_2d, periodic;

    Cosines(unsigned seed, Index coarse, Index shortest, bool is_map, bool periodic)
        : nodes(coarse), is_2d(is_map), periodic(periodic) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> uniform(0, 1);
        const Index most = coarse / shortest;
        for (Index m = 0; m <= (is_map ? most : 0); ++m)
            for (Index n = is_map ? -most : 1; n <= most; ++n)
                if (const double q = std::hypot(n, m); q > 0 && q <= double(most))
                    waves.push_back({2 * std::numbers::pi * double(n), 2 * std::numbers::pi * double(m),
                                     1e-3 * std::pow(q, is_map ? -1.8 : -1) * (0.5 + uniform(random)),
                                     2 * std::numbers::pi * uniform(random)});
    }
    /// On `times` elements for each of the coarse grid.
    Profile on(Index times) const {
        const Index n = periodic ? times * nodes : times * (nodes - 1) + 1;
        const double spacing = 1 / double(times * nodes);
        Profile surface{Eigen::VectorXd::Zero(is_2d ? n * n : n), spacing, is_2d ? n : 1,
                        is_2d ? spacing : 0};
        for (Index i = 0; i < surface.nodes(); ++i)
            for (const Wave& w : waves)
                surface.heights[i] += w.height * std::cos(w.kx * spacing * double(i % n) +
                                                          w.ky * spacing * double(i / n) + w.phase);
        return surface;
    }
    Model model() const {
        Model model;
        model.body.kernel = periodic ? Kernel::periodic : Kernel::free;
        const double length = double(periodic ? nodes : nodes - 1) / double(nodes);
        model.grid = {nodes, length, periodic};
        if (is_2d)
            model.grid.rows = nodes, model.grid.width = length;
        return completed(model);
    }
};

Profile parabola(Index nodes) {
    Profile cap{Eigen::VectorXd(nodes), 1 / double(nodes - 1)};
    for (Index i = 0; i < nodes; ++i)
        cap.heights[i] = -0.5 * std::pow(cap.spacing * double(i) - 0.487, 2);
    return cap;
}

} // namespace

TEST_CASE("finer heights keep the nodes and are exact for straight lines") {
    for (const bool periodic : {false, true})
        for (const bool is_2d : {false, true}) {
            const Cosines surface(3, 40, 8, is_2d, periodic);
            const Profile coarse = surface.on(1), truth = surface.on(4);
            const Profile linear = finer(coarse, 4, Interpolation::linear, periodic),
                          spline = finer(coarse, 4, Interpolation::spline, periodic);
            REQUIRE(linear.nodes() == truth.nodes());
            CHECK(spline.spacing == Approx(truth.spacing));
            CHECK(spline.shape().rows == truth.shape().rows);
            const auto off = [&](const Profile& of) { return (of.heights - truth.heights).norm(); };
            CHECK(off(spline) < 0.25 * off(linear));
            const auto [columns, rows] = coarse.shape();
            for (const Profile* fine : {&linear, &spline})
                for (Index i = 0; i < coarse.nodes(); ++i) {
                    const Index at = 4 * (i / columns) * fine->shape().columns + 4 * (i % columns);
                    CHECK(fine->heights[at] == coarse.heights[i]);
                }
        }
    const Profile slope = profile_of({0, 1, 2, 3, 4, 5}, 0.1);
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline})
        CHECK((finer(slope, 4, by).heights - Eigen::VectorXd::LinSpaced(21, 0, 5)).cwiseAbs().maxCoeff() <
              1e-12);
    // Splines do not oscillate at a jump at the ends of a periodic surface.
    CHECK(finer(slope, 4, Interpolation::spline, true).heights.maxCoeff() == Approx(5));
}

TEST_CASE("the band of a band-limited surface holds the curve of eight times finer nodes") {
    int rows = 0, area = 0, stiffness = 0;
    for (const bool is_2d : {false, true})
        for (const bool periodic : {false, true})
            for (unsigned seed = 1; seed <= (is_2d ? 2u : 5u); ++seed) {
                const Cosines surface(seed, is_2d ? 32 : 256, 8, is_2d, periodic);
                Model model = surface.model();
                const Response measured = respond(surface.on(1), model);
                const ResolutionBand band = resolution_band(surface.on(1), model, measured);
                REQUIRE(band.is_computed());
                model.loading.pressures = {measured.pressure.begin(), measured.pressure.end()};
                const Response truth = respond(surface.on(8), model);
                for (Index j = 0; j < measured.steps(); ++j, ++rows) {
                    const auto holds = [&](const auto& low, const auto& value, const auto& high) {
                        return low[j] <= value[j] && value[j] <= high[j];
                    };
                    CHECK(holds(band.contact_fraction_low, measured.contact_fraction,
                                band.contact_fraction_high));
                    area +=
                        holds(band.contact_fraction_low, truth.contact_fraction, band.contact_fraction_high);
                    stiffness += holds(band.tangent_stiffness_low, truth.tangent_stiffness,
                                       band.tangent_stiffness_high);
                }
            }
    INFO(rows << " rows, area in " << area << ", stiffness in " << stiffness);
    CHECK(area >= 0.9 * rows);
    CHECK(stiffness >= 0.9 * rows);
}

TEST_CASE("the band of a smooth cap shrinks with the spacing") {
    double before = 1;
    for (const Index nodes : {41, 161, 641}) {
        Model model;
        model.grid = {nodes, 1};
        model.loading.to_pressure = 0.002;
        const Profile cap = parabola(nodes);
        const Response measured = respond(cap, completed(model));
        const ResolutionBand band = resolution_band(cap, completed(model), measured);
        const double width = (band.contact_fraction_high - band.contact_fraction_low).maxCoeff();
        CHECK(width < 0.4 * before);
        before = width;
    }
    CHECK(spot_width({3, 4, 8, 9, 10, 11, 12, 15}, {20}, false) == 5);
    CHECK(spot_width({0, 1, 2, 17, 18, 19}, {20}, true) == 6);
    CHECK(spot_width({0, 1, 4, 5, 10}, {4, 4}, false) == 2);
    CHECK(spot_width({}, {20}, false) == 0);
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
    Model model;
    model.grid = {801, 1};
    model.loading = {.steps = 40, .to_pressure = 0.004};
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
    Model model;
    model.grid = {400, 1};
    model.loading.to_pressure = 1e-4;
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
        CHECK((*material.of && *material.elastic && *material.indented));
    }
    const auto names = material_names();
    CHECK(names.size() >= 12);
    CHECK(std::is_sorted(names.begin(), names.end()));
}
