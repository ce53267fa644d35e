#include "domain/errors.hpp"
#include "domain/problem/problem.hpp"
#include "domain/target/like.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

Genome one_wave() { return {0.01, {{1, 0.8, 1.5, 2, {{1, {0.3}}, {2, {1.0}}}}}}; }

DesignSetup set_up() {
    DesignSetup setup;
    setup.model.grid = {65, 2};
    setup.targets = {target_like(sample(one_wave(), setup.model.grid), setup.model, "a wave")};
    return setup;
}

} // namespace

TEST_CASE("a design left open has waves of 8 nodes at least and series of a quarter of the length to four") {
    const DesignProblem problem(set_up());
    CHECK(problem.setup().limits.shortest_wave == 8 * (2.0 / 64));
    CHECK(problem.setup().bounds.lambda_from == 0.5);
    CHECK(problem.setup().bounds.lambda_to == 8);
    CHECK(problem.setup().model.body.datum == 2);
    CHECK(problem.setup().model.loading.reach == 1);
    ga::Stream random(1);
    for (int draw = 0; draw < 20; ++draw)
        CHECK(shortest_wave(problem.sample(random)) >= 8 * (2.0 / 64));
}

TEST_CASE("a design that its grid cannot show is refused by the name of the value") {
    const auto about = [](auto change) {
        DesignSetup setup = set_up();
        change(setup);
        try {
            completed(setup);
        } catch (const InputError& error) {
            return error.about;
        }
        return std::string();
    };
    CHECK(about([](DesignSetup&) {}).empty());
    CHECK(about([](DesignSetup& s) { s.model.grid.nodes = 15; }) == "nodes");
    CHECK(about([](DesignSetup& s) { s.limits.shortest_wave = 0.9 * 2.0 / 64; }) == "shortest wave");
    CHECK(about([](DesignSetup& s) { s.limits.shortest_wave = 2.0 / 64; }).empty()); // the grid's spacing
    CHECK(about([](DesignSetup& s) { s.limits.shortest_wave = 8.1; }) == "shortest wave");
    CHECK(about([](DesignSetup& s) { s.model.body.datum = 0.1; }) == "datum");
}
