#include "ga/ga.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <numeric>

using namespace ga;

namespace {

/// Genomes of 20 penalties; `all` is minus their sum, `late` minus that of the last ten. Evaluating reads one
/// after the other, so what was read bounds the sum.
struct Penalties {
    using Genome = std::vector<double>;
    using Outcome = std::vector<double>;

    Outcome evaluate(const Genome& genome) const {
        if (genome.front() < 0)
            throw std::domain_error("a penalty under 0");
        read += 20;
        return genome;
    }
    const std::vector<Objective<Outcome>>& objectives() const {
        static const std::vector<Objective<Outcome>> list = {
            {"all", [](const Outcome& g) { return -std::accumulate(g.begin(), g.end(), 0.0); }},
            {"late", [](const Outcome& g) { return -std::accumulate(g.begin() + 10, g.end(), 0.0); }}};
        return list;
    }

    struct Reading : Appraisal<Outcome> {
        const Penalties& problem;
        Genome genome;
        std::size_t known = 0;

        Reading(const Penalties& p, Genome g) : problem(p), genome(std::move(g)) {}
        double bound(std::size_t objective) override {
            const std::size_t from = std::min<std::size_t>(known, objective == 0 ? 0 : 10);
            return -std::accumulate(genome.begin() + static_cast<long>(from),
                                    genome.begin() + static_cast<long>(known), 0.0);
        }
        void advance() override {
            if (genome.front() < 0)
                throw std::domain_error("a penalty under 0");
            ++known;
            ++problem.read;
        }
        std::optional<Outcome> outcome() override {
            return known == genome.size() ? std::optional(genome) : std::nullopt;
        }
    };
    std::unique_ptr<Appraisal<Outcome>> appraise(const Genome& genome) const {
        return genome.back() > 0.99 ? nullptr : std::make_unique<Reading>(*this, genome);
    }

    mutable std::atomic<long> read = 0;
};

Population<Penalties::Genome> start(std::size_t n, std::uint64_t seed = 0) {
    std::vector<Penalties::Genome> genomes(n, Penalties::Genome(20));
    for (std::size_t i = 0; i < n; ++i) {
        Stream stream(fold(seed, i));
        const double level = stream.uniform();
        for (double& penalty : genomes[i])
            penalty = level * stream.uniform();
    }
    genomes[n / 2] = genomes[n / 3]; // twins
    genomes[n / 4].front() = -1;     // fails
    return population(genomes);
}

struct Ran {
    Result<Penalties::Genome> result;
    long read;
};

template <class Pipeline>
Ran run_with(const Pipeline& pipeline, bool screening, std::uint64_t seed = 0, int threads = 1,
             std::size_t n = 600) {
    const Penalties problem;
    auto result = run(pipeline, problem, start(n, seed), {.threads = threads, .screening = screening});
    return {std::move(result), problem.read};
}

bool same(const Population<Penalties::Genome>& a, const Population<Penalties::Genome>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.identity == y.identity && x.genome == y.genome && x.value() == y.value();
    });
}

} // namespace

TEST_CASE("screening leaves the same survivors with the same fitness, for a part of the work") {
    const auto keeps_best = score() | best(5);
    const auto keeps_above = score() | above(-1.5);
    const auto keeps_some = score("late") | above(0.5, at_least(4)); // nobody passes
    const auto in_turn = score("late") | above(-0.4, at_least(3)) | score() | best(3);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const auto compare = [&](const auto& pipeline, double part) {
            const Ran whole = run_with(pipeline, false, seed), screened = run_with(pipeline, true, seed);
            CHECK(same(whole.result.population, screened.result.population));
            CHECK(whole.result.notes == screened.result.notes);
            CHECK(static_cast<double>(screened.read) < part * static_cast<double>(whole.read));
            CHECK(screened.result.counters.given_up > 0);
            CHECK(screened.result.counters.given_up + screened.result.counters.asked >=
                  whole.result.counters.asked);
        };
        compare(keeps_best, 0.5);
        compare(keeps_above, 0.7);
        compare(keeps_some, 0.8);
        compare(in_turn, 1);
    }
}

TEST_CASE("in a generation the start competes: children that cannot replace it are given up") {
    const auto mix = transform("mix", [](const Penalties::Genome& g) {
        Penalties::Genome mixed = g;
        std::rotate(mixed.begin(), mixed.begin() + 7, mixed.end());
        mixed[3] *= 1.3;
        return mixed;
    });
    for (const std::size_t mu : {0, 20})
        for (const double rate : {1.0, 0.5}) {
            // Where not all are crossed, the others are parents: as they were, or in another shape.
            const auto check = [&](const auto& reshape) {
                const auto generations =
                    score() | best(40) |
                    repeat(4, tournament(2) | cross(uniform(), rate) | reshape | score() | plus(mu));
                const Ran whole = run_with(generations, false), screened = run_with(generations, true);
                CHECK(same(whole.result.population, screened.result.population));
                CHECK(screened.read < whole.read);
            };
            check(mix);
            check(cross(one_point(), 0.3));
        }
}

TEST_CASE("nobody is given up where nobody asked for it") {
    const Penalties problem;
    const auto result = run(score() | best(5), problem, start(600));
    CHECK(result.counters.given_up == 0);
    CHECK(problem.read == run_with(score() | best(5), false).read);
}

TEST_CASE("screening does the same for any number of threads") {
    const auto pipeline = score() | best(7);
    const Ran one = run_with(pipeline, true, 3, 1);
    for (const int threads : {2, 5}) {
        const Ran many = run_with(pipeline, true, 3, threads);
        CHECK(same(one.result.population, many.result.population));
        CHECK(one.read == many.read);
        CHECK(one.result.counters.evaluations == many.result.counters.evaluations);
    }
}

TEST_CASE("an evaluation given up under one objective goes on from there under another") {
    // Everybody is read to the tenth penalty at least under `late`, which says nothing before.
    const auto both = pair(score("late") | best(3), score() | best(3),
                           Combine<Penalties::Genome>{
                               "left", [](const auto& a, const auto&) { return std::optional(a.genome); }}) |
                      score();
    const Ran whole = run_with(both, false), screened = run_with(both, true);
    CHECK(whole.result.population.size() == screened.result.population.size());
    CHECK(screened.read < whole.read);
}

TEST_CASE("nobody is worked on who is sure not to be kept, not even to keep others company") {
    // One whose penalties read so far leave it above the last that is kept must be read on; no other.
    const auto least_work = [](std::uint64_t seed, double last_kept) {
        long read = 0;
        for (const auto& individual : start(250, seed)) {
            const auto& genome = individual.genome;
            double bound = 0;
            if (genome.front() < 0)
                continue; // fails before it is read
            for (std::size_t i = 0; i < genome.size() && (genome.back() > 0.99 || bound >= last_kept); ++i) {
                bound -= genome[i];
                ++read;
            }
        }
        return read;
    };
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Ran best5 = run_with(score() | best(5), true, seed, 1, 250);
        CHECK(best5.read == least_work(seed, best5.result.population.back().value()));
        CHECK(run_with(score() | above(-1.5), true, seed, 1, 250).read == least_work(seed, -1.5));
    }
}

TEST_CASE("without a stage behind that keeps a part, everybody is scored") {
    const auto pipeline = score() | tournament(2, 600);
    const Ran whole = run_with(pipeline, false), screened = run_with(pipeline, true);
    CHECK(same(whole.result.population, screened.result.population));
    CHECK(screened.result.counters.given_up == 0);
}

TEST_CASE("the floor is that of the last of the best, or the threshold where that is lower") {
    Floor floor({.best = 2, .above = 0.5});
    CHECK(floor.value() == -HUGE_VAL);
    floor.offer(0.9);
    floor.offer(0.1);
    CHECK(floor.value() == 0.1);
    floor.offer(0.3);
    CHECK(floor.value() == 0.3);
    floor.offer(0.8);
    CHECK(floor.value() == 0.5);
    CHECK(Floor({.above = 0.5}).value() == 0.5);
}

TEST_CASE("one is kept if too few are known or hoped to be better, or above the threshold") {
    Floor floor({.best = 3, .above = 0.9});
    floor.offer(0.5);
    CHECK(floor.would_keep(0.4, 1));
    CHECK_FALSE(floor.would_keep(0.4, 2));
    CHECK(floor.would_keep(0.6, 2));
    CHECK_FALSE(floor.would_keep(0.6, 3));
    CHECK(floor.would_keep(0.9, 7));
    CHECK_FALSE(Floor({.above = 0.5}).would_keep(0.4, 0));
}

TEST_CASE("an appraisal that throws, whatever it throws, leaves the word to the evaluation") {
    /// One in seven cannot be appraised, one in five no further than a few penalties.
    struct Fragile : Penalties {
        struct Breaking : Reading {
            using Reading::Reading;
            double bound(std::size_t objective) override {
                if (known > 3)
                    throw 7;
                return Reading::bound(objective);
            }
        };
        std::unique_ptr<Appraisal<Outcome>> appraise(const Genome& genome) const {
            const auto kind = static_cast<long>(genome[5] * 1e6);
            if (kind % 7 == 0)
                throw 7;
            if (kind % 7 == 1)
                throw std::domain_error("cannot be appraised");
            return kind % 5 == 0 ? std::make_unique<Breaking>(*this, genome) : Penalties::appraise(genome);
        }
    };
    for (const int threads : {1, 2}) {
        const Fragile fragile;
        const auto result =
            run(score() | best(5), fragile, start(600), {.threads = threads, .screening = true});
        CHECK(same(result.population, run_with(score() | best(5), false).result.population));
        CHECK(result.counters.given_up > 0);
    }
}
