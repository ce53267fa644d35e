#include "domain/text/words.hpp"
#include "experiments/compare/problems/problems.hpp"
#include "ga/pareto/many_objectives.hpp"

#include <map>
#include <numbers>
#include <numeric>

namespace app {
namespace {

using std::numbers::pi;
using Reals = std::vector<double>;
using Points = std::vector<ga::Point>;

struct FrontProblem {
    std::size_t genes, objectives;
    Evaluation (*evaluate)(const Reals&);
    Points (*front)();
    double reach = 0; ///< genes after the first lie in [-reach, reach]; 0: in [0, 1]
};

double sum_from(std::size_t first, const Reals& x, double (*term)(double)) {
    double sum = 0;
    for (std::size_t i = first; i < x.size(); ++i) sum += term(x[i]);
    return sum;
}
double linear_g(const Reals& x) {
    return 1 + 9 * sum_from(1, x, [](double xi) { return xi; }) / static_cast<double>(x.size() - 1);
}

double convex(double f1, double g) { return g * (1 - std::sqrt(f1 / g)); }
double concave(double f1, double g) { return g * (1 - f1 / g * f1 / g); }
double broken(double f1, double g) { return convex(f1, g) - f1 * std::sin(10 * pi * f1); }

Evaluation zdt1(const Reals& x) { return {{x[0], convex(x[0], linear_g(x))}}; }
Evaluation zdt2(const Reals& x) { return {{x[0], concave(x[0], linear_g(x))}}; }
Evaluation zdt3(const Reals& x) { return {{x[0], broken(x[0], linear_g(x))}}; }
Evaluation zdt4(const Reals& x) {
    const double g = 1 + 10 * static_cast<double>(x.size() - 1) +
                     sum_from(1, x, [](double xi) { return xi * xi - 10 * std::cos(4 * pi * xi); });
    return {{x[0], convex(x[0], g)}};
}
Evaluation zdt6(const Reals& x) {
    const double f1 = 1 - std::exp(-4 * x[0]) * std::pow(std::sin(6 * pi * x[0]), 6);
    const double g = 1 + 9 * std::pow((linear_g(x) - 1) / 9, 0.25);
    return {{f1, concave(f1, g)}};
}

Evaluation dtlz1(const Reals& x) {
    const double g =
        sum_from(2, x, [](double xi) { return 100 * (1 + (xi - 0.5) * (xi - 0.5) - std::cos(20 * pi * (xi - 0.5))); });
    const double size = 0.5 * (1 + g);
    return {{size * x[0] * x[1], size * x[0] * (1 - x[1]), size * (1 - x[0])}};
}
template <std::size_t objectives>
Evaluation dtlz2(const Reals& x) {
    constexpr std::size_t last = objectives - 1;
    const double g = sum_from(last, x, [](double xi) { return (xi - 0.5) * (xi - 0.5); });
    Evaluation found{Reals(objectives, 1 + g)};
    for (std::size_t k = 0; k < objectives; ++k) {
        for (std::size_t i = 0; i < last - k; ++i) found.objectives[k] *= std::cos(x[i] * pi / 2);
        if (k > 0) found.objectives[k] *= std::sin(x[last - k] * pi / 2);
    }
    return found;
}
Evaluation dtlz7(const Reals& x) {
    double g = 1;
    for (std::size_t i = 2; i < x.size(); ++i) g += 9 * x[i] / static_cast<double>(x.size() - 2);
    double h = 3;
    for (const double f : {x[0], x[1]}) h -= f / (1 + g) * (1 + std::sin(3 * pi * f));
    return {{x[0], x[1], (1 + g) * h}};
}

constexpr int along = 500;             // points of a curve
constexpr std::size_t across = 31;     // divisions of an edge of a surface: 528 points
constexpr std::size_t across_five = 8; // with five objectives: 495 points

/// The points that no other one dominates; lower is better.
Points undominated(const Points& points) {
    Points kept;
    for (const ga::Point& a : points)
        if (std::ranges::none_of(points, [&](const ga::Point& b) { return ga::dominates(a, b); })) kept.push_back(a);
    return kept;
}
Points curve(double (*f2)(double, double), double from = 0) {
    Points points;
    for (int i = 0; i < along; ++i) {
        const double f1 = from + (1 - from) * i / (along - 1.0);
        points.push_back({f1, f2(f1, 1)});
    }
    return undominated(points);
}
/// Points of the simplex of shares whose sum is 1, each over its size.
Points shares(double (*size)(const ga::Point&), std::size_t objectives = 3, std::size_t divisions = across) {
    Points points = ga::reference_directions(objectives, divisions, 0);
    for (ga::Point& point : points) {
        const double divisor = size(point);
        for (double& f : point) f /= divisor;
    }
    return points;
}
Points plane() {
    return shares([](const ga::Point&) { return 2.0; });
}
double norm_of(const ga::Point& f) { return std::sqrt(std::inner_product(f.begin(), f.end(), f.begin(), 0.0)); }
Points four_pieces() {
    Points points;
    for (int i = 0; i < 50; ++i)
        for (int j = 0; j < 50; ++j) points.push_back(dtlz7({i / 49.0, j / 49.0, 0}).objectives);
    return undominated(points);
}

const std::map<std::string, FrontProblem>& problems() {
    static const std::map<std::string, FrontProblem> all{
        {"zdt1", {30, 2, zdt1, [] { return curve(convex); }}},
        {"zdt2", {30, 2, zdt2, [] { return curve(concave); }}},
        {"zdt3", {30, 2, zdt3, [] { return curve(broken); }}},
        {"zdt4", {10, 2, zdt4, [] { return curve(convex); }, 5}},
        {"zdt6", {10, 2, zdt6, [] { return curve(concave, 0.2807753191); }}}, // the least f1
        {"dtlz1", {7, 3, dtlz1, plane}},
        {"dtlz2", {12, 3, dtlz2<3>, [] { return shares(norm_of); }}},
        {"dtlz2-5", {14, 5, dtlz2<5>, [] { return shares(norm_of, 5, across_five); }}},
        {"dtlz7", {22, 3, dtlz7, four_pieces}},
    };
    return all;
}

} // namespace

std::vector<std::string> front_problems() { return rough::names_of(problems()); }

RealInstance front_instance(const std::string& name) {
    const FrontProblem& problem = problems().at(name);
    RealInstance instance;
    instance.evaluate = problem.evaluate;
    instance.genes = problem.genes;
    instance.objectives = problem.objectives;
    for (std::size_t i = 0; i < problem.genes; ++i)
        instance.box.push_back({i, i > 0 ? -problem.reach : 0, i > 0 && problem.reach > 0 ? problem.reach : 1});
    instance.front = std::make_shared<const Points>(problem.front());
    return instance;
}

} // namespace app
