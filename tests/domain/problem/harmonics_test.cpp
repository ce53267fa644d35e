#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "tests/domain/problem/jacobian.hpp"

using namespace rough;

namespace {

using testing::paper_length;

DesignSetup periodic_setup() { return rough::testing::drawn_setup(128, false, Kernel::periodic); }

/// The height at L minus that at 0, over the range.
double jump(const Genome& genome) {
    const Profile profile = sample(genome, {1025, paper_length});
    return std::abs(profile.heights[1024] - profile.heights[0]) /
           (profile.heights.maxCoeff() - profile.heights.minCoeff());
}

} // namespace

TEST_CASE("starts on a periodic body repeat without a jump, also after a mutation") {
    const DesignProblem problem(periodic_setup());
    ga::Stream random(3);
    for (int draw = 0; draw < 4; ++draw)
        for (const Genome& genome : {problem.sample(random), shaped_start(problem.setup(), ga::Stream(random()))}) {
            CHECK(jump(genome) < 1e-12);
            CHECK(shortest_wave(genome) >= problem.setup().limits.shortest_wave * (1 - 1e-12));
            std::vector<double> values = genes(genome);
            for (const ga::Variable& variable : problem.bounds(genome))
                values[variable.gene] = random.uniform(variable.lower, variable.upper);
            CHECK(jump(with_genes(genome, values)) < 1e-12);
        }
}

TEST_CASE("a genome moved to harmonics keeps amplitudes and phases and has no jump") {
    std::mt19937_64 random(5);
    for (int i = 0; i < 10; ++i) {
        const Genome genome = rough::testing::random_genome(random, 2, 2, paper_length, 0.02);
        const Genome moved = in_harmonics(genome, paper_length);
        CHECK(jump(moved) < 1e-12);
        const auto before = waves(genome), after = waves(moved);
        REQUIRE(before.size() == after.size());
        for (std::size_t w = 0; w < before.size(); ++w) {
            CHECK(after[w].amplitude == Approx(before[w].amplitude).epsilon(1e-12));
            CHECK(after[w].phase == before[w].phase);
        }
        CHECK(genes(in_harmonics(moved, paper_length)) == genes(moved));
    }
}

TEST_CASE("a search on a periodic body begins at harmonics, from given genomes or the database") {
    std::mt19937_64 random(6);
    const DesignSetup setup = periodic_setup();
    SearchOptions options;
    options.pipeline = "score | best 2";
    options.alternatives = 2;
    options.threads = 1;
    for (const bool given : {true, false}) {
        options.starts.clear();
        for (int i = 0; given && i < 2; ++i)
            options.starts.push_back(rough::testing::random_genome(random, 1, 2, paper_length, 0.02));
        for (const Genome& start : options.starts) CHECK(jump(start) > 0.01);
        const SearchResult found = search(setup, options);
        REQUIRE(!found.alternatives.empty());
        for (const Answer& answer : found.alternatives) CHECK(jump(answer.genome) < 1e-12);
        CHECK(found.best.similarity > 0);
    }
}
