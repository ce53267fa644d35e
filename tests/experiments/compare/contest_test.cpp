#include "experiments/compare/contest.hpp"
#include "tests/catch.hpp"

using namespace app;

namespace {

Attempt within(long budget, std::uint64_t seed = 1) { return {seed, budget, nullptr}; }

/// A sphere in five dimensions with its best, 0, at 1.
RealInstance sphere() {
    RealInstance instance;
    instance.genes = 5;
    for (std::size_t i = 0; i < 5; ++i) instance.box.push_back({i, -5, 5});
    instance.evaluate = [](const std::vector<double>& x) {
        double sum = 0;
        for (const double xi : x) sum += (xi - 1) * (xi - 1);
        return Evaluation{{sum}};
    };
    return instance;
}

const std::string ga_text = "sample 40 | score | repeat 1000000000 { tournament 2 | cross sbx rate=0.9 | mutate 1/n "
                            "polynomial | score | elite 2 } | best 1";

bool same(const Reached& a, const Reached& b) { return nlohmann::json(a).dump() == nlohmann::json(b).dump(); }

Reached reached(std::vector<double> evaluations, long spent) { return {std::move(evaluations), 1, spent}; }

} // namespace

TEST_CASE("a run ends with budget, last target or stop, and its seed decides it") {
    const std::atomic<bool> stop = true;
    CHECK(raced(sphere(), ga_text, {1e-300}, {1, 100000, &stop}).spent <= 1);
    const std::vector<double> far = precisions(1e2, 1e-200), near = precisions(1e2, 1);
    const Reached all = raced(sphere(), ga_text, far, within(3000));
    CHECK(all.spent <= 3000); // remembered genomes are not evaluated again
    CHECK(all.spent > 2000);
    CHECK(all.precision < 1e-1);
    const Reached some = raced(sphere(), ga_text, near, within(3000));
    CHECK(static_cast<double>(some.spent) == some.evaluations.back());
    CHECK(some.spent < all.spent);
    CHECK(same(all, raced(sphere(), ga_text, far, within(3000))));
    CHECK_FALSE(same(all, raced(sphere(), ga_text, far, within(3000, 2))));
}

TEST_CASE("a pipeline that ends early restarts from other genomes until its budget is spent") {
    const Reached once = raced(sphere(), "sample 10 | score | best 1", precisions(1e2, 1e-200), within(10));
    const Reached often = raced(sphere(), "sample 10 | score | best 1", precisions(1e2, 1e-200), within(5000));
    CHECK(once.spent == 10);
    CHECK(often.spent == 5000);
    CHECK(often.precision < once.precision);
}

TEST_CASE("a pipeline that does not fit the problem is refused before it runs") {
    CHECK_THROWS_AS(expect_fits(sphere(), "sample 10 | scroe"), ga::UsageError);
    CHECK_THROWS_AS(expect_fits(sphere(), "score | best 1"), ga::UsageError);
    CHECK_THROWS_AS(expect_fits(sphere(), "sample 4 | cross order | score | best 1"), ga::UsageError);
    CHECK_THROWS_AS(expect_fits(sphere(), "sample 4 | pareto objectives | front"), ga::UsageError);
    CHECK_NOTHROW(expect_fits(sphere(), ga_text));
    CHECK_THROWS_AS(expect_pagmos(sphere(), "pagmo:cmeas"), ga::UsageError);
}

TEST_CASE("usual variants fit every problem of their kind") {
    for (const Benchmark& problem :
         benchmarks({"bbob5-1", "bbob20-2", "zdt", "dtlz", "cec2006", "knapsack", "tsp"}, {}))
        for (const auto& [name, text] : usual_contestants().at(problem.kind)) {
            INFO(problem.name << " " << name);
            CHECK_NOTHROW(problem.check(text));
        }
    CHECK(benchmarks({"bbob5", "bbob20"}, {}).size() == 48);
    for (const char* wrong : {"bbob", "bbob1", "bbob41", "bbob5-25", "bbob5-0", "bbob5-x", "zdt5", "roughness", ""})
        CHECK_THROWS_AS(benchmarks({wrong}, {}), rough::InputError);
    CHECK_THROWS_AS(benchmarks({"zdt", "zdt1"}, {}), rough::InputError);
}

TEST_CASE("libpagmo's algorithms find the sphere's bottom within the budget, the same for the same seed") {
    for (const std::string& name : pagmo_variants()) {
        INFO(name);
        const auto targets = precisions(1e2, 1e-8);
        const Reached run = raced_by_pagmo(sphere(), name, targets, within(20000));
        CHECK(run.spent <= 20000);
        CHECK(run.precision < (name == "pagmo:sga" ? 1e-1 : 1e-8));
        CHECK(same(run, raced_by_pagmo(sphere(), name, targets, within(20000))));
        CHECK_FALSE(same(run, raced_by_pagmo(sphere(), name, targets, within(20000, 2))));
    }
}

TEST_CASE("the expected runtime counts what failed runs spent") {
    const std::vector<Reached> runs{reached({10, 100}, 100), reached({20, NAN}, 1000), reached({30, 300}, 300)};
    CHECK(expected_runtime(runs, 0) == Approx(20));
    CHECK(expected_runtime(runs, 1) == Approx((100 + 1000 + 300) / 2.0));
    CHECK(successes(runs, 1) == 2);
    CHECK(std::isinf(expected_runtime({reached({NAN}, 5)}, 0)));
}

TEST_CASE("shares of targets, their means, ranks and duels of a comparison by hand") {
    Contest contest;
    contest.seeds = 6;
    for (int k = 0; k < 6; ++k) {
        ProblemResults results;
        results.problem.name = "p" + std::to_string(k);
        results.problem.group = "g";
        results.problem.genes = 2;
        results.problem.targets = {1, 0.1};
        results.variants = {{"slow", ""}, {"fast", ""}};
        results.budget = 2000; // 1000 per gene
        for (const double factor : {100.0, 2.0})
            results.runs.push_back(std::vector<Reached>(6, reached({factor, factor > 2 ? NAN : 2000}, 2000)));
        contest.results.push_back(std::move(results));
    }
    const Findings found = findings_of(contest);
    const nlohmann::json &group = found.result["groups"]["g"], &slow = group["variants"]["slow"],
                         &fast = group["variants"]["fast"];
    const std::vector<double> evaluations = group["evaluations_per_gene"], slow_share = slow["share"],
                              fast_share = fast["share"], fast_lower = fast["share_lower"];
    CHECK(evaluations.front() == 1);
    CHECK(evaluations.back() == Approx(1000));
    CHECK(fast_share.front() == Approx(0.5)); // 2 evaluations of 2 genes
    CHECK(fast_share.back() == Approx(1));
    CHECK(slow_share.front() == 0);
    CHECK(slow_share.back() == Approx(0.5));
    CHECK(fast_lower[30] == Approx(fast_share[30])); // all seeds alike
    // From 50 evaluations per gene on, half of the targets; `fast` has all targets at the last moment.
    CHECK(slow["area"].get<double>() == Approx(0.5 * (1 - std::log(50) / std::log(1000))).margin(0.01));
    CHECK(fast["area"].get<double>() == Approx(0.5 + 0.5 / 61));
    CHECK(slow["mean_rank"] == 2);
    CHECK(group["standing"][0]["variant"] == "fast");
    CHECK(group["standing"][0]["better_than"] == "slow");
    CHECK(group["standing"][0]["wins"] == 6);
    const nlohmann::json& tests = found.tables.at("tests.csv").rows();
    REQUIRE(tests.size() == 7);
    CHECK(tests[0]["problem"] == "");
    CHECK(tests[0]["area_difference"] < 0);
    CHECK(tests[0]["p"].get<double>() == Approx(2 / 64.0));  // six problems on one side
    CHECK(tests[1]["p"].get<double>() == Approx(2 / 924.0)); // six seeds against six
}
