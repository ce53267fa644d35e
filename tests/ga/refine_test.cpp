#include "ga/text/parser.hpp"
#include "tests/ga/curve_fit.hpp"

#include <catch2/catch.hpp>

using namespace ga;

TEST_CASE("Levenberg-Marquardt finds the curve's own parameters from every start") {
    const auto result = run(score() | refine(lm(60)), CurveFit{}, CurveFit::start(30));
    for (const auto& each : result.population) {
        CHECK(each.genome[0] == Approx(2).epsilon(1e-6));
        CHECK(each.genome[1] == Approx(1.5).epsilon(1e-6));
        CHECK(each.genome[2] == Approx(0.5).epsilon(1e-6));
    }
}

TEST_CASE("minimax reaches further than one row at a time by the same search in as many evaluations") {
    const auto by_one_row = run(score() | refine(mma(40)), CurveFit{}, CurveFit::start(30));
    const auto by_all_rows = run(score() | refine(minimax(40)), CurveFit{}, CurveFit::start(30));
    int further = 0;
    for (std::size_t i = 0; i < 30; ++i)
        further += by_all_rows.population[i].value() > by_one_row.population[i].value();
    CHECK(further >= 27);
    CHECK(by_all_rows.best->value() > 0.999);
}

TEST_CASE("mma and lm spend their evaluations and one for the start on each individual") {
    const auto result = run(score() | refine(mma(5)), CurveFit{}, CurveFit::start(7));
    CHECK(result.counters.gradients == 7 * 6);
    CHECK(run(score() | refine(lm(3)), CurveFit{}, CurveFit::start(7)).counters.gradients == 7 * 4);
}

TEST_CASE("a refinement never makes an individual worse and never leaves its bounds") {
    const auto start = run(score(), CurveFit{}, CurveFit::start(20)).population;
    const auto check = [&](const auto& method) {
        const auto result = run(refine(method), CurveFit{}, start);
        for (std::size_t i = 0; i < start.size(); ++i) {
            const auto& each = result.population[i];
            CHECK(each.value() >= start[i].value());
            for (const double gene : each.genome)
                CHECK((gene >= 0 && gene <= 5));
        }
        CHECK(result.best->value() > 0.4);
    };
    check(mma(3));
    check(minimax(3));
    check(lm(3));
    check(lm(20, 5));
    check(nlopt_method("LN_COBYLA", 50));
    check(nlopt_method("LN_NELDERMEAD", 50));
    check(nlopt_method("GN_DIRECT_L", 50));
}

TEST_CASE("failing evaluations inside a refinement are walked around") {
    struct Hole : CurveFit {
        Sensitivity sensitivity(const Genome& g, const std::string& objective) const {
            if (g[0] < 2.2)
                throw std::domain_error("in the hole");
            return CurveFit::sensitivity(g, objective);
        }
    };
    Population<Hole::Genome> start = population<Hole::Genome>({{3, 1, 0.7}});
    for (const auto& method : std::vector<ResidualMethod>{mma(30), minimax(30), lm(30)}) {
        const auto result = run(score() | refine(method), Hole{}, start);
        CHECK(result.population[0].genome[0] >= 2.2);
        CHECK(result.population[0].value() > run(score(), Hole{}, start).population[0].value() + 0.1);
    }
}

TEST_CASE("a gradient method is refused for a problem without a gradient when the pipeline meets it") {
    CHECK_THROWS_WITH(
        Stage<CurveFit>(score() | refine(nlopt_method("LD_LBFGS", 5))),
        "stage 'refine nlopt LD_LBFGS 5 genes=all' needs the problem's gradient; expected a method without, "
        "e.g. nlopt LN_COBYLA");
}

TEST_CASE("an unknown NLopt algorithm is refused by name") {
    CHECK_THROWS_WITH(nlopt_method("LN_NONE", 5),
                      "refine nlopt: unknown algorithm 'LN_NONE'; expected one of NLopt's, e.g. LN_COBYLA");
}

TEST_CASE("no name of NLopt's list ends the program, and a misspelt one is refused") {
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; ++i) {
        const std::string name = nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(i));
        try {
            const auto result = run(score() | refine(nlopt_method(name, 10)), CurveFit{}, CurveFit::start(2));
            CHECK(result.counters.asked <= 2 + 2 * 11 + 2); // scored, searched, scored
        } catch (const UsageError& refused) {
            CHECK(std::string(refused.what()).find(name) != std::string::npos);
        }
    }
    CHECK_THROWS_WITH(nlopt_method("LN_AUGLAG", 10),
                      "refine nlopt: algorithm 'LN_AUGLAG' needs a second optimiser; "
                      "expected one that works alone, e.g. LN_COBYLA");
    CHECK_THROWS_WITH(nlopt_method("LN_COBYLE", 10),
                      "refine nlopt: unknown algorithm 'LN_COBYLE'; expected one of NLopt's, e.g. LN_COBYLA");
    CHECK_THROWS_AS(nlopt_method("", 10), UsageError);
}

TEST_CASE("a choice of genes that the genome does not have is refused") {
    const Variables<CurveFit::Genome> beyond{"beyond", [](const CurveFit::Genome&) {
                                                 return std::vector<Variable>{{7, 0, 1}};
                                             }};
    CHECK_THROWS_WITH(run(score() | refine(lm(3), beyond), CurveFit{}, CurveFit::start(2)),
                      "refine: gene 7 is to move, the genome has 3");
}

TEST_CASE("a refinement follows the direction of its objective") {
    struct Misfit : CurveFit {
        const std::vector<Objective<Outcome>>& objectives() const {
            static const std::vector<Objective<Outcome>> list = {
                {"misfit", [](const Outcome& r) { return r.cwiseAbs().maxCoeff(); }, true}};
            return list;
        }
    };
    const auto before = run(score(), Misfit{}, CurveFit::start(5)).population;
    const auto after = run(refine(nlopt_method("LN_COBYLA", 60)), Misfit{}, before).population;
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(after[i].value() < before[i].value());
}
