#include "domain/profile/roughness.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

using std::numbers::pi;

Profile cosine(double amplitude, int waves, double length, Index nodes) {
    return sampled({nodes, length, true},
                   [&](double x) { return 7 + amplitude * std::cos(2 * pi * waves * x / length); });
}

} // namespace

TEST_CASE("a cosine has the parameters of textbooks") {
    const double a = 0.003, length = 2;
    const int waves = 10;
    const Roughness r = roughness(cosine(a, waves, length, 4000));
    CHECK(r.sections == 1);
    CHECK(r["Pp"] == Approx(a).epsilon(1e-12));
    CHECK(r["Pv"] == Approx(a).epsilon(1e-12));
    CHECK(r["PSm"] == Approx(length / waves).epsilon(1e-9));
    CHECK(r["Pmr"] == Approx(0.5).margin(1e-3));
    const double k = 2 * pi * waves / length;
    CHECK(r["Pa"] == Approx(2 * a / pi).epsilon(1e-4));
    CHECK(r["Pq"] == Approx(a / std::sqrt(2)).epsilon(1e-12));
    CHECK(r["Psk"] == Approx(0).margin(1e-12));
    CHECK(r["Pku"] == Approx(1.5).epsilon(1e-12));
    for (const char* height : {"Pz", "Pt", "Pc"}) CHECK(r[height] == Approx(2 * a).epsilon(1e-12));
    CHECK(r["Pdq"] == Approx(a * k / std::sqrt(2)).epsilon(1e-3));
    CHECK(r["rms curvature"] == Approx(a * k * k / std::sqrt(2)).epsilon(1e-3));
    CHECK(r["m0"] == Approx(a * a / 2));
    CHECK(r["bandwidth"] == Approx(1).epsilon(1e-2)); // three nodes at either end have no derivative
}

TEST_CASE("Rz is the mean of the sections' heights and Rt the height of the whole") {
    Profile profile{Eigen::VectorXd::Zero(51), 0.1};
    for (Index s = 0; s < 5; ++s) {
        profile.heights[10 * s + 3] = double(s + 1);
        profile.heights[10 * s + 7] = -0.5;
    }
    const Roughness r = roughness(profile, 1), whole = roughness(profile);
    const double mean = profile.heights.mean();
    CHECK(r.sections == 5);
    CHECK(r["Rp"] == Approx(3 - mean));
    CHECK(r["Rv"] == Approx(0.5 + mean));
    CHECK(r["Rz"] == Approx(3.5));
    CHECK(r["Rt"] == Approx(5.5));
    CHECK(r["Rsk"] > 0);
    CHECK(whole["Pz"] == Approx(5.5));
    CHECK(roughness(profile, 1.6).sections == 3); // 4.8 mm in the middle of 5 mm
    CHECK_THROWS_WITH(roughness(profile, 5.1), Catch::Contains("shorter than a section"));
    CHECK_THROWS_WITH(roughness(profile, 0.1), Catch::Contains("two nodes"));
}

TEST_CASE("a triangle wave has a straight bearing curve, only core") {
    Profile profile{Eigen::VectorXd(4000), 0.001};
    for (Index i = 0; i < 4000; ++i) profile.heights[i] = 0.004 * std::abs(double(i % 400) + 0.5 - 200) / 200;
    const Roughness r = roughness(profile);
    CHECK(r["Pk"] == Approx(0.004).epsilon(1e-2));
    CHECK((r["Ppk"] < 4e-5 && r["Pvk"] < 4e-5));
    CHECK(r["Pa"] == Approx(0.001).epsilon(1e-3));
    CHECK(r["Pq"] == Approx(0.002 / std::sqrt(3)).epsilon(1e-3));
    CHECK(r["Pku"] == Approx(1.8).epsilon(1e-3));
    CHECK(r["Pdq"] == Approx(0.02).epsilon(2e-2)); // except at the corners
    CHECK(r["PSm"] == Approx(0.4).epsilon(1e-6));
    CHECK(material_ratio(profile, -1e-9) == 1);          // all of it is higher
    for (const double level : {-0.0015, -0.001, 0.0005}) // the ratio of a triangle falls evenly
        CHECK(material_ratio({profile.heights.array() - 0.002, 0.001}, level) ==
              Approx(0.5 - level / 0.004).margin(2e-3));
}

TEST_CASE("Gaussian heights have the core, peaks and valleys of the normal distribution") {
    const Index n = 20001;
    const double sigma = 0.7e-3;
    Eigen::VectorXd z(n);
    for (Index i = 0; i < n; ++i) { // quantiles in another order than theirs, by bisection of erfc
        double low = -10, high = 10;
        for (int k = 0; k < 80; ++k) {
            const double middle = (low + high) / 2;
            (std::erfc(middle / std::sqrt(2)) / 2 > (double(i) + 0.5) / double(n) ? low : high) = middle;
        }
        z[i * 7919 % n] = sigma * low;
    }
    const Roughness core = roughness({z, 0.001});
    // The line of least squares through the quantiles of 0.3 to 0.7 has the slope 2.573956. This is 12/0.4^3
    // times the integral of (s - 1/2) q(s) ds, by quadrature. The line cuts off the share 0.099051 on either
    // side. A triangle there has the area of the integral of (u - t) phi(u) du from t = 1.286978. It is
    // 0.945031 high.
    CHECK(core["Pk"] == Approx(2.573956 * sigma).epsilon(1e-3));
    CHECK(core["Pmrk1"] == Approx(0.099051).epsilon(1e-2));
    CHECK(core["Pmrk2"] == Approx(1 - 0.099051).epsilon(1e-2));
    CHECK(core["Ppk"] == Approx(0.945031 * sigma).epsilon(2e-2));
    CHECK(core["Pvk"] == Approx(core["Ppk"]).epsilon(1e-6));
}

TEST_CASE("profile elements exceed a tenth of the largest height and depth") {
    Profile profile = cosine(1, 8, 2, 1600);
    const double plain = roughness(profile)["PSm"];
    CHECK(plain == Approx(0.25));
    for (Index i = 0; i < 1600; ++i)
        profile.heights[i] += 0.04 * std::cos(1.7 * double(i)); // crosses the mean line more than once
    const Roughness r = roughness(profile);
    CHECK(r["PSm"] == Approx(plain).epsilon(0.02));
    CHECK(r["Pc"] == Approx(2).epsilon(0.05));
    profile.heights *= 3;
    CHECK(roughness(profile)["Pc"] == Approx(3 * r["Pc"]));
    CHECK(roughness(profile)["PSm"] == Approx(r["PSm"]));
    CHECK(std::isnan(roughness({Eigen::VectorXd::LinSpaced(50, -1, 1), 0.1})["PSm"]));
}

TEST_CASE("spectral moments of a finely sampled profile are those of its cosines") {
    std::mt19937_64 random(11);
    for (int trial = 0; trial < 5; ++trial) {
        // whole numbers of waves on the length, so that means over it are exact
        Genome genome;
        genome.series.push_back({0.7, 0.8, 2, 1, {}});
        for (int n = 1; n <= 5; ++n) genome.series[0].chromosomes.push_back({n, {testing::uniform(random, 0, 6.28)}});
        const Roughness r = roughness(sample(genome, {.nodes = 8192, .length = 1, .periodic = true}));
        double m0 = 0, m2 = 0, m4 = 0;
        for (const Wave& wave : waves(genome)) {
            const double power = wave.amplitude * wave.amplitude / 2, k = wave.wave_number;
            m0 += power, m2 += power * k * k, m4 += power * k * k * k * k;
        }
        CHECK(r["m0"] == Approx(m0).epsilon(1e-9));
        CHECK(r["m2"] == Approx(m2).epsilon(5e-3));
        CHECK(r["m4"] == Approx(m4).epsilon(5e-3));
    }
}

TEST_CASE("roughness ignores a profile's mean height and scales with its heights") {
    std::mt19937_64 random(5);
    const Profile profile = sample(testing::random_genome(random, 2, 3, 1, 0.05), {});
    Profile other = profile;
    other.heights = 3 * profile.heights.array() - 20;
    const Roughness one = roughness(profile), three = roughness(other);
    for (const char* length : {"Pa", "Pz", "Pdq", "Ppk"}) CHECK(three[length] == Approx(3 * one[length]));
    for (const char* ratio : {"Psk", "Pku", "bandwidth"}) CHECK(three[ratio] == Approx(one[ratio]).margin(1e-9));
}
