#include "ga/base/random.hpp"
#include "ga/pareto/hypervolume.hpp"
#include "ga/problem/comparison.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

const Name one(std::string("f")), several(std::string("pareto f g"));

std::vector<double> worth(const std::vector<Fitness>& all) {
    std::vector<const Fitness*> each;
    for (const Fitness& fitness : all)
        each.push_back(&fitness);
    return merits(std::span<const Fitness* const>(each));
}

Population<int> scored(const std::vector<Fitness>& all) {
    Population<int> individuals = population(std::vector<int>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i)
        individuals[i].fitness = all[i];
    return individuals;
}

std::vector<Identity> identities(const Population<int>& individuals) {
    std::vector<Identity> all;
    for (const auto& each : individuals)
        all.push_back(each.identity);
    return all;
}

} // namespace

TEST_CASE("Deb's rules give classes from -1 down, one step each, shared by equals") {
    CHECK(worth({Fitness(one, 100, false, 2), Fitness(one, 1), Fitness(one, 3), Fitness(one, 100, false, 0.5),
                 Fitness::failed(one, reason("broke")), Fitness(one, 3), Fitness(one, 7, false, 2)}) ==
          std::vector<double>{-4, -2, -1, -3, -HUGE_VAL, -1, -4});
    CHECK(worth({Fitness(one, 1, true, 1), Fitness(one, 2, true), Fitness(one, 3, true)}) ==
          std::vector<double>{-3, -1, -2});
    CHECK(worth({Fitness(one, 4, true), Fitness(one, -2, true)}) == std::vector<double>{-4, 2});
}

TEST_CASE(
    "under several objectives rank and crowding make one number, and violation follows the last front") {
    // the front (0,3) (1,2) (3,0), behind it (0,1), behind that two violations and a failure
    const std::vector<Fitness> all = {
        Fitness(several, Point{0, 3}),    Fitness(several, Point{1, 2}),
        Fitness(several, Point{3, 0}),    Fitness(several, Point{0, 1}),
        Fitness(several, Point{9, 9}, 2), Fitness(several, Point{9, 9}, 0.1),
        Fitness(several, Point{0, 0}, 2), Fitness::failed(several, reason("broke"))};
    const std::vector<double> found = worth(all);
    CHECK(found[0] == 0.5);
    CHECK(found[1] == Approx(2 / (2 * (1 + 2.0))));
    CHECK(found[2] == 0.5);
    CHECK(found[3] == -0.5);
    CHECK(found[4] == -3);
    CHECK(found[5] == -2);
    CHECK(found[6] == -3);
    CHECK(found[7] == -HUGE_VAL);
    CHECK(identities(front_of(scored(all))) == std::vector<Identity>{0, 1, 2});
    CHECK(identities(front_of(scored({all[4], all[5], all[7]}))) == std::vector<Identity>{1});
}

TEST_CASE("the best come first, equals in their order, and as many as asked for") {
    const auto individuals =
        scored({Fitness(one, 1), Fitness(one, 5), Fitness(one, 3), Fitness(one, 5), Fitness(one, 3)});
    CHECK(ranking(individuals) == std::vector<std::size_t>{1, 3, 2, 4, 0});
    CHECK(ranking(individuals, 3) == std::vector<std::size_t>{1, 3, 2});
    CHECK(identities(best_of(individuals, 2)) == std::vector<Identity>{1, 3});
    CHECK(best_of(individuals, 9).size() == 5);
    CHECK(start_of_generation(individuals, 0).empty());
    CHECK(start_of_generation(individuals, 2).size() == 2);
    CHECK(identities(start_of_generation(individuals, everyone)) == std::vector<Identity>{0, 1, 2, 3, 4});
    CHECK(identities(joined_with(individuals, {individuals[3], individuals[1]})) ==
          std::vector<Identity>{3, 1, 0, 2, 4});
    CHECK(identities(front_of(individuals)) == std::vector<Identity>{1, 3});
    CHECK(front_of(Population<int>()).empty());
}

TEST_CASE("positions stand in the order of a comparison, equals in their own") {
    const std::vector<int> values = {3, 1, 2, 1, 3, 1};
    CHECK(in_order(6, [&](std::size_t a, std::size_t b) { return values[a] < values[b]; }) ==
          std::vector<std::size_t>{1, 3, 5, 2, 0, 4});
    CHECK(in_order(0, [](std::size_t, std::size_t) { return true; }).empty());
}

TEST_CASE("what different policies scored is never compared, nor what none did") {
    const Fitness f(one, 1), g(Name(std::string("g")), 2), both(several, Point{1, 2}), none;
    CHECK_THROWS_AS(worth({f, g}), UsageError);
    CHECK_THROWS_AS(worth({f, none}), UsageError);
    CHECK_THROWS_AS(better(f, both), UsageError);
    CHECK_THROWS_AS(better(both, Fitness(Name(std::string("pareto g f")), Point{1, 2})), UsageError);
    CHECK(better(both, Fitness(several, Point{1, 1})));
    CHECK(!better(both, Fitness(several, Point{2, 1})));
    CHECK(better(both, Fitness(several, Point{9, 9}, 1)));
    CHECK(comparable(scored({f, f})));
    CHECK(!comparable(scored({f, g})));
    CHECK(!comparable(scored({f, none})));
}

TEST_CASE("the hypervolume is that of the union of boxes above the reference") {
    CHECK(hypervolume({{2.0}, {5.0}, {3.0}}, {1}) == 4);
    CHECK(hypervolume({{0.5}}, {1}) == 0);
    CHECK(hypervolume({{3, 1}, {1, 3}, {2, 2}, {0, 9}}, {0, 0}) == 6);
    CHECK(hypervolume({}, {0, 0}) == 0);
    Stream stream(3);
    for (const std::size_t m : {2u, 3u, 4u})
        for (int round = 0; round < 20; ++round) {
            std::vector<Point> points(3, Point(m));
            for (Point& point : points)
                for (double& value : point)
                    value = stream.uniform(0, 2);
            const Point reference(m, 0.25);
            double volume = 0; // inclusion and exclusion
            for (unsigned chosen = 1; chosen < 8; ++chosen) {
                double box = -1;
                for (std::size_t k = 0; k < m; ++k) {
                    double least = HUGE_VAL;
                    for (std::size_t i = 0; i < 3; ++i)
                        if (chosen >> i & 1)
                            least = std::min(least, points[i][k]);
                    box *= std::max(0.0, least - reference[k]);
                }
                for (std::size_t i = 0; i < 3; ++i)
                    if (chosen >> i & 1)
                        box = -box;
                volume += box;
            }
            CHECK(hypervolume(points, reference) == Approx(volume).margin(1e-12));
        }
}
