#include "ga/text/listing.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/refinement_vocabulary.hpp"
#include "tests/ga/curve_fit.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

/// Words a domain adds.
Registry<CurveFit> domain_words() {
    Registry<CurveFit> registry = with_refinement(vocabulary<CurveFit>());
    registry.add(mean, "the parents' mean");
    registry.add(tenth, "each gene within a tenth of its value");
    registry.add("turn genes", "domain", "the genes in another order",
                 transform("turn genes", [](const CurveFit::Genome& g) {
                     return CurveFit::Genome{g[1], g[2], g[0]};
                 }));
    return registry;
}

std::vector<std::string> trace(const Stage<CurveFit>& pipeline) {
    std::vector<std::string> trace;
    const Observer<CurveFit::Genome> observer = [&](const auto& event) {
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

void refused(const std::string& text, const std::string& message, const Variants& variants = {}) {
    const auto registry = domain_words();
    CHECK_THROWS_WITH(
        [&] {
            const auto stage = Parser<CurveFit>(registry, variants).parse(text);
            check(stage, CurveFit{}, CurveFit::start(2));
        }(),
        message);
}

} // namespace

TEST_CASE("a pipeline written as text takes the same paths to the same bits as in code") {
    const auto registry = domain_words();
    Parser<CurveFit> parser(registry);
    const auto same = [&](const std::string& text, const Stage<CurveFit>& code) {
        const auto parsed = parser.parse(text);
        CHECK(parsed.text() == code.text());
        CHECK(trace(parsed) == trace(code));
    };
    same("score | best 3 | refine mma 5 genes=tenth | refine minimax 2 | best 1",
         score() | best(3) | refine(mma(5), tenth) | refine(minimax(2)) | best(1));
    same("pair(score low | above 0.95 at_least=3, score high | above 0.95 at_least=3 | turn genes, mean) | "
         "score | best 3 "
         "| refine mma 3 genes=tenth | best 1",
         pair(score("low") | above(0.95, at_least(3)),
              score("high") | above(0.95, at_least(3)) |
                  transform("turn genes",
                            [](const CurveFit::Genome& g) {
                                return CurveFit::Genome{g[1], g[2], g[0]};
                            }),
              mean) |
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

TEST_CASE("every operator's own text is read as the same operator") {
    const auto registry = domain_words();
    Parser<CurveFit> parser(registry);
    for (const std::string text :
         {"score",
          "score low",
          "best 3",
          "above 0.95",
          "below -1.5e-07 at_least=2",
          "tournament 3",
          "tournament 2 size=5",
          "roulette",
          "sus",
          "rank 1.25",
          "random",
          "random 4",
          "pareto low high",
          "front",
          "cross one_point",
          "cross n_points 4 rate=0.5",
          "cross uniform",
          "cross blend 0.25",
          "cross sbx 2",
          "mutate 0.1",
          "mutate 0.1 gaussian 0.2",
          "mutate 0.1 uniform 0.3",
          "mutate 0.1 polynomial 30",
          "mutate 0.1 reset",
          "mutate 0.1 swap",
          "mutate 0.1 reverse",
          "refine mma 3 genes=all",
          "refine minimax 3 genes=tenth",
          "refine lm 30 genes=all",
          "refine lm 9 sharpen=3 genes=all",
          "refine nlopt LN_COBYLA 20 genes=all",
          "elite 2",
          "plus",
          "plus 7",
          "parents",
          "steady",
          "turn genes",
          "repeat 3 { score | elite 1 }",
          "until generations 3 evaluations 100 seconds 2.5 fitness 0.5 stagnation 4 { score }",
          "until stagnation 4 converged 1e-12 { score }",
          "restarts 2 { score | best 1 }",
          "islands 3 rounds=4 migrants=2 { score }",
          "pair(score, best 2, mean)"})
        CHECK(parser.parse(text).text() == text);
}

TEST_CASE("a text that cannot be read is refused at its column with what was expected") {
    refused("", "pipeline, column 1: unexpected end; expected the name of a stage");
    refused("score |", "pipeline, column 8: unexpected end; expected the name of a stage");
    refused("score | | best 1", "pipeline, column 9: unexpected '|'; expected the name of a stage");
    refused("score } best", "pipeline, column 7: unexpected '}'; expected | or the end");
    refused("score | repeat 3 { best 1", "pipeline, column 26: unexpected end; expected }");
    refused("pair(score, score)", "pipeline, column 18: unexpected ')'; expected ,");
    refused("best n=", "pipeline, column 8: unexpected end; expected a value for n");
    refused("score(low)", "pipeline, column 6: unexpected '('; expected | or the end");
}

TEST_CASE("an unknown word is refused with the nearest known one") {
    refused("score | tornament 2",
            "pipeline, column 9: unknown stage 'tornament'; did you mean 'tournament'?");
    refused("score | minee", "pipeline, column 9: unknown stage 'minee'; did you mean 'mine'?",
            {{"mine", "best 1"}});
    refused("cross unifrom", "pipeline, column 7: unknown cross 'unifrom'; did you mean 'uniform'?");
    refused("score | refine lm 3 genes=tent",
            "pipeline, column 21: unknown genes 'tent'; did you mean 'tenth'?");
    refused("score | refine lm 3 genes=al", "pipeline, column 21: unknown genes 'al'; did you mean 'all'?");
    refused("pair(score, score, men)",
            "pipeline, column 20: unknown combination 'men'; did you mean 'mean'?");
    refused("score | above 0.5 atleast=3",
            "pipeline, column 19: stage 'above' has no 'atleast'; did you mean 'at_least'?");
    refused("refine 3",
            "pipeline, column 1: stage 'refine' lacks its kind; expected one of minimax, mma, lm, nlopt");
    refused("cross order",
            "pipeline, column 1: stage 'cross order' cannot work here: it needs a permutation for a genome");
}

TEST_CASE("what looks like another notation is refused with what to write instead") {
    refused("score > best 3", "pipeline, column 7: unexpected '>'; expected | or the end");
    refused(
        "score | until generations { score }",
        "pipeline, column 15: stage 'until': 'generations' lacks its value; expected a whole number from 1");
    refused("crossover uniform", "pipeline, column 1: unknown stage 'crossover'; did you mean 'cross'?");
    refused("score | cross uniform",
            "pipeline, column 9: stage 'cross uniform' leaves the population unscored at the "
            "end; expected score after it");
    refused("pareto low low",
            "pipeline, column 1: pareto is given 'low' twice; expected different objectives");
    refused("score | repeat 2 { score low | elite 1 }", "pipeline, column 32: stage 'elite 1' compares the "
                                                        "population, scored by 'low', with the generation's "
                                                        "start, scored by 'fit'; expected the same for both");
    refused("islands 100000000 { score }",
            "pipeline, column 9: stage 'islands': n is '100000000'; expected a whole "
            "number from 2 to 10000");
}

TEST_CASE("variants that unfold without end are refused before they fill the memory") {
    Variants variants{{"v0", "score"}};
    for (int i = 1; i < 40; ++i)
        variants["v" + std::to_string(i)] = "v" + std::to_string(i - 1) + " | v" + std::to_string(i - 1);
    refused("v39", "variant 'v0', column 1: more than 10000 stages, with those of variants", variants);
}

TEST_CASE("a hundred pipelines inside each other and ten thousand stages are read, and not one more") {
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

TEST_CASE("a value out of range is refused with the range") {
    refused("best", "pipeline, column 1: stage 'best' lacks 'n'; expected a whole number from 1");
    refused("best 0", "pipeline, column 6: stage 'best': n is '0'; expected a whole number from 1");
    refused("best 1000000000000", "pipeline, column 6: stage 'best': n is '1000000000000'; expected a whole "
                                  "number from 1 to 1000000000");
    refused("best 1.5", "pipeline, column 6: stage 'best': n is '1.5'; expected a whole number from 1");
    refused("best 1 2", "pipeline, column 8: stage 'best' has no place for '2'");
    refused("best 1 n=2", "pipeline, column 8: 'n' is given twice");
    refused("mutate 1.5", "pipeline, column 8: stage 'mutate': rate is '1.5'; expected a number from 0 to 1");
    refused("mutate nan", "pipeline, column 8: stage 'mutate': rate is 'nan'; expected a number from 0 to 1");
    refused("above inf", "pipeline, column 7: stage 'above': threshold is 'inf'; expected a number");
    refused("above nan", "pipeline, column 7: stage 'above': threshold is 'nan'; expected a number");
    refused(
        "until { score }",
        "pipeline, column 1: a block of generations needs an end; expected repeat N with N >= 1, or until "
        "with one of generations, evaluations, seconds, fitness, stagnation, converged");
    refused("refine nlopt LN_NONE 5", "pipeline, column 1: refine nlopt: unknown algorithm 'LN_NONE'; "
                                      "expected one of NLopt's, e.g. LN_COBYLA");
    refused("best 1 { score }", "pipeline, column 1: stage 'best' takes no { ... }");
    refused("repeat 3", "pipeline, column 1: stage 'repeat' lacks its { ... }");
}

TEST_CASE("what a pipeline lacks is refused at the column of the stage that lacks it") {
    refused("best 1",
            "pipeline, column 1: stage 'best 1' needs a scored population; expected score before it");
    refused("score | elite 1", "pipeline, column 9: stage 'elite 1' reads the start of a generation; "
                               "expected it inside repeat or until");
    refused("score | repeat 2 { mutate 0.1 | best 1 }",
            "pipeline, column 33: stage 'best 1' needs a scored population; expected score before it");
    refused("score | score middle", "pipeline, column 9: stage 'score middle': unknown objective 'middle'; "
                                    "expected one of fit, low, high");
}

TEST_CASE("two letters that changed places are one edit, at the beginning and at the end of a word too") {
    CHECK(edits("csore", "score") == 1);
    CHECK(edits("scoer", "score") == 1);
    CHECK(edits("ab", "ba") == 1);
    CHECK(edits("abc", "cab") == 2);
}

TEST_CASE("named pipelines stand as stages in each other and are expanded in place") {
    const auto registry = domain_words();
    Parser<CurveFit> parser(registry, {{"start", "score | best 3"}, {"all", "start | refine lm 3 | start"}});
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

TEST_CASE("the listing names every operator with its parameters, and what a genome lacks for it") {
    const auto registry = domain_words();
    const std::string list = listing(registry);
    for (const auto& entry : registry.entries()) {
        CHECK(list.find("  " + entry.name) != std::string::npos);
        CHECK(list.find(entry.meaning) != std::string::npos);
        CHECK(!entry.meaning.empty());
        for (const auto& parameter : entry.parameters)
            CHECK(!parameter.meaning.empty());
    }
    const auto after = [&](const std::string& line, std::size_t from) {
        const std::size_t at = ("\n" + list).find("\n" + line, from);
        REQUIRE(at != std::string::npos);
        return at;
    };
    std::string group;
    std::size_t at = 0;
    for (const auto& entry : registry.entries()) { // each below the heading of its group
        if (entry.group != group)
            at = after(entry.group + "\n", at);
        group = entry.group;
        const std::size_t next = after("  " + entry.name, at);
        CHECK(list.substr(at, next - at).find("\n\n") == std::string::npos); // and of no other
        at = next;
    }
    CHECK(list.find("  pair(left, right, name) ") != std::string::npos);
    CHECK(list.find("not for this genome: it needs a permutation for a genome") != std::string::npos);
    CHECK(list.find("a number from 0 to 1, by default 1: a pair's chance to be crossed") !=
          std::string::npos);
}

TEST_CASE("what is used wrongly is refused in a line") {
    refused(
        "score | front",
        "pipeline, column 9: stage 'front' needs a population ranked by pareto; expected pareto before it");
    auto registry = domain_words();
    CHECK_THROWS_WITH(registry.add<Best>(), "operator 'best' is registered twice");
    CHECK_NOTHROW(Syntax(std::string(999995, ' ') + "score", "it").read());
    CHECK_THROWS_WITH(Syntax(std::string(999996, ' ') + "score", "it"),
                      "it, column 1000000: the text is longer than 1000000 characters");
}
