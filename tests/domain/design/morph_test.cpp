#include "domain/design/morph.hpp"
#include "domain/errors.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

#include <numbers>

using namespace rough;

namespace {

using testing::two_mm;

Genome surface() {
    return {0.01, {{1, 0.9, 1.6, two_mm, {{1, {0.3}}, {2, {1.9}}, {3, {4.0}}, {4, {2.2}}, {5, {5.1}}}}}};
}

/// The response of `wanted` as target.
DesignSetup like_another(const Genome& wanted, std::optional<double> max_pressure = {}) {
    const Model model = completed({.grid = {128, two_mm}});
    DesignSetup setup{.model = model,
                      .targets = {target_like(sample(wanted, model.grid), model, "wanted")},
                      .max_pressure = max_pressure};
    if (max_pressure) setup.targets[0].x *= *max_pressure / setup.targets[0].last();
    return setup;
}

/// The surface with chromosome n's phase moved by `by` rad.
Genome moved(Genome genome, int n, double by) {
    genome.series[0].chromosomes[static_cast<std::size_t>(n - 1)].phases[0] += by;
    return genome;
}

double squares(const Morphed& morphed) {
    double sum = 0;
    for (const PhaseChange& change : morphed.changes) sum += std::pow(change.after - change.before, 2);
    return sum;
}

} // namespace

TEST_CASE("a drifted surface meets its target again after at most as large a change") {
    for (const auto& max_pressure : {std::optional<double>(), std::optional(1e-3)}) {
        const DesignSetup setup = like_another(surface(), max_pressure);
        const Genome drifted = moved(moved(surface(), 2, 0.25), 4, -0.2);
        const Morphed back = morph(setup, drifted, {{1, 2}, {1, 4}}, 0.1);
        CHECK(back.before < 0.97);
        CHECK(back.after >= default_required_similarity);
        CHECK(back.after == Approx(similarity(setup, back.genome)).margin(1e-9));
        CHECK(back.missed.empty());
        CHECK(squares(back) <= 0.25 * 0.25 + 0.2 * 0.2);
        REQUIRE(back.changes.size() == 2);
        CHECK(back.changes[0].before == drifted.series[0].chromosomes[1].phases[0]);
        CHECK(back.changes[1].n == 4);
        auto before = genes(drifted), after = genes(back.genome);
        for (std::size_t g = 1; g < before.size(); ++g) // A carries the scale
            if (g != 5 && g != 7) CHECK(before[g] == after[g]);
    }
}

TEST_CASE("the least change of one phase is the smallest that meets the target") {
    const DesignSetup setup = like_another(surface());
    for (const double drift : {0.3, -0.4}) {
        const Genome drifted = moved(surface(), 3, drift);
        double least = 0;
        while (similarity(setup, moved(drifted, 3, least)) < 0.98 &&
               similarity(setup, moved(drifted, 3, -least)) < 0.98)
            least += 1e-3;
        const Morphed back = morph(setup, drifted, {{1, 3}}, 0.2, 0.98);
        CHECK(back.after >= 0.98);
        CHECK(std::sqrt(squares(back)) == Approx(least).epsilon(0.05));
    }
}

TEST_CASE("points that the chromosomes cannot meet are named, and phases keep their limit") {
    const DesignSetup setup = like_another(surface());
    const Genome drifted = moved(moved(surface(), 1, 0.5), 2, 0.9);
    const double limit = 0.02;
    const Morphed nearer = morph(setup, drifted, {{1, 2}, {1, 5}}, limit);
    CHECK(nearer.after > nearer.before);
    CHECK(nearer.after < default_required_similarity);
    REQUIRE(!nearer.missed.empty());
    double worst = 0;
    for (const MissedPoint& missed : nearer.missed) worst = std::max(worst, std::abs(missed.misfit));
    CHECK(worst == Approx(1 - nearer.after).epsilon(1e-12));
    for (const PhaseChange& change : nearer.changes)
        CHECK(std::abs(change.after - change.before) <= 2 * std::numbers::pi * limit * (1 + 1e-12));
    CHECK(std::count_if(nearer.changes.begin(), nearer.changes.end(), std::mem_fn(&PhaseChange::at_limit)) > 0);
}

TEST_CASE("a surface that meets its target is not changed") {
    const Morphed same = morph(like_another(surface()), surface(), {{1, 1}}, 0.1);
    CHECK(squares(same) == 0);
    CHECK(same.gradients == 1);
    CHECK(genes(same.genome) == genes(folded(surface())));
}

TEST_CASE("a chromosome that the genome does not have is refused with those that it has") {
    const auto names = chromosomes_from("1:3, 1:5", surface());
    REQUIRE(names.size() == 2);
    CHECK(names[1].n == 5);
    for (const char* bad : {"", "1", "1:", "a:1", "1:6", "0:1", "2:1", "1:2,1:2", "1:99999999999"})
        CHECK_THROWS_AS(chromosomes_from(bad, surface()), InputError);
    CHECK_THROWS_WITH(chromosomes_from("1:6", surface()), Catch::Contains("1:1 to 1:5"));
    CHECK_THROWS_AS(morph(like_another(surface()), surface(), {{1, 1}}, 0.6), InputError);
}
