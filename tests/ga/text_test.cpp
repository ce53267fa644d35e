#include "ga/text/listing.hpp"
#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

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

std::vector<std::string> trace(const Pipeline<CurveFit>& pipeline) {
    std::vector<std::string> trace;
    const Observer<Vector> observer = [&](const auto& event) {
        std::string line = event.path;
        for (const auto& each : event.population) {
            line += " " + std::to_string(each.identity);
            for (const double gene : each.genome) line += " " + number(gene);
        }
        trace.push_back(line);
    };
    run<CurveFit>(pipeline, CurveFit{}, CurveFit::start(40), {.variant = "v"}, {observer});
    return trace;
}

void refused(const std::string& text, const std::string& message, const Variants& variants = {}) {
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
Pipeline<CurveFit> curves(const std::string& pipeline) { return Parser<CurveFit>(curve_registry()).parse(pipeline); }
Result<Vector> run(const std::string& pipeline, const CurveFit& problem, const Population<Vector>& start,
                   const RunOptions& options, const Observers& observers) {
    return run(curves(pipeline), problem, start, options, observers);
}

TEST_CASE("a pipeline as text gives the same paths and bits as in code") {
    Parser<CurveFit> parser(curve_registry());
    const auto same = [&](const std::string& text, const Pipeline<CurveFit>& code) {
        const auto parsed = parser.parse(text);
        CHECK(parsed.text() == code.text());
        CHECK(trace(parsed) == trace(code));
    };
    same("score | best 3 | refine mma 5 genes=tenth | refine minimax 2 | best 1",
         score() | best(3) | refine(mma(5), tenth) | refine(minimax(2)) | best(1));
    same("pair(score low | above 0.95 at_least=3, score high | above 0.95 at_least=3 | turn genes, mean) | "
         "score | best 3 "
         "| refine mma 3 genes=tenth | best 1",
         pair(score("low") | above(0.95, at_least(3)), score("high") | above(0.95, at_least(3)) | turn, mean) |
             score() | best(3) | refine(mma(3), tenth) | best(1));
    same("score|best 10|repeat 20{tournament 2|cross uniform|mutate 0.1|score|refine lm 3|elite 5}|best 1",
         score() | best(10) |
             repeat(20, tournament(2) | cross(uniform()) | mutate(0.1) | score() | refine(lm(3)) | elite(5)) | best(1));
    same("score | until fitness 0.99 generations=30 { rank 1.8 | cross sbx rate=0.9 | mutate 0.2 polynomial "
         "10 | score | plus }",
         score() | until({.generations = 30, .fitness = 0.99},
                         rank(1.8) | cross(sbx(), 0.9) | mutate(0.2, polynomial(10)) | score() | plus()));
    same("pareto low high | islands 2 rounds=3 { tournament | cross n_points 2 | mutate reset 0.1 | parents "
         "| pareto low high "
         "| best 20 } | front",
         pareto({"low", "high"}) |
             islands(2, {.rounds = 3, .migrants = 1},
                     tournament(2) | cross(n_points(2)) | mutate(0.1, reset()) | parents() | pareto({"low", "high"}) |
                         best(20)) |
             front());
}

TEST_CASE("the algorithm of ga/README.md gives the same bits as its text") {
#include "page/1.inc"
    std::ostringstream page;
    page << std::ifstream(RUGOSA_SOURCE "/ga/README.md").rdbuf();
    const std::size_t at = page.str().find("    mine = ") + 11;
    const std::string line = page.str().substr(at, page.str().find('\n', at) - at);
    const auto text = curves(line);
    CHECK(Pipeline<CurveFit>(mine).text() == text.text());
    CHECK(trace(mine) == trace(text));
    CHECK(run(text, CurveFit{}, CurveFit::start(20)).best->value() > 0.9999);
}

TEST_CASE("an operator's text is read as the same operator") {
    Parser<CurveFit> parser(curve_registry());
    const auto each_line = [](const std::string& text, auto check) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) check(line);
    };
    each_line("score\nscore low\nbest 3\nabove 0.95\nbelow -1.5e-07 at_least=2\ntournament 3\ntournament 2 "
              "size=5\ntournament 2 draw=each\n"
              "roulette\nsus\nrank 1.25\nrandom\nrandom 4\npareto low high\nfront\nhypervolume 9\nhypervolume 9 "
              "beyond=0.5\ndirections 9\n"
              "directions 9 divisions=3 inner=2\ncross one_point\n"
              "cross n_points 4 rate=0.5\ncross uniform\ncross blend 0.25\ncross sbx 2\nmutate 0.1\n"
              "mutate 0.1 gaussian 0.2\nmutate 0.1 uniform 0.3\nmutate 0.1 polynomial 30\nmutate 0.1 reset\n"
              "mutate 0.1 swap\nmutate 0.1 reverse\nmutate 0.1 insertion\nmutate 0.1 or_opt\nrefine mma 3 "
              "genes=all\nrefine minimax 3 genes=tenth\n"
              "refine lm 30 genes=all\nrefine lm 9 sharpen=3 genes=all\nrefine nlopt LN_COBYLA 20 genes=all\n"
              "elite 2\nplus\nplus 7\nplus copies=none\ndistinct\ndistinct 0.25\nparents\nsteady\nturn "
              "genes\nrepeat 3 { score | elite 1 }\n"
              "until generations 3 evaluations 100 seconds 2.5 fitness 0.5 stagnation 4 { score }\n"
              "until stagnation 4 converged 1e-12 { score }\nrestarts 2 { score | best 1 }\n"
              "islands 3 rounds=4 migrants=2 { score }\npair(score, best 2, mean)",
              [&](const std::string& text) { CHECK(parser.parse(text).text() == text); });
    each_line("average 3\ncma-es sigma=0.2 population=7 restarts=ipop\nde best F=0.7 CR=0.3\n"
              "de rand F=0.5 CR=0.9 crossing=exp\nl-shade evaluations=900 memory=4 archive=1.5 p=0.2\n"
              "self-adaptive 0.2 steps=one\nshare 0.3 alpha=2\nclear 0.3 capacity=2\nmap-elites a b cells=5\n"
              "emit 4 a b sigma=0.2\nduel\ncrowding\nsample 3\nsample 3 sobol\nsample 3 latin",
              [](const std::string& text) { CHECK(reals(text).text() == text); });
}

TEST_CASE("unreadable text is refused at its column with the expected word") {
    refused("", "pipeline, column 1: unexpected end; give the name of a stage");
    refused("score | | best 1", "pipeline, column 9: unexpected '|'; give the name of a stage");
    refused("score | repeat 3 { best 1", "pipeline, column 26: unexpected end; write }");
    refused("pair(score, score)", "pipeline, column 18: unexpected ')'; write ,");
    refused("score > best 3", "pipeline, column 7: unexpected '>'; write | or end the text");
    refused("best 1 { score }", "pipeline, column 1: stage 'best' takes no { ... }; remove it");
    refused("repeat 3", "pipeline, column 1: stage 'repeat' lacks its { ... }; add it");
}

TEST_CASE("an unknown word is refused with the nearest known one") {
    refused("score | tornament 2", "pipeline, column 9: unknown stage 'tornament'; did you mean 'tournament'?");
    refused("score | minee", "pipeline, column 9: unknown stage 'minee'; did you mean 'mine'?", {{"mine", "best 1"}});
    refused("cross unifrom", "pipeline, column 7: unknown cross 'unifrom'; did you mean 'uniform'?");
    refused("pair(score, score, men)", "pipeline, column 20: unknown combination 'men'; did you mean 'mean'?");
    refused("score | above 0.5 atleast=3",
            "pipeline, column 19: stage 'above' has no 'atleast'; did you mean 'at_least'?");
    refused("refine 3", "pipeline, column 1: stage 'refine' lacks its kind; use one of minimax, mma, lm, nlopt");
    refused("cross order", "pipeline, column 1: stage 'cross order' cannot work here; use a problem that has "
                           "a permutation for a genome");
}

TEST_CASE("more than 100 nested pipelines, 10,000 stages or a million characters are refused") {
    const auto inside = [](int depth) {
        std::string text = "score";
        for (int i = 1; i < depth; ++i) text = "repeat 2 { " + text + " }";
        return Syntax(text, "pipeline").read().size();
    };
    CHECK(inside(100) == 1);
    CHECK_THROWS_WITH(inside(101), Catch::Contains("more than 100 pipelines inside each other"));
    const auto hundred = [](const std::string& stage) {
        std::string text = stage;
        for (int i = 1; i < 100; ++i) text += " | " + stage;
        return text;
    };
    const std::string row = hundred("score"), all = hundred("row");
    Parser<CurveFit> parser(curve_registry(), {{"row", row}, {"all", all}, {"more", all + " | best 1"}});
    CHECK_NOTHROW(parser.variant("all"));
    CHECK_THROWS_WITH(parser.variant("more"), Catch::Contains("more than 10000 stages"));
    CHECK_NOTHROW(parser.variant("all")); // stages of earlier texts do not count
    CHECK_NOTHROW(parser.parse(all));
    CHECK_NOTHROW(Syntax(std::string(999995, ' ') + "score", "it").read());
    CHECK_THROWS_WITH(Syntax(std::string(999996, ' ') + "score", "it"),
                      Catch::Contains("it, column 1000000: the text is longer than 1000000 characters"));
}

TEST_CASE("a value out of range is refused with the range") {
    refused("best", "pipeline, column 1: stage 'best' lacks 'n'; give a whole number from 1");
    for (const std::string value : {"0", "1.5"})
        refused("best " + value, "pipeline, column 6: stage 'best': n is '" + value + "'; give a whole number from 1");
    refused("best 1 2", "pipeline, column 8: stage 'best' has no place for '2'; remove it");
    refused("best 1 n=2", "pipeline, column 8: 'n' is given twice; give it once");
    for (const std::string value : {"1.5", "nan"})
        refused("mutate " + value,
                "pipeline, column 8: stage 'mutate': rate is '" + value + "'; give a number from 0 to 1");
    refused("islands 10001 { score }",
            "pipeline, column 9: stage 'islands': n is '10001'; give a whole number from 2 to 10000");
    refused("until generations { score }",
            "pipeline, column 7: stage 'until': 'generations' lacks its value; give a whole number from 1");
    refused("until { score }",
            "pipeline, column 1: until has no end; give one of generations, evaluations, seconds, fitness, "
            "stagnation, converged");
}

TEST_CASE("a pipeline that cannot work is refused at its stage's column") {
    refused("score | repeat 2 { mutate 0.1 | best 1 }",
            "pipeline, column 33: stage 'best 1' needs a scored population; put score before it");
    refused("score | cross uniform", "pipeline, column 9: stage 'cross uniform' leaves the population "
                                     "unscored at the end; put score after it");
    refused("pareto low low", "pipeline, column 1: pareto is given 'low' twice; give different objectives");
}

TEST_CASE("a named pipeline is expanded in place") {
    Parser<CurveFit> parser(curve_registry(), {{"start", "score | best 3"}, {"all", "start | refine lm 3 | start"}});
    CHECK(parser.variant("all").text() == "score | best 3 | refine lm 3 genes=all | score | best 3");
    CHECK(trace(parser.variant("all")).back().starts_with("v/best.2 "));
    CHECK_THROWS_WITH(parser.variant("al"), "unknown variant 'al'; did you mean 'all'?");
    refused("a", "variant 'b', column 9: variants contain each other: a -> b -> a; remove one",
            {{"a", "b"}, {"b", "score | a"}});
    refused("a 3", "pipeline, column 1: variant 'a' takes no arguments; remove them", {{"a", "score"}});
    refused("score", "variant 'best' has an operator's name; choose another", {{"best", "score"}});
    refused("a", "variant 'a', column 6: stage 'best': n is '0'; give a whole number from 1", {{"a", "best 0"}});
}

TEST_CASE("the listing names every operator under its group, with its unmet needs") {
    const std::string list = "\n" + listing(curve_registry());
    std::size_t group = 0;
    for (const auto& entry : curve_registry().entries()) {
        group = list.find("\n" + entry.group + "\n", group);
        REQUIRE(group != std::string::npos);
        const std::size_t at = list.find("\n  " + entry.name, group);
        CHECK((at != std::string::npos && list.find(entry.meaning, at) != std::string::npos));
    }
    CHECK(list.find("not for this genome: it needs a permutation for a genome") != std::string::npos);
    CHECK(list.find("a number from 0 to 1, by default 1: a pair's chance to be crossed") != std::string::npos);
}

TEST_CASE("operators have the default parameters of their publications") {
    for (const auto& [name, published] :
         std::map<std::string, std::string>{{"cross blend", "0.5"},        // Eshelman and Schaffer 1993
                                            {"mutate 1 polynomial", "20"}, // Deb et al. 2002, as is sbx
                                            {"cross sbx", "15"},
                                            {"share 1", "alpha=1"},                     // Goldberg and Richardson 1987
                                            {"clear 1", "capacity=1"},                  // Petrowski 1996
                                            {"cma-es", "0.3"},                          // Hansen 2016
                                            {"de", "rand F=0.5 CR=0.9 crossing=bin"},   // Storn and Price 1997
                                            {"l-shade", "memory=6 archive=2.6 p=0.11"}, // Tanabe and Fukunaga 2014
                                            {"epsilon 9", "share=0.5 power=5"}})        // Takahama and Sakai 2006
        CHECK(reals(name).text() == reals(name + " " + published).text());
}
