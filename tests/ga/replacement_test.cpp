#include "tests/ga/problems.hpp"

#include <catch2/catch.hpp>

using namespace ga;

TEST_CASE("a replacement keeps the population's size, and elite and plus its best") {
    const std::string children = "tournament 2 | cross uniform | mutate 0.2 | score | ";
    for (const std::string body :
         {children + "elite 1", children + "elite 5", children + "plus", children + "plus 20",
          std::string("tournament 2 size=2 | cross blend | score | steady")}) {
        CAPTURE(body);
        std::vector<double> bests;
        const Observer<Vector> observer = [&](const auto& event) {
            if (!event.path.ends_with("elite.1") && !event.path.ends_with("plus.1") &&
                !event.path.ends_with("steady.1"))
                return;
            CHECK(event.population.size() == 20);
            bests.push_back(event.population[ranking(event.population)[0]].value());
        };
        run("sample 20 | score | repeat 60 { " + body + " }", Reals{}, {}, {}, {observer});
        CHECK(bests.size() == 60);
        CHECK((body.ends_with("steady") || std::is_sorted(bests.begin(), bests.end())));
        CHECK(bests.back() > bests.front());
    }
}

TEST_CASE("a replacement is refused outside of a generation") {
    for (const std::string stage : {"elite 1", "plus 5", "steady"})
        CHECK_THROWS_WITH(
            run("score | " + stage, given(), individuals({1})),
            Catch::Contains("stage '" + stage +
                            "' reads the start of a generation; expected it inside repeat or until"));
    CHECK_THROWS_WITH(
        run("repeat 3 { score | elite 2 }", given(), individuals({1})),
        Catch::Contains("stage 'repeat 3' needs a scored population; expected score before it"));
}

TEST_CASE("steady replaces the worst by the children, whatever their fitness") {
    const auto zero = transform("zero", [](const Vector&) { return Vector{-7}; });
    const auto body = reals("best 1") | zero | reals("score | steady");
    Vector values;
    for (const auto& each : run(reals("score") | repeat(1, body), given(), individuals({3, 1, 2})).population)
        values.push_back(each.value());
    CHECK(values == Vector{3, -7, 2});
}
