#include "domain/problem/problem.hpp"
#include "domain/profile/roughness.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

const ga::Descriptor<Genome>& named(const std::vector<ga::Descriptor<Genome>>& all, const std::string& name) {
    return *std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
}

} // namespace

TEST_CASE("descriptors of one cosine are its height, slope and wavelength, with skewness near 0") {
    const double L = 2;
    const Grid grid{1001, L};
    const Genome wave{0.01, {{1, 0.8, 2, L, {{3, {0.3}}}}}}; // a quarter of L long, four of them
    const auto all = surface_descriptors(grid);
    const Roughness r = roughness(sample(wave, grid));
    CHECK(named(all, "height").of(wave) == Approx(std::log10(r["Pq"] / L)));
    CHECK(std::pow(10, named(all, "slope").of(wave)) == Approx(r["Pdq"]).epsilon(5e-3));
    CHECK(std::pow(10, named(all, "wavelength").of(wave)) == Approx(0.25).epsilon(2e-3));
    CHECK(named(all, "skewness").of(wave) == Approx(r["Psk"]).margin(1e-12));
    CHECK(std::abs(named(all, "skewness").of(wave)) < 0.01);
}

TEST_CASE("derivatives of descriptors agree with differences") {
    std::mt19937_64 random(5);
    for (int trial = 0; trial < 3; ++trial) {
        const Grid grid = trial < 2 ? Grid{257, 0.84942} : Grid{24, 0.84942, false, 0, 20, 0.8};
        const Genome genome = rough::testing::random_genome(random, 2, 2, 0.84942, trial < 2 ? 0.03 : 0.25);
        const std::vector<double> genes = rough::genes(genome);
        for (const auto& descriptor : surface_descriptors(grid)) {
            CAPTURE(descriptor.name, trial);
            const std::vector<double> gradient = descriptor.gradient(genome);
            REQUIRE(gradient.size() == genes.size());
            double largest = 0;
            for (const double each : gradient) largest = std::max(largest, std::abs(each));
            for (std::size_t g = 0; g < genes.size(); ++g) {
                const double step = 1e-6 * std::max(1.0, std::abs(genes[g]));
                const auto at = [&](double change) {
                    return descriptor.of(with_genes(genome, rough::testing::moved(genes, g, change)));
                };
                CHECK(gradient[g] == Approx((at(step) - at(-step)) / (2 * step)).epsilon(1e-4).margin(1e-6 * largest));
            }
        }
    }
}
