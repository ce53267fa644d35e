#include "ga/checkpoint/checkpoint.hpp"
#include "ga/text/compiled_once.hpp"
#include "tests/folder.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

GA_PIPELINES_ELSEWHERE(Vectors)

using namespace ga;

namespace {

const Population<std::vector<double>> nobody;

/// A rule of one's own: the population has come together.
struct AtSpread : StoppingRule {
    double spread = 0; ///< largest distance of first genes

    static Words words() { return {"spread", "stopping", "the first genes lie this near"}; }
    static void describe(auto& self, auto visit) {
        visit(self.spread, ga::number("spread", "", 0, no_limit, words().meaning));
    }
    template <class G>
    bool operator()(const Progress<G>& now, Numbers&) const {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& each : now.population) {
            low = std::min(low, each.genome[0]);
            high = std::max(high, each.genome[0]);
        }
        return high - low <= spread;
    }
};

/// A mutation whose step grows where it was better and shrinks where not (Rechenberg's rule of one fifth),
/// kept from one generation to the next.
struct Adaptive : Operator {
    struct State {
        double step = 0.5, best = -HUGE_VAL;
        std::size_t generation = 0;
    };
    static Words words() { return {"adaptive", "mutation", "steps by the rule of one fifth"}; }
    static void describe(auto&, auto) {}
    void check(CheckState& known) const {
        known.need_one_objective("adaptive");
        known.scored.reset();
    }
    template <HasGenes P>
    Population<typename P::Genome> operator()(Population<typename P::Genome> population, Context<P>& context,
                                              State& state) const {
        const double now = population[0].value();
        state.step *= now > state.best ? std::exp(0.8) : std::exp(-0.2);
        state.best = std::max(state.best, now);
        state.generation = context.position.generation();
        for (std::size_t i = 0; i < population.size(); ++i) {
            Stream stream = context.stream(i);
            for (double& gene : population[i].genome)
                gene += state.step * stream.normal();
            context.make_child(population[i], Parents(population[i].identity));
        }
        return population;
    }
};
void to_json(json& j, const Adaptive::State& state) {
    j = {state.step, state.best == -HUGE_VAL ? json() : json(state.best), state.generation};
}
void from_json(const json& j, Adaptive::State& state) {
    state = {j.at(0), j.at(1).is_null() ? -HUGE_VAL : j.at(1).get<double>(), j.at(2)};
}

/// Counts its calls as its state, and shows the counts it began with.
struct Counting : Operator {
    struct State {
        std::size_t calls = 0;
    };
    using Numbers = std::shared_ptr<std::vector<std::size_t>>;
    Numbers before = std::make_shared<std::vector<std::size_t>>();
    Numbers generations = std::make_shared<std::vector<std::size_t>>();
    std::string text() const { return "counting"; }
    void check(CheckState&) const {}
    Population<std::vector<double>> operator()(Population<std::vector<double>> population,
                                               Context<Vectors>& context, State& state) const {
        before->push_back(state.calls++);
        generations->push_back(context.position.generation());
        return population;
    }
};
void to_json(json& j, const Counting::State& state) { j = state.calls; }
void from_json(const json& j, Counting::State& state) { j.get_to(state.calls); }

const auto evolving = sample(1) | score() | repeat(300, Adaptive() | score() | plus());

} // namespace

TEST_CASE("an operator's state lasts from one generation to the next, and through a stop and a resume") {
    const auto whole = run(evolving, Vectors{}, nobody);
    CHECK(whole.best->value() > -1e-4); // without growing and shrinking steps far off
    const tests::Folder folder;
    std::string stopped = "not yet";
    for (long budget = 20; !stopped.empty(); budget += 40) {
        Checkpoints<Vectors> checkpoints(folder / "run", "", true);
        const auto part =
            run(evolving, Vectors{}, nobody, {.budget = {.evaluations = budget}}, {}, &checkpoints);
        stopped = part.stopped;
        if (stopped.empty())
            CHECK(part.best->genome == whole.best->genome);
    }
}

TEST_CASE("a state begins anew when its block does, and every island has its own") {
    const auto restarted = run(restarts(2, evolving | best(1)), Vectors{}, nobody);
    for (const auto& each : restarted.population)
        CHECK(each.value() > -1e-4);
    const auto apart =
        run(sample(3) | score() | islands(3, {.rounds = 300, .migrants = 0}, Adaptive() | score() | plus()),
            Vectors{}, nobody);
    for (const auto& each : apart.population)
        CHECK(each.value() > -1e-4);
}

TEST_CASE("an operator sees the generation of the innermost block, and 0 outside any") {
    Counting seen;
    run(sample(1) | score() | seen | repeat(2, repeat(3, seen)), Vectors{}, nobody);
    CHECK(*seen.generations == std::vector<std::size_t>{0, 0, 1, 2, 0, 1, 2});
}

TEST_CASE("every restart begins with an operator that has learnt nothing") {
    const Counting counting;
    run(Stage<Vectors>(sample(2)) | score() | Stage<Vectors>(restarts(3, Stage<Vectors>(counting))),
        Vectors{}, nobody);
    CHECK(*counting.before == std::vector<std::size_t>{0, 0, 0});
    counting.before->clear();
    run(Stage<Vectors>(sample(2)) | score() | Stage<Vectors>(repeat(3, Stage<Vectors>(counting))), Vectors{},
        nobody);
    CHECK(*counting.before == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("a stopping rule of one's own ends a block in code and in text") {
    const auto body = tournament(2) | cross(blend(0.1)) | score();
    const auto result = run(sample(30) | score() | until(AtSpread{{}, 0.01}, body), Vectors{}, nobody);
    const auto close = [](const auto& population) {
        return std::all_of(population.begin(), population.end(), [&](const auto& each) {
            return std::abs(each.genome[0] - population[0].genome[0]) <= 0.01;
        });
    };
    CHECK(close(result.population));
    auto registry = vocabulary<Vectors>();
    registry.add_rule<AtSpread>();
    Parser<Vectors> parser(registry);
    const auto stage = parser.parse(
        "sample 30 | score | until generations 5000 spread 0.01 { tournament 2 | cross blend 0.1 | score }");
    CHECK(
        stage.text() ==
        "sample 30 | score | until generations 5000 spread 0.01 { tournament 2 | cross blend 0.1 | score }");
    CHECK(run(stage, Vectors{}, nobody).population[0].genome == result.population[0].genome);
    CHECK(run(sample(30) | score() | until(any_of(AfterGenerations{{}, 2}, AtSpread{{}, 0}), body), Vectors{},
              nobody)
              .counters.asked <= 90);
}

TEST_CASE("a block whose end never comes ends all the same, and says so") {
    for (const Until& end : {Until{.fitness = 1}, Until{.evaluations = 1000}}) {
        const auto result =
            run(sample(3) | score() | until(end, best(3)), Vectors{}, nobody, {.variant = "v"});
        CHECK(result.notes ==
              std::vector<std::string>{
                  "v/until.1: ended after 10000 generations that brought it no nearer to its end"});
    }
}

TEST_CASE("a population that would not fit into its memory ends the run with what it has") {
    const Combine<std::vector<double>> first{"first", [n = 0.0](const auto& a, const auto&) mutable {
                                                 auto child = a.genome;
                                                 child[0] = n += 1e-9;
                                                 return std::optional(child);
                                             }};
    const auto stopped_with = [](const auto& pipeline, const std::string& reason, std::size_t left) {
        const auto result =
            run(pipeline, Vectors{}, nobody, {.variant = "v", .population_bytes = std::size_t{1} << 22});
        CHECK(result.stopped == reason);
        CHECK(result.population.size() == left);
    };
    stopped_with(sample(10) | score() | repeat(20, pair(score(), score(), first) | score()),
                 "v/repeat.1/pair.1: a population of 25600 exceeds the 4 MB for one", 10000);
    const std::size_t one = sizeof(Individual<std::vector<double>>) + 6 * sizeof(double);
    const auto children_in = [&](std::size_t room) { // of 1600 that a pair would have
        return run(sample(40) | score() | pair(score(), score(), first) | score(), Vectors{}, nobody,
                   {.population_bytes = room * one});
    };
    CHECK(children_in(2048).population.size() == 1600);
    CHECK_FALSE(children_in(1500).stopped.empty());
    stopped_with(sample(10) | score() | tournament(2, 1000000000) | score(),
                 "v/tournament.1: a population of 1000000000 exceeds the 4 MB for one", 10);
    stopped_with(sample(1000000000) | score(),
                 "v/sample.1: a population of 1000000000 exceeds the 4 MB for one", 0);
    const std::size_t room = 10 * one;
    for (const std::size_t bytes : {room, room - 1})
        CHECK(run(sample(10) | score(), Vectors{}, nobody, {.population_bytes = bytes}).stopped.empty() ==
              (bytes == room));
    CHECK_FALSE(run(sample(1) | score(), Vectors{}, nobody, {.population_bytes = one - 1}).stopped.empty());
    CHECK_THROWS_WITH(
        islands(100000000, {}, score()),
        "islands: 100000000 islands in 10 rounds; expected 2 to 10000 islands and 1 round at least");
}

TEST_CASE("endless generations stop at once when asked to, and remark no more than a hundred times") {
    std::atomic<bool> stop = false;
    long stages = 0;
    const Observer<std::vector<double>> observer = [&](const auto&) { stop = ++stages == 5000; };
    const auto result =
        run<Vectors>(sample(5) | score() | repeat(1000000000, score() | above(1, at_least(5))), Vectors{},
                     nobody, {.budget = {.stop = &stop}}, {observer});
    CHECK(stages == 5000);
    CHECK(result.stopped == "stop requested");
    CHECK(result.population.size() == 5);
    REQUIRE(result.notes.size() == 101);
    CHECK(result.notes.back() == "and 2399 more remarks");
}

TEST_CASE("every kind of pipeline that is stopped gives back what it has") {
    const auto count = [](const auto& pipeline, long evaluations) {
        const auto result = run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = evaluations}});
        CHECK(result.stopped == "evaluation budget spent");
        CHECK(!result.front.empty());
        CHECK(result.best.has_value());
        for (std::size_t i = 1; i < result.population.size(); ++i)
            CHECK(result.population[i - 1].value() >= result.population[i].value());
        return result.population.size();
    };
    const auto body = tournament(2) | mutate(1) | score() | elite(2);
    CHECK(count(sample(20) | score(), 7) == 7);
    CHECK(count(sample(20) | score() | repeat(100, body), 110) == 12); // ten children and the elite
    CHECK(count(sample(20) | score() | islands(2, {.rounds = 50}, body), 110) >= 10);
    CHECK(count(restarts(9, sample(20) | score() | best(3)), 70) == 9 + 10);
}

TEST_CASE("a population has converged when all hold their constraints and no objective differs by more") {
    const AtConvergence rule{{}, 0.5};
    Numbers memory;
    const auto holds = [&](const std::vector<Fitness>& all) {
        Population<std::vector<double>> population(all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            population[i].fitness = all[i];
        return rule(Progress<std::vector<double>>{1, 10, 0, population}, memory);
    };
    const auto worth = [](double value, bool minimise = false, double violation = 0) {
        return Fitness(Name("f"), value, minimise, violation);
    };
    CHECK(holds({worth(1), worth(1.5), worth(1.25)}));
    CHECK_FALSE(holds({worth(1), worth(1.25), worth(1.75)}));
    CHECK_FALSE(holds({worth(1.75), worth(1.25), worth(1)}));
    CHECK(holds({worth(-1, true), worth(-1.5, true)}));
    CHECK_FALSE(holds({worth(1), worth(1, false, 0.1)}));
    CHECK_FALSE(holds({worth(1), Fitness::failed(Name("f"), reason("none"))}));
    CHECK_FALSE(holds({worth(1), Fitness()}));
    CHECK(holds({Fitness(Name("both"), Point{1, 2}), Fitness(Name("both"), Point{1.5, 2.5})}));
    CHECK_FALSE(holds({Fitness(Name("both"), Point{1, 2}), Fitness(Name("both"), Point{1, 2.75})}));
}

TEST_CASE("a population that is not scored is no improvement") {
    Numbers memory;
    const auto start = run(sample(3) | score(), Vectors{}, nobody).population;
    CHECK(improves(Progress<std::vector<double>>{0, 0, 0, start}, memory));
    auto better = start;
    for (auto& each : better)
        each.genome.assign(6, 0);
    better = run(score(), Vectors{}, population<std::vector<double>>({std::vector<double>(6, 0)})).population;
    better.push_back({std::vector<double>(6, 0), 1, {}, {}, {}});
    CHECK_FALSE(improves(Progress<std::vector<double>>{1, 0, 0, better}, memory));
    better.pop_back();
    CHECK(improves(Progress<std::vector<double>>{2, 0, 0, better}, memory));
    CHECK_FALSE(improves(Progress<std::vector<double>>{3, 0, 0, better}, memory));
    CHECK(memory[2] == 2);
}

TEST_CASE("who failed is to stagnation as if he were not there") {
    const auto start = run(sample(5) | score(), Vectors{}, nobody).population;
    auto with_failed = start;
    for (const std::size_t i : {0, 3, 6})
        with_failed.insert(with_failed.begin() + static_cast<long>(i), start[1])->fitness =
            Fitness::failed(start[1].fitness.objective_name(), reason("no"));
    Numbers memory, other;
    CHECK(improves(Progress<std::vector<double>>{4, 0, 0, start}, memory));
    CHECK(improves(Progress<std::vector<double>>{4, 0, 0, with_failed}, other));
    CHECK(memory == other);
    CHECK(memory[1] == start[ranking(start)[0]].value());
}
