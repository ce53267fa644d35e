#include "apps/cluster/crew.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/hands.hpp"
#include "domain/mwm/genome.hpp"
#include "domain/problem/stored.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

using namespace app;

TEST_CASE("texts and numbers survive being sent, whatever bytes are in them") {
    const std::vector<std::string> parts{"", std::string("\0\xff\n", 3), std::string(70000, 'x')};
    CHECK(unframed(framed(parts)) == parts);
    CHECK(unframed(framed({})).empty());
    CHECK(number_of<double>(number_bytes(-0.1)) == -0.1);
    CHECK(number_of<std::uint64_t>(number_bytes(~std::uint64_t{0})) == ~std::uint64_t{0});
}

TEST_CASE("programs that differ in version, build, processor or words cannot share a run, and say in what") {
    const std::string own = crew::introduction({"design", "--nodes", "64"});
    CHECK(crew::difference(own, own).empty());
    CHECK_THAT(crew::difference(own, crew::introduction({"design", "--nodes", "65"})),
               Catch::Contains("words 'design --nodes 65', expected 'design --nodes 64'"));
    for (const auto& [place, name] : {std::pair(0, "version"), {1, "build"}, {2, "vectors"}}) {
        auto parts = unframed(own);
        parts[static_cast<std::size_t>(place)] = "another";
        CHECK_THAT(crew::difference(own, framed(parts)),
                   Catch::StartsWith(name) && Catch::Contains("'another'"));
    }
    CHECK_FALSE(crew::difference(own, "").empty());
}

TEST_CASE("the patience with ranks is a tenth of a second to a million, and no word of the command") {
    for (const char* given : {"0.1", "1e6"})
        CHECK(app::testing::rugosa(std::string("operators --patience ") + given).code == 0);
    for (const char* given : {"0.09", "1.1e6", "soon"})
        check_refused(app::testing::rugosa(std::string("operators --patience=") + given), given);
}

TEST_CASE("a rank's hands answer chunks in their order, and leave out those that are not wanted any more") {
    rough::DesignSetup setup;
    setup.model.grid.nodes = 64;
    rough::Target target;
    target.x = Eigen::VectorXd::LinSpaced(3, 1e-5, 1e-4);
    target.y = Eigen::VectorXd::LinSpaced(3, 1, 2);
    setup.targets = {target};
    std::string setting, task;
    nlohmann::json::to_cbor(nlohmann::json(setup), setting);
    nlohmann::json::to_cbor(nlohmann::json(rough::Genome{1e-4, {{1, 0.8, 1.5, 0.8, {{1, {0.3}}, {2, {1}}}}}}),
                            task);
    const auto of = std::make_shared<const Assignment>(Assignment{"outcomes", setting});
    Hands hands;
    const auto next = [&] {
        for (;;) {
            if (auto done = hands.done())
                return *done;
            hands.wait(std::chrono::seconds(1));
        }
    };
    hands.give({1, 2, of, {task, task, "no genome"}});
    hands.give({2, 1, of, {task}});
    const Done failed = next(), whole = next();
    CHECK(failed.id == 1);
    CHECK_FALSE(failed.error.empty());
    CHECK(whole.error.empty());
    REQUIRE(whole.answers.size() == 1);
    const rough::DesignProblem problem(setup);
    const auto outcome = nlohmann::json::from_cbor(whole.answers[0]).get<rough::DesignOutcome>();
    const auto own = problem.evaluate(nlohmann::json::from_cbor(task).get<rough::Genome>());
    CHECK(outcome.misfits == own.misfits);
    CHECK(outcome.scale == own.scale);
    for (std::uint64_t id = 3; id < 60; ++id)
        hands.give({id, 1, of, {task}});
    hands.drop();
    std::size_t left_out = 0;
    for (std::uint64_t id = 3; id < 60; ++id) {
        const Done one = next();
        CHECK(one.id == id);
        left_out += one.answers.empty() || one.answers[0].empty();
    }
    CHECK(left_out > 0);
    CHECK(hands.has() == 0);
}
