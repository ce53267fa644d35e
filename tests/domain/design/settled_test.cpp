#include "domain/design/aimed_again.hpp"
#include "domain/design/coarse_to_fine.hpp"
#include "tests/domain/design/suite.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

/// The drawn target, on few nodes.
DesignSetup drawn_setup() {
    DesignSetup setup;
    setup.model.grid.nodes = 96;
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = 1.6e-4;
    return completed(setup);
}

} // namespace

TEST_CASE("a line's target aimed at anew is off by what the curves that are not searched add to the middle") {
    const DesignSetup setup = drawn_setup();
    Judgement judged;
    for (auto& misfits : judged.misfits)
        misfits = {Eigen::VectorXd::Zero(setup.targets[0].points())};
    judged.misfits[0][0][3] = 0.01;
    judged.misfits[2][0][3] = 0.03; // searched, in finer steps: 0.02 in the middle
    judged.misfits[1][0][3] = 0.05;
    const auto aim = [&] { return allowing_for(setup, judged).targets[0].y[3] / setup.targets[0].y[3]; };
    CHECK(aim() == Approx(1 + 0.02 - 0.025)); // all: 0 to 0.05
    judged.confirming = {Eigen::VectorXd::Zero(setup.targets[0].points())};
    judged.confirming[0][3] = -0.03;
    CHECK(aim() == Approx(1 + 0.02 - 0.01));
    CHECK(allowing_for(setup, judged).targets[0].y[4] == setup.targets[0].y[4]);
    DesignSetup banded = setup; // the band goes with its point
    banded.targets[0].lower = 0.9 * setup.targets[0].y;
    banded.targets[0].upper = 1.2 * setup.targets[0].y;
    const Target aimed = allowing_for(banded, judged).targets[0];
    for (const Index k : {3, 4}) {
        CHECK(aimed.lower[k] == Approx(0.9 * aimed.y[k]));
        CHECK(aimed.upper[k] == Approx(1.2 * aimed.y[k]));
    }
}

TEST_CASE(
    "an answer is confirmed where its similarity falls by 0.005 at most in steps that no search has seen") {
    Answer answer;
    answer.judgement.similarity = 0.99;
    answer.similarity_worst = 0.99;
    CHECK(is_confirmed(answer));
    answer.judgement.confirming = {Eigen::VectorXd::Constant(3, -0.0149)};
    CHECK(is_confirmed(answer));
    answer.judgement.confirming[0][1] = 0.0151;
    CHECK_FALSE(is_confirmed(answer));
}

TEST_CASE(
    "aiming again finds what answers better at its worst, the same with any threads, and stops at enough") {
    const DesignSetup setup = in_finer_steps(drawn_setup());
    SearchOptions options;
    options.pipeline = "shape 8 | score | best 2 | refine lm 20 sharpen=8";
    options.alternatives = 1;
    const SearchResult found = search(setup, options);
    const SearchResult better = aimed_again(found, options, "test", {}, HUGE_VAL, 0);
    CHECK(better.best.judged() > found.best.judged());
    CHECK(is_confirmed(better.best));
    CHECK(better.best.judged() ==
          Approx(judged_answer(as_reported(better.setup), better.best.genome).judged()).epsilon(1e-9));
    CHECK(better.best.judged() <=
          similarity(in_finer_steps(better.setup, 16), better.best.genome, 4) + settled + 1e-9);
    CHECK(better.counters.asked > found.counters.asked);
    options.threads = 1;
    CHECK(aimed_again(found, options, "test", {}, HUGE_VAL, 0).best.judged() == better.best.judged());
    CHECK(aimed_again(better, options, "test", {}, 0.5, 0).counters.asked == better.counters.asked);
    options.evaluations = found.counters.asked;
    CHECK(aimed_again(found, options, "test", {}, HUGE_VAL, 0).best.judged() == found.best.judged());
}

TEST_CASE("no answer is worse by 0.01 than reported in 16 times the load steps on 4 times the nodes",
          "[long]") {
    int tried = 0;
    for (std::uint64_t seed = 1; tried < 20; ++seed)
        for (const suite::Asked& asked : suite::targets()) {
            if (!asked.attainable || tried == 20)
                continue;
            ++tried;
            DesignSetup setup;
            setup.targets = {asked.target};
            SearchOptions options;
            options.seed = seed;
            options.reach = 0.97;
            options.settles_steps = true;
            options.alternatives = 2;
            const SearchResult found = search(setup, options);
            const double finer = similarity(in_finer_steps(found.setup, 16), found.best.genome, 4);
            INFO(asked.target.name << ", " << found.setup.model.loading.steps << " steps: reported "
                                   << found.best.judged() << ", finer " << finer);
            CHECK(found.best.judged() <= finer + 0.01);
        }
}
