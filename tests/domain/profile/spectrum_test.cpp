#include "domain/errors.hpp"
#include "domain/profile/spectrum.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

using std::numbers::pi;

/// The integral over q of a spectrum whose wavenumbers are evenly spaced.
double integral(const Spectrum& spectrum) { return spectrum.density.sum() * spectrum.wave_number[0]; }

} // namespace

TEST_CASE("a genome's discrete spectrum has one line per wavenumber and its mean square") {
    Genome genome;
    genome.series.push_back({1.3, 0.9, 2, 1, {{1, {0.3}}, {2, {1.0, 2.5}}, {4, {5.0}}}});
    genome.series.push_back({0.4, 0.6, 2, 0.5, {{1, {2.0}}, {2, {0.1}}}}); // first wave is the other's second
    const auto lines = discrete_spectrum(genome);
    REQUIRE(lines.size() == 4);
    double power = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        CHECK(lines[i].wave_number == Approx(2 * pi * std::pow(2, double(i))));
        power += lines[i].power;
    }
    const Eigen::ArrayXd z = sample(genome, {.nodes = 4096, .length = 1, .periodic = true}).heights.array();
    CHECK(power == Approx((z - z.mean()).square().mean()).epsilon(1e-12));
}

TEST_CASE("the continuous spectrum of white noise is flat") {
    std::mt19937_64 random(3);
    Profile noise{Eigen::VectorXd(1 << 16), 0.01};
    for (double& z : noise.heights) z = std::normal_distribution<double>(2, 0.5)(random);
    const Spectrum spectrum = continuous_spectrum(noise);
    const double flat = 0.25 / (pi / noise.spacing); // mean square over the Nyquist wave number
    const Index band = spectrum.density.size() / 8;
    for (Index b = 0; b < 8; ++b)
        CHECK(spectrum.density.segment(b * band, band).mean() == Approx(flat).epsilon(0.08)); // 4096 values: 1/64 x 5
    CHECK(integral(spectrum) == Approx(0.25).epsilon(0.03));
    for (const Index nodes : {8, 9}) { // with and without a wave of two nodes: Parseval's theorem
        const Eigen::ArrayXd z = noise.heights.head(nodes);
        CHECK(integral(continuous_spectrum({z, 0.01}, true)) == Approx((z - z.mean()).square().mean()));
    }
}

TEST_CASE("a cosine's continuous spectrum has its wavenumber and mean square") {
    const double amplitude = 0.02, length = 3;
    for (const Index nodes : {512, 513, 1000}) {
        const double k = 2 * pi * 17 / length;
        const Profile profile =
            sampled({nodes, length, true}, [&](double x) { return amplitude * std::cos(k * x + 0.7); });
        const Spectrum spectrum = continuous_spectrum(profile);
        Index peak = 0;
        spectrum.density.maxCoeff(&peak);
        CHECK(spectrum.wave_number[peak] == Approx(k));
        CHECK(integral(spectrum) == Approx(amplitude * amplitude / 2).epsilon(1e-9));
        CHECK(spectrum.density[peak + 40] < 1e-12 * spectrum.density[peak]);
        CHECK(spectrum.wave_number.size() == nodes / 2);
    }
}
