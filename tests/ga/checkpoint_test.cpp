#include "ga/checkpoint/checkpoint.hpp"
#include "ga/ga.hpp"
#include "ga/refinement/refinement.hpp"
#include "tests/folder.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace ga;

namespace {

namespace fs = std::filesystem;

/// Vectors whose evaluation takes a while, so that a process can be killed within one.
struct Slow : Vectors {
    Outcome evaluate(const Genome& x) const {
        std::this_thread::sleep_for(std::chrono::microseconds(300));
        if (x[0] > 0.999)
            throw std::domain_error("first gene above 0.999");
        return x;
    }
};

/// Every block there is, inside each other.
template <class P>
Stage<P> nested() {
    const Combine<std::vector<double>> first{
        "first", [](const auto& a, const auto& b) -> std::optional<std::vector<double>> {
            auto child = a.genome;
            child[0] = b.genome[0];
            return child;
        }};
    const auto generation = tournament(2) | cross(blend()) | mutate(0.2) | score() | elite(1);
    return sample(24) | score() |
           islands(2, {.rounds = 3, .migrants = 1},
                   repeat(2, generation) | until({.generations = 3, .stagnation = 2}, generation)) |
           pair(score("first") | best(3), score() | restarts(2, repeat(2, generation) | best(2)), first) |
           score() | repeat(2, refine(nlopt_method("LN_COBYLA", 4)) | best(5));
}

const Population<std::vector<double>> nobody = population<std::vector<double>>({{}});

std::string text_of(const Result<std::vector<double>>& result, const std::vector<std::string>& seen) {
    json j = {result.population, *result.best, result.counters, result.notes, seen};
    return j.dump();
}

std::vector<std::string> seen;
const Observer<std::vector<double>> observer = [](const auto& event) {
    seen.push_back(event.path + " " + std::to_string(event.counters.asked));
};

} // namespace

TEST_CASE("a run that is stopped within any evaluation and resumed ends in the very result") {
    const tests::Folder folder;
    seen.clear();
    const auto whole = run(nested<Vectors>(), Vectors{}, nobody, {}, {observer});
    const std::string expected = text_of(whole, seen);
    REQUIRE(whole.counters.asked > 450);
    for (long step : {70L, 111L, 333L}) {
        /// Asks the run to stop during its step-th evaluation.
        struct Stopping : Vectors {
            std::atomic<bool>* stop;
            std::atomic<long>* left;
            Outcome evaluate(const Genome& x) const {
                if (--*left == 0)
                    *stop = true;
                return Vectors::evaluate(x);
            }
        };
        const fs::path file = folder / "run";
        fs::remove(file);
        fs::remove(file.string() + ".before");
        for (int pieces = 0;; ++pieces) {
            REQUIRE(pieces < 500);
            std::atomic<bool> stop = false;
            std::atomic<long> left = step;
            Stopping problem;
            problem.stop = &stop;
            problem.left = &left;
            seen.clear();
            Checkpoints<Stopping> checkpoints(file, "", true, 1000);
            checkpoints.keep("seen", seen);
            const auto part =
                run(nested<Stopping>(), problem, nobody,
                    {.threads = 1 + pieces % 2, .budget = {.stop = &stop}}, {observer}, &checkpoints);
            if (part.stopped.empty()) {
                CHECK(text_of(part, seen) == expected);
                CHECK(pieces > 0);
                break;
            }
        }
    }
}

TEST_CASE("a finished run is read from its checkpoint without being run") {
    const tests::Folder folder;
    Checkpoints<Vectors> first(folder / "run", "", false), second(folder / "run", "", true);
    const auto done = run(nested<Vectors>(), Vectors{}, nobody, {}, {}, &first);
    seen.clear();
    const auto again = run(nested<Vectors>(), Vectors{}, nobody, {}, {observer}, &second);
    CHECK(seen.empty());
    CHECK(text_of(again, {}) == text_of(done, {}));
    CHECK(done.notes.empty());
}

TEST_CASE("a checkpoint of another run, or a file that is none, is refused") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    Checkpoints<Vectors> write(file, "a", false), same(file, "a", true), other(file, "b", true);
    run(sample(3) | score(), Vectors{}, nobody, {}, {}, &write);
    const std::string message = "checkpoint '" + file.string() +
                                "' is of another run; expected the same pipeline, seed, start and settings";
    CHECK_THROWS_WITH(run(sample(3) | score(), Vectors{}, nobody, {}, {}, &other), message);
    CHECK_THROWS_WITH(run(sample(4) | score(), Vectors{}, nobody, {}, {}, &same), message);
    CHECK_THROWS_WITH(run(sample(3) | score(), Vectors{}, nobody, {.seed = 2}, {}, &same), message);
    fs::resize_file(file, fs::file_size(file) / 2);
    fs::remove(file.string() + ".before");
    CHECK_THROWS_AS(run(sample(3) | score(), Vectors{}, nobody, {}, {}, &same), UsageError);
}

TEST_CASE("a checkpoint that was altered anywhere is refused, and the one before it is gone on from") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    const auto pipeline = sample(8) | score() | repeat(6, tournament(2) | mutate(1) | score() | elite(1));
    Checkpoints<Vectors> write(file, "", false, 0);
    const auto whole = run(pipeline, Vectors{}, nobody, {}, {}, &write);
    std::ifstream stream(file, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(stream), {}};
    std::ofstream(file.string() + ".before", std::ios::binary) << good;
    Stream random(1);
    for (int i = 0; i < 60; ++i) {
        std::string bad = good;
        char& byte = bad[random.below(bad.size())];
        byte = static_cast<char>(byte ^ (1 << random.below(8)));
        std::ofstream(file, std::ios::binary) << (i % 2 ? bad : good.substr(0, random.below(good.size())));
        Checkpoints<Vectors> resume(file, "", true);
        const auto result = run(pipeline, Vectors{}, nobody, {}, {}, &resume);
        CHECK(result.population[0].genome == whole.population[0].genome);
        CHECK(result.notes ==
              std::vector<std::string>{"checkpoint '" + file.string() +
                                       "' is damaged or none; expected a file as this version wrote "
                                       "it; went on from the one before"});
        std::ofstream(file.string() + ".before", std::ios::binary) << good; // what was there before
    }
    std::ofstream(file, std::ios::binary) << good.substr(0, good.size() / 2);
    fs::remove(file.string() + ".before");
    Checkpoints<Vectors> alone(file, "", true);
    CHECK_THROWS_WITH(run(pipeline, Vectors{}, nobody, {}, {}, &alone),
                      "checkpoint '" + file.string() +
                          "' is damaged or none; expected a file as this version wrote it");
}

TEST_CASE("a checkpoint that nests without end, or does not fit its pipeline, is refused though its seal is "
          "whole") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    seal(file, std::string(200000, '\x81') + '\x01'); // arrays of one array of one array ...
    Checkpoints<Vectors> deep(file, "", true);
    CHECK_THROWS_WITH(run(sample(3) | score(), Vectors{}, nobody, {}, {}, &deep),
                      "checkpoint '" + file.string() + "' nests too deep; expected one that a run wrote");
    CHECK(read_cbor(std::string(63, '\x81') + '\x80', file).size() == 1); // 64 arrays
    CHECK_THROWS_AS(read_cbor(std::string(64, '\x81') + '\x80', file), UsageError);
    const auto pipeline = sample(8) | score() | repeat(6, tournament(2) | mutate(1) | score() | elite(1));
    Checkpoints<Vectors> write(file, "", false, 0);
    run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 30}}, {}, &write);
    json j = json::from_cbor(opened(file));
    for (const auto& [place, value] :
         std::vector<std::pair<std::string, json>>{{"/snapshot/0/0/0", 99},
                                                   {"/snapshot/0/1/2", json::array()},
                                                   {"/snapshot/0/1/3", json::array()}}) {
        json altered = j;
        altered[json::json_pointer(place)] = value;
        const auto bytes = json::to_cbor(altered);
        seal(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        Checkpoints<Vectors> resume(file, "", true);
        CHECK_THROWS_WITH(run(pipeline, Vectors{}, nobody, {}, {}, &resume),
                          "the checkpoint does not fit its pipeline; expected one that was written by it");
    }
}

TEST_CASE("a checkpoint with a gene fewer than its origin writes nowhere beyond") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    const auto pipeline = sample(3) | score() | repeat(3, refine(nlopt_method("LN_COBYLA", 4)));
    Checkpoints<Vectors> write(file, "", false, 0);
    run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 25}}, {}, &write);
    json j = json::from_cbor(opened(file));
    for (auto& frame : j["snapshot"][0])
        for (auto& individual : frame[1])
            individual[0].erase(0);
    const auto bytes = json::to_cbor(j);
    seal(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    Checkpoints<Vectors> resume(file, "", true);
    CHECK_THROWS_WITH(run(pipeline, Vectors{}, nobody, {}, {}, &resume),
                      "refine: gene 5 is to move, the genome has 5");
}

TEST_CASE("a checkpoint follows no link, and one that cannot be written ends no run") {
    const tests::Folder folder;
    std::ofstream(folder / "victim") << "precious";
    fs::create_symlink(folder / "victim", folder / "run.tmp");
    Checkpoints<Vectors> write(folder / "run", "", false);
    run(sample(3) | score(), Vectors{}, nobody, {}, {}, &write);
    std::ifstream victim(folder / "victim");
    CHECK(std::string(std::istreambuf_iterator<char>(victim), {}) == "precious");
    Checkpoints<Vectors> nowhere(folder / "gone" / "run", "", false);
    const auto result = run(sample(3) | score(), Vectors{}, nobody, {}, {}, &nowhere);
    CHECK(result.population.size() == 3);
    REQUIRE(result.notes.size() == 1);
    CHECK(result.notes[0].find("cannot be written") != std::string::npos);
}

TEST_CASE("a run whose checkpoint had only its older name when it was killed goes on without a word") {
    const tests::Folder folder;
    const auto pipeline = sample(8) | score() | repeat(6, tournament(2) | mutate(1) | score() | elite(1));
    Checkpoints<Vectors> write(folder / "run", "", false, 0);
    const auto stopped = run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 30}}, {}, &write);
    REQUIRE_FALSE(stopped.stopped.empty());
    fs::rename(folder / "run", folder / "run.before");
    Checkpoints<Vectors> resume(folder / "run", "", true);
    const auto result = run(pipeline, Vectors{}, nobody, {}, {}, &resume);
    CHECK(result.notes.empty());
    CHECK(text_of(result, {}) == text_of(run(pipeline, Vectors{}, nobody), {}));
}

TEST_CASE("a run that took up the older checkpoint keeps it until it has written a newer one") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    const auto pipeline = sample(8) | score() | repeat(6, tournament(2) | mutate(1) | score() | elite(1));
    Checkpoints<Vectors> write(file, "", false, 0);
    run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 30}}, {}, &write);
    std::ofstream(file, std::ios::binary) << "half";
    Checkpoints<Vectors> killed(file, "", true, 1e9); // that writes once
    run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 40}}, {}, &killed);
    CHECK_NOTHROW(opened(file));
    CHECK_NOTHROW(opened(file.string() + ".before"));
}

TEST_CASE("individuals of every kind come back from their text with every bit") {
    Population<std::vector<double>> start = population<std::vector<double>>({{0.1, -0.0, 1e-310}, {1.0 / 3}});
    start[0].fitness = Fitness(Name(std::string("a")), 0.1 + 0.2);
    start.push_back(start[1]);
    start[2].fitness = Fitness(Name(std::string("pareto a b")), Point{1, -0.5}, 0.25);
    start[0].parents = Parents(4, 7);
    start[0].origin = std::make_shared<const std::vector<double>>(3, 1e300);
    start[1].fitness = Fitness::failed(Name(std::string("a")), std::make_shared<const std::string>("no"));
    start[1].parents = Parents(9);
    const auto back = json::from_cbor(json::to_cbor(json(start))).get<Population<std::vector<double>>>();
    CHECK(back[0].genome == start[0].genome);
    CHECK(std::signbit(back[0].genome[1]));
    CHECK(back[0].value() == start[0].value());
    CHECK(back[0].parents == start[0].parents);
    CHECK(*back[0].origin == *start[0].origin);
    CHECK(back[1].fitness.reason() == "no");
    CHECK(back[2].fitness.values() == Point{1, -0.5});
    CHECK(back[2].fitness.violation() == 0.25);
    CHECK(back[1].parents == start[1].parents);
}

// The process that the next case kills: hidden, run by itself.
TEST_CASE("child of the kill test", "[.][kill-child]") {
    const fs::path folder = std::getenv("GA_CHECKPOINT_FOLDER");
    Checkpoints<Slow> checkpoints(folder / "run", "", true, 0.01);
    checkpoints.keep("seen", seen);
    const auto result = run(nested<Slow>(), Slow{}, nobody, {.threads = 2}, {observer}, &checkpoints);
    std::ofstream(folder / "answer.tmp") << text_of(result, seen);
    fs::rename(folder / "answer.tmp", folder / "answer");
}

TEST_CASE("a process that is killed at random moments and resumed ends in the very result") {
    const tests::Folder folder;
    seen.clear();
    const auto whole = run(nested<Slow>(), Slow{}, nobody, {.threads = 1}, {observer});
    const std::string expected = text_of(whole, seen);
    ::setenv("GA_CHECKPOINT_FOLDER", folder.path().c_str(), 1);
    Stream stream(2024);
    int killed = 0;
    for (int attempt = 0; attempt < 200 && !fs::exists(folder / "answer"); ++attempt) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::execl("/proc/self/exe", "tests_ga", "[kill-child]", "-o", "/dev/null", nullptr);
            ::_exit(127);
        }
        // later and later, so that it ends however slow the machine
        const auto milliseconds = 20 + stream.below(60) + static_cast<std::size_t>(10 * attempt);
        int status = 0;
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
        while (::waitpid(child, &status, WNOHANG) == 0) {
            if (std::chrono::steady_clock::now() > end) {
                ::kill(child, SIGKILL);
                ::waitpid(child, &status, 0);
                ++killed;
                break;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    REQUIRE(fs::exists(folder / "answer"));
    CHECK(killed > 0);
    std::ifstream answer(folder / "answer");
    CHECK(std::string(std::istreambuf_iterator<char>(answer), {}) == expected);
}

TEST_CASE("a resumed run goes on with the notes and the seconds of before") {
    const tests::Folder folder;
    const auto pipeline = sample(8) | score() | above(1, at_least(3)) | repeat(6, mutate(1) | score());
    Checkpoints<Vectors> write(folder / "run", "", false), resume(folder / "run", "", true);
    double last = 0;
    const Observer<std::vector<double>> note = [&](const auto& event) { last = event.seconds; };
    const auto part = run(pipeline, Vectors{}, nobody, {.budget = {.evaluations = 20}}, {note}, &write);
    REQUIRE_FALSE(part.stopped.empty());
    const Stopwatch clock;
    std::optional<double> first;
    const Observer<std::vector<double>> look = [&](const auto& event) {
        if (!first) {
            first = event.seconds;
            CHECK(event.seconds >= last);
            CHECK(event.seconds <= part.seconds + clock.seconds());
        }
    };
    const auto result = run(pipeline, Vectors{}, nobody, {}, {look}, &resume);
    CHECK(first);
    CHECK(result.notes == std::vector<std::string>{"pipeline/above.1: 0 of 8 above 1; took the 3 best"});
    const Stopwatch fresh;
    const double alone = run(sample(1) | score(), Vectors{}, nobody).seconds;
    CHECK(alone <= fresh.seconds());
}

TEST_CASE("a program without standard input keeps its checkpoints") {
    const tests::Folder folder;
    const int input = ::dup(0);
    ::close(0); // the next file takes its number
    const std::string trouble = seal(folder / "run", "all");
    ::dup2(input, 0);
    ::close(input);
    CHECK(trouble.empty());
    CHECK(opened(folder / "run") == "all");
}

TEST_CASE(
    "a run of permutations, and one whose memory has grown old, are resumed to the uninterrupted result") {
    /// The sum of distances between neighbours of an order.
    struct Tour {
        using Genome = Permutation;
        using Outcome = double;
        double evaluate(const Genome& g) const {
            double length = 0;
            for (std::size_t i = 0; i + 1 < g.size(); ++i)
                length += std::abs(static_cast<double>(g.order[i]) - static_cast<double>(g.order[i + 1]));
            return length;
        }
        const std::vector<Objective<double>>& objectives() const {
            static const std::vector<Objective<double>> list = {
                {"length", [](const double& y) { return y; }, true}};
            return list;
        }
        Genome sample(Stream& stream) const { return Permutation::random(7, stream); }
    };
    const tests::Folder folder;
    const auto pipeline =
        sample(20) | score() | repeat(8, tournament(2) | cross(order()) | mutate(0.05) | score() | elite(2));
    for (const std::size_t bytes : {std::size_t{1} << 30, std::size_t{5000}, std::size_t{3000}}) {
        const auto whole = run(pipeline, Tour{}, {}, {.memory_bytes = bytes});
        bool resumes = false;
        for (long budget = 30;; budget += 30, resumes = true) {
            Checkpoints<Tour> checkpoints(folder / "run", std::to_string(bytes), resumes);
            const auto part =
                run(pipeline, Tour{}, {}, {.memory_bytes = bytes, .budget = {.evaluations = budget}}, {},
                    &checkpoints);
            if (!part.stopped.empty())
                continue;
            CHECK(json(part.population) == json(whole.population));
            CHECK(json(part.counters) == json(whole.counters));
            break;
        }
        CHECK(resumes);
        if (bytes == 3000) // some was forgotten, and what was old was written
            CHECK(whole.counters.evaluations > run(pipeline, Tour{}, {}).counters.evaluations);
    }
}

namespace {

/// A sum of squares that asks the run to stop at one of its calls.
struct Interrupted {
    using Genome = std::vector<double>;
    using Outcome = double;

    std::atomic<bool>* stop;
    std::atomic<long>* calls;
    long at = -1;

    double evaluate(const Genome& x) const {
        if (++*calls == at)
            *stop = true;
        double sum = 0;
        for (const double gene : x)
            sum -= gene * gene;
        return sum;
    }
    const std::vector<Objective<double>>& objectives() const {
        static const std::vector<Objective<double>> list = {{"squares", [](const double& v) { return v; }}};
        return list;
    }
    std::vector<Variable> bounds(const Genome&) const { return {{0, -2, 2}, {1, -2, 2}}; }
    Genome sample(Stream& stream) const {
        return {static_cast<double>(stream.below(4)) - 1.5, static_cast<double>(stream.below(4)) - 1.5};
    }
};

} // namespace

TEST_CASE("a run stopped at any evaluation counts as an uninterrupted one when resumed, in any memory") {
    const tests::Folder folder;
    using Numbers = std::vector<double>;
    const auto whole = [](const Result<Numbers>& result) {
        std::string text = std::to_string(result.counters.asked) + " " +
                           std::to_string(result.counters.evaluations) + " " +
                           std::to_string(result.counters.remembered);
        for (const auto& each : result.population)
            text += " " + std::to_string(each.identity) + ":" + number(each.genome[0]) + "," +
                    number(each.genome[1]);
        return text;
    };
    const Stage<Interrupted> islands =
        sample(8) | score() |
        ga::islands(2, {3, 1}, tournament(2) | cross(uniform()) | mutate(0.4) | score() | elite(1));
    const Stage<Interrupted> refined =
        sample(3) | score() |
        repeat(3, tournament(2) | mutate(0.5) | score() | refine(nlopt_method("LN_COBYLA", 5)) | elite(1));
    for (const auto& pipeline : {islands, refined})
        for (const std::size_t memory : {std::size_t{600}, std::size_t{1} << 30}) {
            std::atomic<bool> stop = false;
            std::atomic<long> calls = 0;
            RunOptions options{.seed = 5, .threads = 1, .memory_bytes = memory, .budget = {.stop = &stop}};
            const std::string uninterrupted = whole(run(pipeline, Interrupted{&stop, &calls}, {}, options));
            const long count = calls;
            for (long at = 1; at <= count; ++at) {
                stop = false;
                calls = 0;
                options.threads = 1 + static_cast<int>(at % 3);
                {
                    Checkpoints<Interrupted> first(folder / "kept", "x", false, 1e9);
                    run(pipeline, Interrupted{&stop, &calls, at}, {}, options, {}, &first);
                }
                stop = false;
                Checkpoints<Interrupted> second(folder / "kept", "x", true, 1e9);
                CHECK(whole(run(pipeline, Interrupted{&stop, &calls}, {}, options, {}, &second)) ==
                      uninterrupted);
                CHECK(calls == count);
            }
        }
}
