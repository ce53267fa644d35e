// The code of the page ga/README.md, block by block (tests/CMakeLists.txt): a problem, a variant in code and
// text, an operator.

#include "ga/pipeline/ask_tell.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/vocabulary.hpp"
#include "tests/catch.hpp"

namespace {

#include "page/2.inc" // the problem
#include "page/6.inc" // the operator

/// Twelve things whose best choice is found by trying all 4096.
const Knapsack problem{{12, 7, 9, 3, 14, 6, 8, 5, 11, 4, 10, 2}, {6, 4, 5, 2, 8, 3, 5, 3, 7, 2, 6, 1}, 25};

double best_choice() {
    double best = -HUGE_VAL;
    for (unsigned choice = 0; choice < 4096; ++choice) {
        std::vector<bool> taken(12);
        for (std::size_t i = 0; i < 12; ++i) taken[i] = (choice >> i) & 1u;
        if (const auto outcome = problem.evaluate(taken); problem.violation(outcome) <= 0)
            best = std::max(best, outcome.value);
    }
    return best;
}

} // namespace

#pragma GCC diagnostic ignored "-Wunused-value" // the page names what a result holds

TEST_CASE("the page's variant solves its problem, in code and in text") {
#include "page/3.inc"
#include "page/4.inc"
    CHECK(result.best->value() == best_choice());
    const auto again = run(text, problem, {}, {.seed = 7, .threads = 1});
    CHECK(again.best->genome == result.best->genome);
    CHECK(again.best->identity == result.best->identity);
    CHECK(again.counters.evaluations == result.counters.evaluations);
    CHECK_THROWS_WITH(parser.parse("start | repeat 100 { tornament 2 }"),
                      "pipeline, column 22: unknown stage 'tornament'; did you mean 'tournament'?");
}

TEST_CASE("the page's loop of ask and tell gives the same answer") {
#include "page/3.inc"
#include "page/5.inc"
    CHECK(search.result().best->genome == result.best->genome);
}

TEST_CASE("the page's operator works in code and in text") {
    using namespace ga;
    auto registry = vocabulary<Knapsack>();
    registry.add<Regrow>();
    const auto code = sample(20) | score() | repeat(60, Regrow{{}, 8} | score()) | best(1);
    const auto text = Parser<Knapsack>(registry).parse("sample 20 | score | repeat 60 { regrow 8 | score } | best 1");
    const auto first = run(code, problem, {});
    const auto second = run(text, problem, {});
    CHECK(first.best->value() >= 0.95 * best_choice());
    CHECK(first.best->genome == second.best->genome);
    CHECK(run(sample(20) | score() | Regrow{{}, 3} | score(), problem, {}).population.size() == 20);
}
