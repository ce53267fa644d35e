#include "ga/pipeline/run.hpp"
#include "ga/pipeline/score.hpp"
#include "ga/refinement/levenberg_marquardt.hpp"
#include "ga/refinement/refinement.hpp"
#include "ga/selection/selection.hpp"
#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

#include <atomic>

namespace {

/// Two models of one function: a coarse and a fine one that is three times as expensive.
struct TwoModels {
    using Genome = Vector;
    using Outcome = double;

    std::shared_ptr<std::array<std::atomic<long>, 2>> calls = std::make_shared<std::array<std::atomic<long>, 2>>();
    std::shared_ptr<std::atomic<long>> gradients = std::make_shared<std::atomic<long>>();
    std::vector<ga::LevelPrice> prices = {{"coarse", 1, 2}, {"fine", 3, 6}};
    std::vector<ga::Objective<Outcome>> list = {{"coarse", [](const Outcome& x) { return -x; }},
                                                {"fine", [](const Outcome& x) { return -x; }, false, ga::Level{1}}};

    Outcome evaluate(const Genome& x) const { return evaluate(x, {}); }
    Outcome evaluate(const Genome& x, ga::Level level) const {
        const auto number = static_cast<std::size_t>(level);
        ++(*calls)[number];
        return functions::sphere(x) + 0.1 * static_cast<double>(number) * x[0];
    }
    const std::vector<ga::Objective<Outcome>>& objectives() const { return list; }
    const std::vector<ga::LevelPrice>& levels() const { return prices; }
    std::vector<ga::Variable> bounds(const Genome& x) const {
        std::vector<ga::Variable> all;
        for (std::size_t i = 0; i < x.size(); ++i) all.push_back({i, -1, 1});
        return all;
    }
    ga::Sensitivity sensitivity(const Genome& x, const std::string&) const {
        ++*gradients;
        const auto n = static_cast<Eigen::Index>(x.size());
        return {Eigen::Map<const Eigen::VectorXd>(x.data(), n), Eigen::MatrixXd::Identity(n, n)};
    }
    /// Price of the evaluations that a counter in the models saw, in evaluations of the coarse one.
    double seen() const { return static_cast<double>((*calls)[0] + 3 * (*calls)[1]); }
};

ga::Population<Vector> eight() {
    std::vector<Vector> all;
    for (int i = 0; i < 8; ++i) all.push_back({0.1 * i, 0.3, -0.2});
    return ga::population(all);
}

} // namespace

TEST_CASE("an objective of a second level is evaluated, stored, counted and priced") {
    for (const int threads : {1, 3}) {
        const TwoModels problem;
        const ga::Pipeline<TwoModels> pipeline = ga::score() | ga::score("fine") | ga::score() | ga::score("fine");
        const auto found = ga::run(pipeline, problem, eight(), {.threads = threads});
        CHECK((*problem.calls)[0] == 8);
        CHECK((*problem.calls)[1] == 8);
        CHECK(found.counters.requested == 16);
        CHECK(found.counters.evaluations == 16);
        CHECK(found.counters.requested_price == 32);
        CHECK(found.counters.price == problem.seen());
        for (const auto& individual : found.population)
            CHECK(individual.fitness.value() == -problem.evaluate(individual.genome, ga::Level{1}));
    }
}

TEST_CASE("objectives of two levels rank together") {
    const TwoModels problem;
    const auto found = ga::run(ga::Pipeline<TwoModels>(ga::pareto({"fine", "coarse"})), problem, eight());
    CHECK(found.counters.price == 32);
    for (const auto& individual : found.population)
        CHECK(individual.fitness.values() ==
              ga::Point{-problem.evaluate(individual.genome, ga::Level{1}), -problem.evaluate(individual.genome)});
}

TEST_CASE("a budget is the sum of prices and is never exceeded") {
    for (long budget = 1; budget < 40; ++budget) {
        const TwoModels problem;
        const ga::Pipeline<TwoModels> pipeline = ga::score() | ga::score("fine") | ga::refine(ga::lm(3));
        const auto found = ga::run(pipeline, problem, eight(), {.budget = {.evaluations = budget}});
        CHECK(found.counters.requested_price <= static_cast<double>(budget));
        CHECK(found.counters.price ==
              problem.seen() + 6 * static_cast<double>(*problem.gradients)); // gradients of the fine model
        CHECK(found.stopped == "evaluation budget spent");
    }
}
