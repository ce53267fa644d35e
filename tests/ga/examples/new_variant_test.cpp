// The page ga/README.md, word for word where it matters: a new problem, a new variant in code and in text, a
// new operator.

#include "ga/ask_tell.hpp"
#include "ga/ga.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/vocabulary.hpp"

#include <catch2/catch.hpp>

namespace {

struct Knapsack {
    using Genome = std::vector<bool>; // what is taken
    struct Outcome {
        double value, weight;
    };

    std::vector<double> values, weights;
    double capacity;
    std::vector<ga::Objective<Outcome>> list = {{"value", [](const Outcome& o) { return o.value; }}};

    Outcome evaluate(const Genome& taken) const {
        Outcome sum{0, 0};
        for (std::size_t i = 0; i < taken.size(); ++i)
            if (taken[i])
                sum = {sum.value + values[i], sum.weight + weights[i]};
        return sum;
    }
    const std::vector<ga::Objective<Outcome>>& objectives() const { return list; }

    double violation(const Outcome& o) const { return o.weight - capacity; } // optional: a constraint

    Genome sample(ga::Stream& stream) const { // optional: what `sample` needs
        Genome taken(values.size());
        for (std::size_t i = 0; i < taken.size(); ++i)
            taken[i] = stream.chance(0.5);
        return taken;
    }
};

/// Replaces the k worst by mutated copies of the best.
struct Regrow : ga::Operator {
    std::size_t k = 5;

    static ga::Words words() {
        return {"regrow", "replacement", "replaces the k worst by mutated copies of the best"};
    }
    static void describe(auto& self, auto visit) { visit(self.k, ga::whole("k", "5", 1, "how many")); }
    void check(ga::Known& known) const {
        known.need_score("regrow"); // before it: score
        known.scored.reset();       // after it, somebody is unscored
    }

    template <ga::Problem P>
    requires ga::Mutates<ga::Natural, P> ga::PopulationOf<P>
    operator()(ga::PopulationOf<P> population, ga::Context<P>& context) const {
        const auto order = ga::ranking(population);
        for (std::size_t i = 0; i < std::min(k, order.size() - 1); ++i) {
            auto& worst = population[order[order.size() - 1 - i]];
            worst = population[order[0]];
            ga::Stream stream = context.stream(i);
            if (ga::Natural()(context.problem(), worst.genome, 0.1, stream))
                context.make_child(worst, ga::Parents(worst.identity));
        }
        return population;
    }
};

/// Twelve things whose best choice is found by trying all 4096.
const Knapsack problem{{12, 7, 9, 3, 14, 6, 8, 5, 11, 4, 10, 2}, {6, 4, 5, 2, 8, 3, 5, 3, 7, 2, 6, 1}, 25};

double best_choice() {
    double best = -HUGE_VAL;
    for (unsigned choice = 0; choice < 4096; ++choice) {
        std::vector<bool> taken(12);
        for (std::size_t i = 0; i < 12; ++i)
            taken[i] = (choice >> i) & 1u;
        if (const auto outcome = problem.evaluate(taken); problem.violation(outcome) <= 0)
            best = std::max(best, outcome.value);
    }
    return best;
}

} // namespace

using namespace ga;

TEST_CASE("the page's variant solves its problem, in code and in text alike") {
    const auto variant = sample(50) | score() |
                         repeat(100, tournament(2) | cross(uniform()) | mutate(0.05) | score() | elite(1)) |
                         best(1);
    const auto result = run(variant, problem, {}, {.seed = 7, .threads = 2});
    CHECK(result.best->value() == best_choice());

    Parser<Knapsack> parser(vocabulary<Knapsack>(),
                            {{"start", "sample 50 | score"}}); // named pipelines stand as stages
    const auto text = parser.parse(
        "start | repeat 100 { tournament 2 | cross uniform | mutate 0.05 | score | elite 1 } | best 1");
    const auto again = run(text, problem, {}, {.seed = 7, .threads = 1});
    CHECK(again.best->genome == result.best->genome);
    CHECK(again.best->identity == result.best->identity);
    CHECK(again.counters.evaluations == result.counters.evaluations);
    CHECK_THROWS_WITH(parser.parse("start | repeat 100 { tornament 2 }"),
                      "pipeline, column 22: unknown stage 'tornament'; did you mean 'tournament'?");
}

TEST_CASE("the page's loop of one's own gives the same answer") {
    const auto variant = sample(50) | score() |
                         repeat(100, tournament(2) | cross(uniform()) | mutate(0.05) | score() | elite(1)) |
                         best(1);
    AskTell<Knapsack> search(variant, problem, {}, {.seed = 7});
    for (auto questions = search.ask(); !questions.empty(); questions = search.ask())
        for (auto& [id, taken] : questions)
            search.tell(id, problem.evaluate(taken));
    CHECK(search.result().best->genome == run(variant, problem, {}, {.seed = 7}).best->genome);
}

TEST_CASE("the page's operator works in code and in text") {
    auto registry = vocabulary<Knapsack>();
    registry.add<Regrow>();
    const auto code = sample(20) | score() | repeat(60, Regrow{{}, 8} | score()) | best(1);
    const auto text =
        Parser<Knapsack>(registry).parse("sample 20 | score | repeat 60 { regrow 8 | score } | best 1");
    const auto first = run(code, problem, {});
    const auto second = run(text, problem, {});
    CHECK(first.best->value() >= 0.95 * best_choice());
    CHECK(first.best->genome == second.best->genome);
    CHECK(run(sample(20) | score() | Regrow{{}, 3} | score(), problem, {}).population.size() == 20);
}
