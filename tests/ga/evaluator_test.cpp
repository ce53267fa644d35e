#include "ga/refinement/refinement.hpp"
#include "tests/ga/curve_fit.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <thread>

using namespace ga;

namespace {

const Population<std::vector<double>> nobody;

/// Vectors of which 30 % are known at once and the others take 5 ms; notes which threads worked.
struct Uneven : Vectors {
    Outcome evaluate(const Genome& x) const {
        {
            const std::lock_guard lock(guard());
            threads().insert(std::this_thread::get_id());
        }
        if (std::abs(x[0]) > 0.3)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return x;
    }
    static std::mutex& guard() {
        static std::mutex mutex;
        return mutex;
    }
    static std::set<std::thread::id>& threads() {
        static std::set<std::thread::id> ids;
        return ids;
    }
};

std::string bits_of(const auto& result) {
    std::string text;
    for (const auto& each : result.population) {
        text += std::to_string(each.identity) + ":";
        for (const double gene : each.genome)
            text += number(gene) + " ";
        text += number(each.value()) + "\n";
    }
    return text + std::to_string(result.counters.asked) + " " + std::to_string(result.counters.evaluations) +
           " " + std::to_string(result.counters.remembered);
}

} // namespace

TEST_CASE(
    "every thread works from the first batch on, whatever single evaluations cost, and decides no bit") {
    const auto pipeline = sample(24) | score() |
                          islands(3, {.rounds = 2, .migrants = 1},
                                  tournament(2) | cross(blend()) | mutate(0.3) | score() | elite(1));
    std::string one;
    for (const int threads : {1, 2, 5}) {
        Uneven::threads().clear();
        run(sample(24) | score(), Uneven{}, nobody, {.threads = threads}); // one batch
        CHECK(Uneven::threads().size() == static_cast<std::size_t>(threads));
        Uneven::threads().clear();
        const auto result = run(pipeline, Uneven{}, nobody, {.threads = threads});
        CHECK(Uneven::threads().size() == static_cast<std::size_t>(threads));
        one = one.empty() ? bits_of(result) : one;
        CHECK(bits_of(result) == one);
    }
}

TEST_CASE("what the memory holds is never evaluated again, whoever asks") {
    const auto twice = [](const auto& pipeline) {
        Serial<CurveFit> serial;
        Recording<CurveFit> record(serial);
        const auto result = run_by(record, pipeline, CurveFit{}, CurveFit::start(6));
        CHECK(record.evaluated.size() == static_cast<std::size_t>(result.counters.evaluations));
        CHECK(record.evaluated.size() > 30);
        auto genomes = record.evaluated;
        std::sort(genomes.begin(), genomes.end());
        return static_cast<std::size_t>(genomes.end() - std::unique(genomes.begin(), genomes.end()));
    };
    CHECK(twice(score() | refine(nlopt_method("LN_COBYLA", 20)) | refine(nlopt_method("LN_COBYLA", 20))) ==
          0);
    CHECK(twice(score() | repeat(3, refine(nlopt_method("LN_NELDERMEAD", 20)) | refine(lm(3)))) == 0);
    CHECK(twice(score() | islands(2, {.rounds = 3, .migrants = 1},
                                  mutate(0.5) | cross(uniform()) | score() |
                                      refine(nlopt_method("LN_COBYLA", 4)))) == 0);
}

TEST_CASE("an evaluator that records hands derivatives on, and notes whose they are") {
    Serial<CurveFit> serial;
    Recording<CurveFit> record(serial);
    const auto pipeline = score() | refine(lm(3));
    const auto result = run_by(record, pipeline, CurveFit{}, CurveFit::start(6));
    CHECK(bits_of(result) == bits_of(run(pipeline, CurveFit{}, CurveFit::start(6), {})));
    CHECK(record.differentiated.size() == static_cast<std::size_t>(result.counters.gradients));
}

TEST_CASE("searches of several individuals ask together") {
    Serial<CurveFit> serial;
    Recording<CurveFit> record(serial);
    run_by(record, score() | refine(nlopt_method("LN_COBYLA", 10)), CurveFit{}, CurveFit::start(6));
    CHECK(record.batches.front() == 6);
    CHECK(std::count(record.batches.begin(), record.batches.end(), 6) >= 8);
}

TEST_CASE("islands are evaluated together, and an island's bits do not hang on the others' speed") {
    Serial<Vectors> serial;
    Recording<Vectors> record(serial);
    const auto pipeline =
        sample(20) | score() |
        islands(4, {.rounds = 3, .migrants = 1}, mutate(1, gaussian(0.1)) | score() | elite(1));
    const auto result = run_by(record, pipeline, Vectors{}, nobody);
    CHECK(record.batches == std::vector<std::size_t>{20, 20, 20, 20});
    CHECK(bits_of(result) == bits_of(run(pipeline, Vectors{}, nobody, {.threads = 3})));
}

TEST_CASE("an evaluator may answer with failures, and leave unanswered what it had not begun when the run "
          "must end") {
    struct Odd : Serial<Vectors> {
        void outcomes(const Vectors& problem, std::span<Call<Vectors>> calls, const Watch& watch) override {
            for (auto& call : calls)
                if ((*call.genome)[0] < 0)
                    *call.answer = reason("negative");
                else
                    Serial<Vectors>::outcomes(problem, {&call, 1}, watch);
        }
    } odd;
    const auto result = run_by(odd, sample(40) | score(), Vectors{}, nobody);
    for (const auto& each : result.population)
        CHECK(each.fitness.has_failed() == (each.genome[0] < 0));
    CHECK(result.counters.failures > 5);
    std::atomic<bool> stop = false;
    struct Stopping : Vectors {
        std::atomic<bool>* stop;
        mutable int left = 7;
        Outcome evaluate(const Genome& x) const {
            *stop = --left == 0;
            return x;
        }
    } problem;
    problem.stop = &stop;
    const auto part = run(sample(40) | score(), problem, nobody, {.threads = 1, .budget = {.stop = &stop}});
    CHECK(part.stopped == "stop requested");
    CHECK(part.population.size() == 7);
    CHECK(part.counters.evaluations == 7);
}

TEST_CASE("uneven evaluations are spread over four threads at three and a half times the speed of one",
          "[.][speed]") {
    const auto seconds = [](int threads) {
        const Stopwatch clock;
        run(sample(200) | score(), Uneven{}, nobody, {.threads = threads});
        return clock.seconds();
    };
    CHECK(seconds(1) > 3.5 * seconds(4));
}

namespace {

/// Vectors whose evaluation ends itself once somebody asks for it, as a long one does.
struct Endable : Vectors {
    const std::atomic<bool>* stop = nullptr;
    mutable std::shared_ptr<std::atomic<long>> begun = std::make_shared<std::atomic<long>>(0);
    std::atomic<bool>* raised_by_the_tenth = nullptr;

    Outcome evaluate(const Genome& x) const {
        if (++*begun == 10)
            *raised_by_the_tenth = true;
        if (stop->load())
            throw Stopped{"asked"};
        return x;
    }
};

} // namespace

TEST_CASE("an evaluation that ends itself when the run is to stop is no failure, and is not counted") {
    for (const bool patient : {false, true}) {
        std::atomic<bool> stop = false;
        Endable problem;
        problem.stop = problem.raised_by_the_tenth = &stop;
        RunOptions options{.threads = 1, .budget = {.stop = &stop}};
        const auto result = patient
                                ? run(sample(6) | score() | refine(nlopt_method("LN_COBYLA", 20)) | score(),
                                      problem, nobody, options)
                                : run(sample(40) | score(), problem, nobody, options);
        CHECK(result.stopped == (patient ? "stop requested" : "asked"));
        CHECK(result.counters.failures == 0);
        CHECK(result.counters.evaluations == 9);
        CHECK(*problem.begun == 10); // none is begun after it
        for (const auto& each : result.population)
            CHECK_FALSE(each.fitness.has_failed());
    }
}

TEST_CASE(
    "of the exceptions of work that is spread over threads the first in order is thrown, when all is done") {
    for (const int threads : {1, 4}) {
        std::atomic<int> done = 0;
        CHECK_THROWS_WITH(parallel_for(20, threads,
                                       [&](std::size_t i) {
                                           ++done;
                                           if (i % 5 == 3) // the later, the sooner
                                               std::this_thread::sleep_for(std::chrono::milliseconds(20 - i));
                                           if (i % 5 == 3)
                                               throw std::runtime_error(std::to_string(i));
                                       }),
                          "3");
        CHECK(done == 20);
    }
}

TEST_CASE("an evaluation that throws what is no std::exception marks its individual all the same") {
    struct Odd : Vectors {
        Outcome evaluate(const Genome& x) const {
            if (x[0] < 0)
                throw 7;
            return x;
        }
    };
    const auto result = run(sample(20) | score(), Odd{}, nobody, {.threads = 2});
    REQUIRE(result.counters.failures > 3);
    for (const auto& each : result.population)
        CHECK(each.fitness.reason() == (each.genome[0] < 0 ? "an exception that is no std::exception" : ""));
}

TEST_CASE("an evaluator that throws on islands ends the run with its words, and no island waits for ever") {
    struct Cut : Serial<Vectors> {
        int batches = 0;
        void outcomes(const Vectors& problem, std::span<Call<Vectors>> calls, const Watch& watch) override {
            if (++batches == 3)
                throw std::runtime_error("the cable is cut");
            Serial<Vectors>::outcomes(problem, calls, watch);
        }
    } cut;
    CHECK_THROWS_WITH(
        run_by(cut,
               sample(9) | score() | islands(3, {.rounds = 4}, mutate(1, gaussian(0.1)) | score() | elite(1)),
               Vectors{}, nobody),
        "the cable is cut");
}
