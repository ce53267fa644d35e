#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Records the genomes of all calls to another evaluator.
template <Problem P>
struct Recording : Evaluator<P> {
    Evaluator<P>& by;
    std::vector<typename P::Genome> evaluated, differentiated; ///< in the order of the calls
    std::vector<std::size_t> batches;                          ///< number of calls in each batch

    explicit Recording(Evaluator<P>& other) : by(other) {}
    void outcomes(const P& problem, std::span<EvaluationCall<P>> calls, const Watch& watch) override {
        batches.push_back(calls.size());
        for (const EvaluationCall<P>& call : calls) evaluated.push_back(*call.genome);
        by.outcomes(problem, calls, watch);
    }
    void slopes(const P& problem, std::span<Slope<P>* const> slopes, const Watch& watch) override {
        for (const Slope<P>* slope : slopes) differentiated.push_back(slope->genome);
        by.slopes(problem, slopes, watch);
    }
    int threads() const override { return by.threads(); }
};

/// Reals with slow evaluations of uneven length; records the threads that made them.
struct Uneven {
    std::mutex mutex;
    std::set<std::thread::id> threads;
    Reals problem;

    Uneven() {
        problem.f = [this](const Vector& x) {
            {
                const std::lock_guard lock(mutex);
                threads.insert(std::this_thread::get_id());
            }
            if (std::abs(x[0]) > 0.3) std::this_thread::sleep_for(std::chrono::milliseconds(5));
            return x;
        };
    }
};

/// Throws for a first gene below 0, something else than a std::exception above 100; not a number at 50.
double fragile(double y) {
    if (y == 50) return std::nan("");
    if (y < 0) throw std::domain_error("under 0");
    if (y > 100) throw 7;
    return y;
}

const std::vector<std::string> fragile_reasons = {"", "under 0", "an exception of another type than std::exception"};

} // namespace

TEST_CASE("a memory too small for one outcome does not affect a result") {
    const std::string pipeline =
        "score | repeat 6 { turn genes | score low | score } | refine mma 2 genes=tenth | best 2";
    const auto large = run(pipeline, CurveFit{}, CurveFit::start(40));
    const auto small = run(pipeline, CurveFit{}, CurveFit::start(40), {.memory_bytes = 1});
    CHECK(large.counters.evaluations == 3 * 40 + 40);
    CHECK(small.counters.evaluations == 7 * 40 + 40);
    CHECK(small.counters.requested == large.counters.requested);
    CHECK(small.population[0].genome == large.population[0].genome);
    Reals problem; // the memory has room for fewer outcomes the longer they are
    for (const std::size_t length : {1u, 1000u}) {
        problem.f = [length](const Vector& x) { return Vector(length, x[0]); };
        CHECK(run("sample 40 | score | restarts 3 { score first | mutate 1 | score }", problem, {},
                  {.memory_bytes = std::size_t{1} << 17})
                  .counters.evaluations == (length == 1 ? 160 : 240));
    }
}

TEST_CASE("a genome in memory is never evaluated again") {
    for (const std::string pipeline :
         {"score | refine nlopt LN_COBYLA 20 | refine nlopt LN_COBYLA 20",
          "score | repeat 3 { refine nlopt LN_NELDERMEAD 20 | refine lm 3 }",
          "score | islands 2 rounds=3 { mutate 0.5 | cross uniform | score | refine nlopt LN_COBYLA 4 }"}) {
        CAPTURE(pipeline);
        OnThreads<CurveFit> serial(1);
        Recording<CurveFit> record(serial);
        const auto result = run_by(record, curves(pipeline), CurveFit{}, CurveFit::start(6));
        CHECK(record.evaluated.size() == static_cast<std::size_t>(result.counters.evaluations));
        CHECK(record.evaluated.size() > 30);
        CHECK(std::set<Vector>(record.evaluated.begin(), record.evaluated.end()).size() == record.evaluated.size());
        CHECK(record.differentiated.size() == static_cast<std::size_t>(result.counters.gradients));
        CHECK(bits_of(result) == bits_of(run(pipeline, CurveFit{}, CurveFit::start(6))));
    }
}

TEST_CASE("islands, and searches of several individuals, send their evaluations in common batches") {
    OnThreads<CurveFit> serial(1);
    Recording<CurveFit> record(serial);
    run_by(record, curves("score | refine nlopt LN_COBYLA 10"), CurveFit{}, CurveFit::start(6));
    CHECK(record.batches.front() == 6);
    CHECK(std::count(record.batches.begin(), record.batches.end(), 6) >= 8);
    OnThreads<Reals> of_reals(1);
    Recording<Reals> islands(of_reals);
    const std::string apart = "islands 4 rounds=3 { mutate 1 gaussian 0.1 | score | elite 1 }";
    run_by(islands, reals("sample 20 | score | " + apart), Reals{}, {});
    CHECK(islands.batches == std::vector<std::size_t>{20, 20, 20, 20});
}

TEST_CASE("every thread works from the first batch on, without effect on a bit") {
    std::string one;
    for (const int threads : {1, 2, 5}) {
        Uneven batch, whole;
        run("sample 24 | score", batch.problem, {}, {.threads = threads});
        CHECK(batch.threads.size() == static_cast<std::size_t>(threads));
        const auto result = run("sample 24 | score | islands 3 rounds=2 { tournament 2 | cross blend | "
                                "mutate 0.3 | score | elite 1 }",
                                whole.problem, {}, {.threads = threads});
        CHECK(whole.threads.size() == static_cast<std::size_t>(threads));
        one = one.empty() ? bits_of(result) : one;
        CHECK(bits_of(result) == one);
    }
}

TEST_CASE("an evaluator that throws ends the run with its message, on islands too") {
    struct Cut : OnThreads<Reals> {
        int batches = 0;
        Cut() : OnThreads<Reals>(1) {}
        void outcomes(const Reals& problem, std::span<EvaluationCall<Reals>> calls, const Watch& watch) override {
            if (++batches == 3) throw std::runtime_error("the cable is cut");
            OnThreads<Reals>::outcomes(problem, calls, watch);
        }
    } cut;
    const auto pipeline = reals("sample 9 | score | islands 3 rounds=4 { mutate 1 | score | elite 1 }");
    CHECK_THROWS_WITH(run_by(cut, pipeline, Reals{}, {}), "the cable is cut");
}

TEST_CASE("a run in which a member of the problem throws ends with its results and the reason") {
    struct Brittle : Reals {
        mutable std::atomic<int> draws = 0;
        Brittle() = default;
        Brittle(const Brittle& other) : Reals(other) {}
        Vector sample(Stream& stream) const {
            if (++draws > 9) throw std::runtime_error("no more draws");
            return Reals::sample(stream);
        }
    };
    for (const std::string text : {"sample 9 | score | sample 3 | score",
                                   "sample 9 | score | islands 3 rounds=2 { sample 3 | score | best 2 }"}) {
        INFO(text);
        const Brittle problem;
        const auto found = run(Parser<Brittle>(whole_vocabulary<Brittle>()).parse(text), problem, {}, {.threads = 2});
        CHECK(found.is_dead_end);
        CHECK_THAT(found.stopped, Catch::StartsWith("stage '") && Catch::Contains("cannot continue: no more draws"));
        REQUIRE(found.best);
        CHECK(found.counters.requested >= 9);
        CHECK_FALSE(found.population.empty());
    }
    CHECK_THROWS_WITH(run(Parser<Brittle>(whole_vocabulary<Brittle>()).parse("sample 10 | score"), Brittle{}, {}),
                      "no more draws");
}

TEST_CASE("an evaluation that ends itself at a stop is neither counted nor a failure") {
    for (const bool refines : {false, true}) {
        std::atomic<bool> stop = false;
        std::atomic<int> begun = 0;
        Reals problem;
        problem.f = [&](const Vector& x) {
            if (++begun == 10) stop = true;
            if (stop) throw Stopped{"the licence has run out"};
            return x;
        };
        const auto result = run(refines ? "sample 6 | score | refine nlopt LN_COBYLA 20 | score" : "sample 40 | score",
                                problem, {}, {.threads = 1, .budget = {.stop = &stop}});
        CHECK(result.stopped == (refines ? "stop requested" : "the licence has run out"));
        CHECK(result.counters.failures == 0);
        CHECK(result.counters.evaluations == 9);
        CHECK(begun == 10); // none is begun after it
        for (const auto& each : result.population) CHECK_FALSE(each.fitness.has_failed());
    }
}

TEST_CASE("an evaluation that throws marks its individual, which ranks last with the reason") {
    Reals problem = given();
    problem.f = [](const Vector& x) { return Vector{fragile(x[0])}; };
    const auto result = run("score | best 4", problem, individuals({1, 50, -1, 101}), {.threads = 2});
    CHECK(result.counters.failures == 3);
    CHECK(result.best->identity == 0);
    CHECK(result.population[0].identity == 0);
    CHECK(result.population[1].fitness.reason() == "fitness value is nan");
    for (std::size_t i = 1; i < 3; ++i) CHECK(result.population[i + 1].fitness.reason() == fragile_reasons[i]);
}

TEST_CASE("an objective that throws marks its individual with the reason") {
    Reals problem = given();
    problem.list = {{"value", [](const Vector& x) { return fragile(x[0]); }},
                    {"other", [](const Vector& x) { return -x[0]; }}};
    for (const std::string pipeline : {"score", "pareto other value", "pareto value other"})
        for (const int threads : {1, 2}) {
            const auto result = run(pipeline, problem, individuals({1, -1, 101}), {.threads = threads});
            REQUIRE(result.population.size() == 3);
            for (std::size_t i = 0; i < 3; ++i) CHECK(result.population[i].fitness.reason() == fragile_reasons[i]);
            CHECK(result.best->identity == 0);
        }
    CHECK(run("score other", problem, individuals({1, -1, 101})).counters.failures == 0);
}

TEST_CASE("a transformation that throws keeps the genome and marks its individual") {
    const auto half = transform("half", [](const Vector& g) { return Vector{fragile(g[0]) / 2}; });
    for (const auto& before : {reals("score") | half, Pipeline<Reals>(half)}) {
        const auto result = run(before | half | reals("score"), given(), individuals({8, -1, 101}));
        CHECK(result.population[0].value() == 2);
        for (std::size_t i = 1; i < 3; ++i) CHECK(result.population[i].fitness.reason() == fragile_reasons[i]);
        CHECK(result.population[1].genome == Vector{-1});
        CHECK(result.population[2].genome == Vector{101});
    }
}

TEST_CASE("a run ends with the first reason when every evaluation fails") {
    Reals problem = given();
    problem.f = [](const Vector& x) { return Vector{fragile(x[0])}; };
    const auto few = run("score", problem, individuals({-1, 101, 50}));
    CHECK(few.stopped == "every one of 3 evaluations failed; the first: under 0");
    CHECK((few.is_dead_end && !few.best && few.counters.failures == 3 && few.population.size() == 3));
    const Reals none = maximum(2, [](const Vector&) { return std::nan(""); });
    const auto many = run("sample 10 | score | repeat 100 { mutate 1 | score } | best 1", none);
    CHECK(many.stopped == "every one of 200 evaluations failed; the first: fitness f is nan");
    CHECK(many.counters.evaluations == 200);
}

TEST_CASE("a first batch that fails does not end a run, nor do nine failures of ten") {
    const Reals rare = minimum(2, [](const Vector& x) {
        return x[0] > -4.5 ? throw std::runtime_error("mesh failed") : x[1]; // 5 % succeed
    });
    const std::string pipeline = "sample 20 | score | repeat 100 { tournament 2 | mutate 0.5 | score | plus }";
    int found = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto result = run(pipeline, rare, {}, {.seed = seed, .threads = 1});
        found += result.best.has_value();
        CHECK(result.counters.requested >= 200);
    }
    CHECK(found > 15);
    for (const double share : {0.5, 0.7}) {
        const auto half = run("sample 1000 | score | repeat 9 { mutate 1 uniform 1 | score }",
                              minimum(1, [](const Vector& x) { return x[0] > -1 ? std::nan("") : x[0]; }), {},
                              {.budget = {.max_failures = share}});
        CHECK(half.is_dead_end == (share == 0.5)); // six of ten fail
        CHECK(half.best);
        if (half.is_dead_end)
            CHECK_THAT(half.stopped, Catch::Contains(" of 1000 evaluations failed; the first: fitness f is "));
    }
}

TEST_CASE("one thread calls a problem's members one at a time, on islands too") {
    std::atomic<int> inside = 0, most = 0;
    Reals problem;
    const auto visit = [&] {
        most = std::max<int>(most, ++inside);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        --inside;
    };
    problem.box = [&](const Vector&) {
        visit();
        return std::vector<Variable>{{0, -1, 1}};
    };
    problem.f = [&](const Vector& x) { return visit(), x; };
    const std::string pipeline = "sample 16 | score | islands 4 rounds=2 { islands 2 rounds=1 { mutate 1 | score } } | "
                                 "refine nlopt LN_COBYLA 3";
    run(pipeline, problem, {}, {.threads = 1});
    CHECK(most == 1);
}

TEST_CASE("an evaluation budget ends a run exactly, with the best so far") {
    const auto whole = run("score | best 1", CurveFit{}, CurveFit::start(30));
    const auto part = run("score | best 1", CurveFit{}, CurveFit::start(30), {.budget = {.evaluations = 7}});
    CHECK(part.counters.evaluations == 7);
    CHECK(part.stopped == "evaluation budget spent");
    CHECK(part.population.size() == 7);
    CHECK(part.population[0].value() <= whole.population[0].value());
    const auto refined = run("score | repeat 1000 { refine mma 2 genes=tenth }", CurveFit{}, CurveFit::start(5),
                             {.budget = {.evaluations = 200}});
    CHECK(refined.counters.requested <= 200);
    CHECK(refined.best->value() >= run("score", CurveFit{}, CurveFit::start(5)).best->value());
}

TEST_CASE("a stop request ends a run at once with its population, best first") {
    std::atomic<bool> stop = false;
    long stages = 0;
    const Observer<Vector> observer = [&](const auto&) { stop = ++stages == 5000; };
    const auto result = run("sample 5 | score | repeat 1000000000 { score | above 1 at_least=5 }", Reals{}, {},
                            {.budget = {.stop = &stop}}, {observer});
    CHECK(stages == 5000);
    CHECK(result.stopped == "stop requested");
    REQUIRE(result.population.size() == 5);
    CHECK(result.population[0].identity == result.best->identity);
    CHECK(result.notes.size() == 101); // no more than a hundred remarks, and how many more
}

TEST_CASE("every kind of pipeline returns what it has when it is stopped") {
    const auto count = [](const std::string& pipeline, long evaluations) {
        const auto result = run(pipeline, Reals{}, {}, {.budget = {.evaluations = evaluations}});
        CHECK(result.stopped == "evaluation budget spent");
        CHECK(!result.front.empty());
        CHECK(result.best.has_value());
        for (std::size_t i = 1; i < result.population.size(); ++i)
            CHECK(result.population[i - 1].value() >= result.population[i].value());
        return result.population.size();
    };
    const std::string body = " { tournament 2 | mutate 1 | score | elite 2 }";
    CHECK(count("sample 20 | score", 7) == 7);
    CHECK(count("sample 20 | score | repeat 100" + body, 110) == 12); // ten children and the elite
    CHECK(count("sample 20 | score | islands 2 rounds=50" + body, 110) >= 10);
    CHECK(count("restarts 9 { sample 20 | score | best 3 }", 70) == 9 + 10);
}

TEST_CASE("a population beyond its memory ends the run with its last population") {
    const auto ends = [](const std::string& pipeline, const std::string& message, std::size_t left) {
        const auto result = run(pipeline, Reals{}, {}, {.variant = "v", .population_bytes = std::size_t{1} << 22});
        CHECK(result.stopped == "v/" + message + " exceeds the 4 MB for one");
        CHECK(result.population.size() == left);
    };
    ends("sample 300 | score | pair(score, score, mean) | score", "pair.1: a population of 25600", 300);
    ends("sample 9 | score | repeat 50 { mutate 1 | parents | score }", "repeat.1/parents.1: a population of 36864",
         18432);
    ends("sample 10 | score | tournament 2 size=1000000000 | score", "tournament.1: a population of 1000000000", 10);
    ends("sample 1000000000 | score", "sample.1: a population of 1000000000", 0);
}
