#include "tests/catch.hpp"
#include "tests/folder.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// A rule that the engine does not have: the population is close together.
struct AtSpread : StoppingRule {
    double spread = 0; ///< largest distance of first genes

    static Words words() { return {"spread", "stopping", "the first genes lie this near"}; }
    static void describe(auto& self, auto visit) {
        visit(self.spread, ga::number("spread", "", 0, no_limit, words().meaning));
    }
    template <class G>
    bool operator()(const BlockProgress<G>& now, Numbers&) const {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& each : now.population) {
            low = std::min(low, each.genome[0]);
            high = std::max(high, each.genome[0]);
        }
        return high - low <= spread;
    }
};

} // namespace

TEST_CASE("a new stopping rule ends its block, in code and in text") {
    const auto body = reals("tournament 2 | cross blend 0.1 | score");
    const auto result = run(reals("sample 30 | score") | until(AtSpread{{}, 0.01}, body), Reals{}, {});
    for (const auto& each : result.population) CHECK(std::abs(each.genome[0] - result.population[0].genome[0]) <= 0.01);
    auto words = registry();
    words.add_rule<AtSpread>();
    const std::string text =
        "sample 30 | score | until generations 5000 spread 0.01 { tournament 2 | cross blend 0.1 | score }";
    const auto stage = Parser<Reals>(words).parse(text);
    CHECK(stage.text() == text);
    CHECK(run(stage, Reals{}, {}).population[0].genome == result.population[0].genome);
    CHECK(run(reals("sample 30 | score") | until(any_of(AfterGenerations{{}, 2}, AtSpread{{}, 0}), body), Reals{}, {})
              .counters.requested <= 90);
}

TEST_CASE("a population has converged when all are feasible and their objectives agree") {
    const AtConvergence rule{{}, 0.5};
    Numbers memory;
    const auto holds = [&](const std::vector<Fitness>& all) {
        Population<Vector> population(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) population[i].fitness = all[i];
        return rule(BlockProgress<Vector>{1, 10, 0, population}, memory);
    };
    const auto worth = [](double value, bool minimise = false, double violation = 0) {
        return Fitness(Name("f"), value, minimise).constrained({violation});
    };
    CHECK(holds({worth(1), worth(1.5), worth(1.25)}));
    CHECK_FALSE(holds({worth(1), worth(1.25), worth(1.75)}));
    CHECK_FALSE(holds({worth(1.75), worth(1.25), worth(1)}));
    CHECK(holds({worth(-1, true), worth(-1.5, true)}));
    CHECK_FALSE(holds({worth(1), worth(1, false, 0.1)}));
    CHECK_FALSE(holds({worth(1), Fitness::failed(Name("f"), reason("none"))}));
    CHECK_FALSE(holds({worth(1), Fitness()}));
    CHECK(holds({Fitness(Name("both"), Point{1, 2}), Fitness(Name("both"), Point{1.5, 2.5})}));
    CHECK_FALSE(holds({Fitness(Name("both"), Point{1, 2}), Fitness(Name("both"), Point{1, 2.75})}));
}

TEST_CASE("a front that grows from one individual is not stagnation") {
    Reals problem;
    problem.n = 2, problem.lower = 0;
    problem.list = {
        {"f1", [](const Vector& x) { return x[0]; }, true},
        {"f2", [](const Vector& x) { return (1 + 9 * x[1]) * (1 - std::sqrt(x[0] / (1 + 9 * x[1]))); }, true}};
    for (const std::size_t copies : {1, 20}) {
        const auto result = run("pareto f1 f2 | until stagnation 10 generations 500 { tournament 2 size=20 | "
                                "cross sbx | mutate 0.5 polynomial | pareto f1 f2 | plus 20 } | front",
                                problem, population(std::vector<Vector>(copies, Vector{0, 0})));
        double widest = 0;
        for (const auto& each : result.population) widest = std::max(widest, each.genome[0]);
        CHECK(widest > 0.9); // the front reaches to 1
    }
}
