#include "domain/errors.hpp"
#include "domain/profile/preparation.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"
#include "tests/catch.hpp"
#include "tests/domain/contact/maps.hpp"

using namespace rough;
using maps::map_of;

namespace {

using std::numbers::pi;
constexpr double a = 0.002;

/// A cosine with these numbers of waves along x and y on 1 mm x 0.8 mm.
Profile wave(int along_x, int along_y, Index n = 128) {
    return map_of({n, n}, 1.0 / double(n), 0.8 / double(n),
                  [&](double x, double y) { return 5 + a * std::cos(2 * pi * (along_x * x + along_y * y / 0.8)); });
}

} // namespace

TEST_CASE("a wave on a map has the parameters of textbooks", "[areal]") {
    const ArealParameters s = areal_parameters(wave(4, 0, 160), true);
    const double k = 8 * pi;
    CHECK(s["Sq"] == Approx(a / std::sqrt(2)).epsilon(1e-12));
    CHECK(s["Sdq"] == Approx(a * k / std::sqrt(2)).epsilon(1e-5));
    // mean of sqrt(1 + g^2) - 1 for g = a k sin: g^2/4 - 3 g^4/64
    const double g = a * k; // triangles lie between the wave and its chords
    CHECK(s["Sdr"] == Approx(g * g / 4 - 3 * std::pow(g, 4) / 64).epsilon(3e-3));
}

TEST_CASE("heights are positive above the mean plane, depths below it, as in ISO 25178-2", "[areal]") {
    // A plateau with a pit of 9 um in every tenth of 20 x 20 nodes: the mean is 0.9 um under the plateau.
    const Profile pits =
        map_of({20, 20}, 0.1, 0.1, [](double x, double) { return std::lround(10 * x) % 10 == 3 ? 1 : 1.009; });
    const ArealParameters s = areal_parameters(pits);
    CHECK(s["Sp"] == Approx(0.0009).epsilon(1e-9));
    CHECK(s["Sv"] == Approx(0.0081).epsilon(1e-9)); // a depth is positive
    CHECK(s["Sz"] == Approx(0.009).epsilon(1e-9));
    CHECK(s["Sa"] == Approx(2 * 0.9 * 0.0009).epsilon(1e-9));
    CHECK(s["Sq"] == Approx(0.009 * 0.3).epsilon(1e-9));
    CHECK(s["Ssk"] == Approx((0.1 - 0.9) / 0.3).epsilon(1e-9)); // pits: negative
    CHECK(s["Sku"] == Approx((1 - 3 * 0.09) / 0.09).epsilon(1e-9));
    CHECK(s["Smr"] == Approx(0.9));
    CHECK(s["Smc10"] == Approx(0.0009).epsilon(1e-9));
    Profile peaks = pits; // upside down
    peaks.heights *= -1;
    const ArealParameters turned = areal_parameters(peaks);
    CHECK(turned["Ssk"] == Approx(-s["Ssk"]));
    CHECK(turned["Sp"] == Approx(s["Sv"]));
    CHECK(turned["Sv"] == Approx(s["Sp"]));
    CHECK(turned["Smr"] == Approx(0.1));
}

TEST_CASE("material ratio and material height are inverse functions", "[areal]") {
    // A ramp along x from -1 to 1 um, 201 columns: linear in both.
    const Profile ramp = map_of({201, 11}, 0.1, 0.2, [](double x, double) { return 1e-3 * (x / 10 - 1); });
    for (const double c : {-7.05e-4, -2.5e-5, 3.05e-4, 9.05e-4})
        CHECK(material_ratio(ramp, c) == Approx((1 - c / 1e-3) / 2).margin(0.005));
    CHECK(material_ratio(ramp, -1.1e-3) == 1); // all nodes exceed it
    CHECK(material_ratio(ramp, 1.1e-3) == 0);
    CHECK(material_height(ramp.heights, 0) == Approx(1e-3)); // no node exceeds the highest peak
    CHECK(material_height(ramp.heights, 1) == Approx(-1e-3));
    for (const double mr : {0.05, 0.25, 0.5, 0.8})
        CHECK(material_ratio(ramp, material_height(ramp.heights, mr)) == Approx(mr).margin(0.006));
}

TEST_CASE("a plane has its gradient and area, and is levelled to zero", "[areal]") {
    const Profile plane = map_of({20, 30}, 0.1, 0.05, [](double x, double y) { return 3 + 2 * x - y; });
    const ArealParameters s = areal_parameters(plane);
    CHECK(s["Sdq"] == Approx(std::sqrt(5)));
    CHECK(s["Sdr"] == Approx(std::sqrt(6) - 1));
    CHECK(detrended(plane, Detrend::line).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(detrended(plane, Detrend::mean).sum() == Approx(0).margin(1e-10));
}

TEST_CASE("a quadratic form is removed completely, and its residual is orthogonal to it", "[areal]") {
    const Profile bowl = map_of(
        {40, 25}, 0.1, 0.2, [](double x, double y) { return 1 + x - 2 * y + 0.3 * x * x - 0.4 * x * y + 0.1 * y * y; });
    CHECK(detrended(bowl, Detrend::parabola).cwiseAbs().maxCoeff() < 1e-11);
    CHECK(detrended(bowl, Detrend::line).cwiseAbs().maxCoeff() > 0.1);
    Profile cubic = bowl;
    cubic.heights += map_of({40, 25}, 0.1, 0.2, [](double x, double y) { return x * x * y; }).heights;
    CHECK(detrended(cubic, Detrend::parabola).cwiseAbs().maxCoeff() > 0.1);
    CHECK(detrended(cubic, Detrend::cubic).cwiseAbs().maxCoeff() < 1e-10);
    CHECK_THROWS_WITH(detrended(bowl, Detrend::arc), Catch::Contains("arc"));
    // least squares: the residual is orthogonal to every term
    const Eigen::VectorXd rest = detrended(cubic, Detrend::parabola);
    const Profile term = map_of({40, 25}, 0.1, 0.2, [](double x, double y) { return x * y; });
    CHECK(std::abs(rest.dot(term.heights)) < 1e-9 * rest.norm() * term.heights.norm());
}

TEST_CASE("the areal Gaussian filter halves waves of its cut-off and keeps planes", "[areal]") {
    const double spacing = 0.01, cut_off = 0.4;
    const auto angle = GENERATE(0.0, 0.6, 1.57079632679);
    const Profile map = map_of({201, 181}, spacing, spacing, [&](double x, double y) {
        return std::cos(2 * pi / cut_off * (x * std::cos(angle) + y * std::sin(angle)));
    });
    const Eigen::VectorXd passed = low_passed(map, cut_off);
    for (const Index j : {60, 90, 110})
        for (const Index i : {60, 100, 140})
            CHECK(passed[j * 201 + i] == Approx(map.heights[j * 201 + i] / 2).margin(1e-4));
    const Profile plane = map_of({50, 40}, 0.1, 0.05, [](double x, double y) { return 3 + 2 * x - y; });
    CHECK((low_passed(plane, 1.1) - plane.heights).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("texture: a wave's autocorrelation length, lay and aspect ratio", "[areal]") {
    for (const bool periodic : {true, false}) {
        const Texture along_y = texture(wave(8, 0), periodic); // grooves along y
        CHECK(along_y.Sal == Approx(std::acos(0.2) / (2 * pi * 8)).epsilon(0.02));
        CHECK(along_y.Std == 90);
        CHECK(along_y.Str < 0.07);
        CHECK(along_y.Str_is_bound);
        CHECK(texture(wave(0, 8), periodic).Std == 0);
        const Profile strip = map_of({40, 16}, 0.02, 0.002, [](double x, double) { return std::cos(5 * pi * x); });
        CHECK(texture(strip, periodic).Std == 90); // one wave, much wider than long
        // wave vector (6, 10/0.8): the lay is at right angles to it
        const Texture oblique = texture(wave(6, 10), periodic);
        CHECK(oblique.Std == std::round(std::fmod(std::atan2(12.5, 6) * 180 / pi + 90, 180)));
    }
    const Profile alike = map_of({128, 128}, 1.0 / 128, 1.0 / 128,
                                 [](double x, double y) { return std::cos(16 * pi * x) + std::cos(16 * pi * y); });
    // cos kx + cos ky falls to 0.2 at arccos(-0.6) along the axes, sooner along the diagonals
    const Texture both = texture(alike, true);
    CHECK(both.Sal == Approx(std::sqrt(2) * std::acos(0.2) / (16 * pi)).epsilon(0.02));
    CHECK(both.Str == Approx(std::sqrt(2) * std::acos(0.2) / std::acos(-0.6)).epsilon(0.02));
    CHECK_FALSE(both.Str_is_bound);
    CHECK(texture(maps::self_affine(128, 0.8, 3, 0.1), true).Str > 0.5);
}

TEST_CASE("a map's spectrum has its mean square and its wavenumber", "[areal]") {
    const Profile map = wave(6, 0);
    const Spectrum exact = continuous_spectrum(map, true);
    CHECK(exact.power.sum() == Approx(a * a / 2).epsilon(1e-12));
    Index highest = 0;
    exact.power.maxCoeff(&highest);
    CHECK(exact.wave_number[highest] == Approx(12 * pi).epsilon(1e-12));
    CHECK(continuous_spectrum(map).power.sum() == Approx(a * a / 2).epsilon(1e-6)); // Hann's
    // white noise is flat: C = m0 dx dy/(2 pi)^2
    std::mt19937_64 random(3);
    const Profile noise = map_of({256, 200}, 0.01, 0.02,
                                 [&](double, double) { return std::normal_distribution<double>(2, 0.5)(random); });
    const Spectrum flat = continuous_spectrum(noise);
    const double width = 2 * pi / (256 * 0.01); // width of a ring; the first has longer waves, too
    for (Index ring = 1; ring < flat.power.size(); ++ring)
        CHECK(std::abs(flat.wave_number[ring] / width - static_cast<double>(ring + 1)) <= 0.5);
    const double expected = 0.25 * 0.01 * 0.02 / (4 * pi * pi);
    CHECK(flat.power.sum() == Approx(0.25).epsilon(0.02));
    CHECK(flat.density.segment(20, 60).mean() == Approx(expected).epsilon(0.03));
    CHECK(flat.density.segment(80, 60).mean() == Approx(expected).epsilon(0.03));
    CHECK_THROWS_AS(continuous_spectrum(map_of({3, 8}, 1, 1, [](double x, double) { return x; })), InputError);
}
