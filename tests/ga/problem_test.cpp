#include "ga/problem/comparison.hpp"
#include "ga/problem/fingerprint.hpp"
#include "tests/catch.hpp"

using namespace ga;

namespace {

const Name one(std::string("f")), several(std::string("pareto f g"));

std::vector<double> worth(const std::vector<Fitness>& all) {
    std::vector<const Fitness*> each;
    for (const Fitness& fitness : all) each.push_back(&fitness);
    return merits(std::span<const Fitness* const>(each));
}

Population<int> scored(const std::vector<Fitness>& all) {
    Population<int> individuals = population(std::vector<int>(all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) individuals[i].fitness = all[i];
    return individuals;
}

std::vector<Identity> identities(const Population<int>& individuals) {
    std::vector<Identity> all;
    for (const auto& each : individuals) all.push_back(each.identity);
    return all;
}

} // namespace

TEST_CASE("merits follow Deb's rules when individuals violate constraints or fail") {
    CHECK(worth({Fitness(one, 100).constrained({2}), Fitness(one, 1), Fitness(one, 3),
                 Fitness(one, 100).constrained({0.5}), Fitness::failed(one, reason("broke")), Fitness(one, 3),
                 Fitness(one, 7).constrained({2})}) == std::vector<double>{-4, -2, -1, -3, -HUGE_VAL, -1, -4});
    CHECK(worth({Fitness(one, 1, true).constrained({1}), Fitness(one, 2, true), Fitness(one, 3, true)}) ==
          std::vector<double>{-3, -1, -2});
    CHECK(worth({Fitness(one, 4, true), Fitness(one, -2, true)}) == std::vector<double>{-4, 2});
}

TEST_CASE("merits combine rank and crowding when there are several objectives") {
    // the front (0,3) (1,2) (3,0), behind it (0,1), behind that two violations and a failure
    const std::vector<Fitness> all = {Fitness(several, Point{0, 3}),
                                      Fitness(several, Point{1, 2}),
                                      Fitness(several, Point{3, 0}),
                                      Fitness(several, Point{0, 1}),
                                      Fitness(several, Point{9, 9}).constrained({2}),
                                      Fitness(several, Point{9, 9}).constrained({0.1}),
                                      Fitness(several, Point{0, 0}).constrained({2}),
                                      Fitness::failed(several, reason("broke"))};
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

TEST_CASE("a ranking puts the best first and keeps the order of ties") {
    const auto individuals =
        scored({Fitness(one, 1), Fitness(one, 5), Fitness(one, 3), Fitness(one, 5), Fitness(one, 3)});
    CHECK(ranking(individuals) == std::vector<std::size_t>{1, 3, 2, 4, 0});
    CHECK(ranking(individuals, 3) == std::vector<std::size_t>{1, 3, 2});
    CHECK(identities(best_of(individuals, 2)) == std::vector<Identity>{1, 3});
    CHECK(identities(joined_with(individuals, {individuals[3], individuals[1]})) ==
          std::vector<Identity>{3, 1, 0, 2, 4});
    CHECK(identities(front_of(individuals)) == std::vector<Identity>{1, 3});
    CHECK(front_of(Population<int>()).empty());
}

TEST_CASE("a comparison is refused when policies differ or a fitness is missing") {
    const Fitness f(one, 1), g(Name(std::string("g")), 2), both(several, Point{1, 2}), none;
    CHECK_THROWS_AS(worth({f, g}), UsageError);
    CHECK_THROWS_AS(worth({f, none}), UsageError);
    CHECK_THROWS_AS(better(f, both), UsageError);
    CHECK_THROWS_AS(better(both, Fitness(Name(std::string("pareto g f")), Point{1, 2})), UsageError);
    CHECK(better(both, Fitness(several, Point{1, 1})));
    CHECK(!better(both, Fitness(several, Point{2, 1})));
    CHECK(better(both, Fitness(several, Point{9, 9}).constrained({1})));
    CHECK(comparable(scored({f, f})));
    CHECK(!comparable(scored({f, g})));
    CHECK(!comparable(scored({f, none})));
}

TEST_CASE("a fingerprint depends on every bit of a genome, its order and its length") {
    std::string bytes(41, 'a');
    const Fingerprint whole = fingerprint(std::string_view(bytes));
    std::set<std::pair<std::uint64_t, std::uint64_t>> all{{whole.high, whole.low}};
    const auto add = [&](std::string_view text) {
        const Fingerprint print = fingerprint(text);
        all.insert({print.high, print.low});
    };
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        const char before = bytes[bit / 8];
        bytes[bit / 8] = static_cast<char>(before ^ (1 << bit % 8));
        add(bytes);
        bytes[bit / 8] = before;
    }
    for (std::size_t length = 0; length < 70; ++length) add(std::string(length, '\0'));
    CHECK(all.size() == 1 + 8 * bytes.size() + 70);
    CHECK(fingerprint(std::string_view("abc")) == // as checkpoints hold it
          Fingerprint{0x1a7a74f2493112f3u, 0x81be01565d047e5au});
    CHECK(fingerprint(std::string_view("0123456789abcdefg")) == Fingerprint{0xd104d0a51fdea976u, 0xea75ae4e6fd17c8eu});
    CHECK(!(fingerprint(std::vector<double>{1, 2, 3}) == fingerprint(std::vector<double>{2, 1, 3})));
    CHECK(!(fingerprint(std::vector<double>{1, 2, 3}) == fingerprint(std::vector<double>{1, 2, 4})));
    CHECK(!(fingerprint(std::vector<bool>{true, false}) == fingerprint(std::vector<bool>{false, true})));
}
