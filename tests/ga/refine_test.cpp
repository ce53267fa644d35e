#include "ga/text/parser.hpp"
#include "tests/ga/curve_fit.hpp"

#include <Eigen/QR>
#include <catch2/catch.hpp>

using namespace ga;

namespace {

using Eigen::VectorXd;

/// Residuals as a method sees them, in a box of that half width about the start, with as many questions as it
/// likes.
Landscape landscape(const VectorXd& start, double half,
                    std::function<std::optional<Sensitivity>(const VectorXd&)> sensitivity) {
    Landscape land;
    land.start = start;
    land.lower = start.array() - half;
    land.upper = start.array() + half;
    land.sensitivity = std::move(sensitivity);
    land.exhausted = [] { return false; };
    return land;
}

/// Rosenbrock's function as residuals of unit `unit`.
Landscape rosenbrock(double unit) {
    return landscape(Eigen::Vector2d(-1.2, 1), 100, [unit](const VectorXd& x) {
        Eigen::MatrixXd jacobian(2, 2);
        jacobian << -20 * x[0], 10, -1, 0;
        return Sensitivity{unit * Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]), unit * jacobian};
    });
}

/// The curve's residuals with noise, so that no curve has none.
Landscape noisy_curve() {
    return landscape(Eigen::Vector3d(3.5, 0.4, 1.7), 100, [](const VectorXd& x) {
        Sensitivity at = CurveFit().sensitivity({x[0], x[1], x[2]}, "");
        for (Eigen::Index k = 0; k < 5; ++k)
            at.residuals[k] += k % 2 ? 0.2 : -0.1;
        return at;
    });
}

/// Levenberg-Marquardt as it is published, by another way to solve it: each step h is the least-squares
/// solution of J h = -r and sqrt(mu) D h = 0 with D the lengths of J's columns (Marquardt 1963), mu follows
/// the gain (Nielsen 1999, Eq. 2.21), and rows are weighed from evaluation `sharpen` on.
VectorXd by_the_book(const Landscape& land, int evaluations, int sharpen) {
    VectorXd x = land.start, best = x;
    Sensitivity at = *land.sensitivity(x);
    double mu = 1e-3, nu = 2, least = at.residuals.cwiseAbs().maxCoeff();
    for (int used = 0; used < evaluations; ++used) {
        VectorXd weights = VectorXd::Ones(at.residuals.size());
        if (sharpen > 0 && used >= sharpen)
            weights = (at.residuals / at.residuals.cwiseAbs().maxCoeff()).cwiseAbs2().array() + 0.05;
        const VectorXd roots = weights.cwiseSqrt(), here = roots.cwiseProduct(at.residuals);
        const Eigen::MatrixXd rows = roots.asDiagonal() * at.jacobian;
        Eigen::MatrixXd system(rows.rows() + x.size(), x.size());
        system << rows, std::sqrt(mu) * Eigen::MatrixXd(rows.colwise().norm().asDiagonal());
        VectorXd right = VectorXd::Zero(system.rows());
        right.head(here.size()) = -here;
        const VectorXd h = system.colPivHouseholderQr().solve(right);
        const Sensitivity next = *land.sensitivity(x + h);
        const double before = here.squaredNorm(), after = roots.cwiseProduct(next.residuals).squaredNorm();
        if (after < before) {
            const double gain = (before - after) / (before - (here + rows * h).squaredNorm());
            mu *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)), nu = 2;
            x += h;
            at = next;
            if (const double worst = at.residuals.cwiseAbs().maxCoeff(); sharpen == 0 || worst < least)
                best = x, least = worst;
        } else {
            mu *= nu, nu *= 2;
        }
    }
    return best;
}

} // namespace

TEST_CASE("every step of Levenberg-Marquardt is the published one, accepted or not, sharpened or not") {
    for (int n = 1; n <= 12; ++n)
        for (const int sharpen : {0, 3})
            for (const Landscape& land : {rosenbrock(1), noisy_curve()}) {
                CAPTURE(n, sharpen, land.start.size());
                CHECK((lm(n, sharpen).improve(land) - by_the_book(land, n, sharpen)).norm() < 1e-6);
            }
}

TEST_CASE("the unit of the residuals changes no step of Levenberg-Marquardt") {
    for (const double unit : {1e-9, 1e9})
        CHECK((lm(6).improve(rosenbrock(unit)) - lm(6).improve(rosenbrock(1))).norm() < 1e-6);
}

TEST_CASE("a variable that descent holds at its bound is to Levenberg-Marquardt as if it were none") {
    // r = (10 (y - x^2), 1 - x, x y - 2) with y held at 1, where descent would raise it
    const auto row = [](double x, double y, bool both, bool first) {
        Eigen::MatrixXd jacobian(3, 2);
        jacobian << -20 * x, 10, -1, 0, y, x;
        if (first)
            jacobian.col(0).swap(jacobian.col(1));
        return Sensitivity{Eigen::Vector3d(10 * (y - x * x), 1 - x, x * y - 2),
                           both ? jacobian : Eigen::MatrixXd(jacobian.col(first ? 1 : 0))};
    };
    const Landscape alone = landscape(VectorXd::Constant(1, 3), 10,
                                      [&](const VectorXd& x) { return row(x[0], 1, false, false); });
    for (const bool first : {false, true}) { // of the two
        Landscape both = landscape(first ? Eigen::Vector2d(1, 3) : Eigen::Vector2d(3, 1), 10,
                                   [&](const VectorXd& x) { return row(x[first], x[!first], true, first); });
        both.upper[!first] = 1;
        for (int n = 1; n <= 5; ++n) {
            const VectorXd found = lm(n).improve(both);
            CHECK(found[!first] == 1);
            CHECK(found[first] == Approx(lm(n).improve(alone)[0]).epsilon(1e-9));
        }
    }
}

TEST_CASE("minimax finds Chebyshev's line through a parabola in ten evaluations") {
    const Landscape land = landscape(Eigen::Vector2d(0.9, 0.9), 3, [](const VectorXd& x) {
        Sensitivity at{VectorXd(11), Eigen::MatrixXd(11, 2)};
        for (int i = 0; i <= 10; ++i) {
            at.jacobian.row(i) << 1, i / 10.0;
            at.residuals[i] = at.jacobian.row(i) * x - i * i / 100.0;
        }
        return at;
    });
    const VectorXd best = minimax(10).improve(land);
    CHECK(land.sensitivity(best)->residuals.cwiseAbs().maxCoeff() < 0.1251); // 1/8 is the least
}

TEST_CASE("a gradient method takes no point whose gradient is not to be had") {
    for (const VectorXd& none : {VectorXd(), VectorXd(VectorXd::Constant(1, std::nan("")))}) {
        Landscape land = landscape(VectorXd::Constant(1, 0.5), 10, {});
        land.fitness = [](const VectorXd& x) { return -std::pow(x[0] - 3, 2); };
        land.gradient = [&](const VectorXd& x) {
            return x[0] > 2 ? none : VectorXd(VectorXd::Constant(1, 6 - 2 * x[0]));
        };
        const double best = nlopt_method("LD_LBFGS", 40).improve(land)[0];
        CHECK(best <= 2);
        CHECK(best >= 0.5);
    }
}

TEST_CASE("a search asks nothing more once the run has to stop or its share is spent, whatever its method") {
    /// Stops the run at the third question.
    struct Closing : EvaluationQueue<CurveFit> {
        Ledger<CurveFit>& ledger;
        int asked = 0;
        explicit Closing(Ledger<CurveFit>& l) : ledger(l) {}
        using EvaluationQueue<CurveFit>::serve;
        void serve(std::span<EvaluationRequest<CurveFit>* const> inquiries) override {
            if (++asked < 3)
                return ledger.serve(inquiries);
            for (auto* inquiry : inquiries)
                inquiry->error = std::make_exception_ptr(Stopped{"enough"});
        }
    };
    const CurveFit problem;
    Serial<CurveFit> serial;
    const Budget endless;
    const auto individual = run(score(), problem, CurveFit::start(1)).population[0];
    Method stubborn; // that never looks whether it may ask
    stubborn.improve = [](const Landscape& land) {
        for (int i = 1; i <= 50; ++i)
            land.fitness(land.start + Eigen::Vector3d::Constant(1e-3 * i));
        return land.start;
    };
    for (const Method& method :
         std::vector<Method>{lm(20), mma(20), minimax(20), nlopt_method("LN_COBYLA", 20), stubborn}) {
        CAPTURE(method.text);
        Ledger<CurveFit> ledger(problem, serial, 1 << 20, endless);
        const auto search = [&](EvaluationQueue<CurveFit>& door, long limit) {
            Search<CurveFit>(problem, door, ledger.watch(), individual, problem.bounds(individual.genome),
                             limit)
                .by(method, 1);
        };
        Closing closing(ledger);
        search(closing, 1000);
        CHECK(closing.asked == 3);
        ledger.counters = {};
        search(ledger, 7);
        CHECK(ledger.counters.asked == 7);
    }
}

TEST_CASE("neither islands nor gradients let a refinement ask for more than the budget has") {
    struct Sloped : CurveFit {
        std::vector<double> gradient(const Genome& g, const std::string&) const {
            const Sensitivity at = sensitivity(g, "");
            Eigen::Index worst = 0;
            at.residuals.cwiseAbs().maxCoeff(&worst);
            const VectorXd slope = (at.residuals[worst] < 0 ? 1 : -1) * at.jacobian.row(worst).transpose();
            return {slope.begin(), slope.end()};
        }
    };
    const auto check = [](const Stage<Sloped>& stage) {
        const auto start = run(score(), Sloped{}, CurveFit::start(6)).population;
        for (const long budget : {20, 40, 41}) {
            const auto result = run(stage, Sloped{}, start, {.budget = {.evaluations = budget}});
            CHECK(result.counters.asked <= budget);
            REQUIRE(result.population.size() == 6);
            for (const auto& each : result.population)
                CHECK(each.value() >= start[each.identity].value());
        }
    };
    check(refine(nlopt_method("LD_LBFGS", 30)));
    check(islands(2, {.rounds = 1, .migrants = 1}, refine(lm(30))));
    check(islands(2, {.rounds = 1, .migrants = 1}, refine(nlopt_method("LN_COBYLA", 30))));
}

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

TEST_CASE("the worst row is read with its sign, and an NLopt search asks once more than it was given") {
    const Reading worst = least_worst(Eigen::Vector3d(1, -3, 2));
    CHECK(worst.value == -3);
    CHECK(worst.merit == -3);
    CHECK(worst.slopes == std::vector<std::pair<Eigen::Index, double>>{{1, 1.0}});
    CHECK(least_worst(Eigen::Vector2d(4, -3)).slopes[0] == std::pair<Eigen::Index, double>(0, -1.0));
    for (const std::string name : {"LN_COBYLA", "LN_NELDERMEAD", "GN_CRS2_LM", "GN_ESCH"}) {
        CAPTURE(name);
        Landscape land = landscape(Eigen::Vector2d(-1.2, 1), 2, {});
        int asked = 0;
        land.fitness = [&](const VectorXd& x) {
            ++asked;
            return -std::pow(10 * (x[1] - x[0] * x[0]), 2) - std::pow(1 - x[0], 2);
        };
        nlopt_method(name, 25).improve(land);
        CHECK(asked == 26);
    }
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

TEST_CASE("a method without an evaluation is refused in code, too") {
    CHECK_THROWS_AS(lm(0), UsageError);
    CHECK_THROWS_AS(mma(0), UsageError);
    CHECK_THROWS_AS(minimax(0), UsageError);
    CHECK_THROWS_AS(nlopt_method("LN_COBYLA", 0), UsageError);
}

TEST_CASE("an unknown NLopt algorithm is refused by name") {
    CHECK_THROWS_WITH(nlopt_method("LN_NONE", 5),
                      "refine nlopt: unknown algorithm 'LN_NONE'; expected one of NLopt's, e.g. LN_COBYLA");
}

TEST_CASE("no name of NLopt's list ends the program, and a misspelt one is refused") {
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; ++i) {
        const std::string name = nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(i));
        try {
            const int number = algorithm_number(name);
            CHECK(number == i);
            const auto result = run(score() | refine(nlopt_method(name, 10)), CurveFit{}, CurveFit::start(2));
            CHECK(result.counters.asked <= 2 + 2 * 11 + 2); // scored, searched, scored
        } catch (const UsageError& refused) {
            CHECK(std::string(refused.what()).find(name) != std::string::npos);
            CHECK(std::string(refused.what()).find("unknown") == std::string::npos);
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

TEST_CASE("a derivative that is missing, of a wrong size or not finite leaves everybody where he was") {
    struct Faulty : CurveFit {
        int fault = 0;
        void fail() const {
            if (fault == 0)
                throw std::domain_error("none here");
            if (fault == 1)
                throw 7;
        }
        Sensitivity sensitivity(const Genome& g, const std::string& objective) const {
            fail();
            Sensitivity at = CurveFit::sensitivity(g, objective);
            switch (fault) {
            case 2:
                at.jacobian.conservativeResize(5, 2);
                break;
            case 3:
                at.jacobian.conservativeResize(4, 3);
                break;
            case 4:
                at.residuals[2] = std::nan("");
                break;
            case 5:
                at.jacobian(1, 1) = HUGE_VAL;
                break;
            default:
                at = {VectorXd(), Eigen::MatrixXd(0, 3)};
            }
            return at;
        }
        std::vector<double> gradient(const Genome&, const std::string&) const {
            fail();
            switch (fault) {
            case 2:
                return {1, 1};
            case 3:
                return {1, 1, 1, 1};
            case 4:
                return {1, std::nan(""), 1};
            case 5:
                return {1, 1, HUGE_VAL};
            default:
                return {};
            }
        }
    };
    const auto start = run(score(), CurveFit{}, CurveFit::start(3)).population;
    for (Faulty problem; problem.fault < 7; ++problem.fault) {
        CAPTURE(problem.fault);
        const auto check = [&](const auto& method) {
            const auto result = run(refine(method), problem, start);
            CHECK(result.counters.gradients >= 3);
            for (std::size_t i = 0; i < 3; ++i) {
                CHECK(result.population[i].genome == start[i].genome);
                CHECK(result.population[i].value() == start[i].value());
            }
        };
        check(lm(5));
        check(mma(5));
        check(minimax(5));
        check(nlopt_method("LD_LBFGS", 5));
    }
}

TEST_CASE("a start without residuals is the end of minimax") {
    const auto result =
        run(score() | refine(minimax(9)), CurveFit{}, population<CurveFit::Genome>({{2, 1.5, 0.5}}));
    CHECK(result.counters.gradients == 1);
    CHECK(result.population[0].genome == CurveFit::Genome{2, 1.5, 0.5});
}

TEST_CASE("a refinement in which everything fails leaves those who were scored before as they were") {
    struct Broken : CurveFit {
        std::vector<Genome> known;
        Outcome evaluate(const Genome& genome) const {
            if (std::find(known.begin(), known.end(), genome) == known.end())
                throw std::domain_error("out of order");
            return CurveFit::evaluate(genome);
        }
    };
    const auto start = run(score(), CurveFit{}, CurveFit::start(3)).population;
    Broken broken;
    for (const auto& each : start)
        broken.known.push_back(each.genome);
    for (const std::size_t n : {1, 3}) {
        const Population<CurveFit::Genome> some(start.begin(), start.begin() + static_cast<long>(n));
        const auto result = run(refine(nlopt_method("LN_COBYLA", 8)), broken, some);
        CHECK(result.counters.evaluations >= 3);
        for (std::size_t i = 0; i < n; ++i)
            CHECK(result.population[i].genome == start[i].genome);
    }
}

TEST_CASE("what a problem's conversion of genes throws comes through NLopt as it was") {
    struct Brittle : CurveFit {
        bool odd = false;
        Genome with_genes(const Genome&, const std::vector<double>& genes) const {
            if (odd)
                throw 7;
            throw std::domain_error("cannot be " + std::to_string(genes.size()));
        }
    };
    for (const std::size_t n : {1, 3}) {
        CHECK_THROWS_WITH(run(score() | refine(nlopt_method("LN_COBYLA", 8)), Brittle{}, CurveFit::start(n)),
                          "cannot be 3");
        CHECK_THROWS_WITH(run(score() | refine(minimax(8)), Brittle{}, CurveFit::start(n)), "cannot be 3");
        CHECK_THROWS_AS(run(score() | refine(mma(8)), Brittle{{}, true}, CurveFit::start(n)), int);
    }
}

TEST_CASE("what NLopt refuses is refused under the algorithm's name") {
    const Variables<CurveFit::Genome> free{"free", [](const CurveFit::Genome&) {
                                               return std::vector<Variable>{{0, -HUGE_VAL, HUGE_VAL}};
                                           }};
    CHECK_THROWS_WITH(
        run(score() | refine(nlopt_method("GN_CRS2_LM", 8), free), CurveFit{}, CurveFit::start(2)),
        "refine Controlled random search (CRS2) with local mutation (global, no-derivative): "
        "finite domain required for global algorithm");
}
