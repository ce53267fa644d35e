#include "tests/ga/problems.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace ga;

GA_PIPELINES_HERE(CurveFit)

namespace {

const Combine<Vector> mean = registry().combines()[0].first;
const Variables<Vector> tenth{"tenth", [](const Vector& g) {
                                  std::vector<Variable> variables;
                                  for (std::size_t i = 0; i < g.size(); ++i)
                                      variables.push_back({i, 0.9 * g[i], 1.1 * g[i]});
                                  return variables;
                              }};
const auto turn = transform("turn genes", [](const Vector& g) { return Vector{g[1], g[2], g[0]}; });

std::vector<std::string> trace(const Stage<CurveFit>& pipeline) {
    std::vector<std::string> trace;
    const Observer<Vector> observer = [&](const auto& event) {
        std::string line = event.path;
        for (const auto& each : event.population) {
            line += " " + std::to_string(each.identity);
            for (const double gene : each.genome)
                line += " " + number(gene);
        }
        trace.push_back(line);
    };
    run<CurveFit>(pipeline, CurveFit{}, CurveFit::start(40), {.variant = "v"}, {observer});
    return trace;
}

void refused(const std::string& text, const auto& message, const Variants& variants = {}) {
    CHECK_THROWS_WITH(
        [&] {
            const auto stage = Parser<CurveFit>(curve_registry(), variants).parse(text);
            check(stage, CurveFit{}, CurveFit::start(2));
        }(),
        message);
}

} // namespace

const Registry<CurveFit>& curve_registry() {
    static const Registry<CurveFit> registry = [] {
        auto all = with_refinement(vocabulary<CurveFit>());
        all.add(mean, "the parents' mean");
        all.add(tenth, "each gene within a tenth of its value");
        all.add("turn genes", "domain", "the genes in another order", turn);
        return all;
    }();
    return registry;
}
Stage<CurveFit> curves(const std::string& pipeline) {
    return Parser<CurveFit>(curve_registry()).parse(pipeline);
}
Result<Vector> run(const std::string& pipeline, const CurveFit& problem, const Population<Vector>& start,
                   const RunOptions& options, const Observers& observers) {
    return run(curves(pipeline), problem, start, options, observers);
}

TEST_CASE("a pipeline as text gives the same paths and bits as in code") {
    Parser<CurveFit> parser(curve_registry());
    const auto same = [&](const std::string& text, const Stage<CurveFit>& code) {
        const auto parsed = parser.parse(text);
        CHECK(parsed.text() == code.text());
        CHECK(trace(parsed) == trace(code));
    };
    same("score | best 3 | refine mma 5 genes=tenth | refine minimax 2 | best 1",
         score() | best(3) | refine(mma(5), tenth) | refine(minimax(2)) | best(1));
    same(
        "pair(score low | above 0.95 at_least=3, score high | above 0.95 at_least=3 | turn genes, mean) | "
        "score | best 3 "
        "| refine mma 3 genes=tenth | best 1",
        pair(score("low") | above(0.95, at_least(3)), score("high") | above(0.95, at_least(3)) | turn, mean) |
            score() | best(3) | refine(mma(3), tenth) | best(1));
    same("score|best 10|repeat 20{tournament 2|cross uniform|mutate 0.1|score|refine lm 3|elite 5}|best 1",
         score() | best(10) |
             repeat(20, tournament(2) | cross(uniform()) | mutate(0.1) | score() | refine(lm(3)) | elite(5)) |
             best(1));
    same("score | until fitness 0.99 generations=30 { rank 1.8 | cross sbx rate=0.9 | mutate 0.2 polynomial "
         "10 | score | plus }",
         score() | until({.generations = 30, .fitness = 0.99},
                         rank(1.8) | cross(sbx(), 0.9) | mutate(0.2, polynomial(10)) | score() | plus()));
    same("pareto low high | islands 2 rounds=3 { tournament | cross n_points 2 | mutate reset 0.1 | parents "
         "| pareto low high "
         "| best 20 } | front",
         pareto({"low", "high"}) |
             islands(2, {.rounds = 3, .migrants = 1},
                     tournament(2) | cross(n_points(2)) | mutate(0.1, reset()) | parents() |
                         pareto({"low", "high"}) | best(20)) |
             front());
}

TEST_CASE("the algorithm of ga/README.md gives the same bits as its text") {
#include "page/1.inc"
    std::ostringstream page;
    page << std::ifstream(RUGOSA_SOURCE "/ga/README.md").rdbuf();
    const std::size_t at = page.str().find("    mine = ") + 11;
    const std::string line = page.str().substr(at, page.str().find('\n', at) - at);
    const auto text = curves(line);
    CHECK(Stage<CurveFit>(mine).text() == text.text());
    CHECK(trace(mine) == trace(text));
    CHECK(run(text, CurveFit{}, CurveFit::start(20)).best->value() > 0.9999);
}

TEST_CASE("an operator's text is read as the same operator") {
    Parser<CurveFit> parser(curve_registry());
    for (const std::string text :
         {"score | score low | best 3 | above 0.95 | below -1.5e-07 at_least=2 | front | pareto low high",
          "tournament 3 | tournament 2 size=5 | roulette | sus | rank 1.25 | random | random 4",
          "cross one_point | cross n_points 4 rate=0.5 | cross uniform | cross blend 0.25 | cross sbx 2",
          "mutate 0.1 | mutate 0.1 gaussian 0.2 | mutate 0.1 uniform 0.3 | mutate 0.1 polynomial 30",
          "mutate 0.1 reset | mutate 0.1 swap | mutate 0.1 reverse | turn genes",
          "refine mma 3 genes=all | refine minimax 3 genes=tenth | refine lm 30 genes=all",
          "refine lm 9 sharpen=3 genes=all | refine nlopt LN_COBYLA 20 genes=all",
          "elite 2 | plus | plus 7 | parents | steady",
          "repeat 3 { score | elite 1 } | restarts 2 { score | best 1 } | pair(score, best 2, mean)",
          "until generations 3 evaluations 100 seconds 2.5 fitness 0.5 stagnation 4 { score }",
          "until stagnation 4 converged 1e-12 { score } | islands 3 rounds=4 migrants=2 { score }"})
        CHECK(parser.parse(text).text() == text);
    for (const std::string text :
         {"average 3 | cma-es sigma=0.2 population=7 restarts=ipop | de best F=0.7 CR=0.3 | duel | crowding",
          "de rand F=0.5 CR=0.9 crossing=exp | l-shade evaluations=900 memory=4 archive=1.5 p=0.2",
          "self-adaptive 0.2 steps=one | share 0.3 alpha=2 | clear 0.3 capacity=2",
          "map-elites a b cells=5 | emit 4 a b sigma=0.2"})
        CHECK(reals(text).text() == text);
}

TEST_CASE("wrong text is refused at its column with what was expected") {
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"", "column 1: unexpected end; expected the name of a stage"},
        {"score | | best 1", "column 9: unexpected '|'"},
        {"score | repeat 3 { best 1", "column 26: unexpected end; expected }"},
        {"best n=", "column 8: unexpected end; expected a value for n"},
        {"best 1 { score }", "column 1: stage 'best' takes no { ... }"},
        {"repeat 3", "column 1: stage 'repeat' lacks its { ... }"},
        {"score | tornament 2", "column 9: unknown stage 'tornament'; did you mean 'tournament'?"},
        {"cross unifrom", "column 7: unknown cross 'unifrom'; did you mean 'uniform'?"},
        {"pair(score, score, men)", "column 20: unknown combination 'men'; did you mean 'mean'?"},
        {"score | above 0.5 atleast=3",
         "column 19: stage 'above' has no 'atleast'; did you mean 'at_least'?"},
        {"refine 3", "column 1: stage 'refine' lacks its kind; expected one of minimax, mma, lm, nlopt"},
        {"cross order", "it needs a permutation for a genome"},
        {"best", "column 1: stage 'best' lacks 'n'; expected a whole number from 1"},
        {"best 1.5", "column 6: stage 'best': n is '1.5'; expected a whole number from 1"},
        {"best 1 2", "column 8: stage 'best' has no place for '2'"},
        {"best 1 n=2", "column 8: 'n' is given twice"},
        {"mutate nan", "column 8: stage 'mutate': rate is 'nan'; expected a number from 0 to 1"},
        {"islands 10001 { score }", "n is '10001'; expected a whole number from 2 to 10000"},
        {"until { score }", "a block of generations needs an end"},
        {"score | repeat 2 { mutate 0.1 | best 1 }", "column 33: stage 'best 1' needs a scored population"},
        {"score | score middle", "column 9: stage 'score middle': unknown objective 'middle'"},
        {"score | cross uniform",
         "column 9: stage 'cross uniform' leaves the population unscored at the end"},
        {"score | front", "needs a population ranked by pareto"},
        {"pareto low low", "expected different objectives"},
    };
    for (const auto& [text, message] : wrong)
        refused(text, Catch::StartsWith("pipeline, column ") && Catch::Contains(message));
    CHECK(edits("csore", "score") == 1); // two letters that changed places
    CHECK(edits("abc", "cab") == 2);
}

TEST_CASE("more than 100 nested pipelines or 10,000 stages are refused") {
    const auto inside = [](int depth) {
        std::string text = "score";
        for (int i = 1; i < depth; ++i)
            text = "repeat 2 { " + text + " }";
        return Syntax(text, "pipeline").read().size();
    };
    CHECK(inside(100) == 1);
    CHECK_THROWS_WITH(inside(101), Catch::Contains("more than 100 pipelines inside each other"));
    Registry<CurveFit> registry = vocabulary<CurveFit>();
    std::string row = "score";
    for (int i = 1; i < 100; ++i)
        row += " | score";
    std::string all = "row";
    for (int i = 1; i < 100; ++i)
        all += " | row";
    Parser<CurveFit> parser(registry, {{"row", row}, {"all", all}, {"more", all + " | best 1"}});
    CHECK_NOTHROW(parser.variant("all"));
    CHECK_THROWS_WITH(parser.variant("more"), Catch::Contains("more than 10000 stages"));
    CHECK_NOTHROW(parser.variant("all")); // what was read before, or refused, does not count
    CHECK_NOTHROW(parser.parse(all));
}

TEST_CASE("a named pipeline is expanded in place") {
    Parser<CurveFit> parser(curve_registry(),
                            {{"start", "score | best 3"}, {"all", "start | refine lm 3 | start"}});
    CHECK(parser.variant("all").text() == "score | best 3 | refine lm 3 genes=all | score | best 3");
    CHECK(trace(parser.variant("all")).back().starts_with("v/best.2 "));
    CHECK_THROWS_WITH(parser.variant("al"), "unknown variant 'al'; did you mean 'all'?");
    refused("a", "variant 'b', column 9: variants contain each other: a -> b -> a",
            {{"a", "b"}, {"b", "score | a"}});
    refused("a 3", "pipeline, column 1: variant 'a' takes no arguments", {{"a", "score"}});
    refused("score", "variant 'best' has an operator's name; expected another", {{"best", "score"}});
    refused("a", "variant 'a', column 6: stage 'best': n is '0'; expected a whole number from 1",
            {{"a", "best 0"}});
}

TEST_CASE("text of more than a million characters is refused") {
    CHECK_NOTHROW(Syntax(std::string(999995, ' ') + "score", "it").read());
    CHECK_THROWS_WITH(Syntax(std::string(999996, ' ') + "score", "it"),
                      "it, column 1000000: the text is longer than 1000000 characters");
}
