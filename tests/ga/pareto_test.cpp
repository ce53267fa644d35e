#include "ga/pareto/many_objectives.hpp"
#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

std::vector<Point> points(std::size_t n, std::size_t objectives, std::uint64_t seed) {
    Stream stream(seed);
    std::vector<Point> points(n, Point(objectives));
    for (auto& point : points)
        for (double& value : point) value = static_cast<double>(stream.below(12)); // ties included
    return points;
}

} // namespace

TEST_CASE("Pareto ranks equal those of the definition") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const auto distribution = points(40, 2 + seed % 3, seed);
        std::vector<std::size_t> expected(distribution.size(), 99);
        for (std::size_t front = 0, left = distribution.size(); left > 0; ++front) {
            std::vector<std::size_t> members;
            for (std::size_t i = 0; i < distribution.size(); ++i) {
                bool dominated = false;
                for (std::size_t j = 0; j < distribution.size(); ++j)
                    dominated |= expected[j] >= front && dominates(distribution[j], distribution[i]);
                if (expected[i] == 99 && !dominated) members.push_back(i);
            }
            for (const std::size_t i : members) expected[i] = front;
            left -= members.size();
        }
        CHECK(pareto_ranks(distribution) == expected);
    }
}

TEST_CASE("crowding distances are infinite at the ends, else the sides of the box") {
    const std::vector<Point> front = {{0, 4}, {1, 3}, {3, 1}, {4, 0}};
    const double sides = 3.0 / 4 + 3.0 / 4;
    CHECK(crowding_distances(front, {0, 0, 0, 0}) == Vector{HUGE_VAL, sides, sides, HUGE_VAL});
}

TEST_CASE("the dominated share grows unless the new point is dominated") {
    Stream stream(9);
    const Point reference(5, 0), width(5, 1);
    CHECK(dominated_share({}, reference, width) == 0);
    CHECK(dominated_share({Point(5, 1e9)}, reference, width) == 1);
    CHECK(dominated_share({{3, 2}}, {1, -1}, {2, 1}) == Approx(1.0 / 2 * 3 / 4).margin(0.02)); // u, 1 by 1
    std::vector<Point> points;
    double before = 0;
    for (int i = 0; i < 20; ++i) {
        Point point(5);
        for (double& value : point) value = 3 * stream.uniform();
        points.push_back(point);
        const double share = dominated_share(points, reference, width);
        CHECK(share >= before);
        before = share;
        Point dominated = point;
        dominated[0] *= 0.5;
        auto more = points;
        more.push_back(dominated);
        CHECK(dominated_share(more, reference, width) == share);
    }
    CHECK(before > 0);
}

TEST_CASE("the hypervolume equals that of the union of boxes above the reference") {
    CHECK(hypervolume({{2.0}, {5.0}, {3.0}}, {1}) == 4);
    CHECK(hypervolume({{0.5}}, {1}) == 0);
    CHECK(hypervolume({{3, 1}, {1, 3}, {2, 2}, {0, 9}}, {0, 0}) == 6);
    CHECK(hypervolume({}, {0, 0}) == 0);
    Stream stream(3);
    for (const std::size_t m : {2u, 3u, 4u, 5u})
        for (int round = 0; round < 20; ++round) {
            std::vector<Point> points(3, Point(m));
            for (Point& point : points)
                for (double& value : point) value = stream.uniform(0, 2);
            const Point reference(m, 0.25);
            double volume = 0; // inclusion and exclusion
            for (unsigned chosen = 1; chosen < 8; ++chosen) {
                double box = -1;
                for (std::size_t k = 0; k < m; ++k) {
                    double least = HUGE_VAL;
                    for (std::size_t i = 0; i < 3; ++i)
                        if (chosen >> i & 1) least = std::min(least, points[i][k]);
                    box *= std::max(0.0, least - reference[k]);
                }
                for (std::size_t i = 0; i < 3; ++i)
                    if (chosen >> i & 1) box = -box;
                volume += box;
            }
            CHECK(hypervolume(points, reference) == Approx(volume).margin(1e-12));
        }
}

TEST_CASE("the points that add the smallest volumes go first") {
    // Removing one after the other, each time the one that adds least, is the definition.
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const std::size_t m = 2 + seed % 4;
        std::vector<Fitness> fitness;
        std::vector<const Fitness*> pointers;
        std::vector<Point> left;
        Stream stream(seed);
        for (std::size_t i = 0; i < 14; ++i) { // on a sphere: one front
            Point point(m);
            double norm = 0;
            for (double& value : point) value = stream.uniform(), norm += value * value;
            for (double& value : point) value /= std::sqrt(norm);
            left.push_back(point);
            fitness.emplace_back(Name("pareto a b"), point);
        }
        for (const Fitness& each : fitness) pointers.push_back(&each);
        Point low = left[0], high = left[0];
        for (const Point& point : left)
            for (std::size_t k = 0; k < m; ++k)
                low[k] = std::min(low[k], point[k]), high[k] = std::max(high[k], point[k]);
        Point reference(m);
        for (std::size_t k = 0; k < m; ++k) reference[k] = low[k] - (high[k] - low[k]);
        while (left.size() > 6) {
            std::vector<double> added;
            for (std::size_t i = 0; i < left.size(); ++i) {
                auto others = left;
                others.erase(others.begin() + static_cast<long>(i));
                added.push_back(hypervolume(left, reference) - hypervolume(others, reference));
            }
            left.erase(left.begin() + (std::ranges::min_element(added) - added.begin()));
        }
        std::vector<Point> chosen;
        for (const std::size_t i : chosen_by_hypervolume(pointers, 6, 1)) chosen.push_back(fitness[i].values());
        std::ranges::sort(chosen);
        std::ranges::sort(left);
        CHECK(chosen == left);
    }
}

TEST_CASE("reference directions have the counts of Das and Dennis and fill evenly") {
    for (const auto& [m, divisions, inner, count] :
         {std::array<std::size_t, 4>{3, 12, 0, 91}, {5, 6, 0, 210}, {8, 3, 2, 156}, {2, 99, 0, 100}}) {
        const auto all = reference_directions(m, divisions, inner);
        CHECK(all.size() == count);
        CHECK(std::set<Point>(all.begin(), all.end()).size() == count);
        for (const Point& w : all) CHECK(std::accumulate(w.begin(), w.end(), 0.0) == Approx(1).epsilon(1e-12));
    }
    CHECK(directions(92).of(3).size() == 91);
    CHECK(directions(100).of(5).size() == 85); // 70 and an inner layer of 15
    // Each of the 15 directions gets one of the individuals on its line, and the other individuals stay out.
    std::vector<Fitness> fitness;
    std::vector<const Fitness*> pointers;
    for (const Point& w : reference_directions(3, 12, 0))
        fitness.emplace_back(Name("pareto a b c"), Point{-w[0], -w[1], -w[2]});
    for (const Fitness& each : fitness) pointers.push_back(&each);
    const auto wanted = reference_directions(3, 4, 0);
    Stream stream(1);
    std::set<Point> chosen;
    for (const std::size_t i : chosen_by_directions(pointers, 15, wanted, stream)) {
        const Point& f = fitness[i].values();
        chosen.insert({-f[0], -f[1], -f[2]});
    }
    CHECK(chosen == std::set<Point>(wanted.begin(), wanted.end()));
}

namespace {

/// Schaffer's problem (1985): x^2 and (x - 2)^2 are minimised.
Reals schaffer() {
    Reals problem;
    problem.n = 1;
    problem.f = [](const Vector& x) { return Vector{x[0] * x[0], (x[0] - 2) * (x[0] - 2)}; };
    problem.lower = -10, problem.upper = 10;
    problem.list = {{"f1", [](const Vector& f) { return f[0]; }, true},
                    {"f2", [](const Vector& f) { return f[1]; }, true},
                    {"worth", [](const Vector& f) { return -f[0] - f[1]; }}};
    return problem;
}
/// Schaffer's problem with the constraint |x| >= 1.
Reals walled() {
    Reals problem = schaffer();
    problem.excess = [](const Vector& f) { return Vector{1 - f[0]}; };
    return problem;
}

} // namespace

TEST_CASE("a search minimises an objective that is to be minimised") {
    const auto result = run("sample 30 | score f1 | best 3", schaffer());
    CHECK(result.population[0].value() <= result.population[1].value());
    CHECK(result.best->value() == result.population[0].value());
    CHECK(run("sample 20 | score | repeat 30 { tournament 2 | mutate 1 | score | elite 1 }", schaffer()).best->value() <
          1e-2);
    CHECK(run("sample 30 | score f1 | below 1 at_least=1", schaffer()).population[0].value() < 1);
}

TEST_CASE("a search holds the problem's constraints") {
    const auto result =
        run("sample 40 | score | repeat 40 { tournament 2 | cross blend | mutate 0.5 | score | plus }", walled());
    CHECK(result.best->fitness.feasible());
    CHECK(result.best->value() == Approx(1).margin(0.01));
    for (const auto& each : run("sample 40 | pareto f1 f2 | front", walled()).population)
        CHECK(each.fitness.feasible());
}

TEST_CASE("plus, elite and best keep the front when there are several objectives") {
    const std::string children = "{ tournament 2 | cross blend | mutate 0.5 gaussian 0.05 | pareto f1 f2 | ";
    const auto result = run("sample 40 | pareto f1 f2 | repeat 40 " + children + "plus }", schaffer());
    REQUIRE(result.population.size() == 40);
    CHECK(result.front.size() == 40);
    for (const auto& a : result.front)
        for (const auto& b : result.front) CHECK(!dominates(a.fitness.values(), b.fitness.values()));
    CHECK(result.best->fitness.minimises());
    CHECK_FALSE(result.front[0].fitness.minimises()); // its values are higher if better
    CHECK(result.best->fitness.objective() == "f1");
    CHECK(run("sample 40 | pareto f1 f2 | repeat 40 " + children + "elite 10 }", schaffer()).front.size() >= 10);
}

TEST_CASE("selection by hypervolume and by directions find a front, with the same bits on any threads") {
    const std::string begin =
        "sample 20 | pareto f1 f2 | repeat 30 { random | cross blend | mutate 0.5 gaussian 0.05 | "
        "pareto f1 f2 | parents | ";
    for (const std::string selection : {"hypervolume 20", "directions 20", "hypervolume 20 beyond=0.1"}) {
        const auto result = run(begin + selection + " }", walled(), {}, {.seed = 3, .threads = 1});
        CHECK(result.population.size() == 20);
        CHECK(result.front.size() > 15);
        CHECK(bits_of(result) == bits_of(run(begin + selection + " }", walled(), {}, {.seed = 3, .threads = 3})));
        for (const auto& each : result.population) CHECK(each.fitness.feasible());
    }
    const std::string refusal = "pipeline, column 20: stage 'hypervolume 5' needs a population ranked by "
                                "pareto; put pareto before it";
    CHECK_THROWS_WITH(run("sample 9 | score | hypervolume 5", walled()), refusal);
}

TEST_CASE("a run returns its population and front when it stops under several objectives") {
    const auto result = run("sample 40 | pareto f1 f2 | "
                            "repeat 1000 { tournament 2 | mutate 1 gaussian 0.05 | pareto f1 f2 | plus }",
                            schaffer(), {}, {.budget = {.evaluations = 410}});
    CHECK(result.stopped == "evaluation budget spent");
    CHECK(result.population.size() >= 40);
    CHECK(result.front.size() > 10);
    CHECK(result.best.has_value());
}

TEST_CASE("a search under several objectives ends when its front stagnates") {
    std::size_t generations = 0;
    const Observer<Vector> count = [&](const auto& event) { generations += event.path.ends_with("plus.1"); };
    run("sample 10 | pareto f1 f2 | until generations 5000 stagnation 30 "
        "{ tournament 2 | mutate 1 gaussian 0.01 | pareto f1 f2 | plus }",
        schaffer(), {}, {}, {count});
    CHECK((generations > 31 && generations < 5000));
}
