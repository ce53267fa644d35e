#include "experiments/compare/problems/problems.hpp"
#include "tests/catch.hpp"

#include <Eigen/Eigenvalues>

#include <numbers>

using app::Bbob;
using Point = std::vector<double>;

namespace {

Point somewhere(std::size_t n, ga::Stream& stream, double reach = 5) {
    Point x(n);
    for (double& xi : x) xi = stream.uniform(-reach, reach);
    return x;
}

/// Condition number of the Hessian at the optimum by central differences of step h.
double condition(const Bbob& f, double h) {
    const Point& best = f.optimum();
    const auto n = static_cast<Eigen::Index>(best.size());
    Eigen::MatrixXd hessian(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) {
            const auto at = [&](double di, double dj) {
                Point x = best;
                x[static_cast<std::size_t>(i)] += di;
                x[static_cast<std::size_t>(j)] += dj;
                return f(x) - f.value();
            };
            hessian(i, j) = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h);
        }
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian).eigenvalues();
    return values[n - 1] / values[0];
}

/// Highest over lowest value above the optimum on a circle around it, for two dimensions.
double contrast(const Bbob& f, double radius) {
    double lowest = HUGE_VAL, highest = 0;
    for (int k = 0; k < 20000; ++k) {
        const double angle = k * std::numbers::pi / 1e4;
        const double above =
            f({f.optimum()[0] + radius * std::cos(angle), f.optimum()[1] + radius * std::sin(angle)}) - f.value();
        lowest = std::min(lowest, above);
        highest = std::max(highest, above);
    }
    return highest / lowest;
}

/// How much moving one coordinate changes what moving another does, relative to both.
double coupling(const Bbob& f, ga::Stream& stream) {
    const Point x = somewhere(5, stream, 4);
    double highest = 0;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            Point xi = x, xj = x, both = x;
            xi[i] = both[i] = -x[i];
            xj[j] = both[j] = -x[j];
            const double together = f(both) - f(x), apart = f(xi) + f(xj) - 2 * f(x);
            highest = std::max(highest, std::abs(together - apart) / (std::abs(f(xi) - f(x)) + std::abs(f(xj) - f(x))));
        }
    return highest;
}

} // namespace

TEST_CASE("optima of the first instance are worth what COCO publishes") {
    constexpr std::array values{79.48,  -209.88, -462.09, -462.09, -9.21, 35.9,    92.94,  149.15,
                                123.83, -54.94,  76.27,   -621.11, 29.97, -52.35,  1000.0, 71.35,
                                -16.94, -16.94,  -102.55, -546.5,  40.78, -1000.0, 6.87,   102.61};
    for (int f = 1; f <= Bbob::functions; ++f) {
        INFO("f" << f);
        CHECK(Bbob(f, 2, 1).value() == Approx(values[static_cast<std::size_t>(f - 1)]).epsilon(1e-12));
    }
}

TEST_CASE("every function of BBOB is least at its optimum, in every dimension and instance") {
    for (const int n : {2, 5, 20, 40})
        for (int f = 1; f <= Bbob::functions; ++f)
            for (const int instance : {1, 2, 15}) {
                const Bbob function(f, n, instance);
                INFO("f" << f << " of " << n << ", instance " << instance);
                CHECK(function(function.optimum()) == Approx(function.value()).margin(f == 16 ? 1e-7 : 1e-9));
                ga::Stream stream(ga::fold(static_cast<std::uint64_t>(f), static_cast<std::uint64_t>(n)));
                for (int i = 0; i < 200; ++i) {
                    CHECK(function(somewhere(static_cast<std::size_t>(n), stream)) > function.value());
                    CHECK(function(somewhere(static_cast<std::size_t>(n), stream, 20)) >= function.value());
                }
                for (const double step : {1e-2, 1e-4}) {
                    Point near = function.optimum();
                    for (double& xi : near) xi += step * stream.normal();
                    CHECK(function(near) >= function.value() - 1e-9);
                }
            }
}

TEST_CASE("the first five functions are separable, and those that are rotated are not") {
    for (int f = 1; f <= Bbob::functions; ++f) {
        ga::Stream stream(5);
        INFO("f" << f);
        const double coupled = coupling(Bbob(f, 5, 1), stream);
        if (f <= 5)
            CHECK(coupled < 1e-9);
        else
            CHECK(coupled > 1e-4);
    }
}

TEST_CASE("conditions by finite differences are those of the report") {
    CHECK(condition(Bbob(1, 5, 1), 1e-3) == Approx(1).epsilon(1e-6));
    CHECK(condition(Bbob(8, 2, 1), 1e-4) == Approx(2508).epsilon(1e-2)); // Rosenbrock's in two dimensions
    CHECK(condition(Bbob(9, 2, 1), 1e-4) == Approx(2508).epsilon(1e-2));
    for (const int f : {2, 10, 11, 12}) { // T_osz and T_asy bend what would be 1e6
        INFO("f" << f);
        CHECK(contrast(Bbob(f, 2, 3), 1e-2) > 1e3);
        CHECK(contrast(Bbob(f, 2, 3), 1e-2) < 1e7);
    }
}

TEST_CASE("values by hand") {
    for (const int n : {2, 5}) {
        // the slope's corner is flat beyond, and as steep as the report says inside
        const Bbob slope(5, n, 2);
        Point corner = slope.optimum();
        CHECK(slope(corner) == Approx(slope.value()));
        corner.back() *= 0.8;
        CHECK(slope(corner) - slope.value() == Approx(10));
        corner.back() *= 2;
        CHECK(slope(corner) == Approx(slope.value()));
    }
    // f3 where T_osz and T_asy leave 1 alone, Lambda^10 has sqrt(10) in the last of two
    const double last = std::sqrt(10), turn = 2 * std::numbers::pi;
    const Bbob f3(3, 2, 4);
    CHECK(f3({f3.optimum()[0] + 1, f3.optimum()[1] + 1}) - f3.value() ==
          Approx(10 * (2 - 1 - std::cos(turn * last)) + 1 + 10));
    // f4: a positive step of an even place counts tenfold
    const Bbob f4(4, 2, 4);
    CHECK(f4({f4.optimum()[0] + 1, f4.optimum()[1]}) - f4.value() == Approx(100));
    CHECK(f4({f4.optimum()[0] - 1, f4.optimum()[1]}) - f4.value() == Approx(1));
    CHECK(f4({f4.optimum()[0], 6}) - f4({f4.optimum()[0], 5}) > 90); // f_pen
}

TEST_CASE("the attractive sector is steep on one side only, and the step ellipsoid flat in steps") {
    CHECK(contrast(Bbob(6, 2, 1), 1) > 1e2);
    const Bbob steps(7, 5, 1);
    ga::Stream stream(8);
    int flat = 0;
    for (int i = 0; i < 100; ++i) {
        Point x = somewhere(5, stream, 4);
        const double before = steps(x);
        x[2] += 1e-9;
        flat += steps(x) == before;
    }
    CHECK(flat >= 95);
}

TEST_CASE("Gallagher's highest peak is the optimum, and its others are lower by their heights") {
    for (const int f : {21, 22}) {
        const Bbob function(f, 5, 1);
        ga::Stream stream(2);
        int low = 0;
        for (int i = 0; i < 3000; ++i) low += function(somewhere(5, stream)) - function.value() < 1;
        CHECK(low < 30); // (10 - 9.1)^2 is the next peak's
        CHECK(function({996, 0, 0, 0, 0}) - function({995, 0, 0, 0, 0}) ==
              Approx(991.0 * 991 - 990.0 * 990)); // f_pen alone, far from all peaks
        for (const double xi : function.optimum()) CHECK(std::abs(xi) <= (f == 21 ? 4.0 : 3.92));
    }
}
