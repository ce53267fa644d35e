#include "ga/adaptation/adaptation.hpp"
#include "ga/refinement/refinement.hpp"
#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Random pipelines in code: any operators in any order, odd parameters, blocks inside each other.
class RandomPipelines {
  public:
    explicit RandomPipelines(std::uint64_t seed) : random_(mix(seed)) {}

    /// A pipeline that works on no population.
    Pipeline<Reals> whole() {
        Pipeline<Reals> pipeline = sample(4 + below(9)) | score();
        for (std::size_t parts = 1 + below(3); parts > 0; --parts) pipeline.append(part(2, false));
        return pipeline;
    }

  private:
    std::size_t below(std::size_t n) { return random_.below(n); }
    /// The result of one of these functions.
    template <class... Makes>
    Pipeline<Reals> one_of(Makes... makes) {
        const std::function<Pipeline<Reals>()> all[] = {makes...};
        return all[below(sizeof...(makes))]();
    }
    static Pipeline<Reals> then_score(Pipeline<Reals> pipeline) { return std::move(pipeline) | score(); }

    Pipeline<Reals> selected() {
        const double threshold = -0.25 * static_cast<double>(below(8));
        return one_of([&] { return best(1 + below(6)); }, [&] { return tournament(1 + below(9), below(9)); },
                      [&] { return at_random(below(4)); }, [] { return distinct(); }, [] { return roulette(); },
                      [] { return sus(); }, [&] { return rank(1.25 + 0.25 * static_cast<double>(below(4))); },
                      [&] { return above(threshold, at_least(below(4))); }, [&] { return below_threshold(threshold); });
    }
    static Pipeline<Reals> below_threshold(double threshold) { return ga::below(threshold, at_least(2)); }
    Pipeline<Reals> varied() {
        const double rate = 0.25 * static_cast<double>(below(5));
        return then_score(one_of([&] { return mutate(rate); }, [&] { return mutate(rate, polynomial(1)); },
                                 [&] { return mutate(rate, uniform_step(2)); }, [&] { return mutate(rate, reset()); },
                                 [&] { return mutate(rate, reverse()); }, [&] { return mutate(rate, ga::swap()); },
                                 [&] { return mutate(rate, or_opt()); }, [&] { return cross(uniform(), rate); },
                                 [&] { return cross(sbx(1), rate); }, [&] { return cross(blend(0.5)); },
                                 [&] { return cross(n_points(1 + below(9))); },
                                 [] { return differential_evolution("best"); }));
    }
    Pipeline<Reals> refined() {
        const int n = 1 + static_cast<int>(below(6));
        return one_of([&] { return refine(nlopt_method("LN_COBYLA", n)); },
                      [&] { return refine(nlopt_method("LN_NELDERMEAD", n)); },
                      [&] { return refine(nlopt_method("LD_SLSQP", n)); },
                      [&] { return average(1 + below(3), "", below(7)); });
    }
    Pipeline<Reals> replaced() {
        return one_of([&] { return elite(1 + below(9)); },
                      [&] { return plus(below(9), below(2) > 0 ? "none" : "any"); }, [] { return parents(); },
                      [] { return steady(); }, [] { return duel(); });
    }
    Pipeline<Reals> learnt() {
        return one_of([] { return then_score(differential_evolution()) | duel(); },
                      [] { return then_score(l_shade()) | duel(); }, [] { return then_score(cma_es()); },
                      [] { return then_score(self_adaptive(0.2)); });
    }
    Pipeline<Reals> block(int depth) {
        const std::size_t n = 1 + below(4);
        return one_of([&] { return repeat(n, body(depth, true)); },
                      [&] { return until({.evaluations = 20, .fitness = -0.25}, body(depth, true)); },
                      [&] { return until({.generations = 9, .stagnation = n}, body(depth, true)); },
                      [&] { return restarts(n, body(depth, false)); },
                      [&] {
                          return islands(1 + n, {n, below(3)}, body(depth, true));
                      },
                      [&] {
                          return then_score(
                              pair(body(depth, false), body(depth, false) | best(3), registry().combines()[0].first));
                      });
    }
    Pipeline<Reals> body(int depth, bool generations) {
        Pipeline<Reals> pipeline = part(depth - 1, generations);
        for (std::size_t parts = below(3); parts > 0; --parts) pipeline.append(part(depth - 1, generations));
        return pipeline;
    }
    Pipeline<Reals> part(int depth, bool generations) {
        switch (below(generations ? 6 : 4)) {
        case 0:
            return selected();
        case 1:
            return depth > 0 ? block(depth) : varied();
        case 2:
            return refined();
        case 4:
            return replaced();
        case 5:
            return learnt();
        default:
            return varied();
        }
    }

    Stream random_;
};

/// A problem of 1 to 4 genes with ties, noise, failures, values that are not finite and constraints.
Reals difficult(std::uint64_t seed, std::atomic<long>& calls) {
    Reals problem;
    problem.n = 1 + seed % 4;
    problem.noise = seed % 3 == 0 ? 0.1 : 0;
    const double failures[] = {0, 0.2, 0.6, 0.95};
    problem.f = [&calls, share = failures[seed / 4 % 4], ties = seed % 5 < 2](const Vector& x) {
        ++calls;
        const double chance = static_cast<double>(fingerprint(x).low >> 11) * 0x1p-53;
        if (chance < share / 2) throw std::runtime_error("failed");
        Vector outcome = x;
        for (double& each : outcome) each = chance < share ? std::nan("") : ties ? std::round(2 * each) / 2 : each;
        return outcome;
    };
    problem.slope = [](const Vector& x) {
        Vector slope;
        for (const double each : x) slope.push_back(each < -0.5 ? std::nan("") : -2 * each);
        return slope;
    };
    if (seed / 16 % 2 == 1)
        problem.excess = [](const Vector& y) { return Vector{y[0], y[0] < -0.5 ? -HUGE_VAL : y[0] - 0.5}; };
    return problem;
}

/// Compares runs of pipelines in code and in text, on 1 to 3 threads, uninterrupted and stopped twice.
/// Returns the number of pipelines that can work.
int compare_runs(std::uint64_t from, std::uint64_t to) {
    int runs = 0;
    for (std::uint64_t seed = from; seed < to; ++seed) {
        const Pipeline<Reals> code = RandomPipelines(seed).whole();
        const std::string text = code.text();
        CAPTURE(seed, text);
        std::atomic<long> calls = 0;
        const Reals problem = difficult(seed, calls);
        const RunOptions options{.seed = seed,
                                 .threads = 1,
                                 .budget = {.evaluations = 400},
                                 .population_bytes = std::size_t{1} << 18}; // some populations double
        Result<Vector> whole;
        try {
            whole = run(text, problem, {}, options);
        } catch (const UsageError&) { // e.g. scores that cannot be compared
            CHECK(calls == 0);
            continue;
        }
        ++runs;
        CHECK(calls == whole.counters.evaluations);
        CHECK(whole.counters.requested <= 400);
        CHECK(whole.counters.failures <= whole.counters.requested);
        for (const auto& each : whole.population)
            CHECK((!each.fitness.known() || each.fitness.has_failed() || whole.best));
        RunOptions others = options;
        others.threads = 2 + static_cast<int>(seed % 2);
        const auto again = run(code, problem, {}, others);
        CHECK(bits_of(again) == bits_of(whole));
        CHECK(again.stopped == whole.stopped);
        if (whole.counters.evaluations < 4) continue;
        calls = 0;
        const auto pieces = in_pieces(text, problem, whole.counters.evaluations / 3 + 1, options);
        CHECK(calls == whole.counters.evaluations);
        CHECK(bits_of(pieces) == bits_of(whole));
        CHECK(pieces.is_dead_end == whole.is_dead_end);
    }
    return runs;
}

} // namespace

TEST_CASE("random pipelines give the same result in code, in text, on any threads and resumed") {
    CHECK(compare_runs(0, 300) > 200);
}

TEST_CASE("5,000 random pipelines give the same result in code, in text and resumed", "[long]") {
    CHECK(compare_runs(300, 5300) > 3500);
}
