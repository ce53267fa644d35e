#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

#include <Eigen/QR>
#include <nlopt.h>

using namespace ga;

namespace {

using Eigen::VectorXd;

/// Residuals as a method sees them, in a box of that half width about the start. Questions are not limited.
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
        const Eigen::MatrixXd jacobian{{-20 * x[0], 10}, {-1, 0}};
        return Sensitivity{unit * Eigen::Vector2d(10 * (x[1] - x[0] * x[0]), 1 - x[0]), unit * jacobian};
    });
}

/// The curve's residuals with noise, so that no curve has none.
Landscape noisy_curve() {
    return landscape(Eigen::Vector3d(3.5, 0.4, 1.7), 100, [](const VectorXd& x) {
        Sensitivity at = CurveFit().sensitivity({x[0], x[1], x[2]}, "");
        for (Eigen::Index k = 0; k < 5; ++k) at.residuals[k] += k % 2 ? 0.2 : -0.1;
        return at;
    });
}

/// Six residuals of 300 variables.
Landscape many_variables() {
    Eigen::MatrixXd waves(6, 300);
    for (Eigen::Index i = 0; i < waves.size(); ++i) waves.data()[i] = std::sin(1.7 * static_cast<double>(i * i)) / 10;
    return landscape(VectorXd::Constant(300, 0.1), 100, [waves](const VectorXd& x) {
        const Eigen::ArrayXd at = waves * x;
        return Sensitivity{at.sin() + 0.1 * at - 0.5, (at.cos() + 0.1).matrix().asDiagonal() * waves};
    });
}

/// Levenberg-Marquardt as published, with another linear solver. Each step h is the least-squares solution of
/// J h = -r and sqrt(mu) D h = 0. D has the lengths of J's columns (Marquardt 1963). mu follows the gain
/// (Nielsen 1999, Eq. 2.21).
VectorXd by_the_book(const Landscape& land, int evaluations) {
    VectorXd x = land.start;
    Sensitivity at = *land.sensitivity(x);
    double mu = 1e-3, nu = 2;
    for (int used = 0; used < evaluations; ++used) {
        Eigen::MatrixXd system(at.jacobian.rows() + x.size(), x.size());
        system << at.jacobian, std::sqrt(mu) * Eigen::MatrixXd(at.jacobian.colwise().norm().asDiagonal());
        VectorXd right = VectorXd::Zero(system.rows());
        right.head(at.residuals.size()) = -at.residuals;
        const VectorXd h = system.colPivHouseholderQr().solve(right);
        const Sensitivity next = *land.sensitivity(x + h);
        const double before = at.residuals.squaredNorm(), after = next.residuals.squaredNorm();
        if (after < before) {
            const double gain = (before - after) / (before - (at.residuals + at.jacobian * h).squaredNorm());
            mu *= std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)), nu = 2;
            x += h;
            at = next;
        } else {
            mu *= nu, nu *= 2;
        }
    }
    return x;
}

} // namespace

TEST_CASE("every step of Levenberg-Marquardt is the published one") {
    for (const int n : {1, 2, 3, 6, 12})
        for (const Landscape& land : {rosenbrock(1), noisy_curve(), many_variables()}) {
            CAPTURE(n, land.start.size());
            CHECK((lm(n).improve(land) - by_the_book(land, n)).norm() < 1e-6);
        }
}

TEST_CASE("sharpened Levenberg-Marquardt finds the least largest residual of a line through points") {
    // The best line through (0, 0), (1, 0), (2, 3) errs by 3/4 everywhere (Chebyshev); least squares by more.
    const Landscape line = landscape(VectorXd::Zero(2), 100, [](const VectorXd& x) {
        const Eigen::MatrixXd jacobian{{1, 0}, {1, 1}, {1, 2}};
        return Sensitivity{jacobian * x - Eigen::Vector3d(0, 0, 3), jacobian};
    });
    const VectorXd found = lm(30, 1).improve(line);
    CHECK(line.sensitivity(found)->residuals.cwiseAbs().maxCoeff() == Approx(0.75).epsilon(1e-3));
    CHECK(line.sensitivity(lm(30).improve(line))->residuals.cwiseAbs().maxCoeff() > 0.9);
}

TEST_CASE("a step of Levenberg-Marquardt does not depend on the unit of residuals") {
    for (const double unit : {1e-9, 1e9})
        CHECK((lm(6).improve(rosenbrock(unit)) - lm(6).improve(rosenbrock(1))).norm() < 1e-6);
}

TEST_CASE("Levenberg-Marquardt ignores a variable that descent holds at its bound") {
    // r = (10 (y - x^2), 1 - x, x y - 2) with y held at 1, where descent would raise it
    const auto row = [](double x, double y, bool both, bool first) {
        Eigen::MatrixXd jacobian{{-20 * x, 10}, {-1, 0}, {y, x}};
        if (first) jacobian.col(0).swap(jacobian.col(1));
        return Sensitivity{Eigen::Vector3d(10 * (y - x * x), 1 - x, x * y - 2),
                           both ? jacobian : Eigen::MatrixXd(jacobian.col(first ? 1 : 0))};
    };
    const Landscape alone =
        landscape(VectorXd::Constant(1, 3), 10, [&](const VectorXd& x) { return row(x[0], 1, false, false); });
    for (const bool first : {false, true}) { // position of the free variable
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

TEST_CASE("a refinement never asks for more than the budget, on islands too") {
    const auto start = run("score", CurveFit{}, CurveFit::start(6)).population;
    for (const std::string pipeline :
         {"refine nlopt LN_COBYLA 30", "refine mma 30", "refine minimax 30", "islands 2 rounds=1 { refine lm 30 }",
          "islands 2 rounds=1 { refine nlopt LN_COBYLA 30 }"})
        for (const long budget : {20, 40, 41}) {
            const auto result = run(pipeline, CurveFit{}, start, {.budget = {.evaluations = budget}});
            CHECK(result.counters.requested <= budget);
            REQUIRE(result.population.size() == 6);
            for (const auto& each : result.population) CHECK(each.value() >= start[each.identity].value());
        }
}

TEST_CASE("a method spends its evaluations and one for the start on each individual") {
    CHECK(run("score | refine mma 5", CurveFit{}, CurveFit::start(7)).counters.gradients == 7 * 6);
    CHECK(run("score | refine lm 3", CurveFit{}, CurveFit::start(7)).counters.gradients == 7 * 4);
    for (const std::string name : {"LN_COBYLA", "LN_NELDERMEAD", "GN_CRS2_LM", "GN_ESCH"}) {
        CAPTURE(name);
        Landscape land = landscape(Eigen::Vector2d(-1.2, 1), 2, {});
        int asked = 0;
        land.fitness = [&](const VectorXd& x) { return ++asked, -functions::rosenbrock({x[0], x[1]}); };
        nlopt_method(name, 25).improve(land);
        CHECK(asked == 26);
    }
}

TEST_CASE("minimax improves more than mma in as many evaluations") {
    const auto by_one_row = run("score | refine mma 40", CurveFit{}, CurveFit::start(30));
    const auto by_all_rows = run("score | refine minimax 40", CurveFit{}, CurveFit::start(30));
    int further = 0;
    for (std::size_t i = 0; i < 30; ++i)
        further += by_all_rows.population[i].value() > by_one_row.population[i].value();
    CHECK(further >= 27);
    CHECK(by_all_rows.best->value() > 0.999);
}

TEST_CASE("a refinement never makes an individual worse and never leaves its bounds") {
    const auto start = run("score", CurveFit{}, CurveFit::start(20)).population;
    for (const std::string method : {"mma 3", "minimax 3", "lm 3", "lm 20 sharpen=5", "nlopt LN_COBYLA 50",
                                     "nlopt LN_NELDERMEAD 50", "nlopt GN_DIRECT_L 50"}) {
        CAPTURE(method);
        const auto result = run("refine " + method, CurveFit{}, start);
        for (std::size_t i = 0; i < start.size(); ++i) {
            CHECK(result.population[i].value() >= start[i].value());
            for (const double gene : result.population[i].genome) CHECK((gene >= 0 && gene <= 5));
        }
        CHECK(result.best->value() > 0.4);
    }
}

TEST_CASE("a second refinement keeps the bounds of the original genome") {
    const auto start = CurveFit::start(1);
    const auto refined = run("score | repeat 50 { refine lm 5 genes=tenth }", CurveFit{}, start).population[0];
    const Vector& original = start[0].genome;
    for (std::size_t i = 0; i < original.size(); ++i)
        CHECK((refined.genome[i] >= 0.9 * original[i] && refined.genome[i] <= 1.1 * original[i]));
    CHECK(*refined.origin == original);
    CHECK(refined.identity == start[0].identity);
}

TEST_CASE("a refinement passes around failing evaluations") {
    CurveFit hole;
    hole.on_sensitivity = [](const Vector& g, Sensitivity&) {
        if (g[0] < 2.2) throw std::domain_error("in the hole");
    };
    const auto start = population<Vector>({{3, 1, 0.7}});
    const double before = run("score", hole, start).population[0].value();
    for (const std::string method : {"mma", "minimax", "lm"}) {
        const auto result = run("score | refine " + method + " 30", hole, start);
        CHECK(result.population[0].genome[0] >= 2.2);
        CHECK(result.population[0].value() > before + 0.1);
    }
}

TEST_CASE("a missing or wrong derivative leaves genome and fitness as they were") {
    const std::vector<std::function<void(Sensitivity&)>> faults = {
        [](Sensitivity&) { throw std::domain_error("none here"); },
        [](Sensitivity&) { throw 7; },
        [](Sensitivity& at) { at.jacobian.conservativeResize(5, 2); },
        [](Sensitivity& at) { at.jacobian.conservativeResize(4, 3); },
        [](Sensitivity& at) { at.residuals[2] = std::nan(""); },
        [](Sensitivity& at) { at.jacobian(1, 1) = HUGE_VAL; },
        [](Sensitivity& at) { at.residuals.resize(0), at.jacobian.resize(0, 3); }};
    const auto unchanged = [](const auto& result, const auto& start) {
        CHECK(result.counters.gradients >= 3);
        REQUIRE(result.notes.size() == 1); // one for the stage
        CHECK_THAT(result.notes[0], Catch::Contains("/refine.1: a derivative is missing: "));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(result.population[i].genome == start[i].genome);
            CHECK(result.population[i].value() == start[i].value());
        }
    };
    const auto start = run("score", CurveFit{}, CurveFit::start(3)).population;
    for (const auto& fault : faults)
        for (const std::string method : {"lm 5", "mma 5", "minimax 5"}) {
            CurveFit faulty;
            faulty.on_sensitivity = [&](const Vector&, Sensitivity& at) { fault(at); };
            unchanged(run("refine " + method, faulty, start), start);
        }
    const auto three = run("sample 3 | score", minimum(3, functions::sphere)).population;
    for (const Vector& wrong :
         {Vector{1, 1}, Vector{1, 1, 1, 1}, Vector{1, std::nan(""), 1}, Vector{1, 1, HUGE_VAL}, Vector{}}) {
        Reals faulty = minimum(3, functions::sphere);
        faulty.slope = [&](const Vector&) { return wrong; };
        unchanged(run("refine nlopt LD_LBFGS 5", faulty, three), three);
    }
}

TEST_CASE("an exception of a problem's conversion passes through NLopt unchanged") {
    CurveFit brittle;
    for (const std::size_t n : {1u, 3u}) {
        brittle.on_conversion = [] { throw std::domain_error("cannot be"); };
        for (const std::string method : {"nlopt LN_COBYLA", "minimax"})
            CHECK_THAT(run("score | refine " + method + " 8", brittle, CurveFit::start(n)).stopped,
                       Catch::Contains("cannot continue: cannot be"));
        brittle.on_conversion = [] { throw 7; };
        CHECK_THROWS_AS(run("score | refine mma 8", brittle, CurveFit::start(n)), int);
    }
}

TEST_CASE("every algorithm of NLopt ends, inside the box, when evaluations fail or are huge") {
    for (int i = 0; i < NLOPT_NUM_ALGORITHMS; ++i)
        for (const int kind : {0, 1, 2, 3}) {
            const std::string name = nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(i));
            CAPTURE(name, kind);
            std::atomic<bool> all_inside = true; // evaluations run on several threads
            Reals problem = minimum(3, {}, -1, 2);
            problem.f = [&](const Vector& x) {
                for (const double gene : x)
                    if (!(gene >= -1 && gene <= 2)) all_inside = false;
                if (kind == 0 && x[0] > 0.9) throw std::domain_error("failed");
                const double far = kind == 1 ? std::nan("") : 1e305;
                return Vector{x[0] > 0.9 && kind < 3 ? far : std::pow(x[0] - 0.7, 2) + x[1] * x[1] + x[2] * x[2]};
            };
            problem.slope = [](const Vector& x) { return Vector{2 * x[0] - 1.4, 2 * x[1], 2 * x[2]}; };
            if (kind == 3) problem.excess = [](const Vector& y) { return Vector{y[0] - 5, -HUGE_VAL}; };
            const auto start = population(std::vector<Vector>{{0.2, -0.5, 1.5}, {-0.9, 1.9, 0.5}});
            try { // CHECK would catch what it throws
                const auto result = run("score | refine nlopt " + name + " 100", problem, start);
                CHECK(result.counters.requested <= 2 + 2 * (2 * 101 + 2)); // with derivatives
                CHECK(all_inside);
                CHECK(algorithm_number(name) == i);
                for (const auto& each : result.population)
                    CHECK(each.value() <= run("score", problem, start).population[each.identity].value());
            } catch (const UsageError& refused) {
                CHECK_THAT(refused.what(), Catch::Contains(name) && !Catch::Contains("unknown"));
            }
        }
}

TEST_CASE("a refinement without what its method needs is refused by name") {
    const auto refused = [](const std::string& name, const std::string& message) {
        CHECK_THROWS_WITH(run("score | refine nlopt " + name + " 8", CurveFit{}, CurveFit::start(2)),
                          Catch::Contains(message));
    };
    refused("LN_COBYLE", "refine nlopt: unknown algorithm 'LN_COBYLE'; use one of NLopt's, e.g. LN_COBYLA");
    refused("LN_AUGLAG", "refine nlopt: algorithm 'LN_AUGLAG' needs a second optimiser; use one that "
                         "works alone, e.g. LN_COBYLA");
    for (const int none : {0, -1})
        CHECK_THROWS_WITH(mma(none), "stage 'refine mma': evaluations is '" + std::to_string(none) +
                                         "'; give a whole number from 1 to 100000000");
    refused("LD_LBFGS", "needs the problem's gradient; use a method without one, e.g. nlopt LN_COBYLA");
}
