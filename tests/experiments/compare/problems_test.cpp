#include "experiments/compare/contest.hpp"
#include "experiments/compare/problems/problems.hpp"
#include "tests/catch.hpp"

using namespace app;

namespace {

std::vector<double> drawn(const RealInstance& instance, ga::Stream& stream) {
    std::vector<double> x;
    for (const ga::Variable& gene : instance.box) x.push_back(stream.uniform(gene.lower, gene.upper));
    return x;
}

/// Genes behind the first ones that lead to the front.
std::vector<double> best_behind(const std::string& name, std::vector<double> first, std::size_t genes) {
    first.resize(genes, name == "dtlz1" || name == "dtlz2" ? 0.5 : 0.0);
    return first;
}

} // namespace

TEST_CASE("values of the test problems by hand") {
    const auto at = [](const std::string& name, const std::vector<double>& x) {
        return front_instance(name).evaluate(x).objectives;
    };
    const std::vector<double> ones(30, 1.0);
    CHECK(at("zdt1", ones)[1] == Approx(10 * (1 - std::sqrt(0.1))));
    CHECK(at("zdt2", ones)[1] == Approx(10 * (1 - 0.01)));
    CHECK(at("zdt3", {0.05, 0})[1] == Approx(1 - std::sqrt(0.05) - 0.05));
    CHECK(at("zdt4", {0, 0.25})[1] == Approx(1 + 10 + 0.0625 + 10));
    CHECK(at("zdt6", {0, 1})[0] == Approx(1));
    CHECK(at("zdt6", {0, 1})[1] == Approx(10 * (1 - 0.01)));
    CHECK(at("dtlz1", {1, 1, 0.5}) == std::vector<double>{0.5, 0, 0});
    CHECK(at("dtlz1", {1, 1, 1})[0] == Approx(0.5 * (1 + 100 * 0.25)));
    CHECK(at("dtlz2", {0, 0, 0.5}) == std::vector<double>{1, 0, 0});
    CHECK(at("dtlz2", {1, 0.3, 1})[2] == Approx(1.25));
    CHECK(at("dtlz2-5", {0, 0, 0, 0, 1, 0.5})[0] == Approx(1.25));
    CHECK(at("dtlz2-5", {0.5, 1, 0, 0, 0.5})[3] == Approx(std::sqrt(0.5)));
    CHECK(at("dtlz7", {0, 0, 0})[2] == Approx(6));
    CHECK(at("dtlz7", {0, 0, 1})[2] == Approx(33));
}

TEST_CASE("nothing drawn at random betters a known front, and the front can be reached") {
    for (const std::string& name : front_problems()) {
        INFO(name);
        const RealInstance instance = front_instance(name);
        CHECK(instance.front->size() > 100);
        for (std::size_t f = 0; f + 1 < instance.objectives; ++f) // up to its rim
            CHECK(std::any_of(instance.front->begin(), instance.front->end(), [&](const ga::Point& point) {
                return std::abs(point[f] - (name == "zdt6" ? 0.2807753191 : 0)) < 1e-12;
            }));
        ga::Stream stream(3);
        for (int i = 0; i < 200; ++i) {
            const auto f = instance.evaluate(drawn(instance, stream)).objectives;
            for (const ga::Point& point : *instance.front)
                CHECK_FALSE((std::equal(f.begin(), f.end(), point.begin(), std::less_equal<>()) && f != point));
        }
        if (instance.objectives > 3) continue;
        Nearness nearness(instance);
        double near = HUGE_VAL;
        const int steps = instance.objectives == 2 ? 3000 : 70;
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; j <= (instance.objectives == 2 ? 0 : steps); ++j) {
                const double u = i / double(steps), v = j / double(steps);
                std::vector<double> first{u};
                if (instance.objectives == 3) first.push_back(v);
                near = nearness.after(instance.evaluate(best_behind(name, first, instance.genes)));
            }
        CHECK(near < (instance.objectives == 2 ? 1e-3 : 1e-2));
    }
}

TEST_CASE("functions of CEC 2006 have their published values at the published optima") {
    const std::vector<std::vector<double>> optima{
        {1, 1, 1, 1, 1, 1, 1, 1, 1, 3, 3, 3, 1},
        {3.16246061572,  3.12833142813,  3.09479212989,  3.06145059523,  3.02792915886,  2.99382606702,  2.95866871765,
         2.92184227312,  0.494825114569, 0.488357110055, 0.482316427119, 0.476644750927, 0.471295508355, 0.466230992642,
         0.461420049842, 0.456836647672, 0.452458769033, 0.448267622419, 0.444247009588, 0.440382859563},
        std::vector<double>(10, 0.316243577),
        {78, 33, 29.9952560257, 45, 36.7758129058},
        {679.945148297, 1026.066976, 0.118876369094, -0.396233485215},
        {14.095, 0.842960789215},
        {2.17199634143, 2.3636830416, 8.77392573913, 5.09598443745, 0.99065475656, 1.43057392853, 1.32164415364,
         9.82872576524, 8.28009158874, 8.37592664773},
        {1.22797135261, 4.24537336612},
        {2.33049935147, 1.95137236847, -0.477541399511, 4.36572624924, -0.6244869591, 1.03813099411, 1.59422667807},
        {579.306685018, 1359.97067808, 5109.97065743, 182.017699631, 295.601173703, 217.982300369, 286.416525928,
         395.601173703},
        {-0.707036070037, 0.500000004334}};
    REQUIRE(constrained_problems().size() == optima.size());
    for (std::size_t i = 0; i < optima.size(); ++i) {
        INFO(constrained_problems()[i]);
        const RealInstance instance = constrained_instance(constrained_problems()[i]);
        const Evaluation found = instance.evaluate(optima[i]);
        CHECK(found.objectives[0] == Approx(instance.best).epsilon(1e-8));
        CHECK(violated(found) < 1e-3); // at digits that are printed
    }
}

TEST_CASE("L-SHADE with levels solves functions of CEC 2006 on thin and curved feasible sets") {
    for (const std::string name : {"g03", "g05", "g06"}) {
        int solved = 0;
        for (std::uint64_t seed = 1; seed <= 5; ++seed)
            solved += raced(constrained_instance(name), usual_contestants().at("constrained")[0].second, {1e-4},
                            {seed, 100000, nullptr})
                          .precision <= 1e-4;
        INFO(name);
        CHECK(solved >= 4);
    }
}

TEST_CASE("IGD+ counts only shortfalls: a better point has none") {
    RealInstance instance;
    instance.objectives = 2;
    instance.front = std::make_shared<const std::vector<ga::Point>>(std::vector<ga::Point>{{0, 1}, {1, 0}});
    Nearness nearness(instance);
    CHECK(nearness.after({{3, 5}}) == Approx((std::hypot(3, 4) + std::hypot(2, 5)) / 2));
    CHECK(nearness.after({{9, 9}}) == Approx((std::hypot(3, 4) + std::hypot(2, 5)) / 2));
    CHECK(nearness.after({{0, 1}}) == Approx(0.5 * 1)); // 1 above the other's f2, better in its f1
    CHECK(nearness.after({{-1, -1}}) == 0);
}

TEST_CASE("an infeasible evaluation does not improve the precision") {
    BitsInstance instance;
    instance.best = -10;
    instance.scale = 10;
    Nearness nearness(instance);
    CHECK(nearness.after({{-10}, {1}}) == HUGE_VAL);
    CHECK(nearness.after({{-9}, {0}}) == Approx(0.1));
    CHECK(nearness.after({{-3}, {0}}) == Approx(0.1));
}

TEST_CASE("the knapsack's optimum is that of all its packings") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const BitsInstance instance = knapsack_instance(14, seed);
        double lowest = HUGE_VAL;
        for (unsigned set = 0; set < (1u << 14); ++set) {
            std::vector<bool> taken(14);
            for (unsigned i = 0; i < 14; ++i) taken[i] = set >> i & 1;
            const Evaluation value = instance.evaluate(taken);
            if (violated(value) == 0) lowest = std::min(lowest, value.objectives[0]);
        }
        CHECK(instance.best == lowest);
    }
    CHECK(knapsack_instance(50, 1).best != knapsack_instance(50, 2).best);
}

TEST_CASE("the shortest tour is that of all orders") {
    for (const std::uint64_t seed : {1u, 2u}) {
        const std::vector<Town> towns = scattered_towns(8, seed);
        std::vector<std::uint32_t> order(8);
        std::iota(order.begin(), order.end(), 0u);
        double lowest = HUGE_VAL;
        do lowest = std::min(lowest, tour_length(towns, order));
        while (std::next_permutation(order.begin() + 1, order.end()));
        CHECK(shortest_tour(towns) == Approx(lowest));
    }
}
