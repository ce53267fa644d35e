#include "tests/catch.hpp"
#include "tests/folder.hpp"
#include "tests/ga/problems.hpp"

#include <csignal>
#include <sys/wait.h>

using namespace ga;

namespace {

namespace fs = std::filesystem;

const std::string evolving = "sample 8 | score | repeat 6 { tournament 2 | mutate 1 | score | elite 1 }";
/// Every block there is, inside each other.
const std::string nested = "sample 24 | score | islands 2 rounds=3 { repeat 2 " + generation +
                           " | until generations 3 stagnation 2 " + generation +
                           " } | pair(score first | best 3, score | restarts 2 { repeat 2 " + generation +
                           " | best 2 }, mean) | score | repeat 2 { refine nlopt LN_COBYLA 4 | best 5 }";

/// Reals whose evaluation takes a while, so that a process can be killed within one.
Reals slow() {
    Reals problem;
    problem.f = [](const Vector& x) {
        std::this_thread::sleep_for(std::chrono::microseconds(300));
        if (x[0] > 0.999) throw std::domain_error("first gene above 0.999");
        return x;
    };
    return problem;
}

/// Events of an observer, which checkpoints store.
std::vector<std::string> seen;
const Observer<Vector> observer = [](const auto& event) {
    seen.push_back(event.path + " " + std::to_string(event.counters.requested));
};
const std::function<void(Checkpoints<Reals>&)> keep_seen = [](Checkpoints<Reals>& checkpoints) {
    seen.clear();
    checkpoints.keep("seen", seen);
};

void write(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

/// A checkpoint of a run of `pipeline` that was stopped.
json stopped(const fs::path& file, const std::string& pipeline, const Reals& problem = {}, long evaluations = 30) {
    Checkpoints<Reals> checkpoints(file, "", false, 0);
    REQUIRE_FALSE(
        run(pipeline, problem, {}, {.budget = {.evaluations = evaluations}}, {}, &checkpoints).stopped.empty());
    return json::from_cbor(opened(file));
}
/// Resumes from a forged checkpoint whose seal is right.
Result<Vector> forged(const fs::path& file, const json& checkpoint, const std::string& pipeline,
                      const Reals& problem = {}) {
    const auto bytes = json::to_cbor(checkpoint);
    seal(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    Checkpoints<Reals> resume(file, "", true);
    return run(pipeline, problem, {}, {}, {}, &resume);
}

} // namespace

TEST_CASE("a run resumes to the uninterrupted result after any stop") {
    seen.clear();
    const auto whole = run(nested, Reals{}, {}, {}, {observer});
    const auto all = seen;
    REQUIRE(whole.counters.requested > 450);
    for (const long step : {70L, 111L, 333L}) {
        CHECK(bits_of(in_pieces(nested, Reals{}, step, {}, {observer}, keep_seen)) == bits_of(whole));
        CHECK(seen == all);
    }
}

TEST_CASE("a run stopped at any evaluation resumes with the same counts, in any memory") {
    Reals problem = minimum(2, functions::sphere, -2, 2);
    for (const std::string pipeline : {"sample 8 | mutate 1 reset | score | islands 2 rounds=3 { tournament "
                                       "2 | cross uniform | mutate 0.4 | score | elite 1 }",
                                       "sample 3 | score | repeat 3 { tournament 2 | mutate 0.5 | score | "
                                       "refine nlopt LN_COBYLA 5 | elite 1 }"})
        for (const std::size_t memory : {std::size_t{600}, std::size_t{1} << 30}) {
            const RunOptions options{.seed = 5, .memory_bytes = memory};
            const auto whole = run(pipeline, problem, {}, options);
            for (long step = 1; step < whole.counters.evaluations; step += 1 + step / 4)
                CHECK(bits_of(in_pieces(pipeline, problem, step, options)) == bits_of(whole));
        }
}

TEST_CASE("a run killed at random moments resumes to the uninterrupted result") {
    const tests::Folder folder;
    seen.clear();
    const auto whole = run(nested, slow(), {}, {.threads = 1}, {observer});
    const std::string expected = bits_of(whole) + json(seen).dump();
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
    CHECK(contents(folder / "answer") == expected);
}

// The process that the case above kills.
TEST_CASE("child of the kill test", "[.][kill-child]") {
    const fs::path folder = std::getenv("GA_CHECKPOINT_FOLDER");
    Checkpoints<Reals> checkpoints(folder / "run", "", true, 0.01);
    checkpoints.keep("seen", seen);
    const auto result = run(nested, slow(), {}, {.threads = 2}, {observer}, &checkpoints);
    write(folder / "answer.tmp", bits_of(result) + json(seen).dump());
    fs::rename(folder / "answer.tmp", folder / "answer");
}

TEST_CASE("a finished run is read from its checkpoint") {
    const tests::Folder folder;
    Checkpoints<Reals> first(folder / "run", "", false), second(folder / "run", "", true);
    const auto done = run(nested, Reals{}, {}, {}, {}, &first);
    seen.clear();
    CHECK(bits_of(run(nested, Reals{}, {}, {}, {observer}, &second)) == bits_of(done));
    CHECK(seen.empty());
    CHECK(done.notes.empty());
}

TEST_CASE("a checkpoint of another run is refused") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    Checkpoints<Reals> kept(file, "a", false), same(file, "a", true), other(file, "b", true);
    run("sample 3 | score", Reals{}, {}, {}, {}, &kept);
    const std::string message =
        "checkpoint '" + file.string() +
        "' is of another run; use the same version, pipeline, seed, start, settings and input files";
    CHECK_THROWS_WITH(run("sample 3 | score", Reals{}, {}, {}, {}, &other), message);
    CHECK_THROWS_WITH(run("sample 4 | score", Reals{}, {}, {}, {}, &same), message);
    CHECK_THROWS_WITH(run("sample 3 | score", Reals{}, {}, {.seed = 2}, {}, &same), message);
}

TEST_CASE("a damaged checkpoint is refused, and the one before it used") {
    const tests::Folder folder;
    const fs::path file = folder / "run", before = folder / "run.before";
    Checkpoints<Reals> kept(file, "", false, 0);
    const auto whole = run(evolving, Reals{}, {}, {}, {}, &kept);
    const std::string good = contents(file),
                      damaged = "checkpoint '" + file.string() +
                                "' is damaged or not a checkpoint; give a file that this version wrote";
    Stream random(1);
    for (int i = 0; i < 60; ++i) {
        std::string bad = good;
        char& byte = bad[random.below(bad.size())];
        byte = static_cast<char>(byte ^ (1 << random.below(8)));
        write(file, i % 2 ? bad : good.substr(0, random.below(good.size())));
        write(before, good);
        Checkpoints<Reals> resume(file, "", true);
        const auto result = run(evolving, Reals{}, {}, {}, {}, &resume);
        CHECK(result.population[0].genome == whole.population[0].genome);
        CHECK(result.notes == std::vector<std::string>{damaged + "; went on from the one before"});
    }
    write(file, good.substr(0, good.size() / 2));
    fs::remove(before);
    Checkpoints<Reals> alone(file, "", true);
    CHECK_THROWS_WITH(run(evolving, Reals{}, {}, {}, {}, &alone), damaged);
}

TEST_CASE("a run that used the older checkpoint keeps it until the next is written") {
    const tests::Folder folder;
    const fs::path file = folder / "run", before = folder / "run.before";
    const std::string whole = bits_of(run(evolving, Reals{}));
    stopped(file, evolving);
    fs::rename(file, before); // killed between two names
    Checkpoints<Reals> resume(file, "", true);
    CHECK(bits_of(run(evolving, Reals{}, {}, {}, {}, &resume)) == whole);

    stopped(file, evolving);
    write(file, "half");
    Checkpoints<Reals> killed(file, "", true, 1e9); // which writes once
    run(evolving, Reals{}, {}, {.budget = {.evaluations = 40}}, {}, &killed);
    CHECK_NOTHROW(opened(file));
    CHECK_NOTHROW(opened(before));
}

TEST_CASE("a forged checkpoint that nests too deep or does not fit is refused") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    seal(file, std::string(200000, '\x81') + '\x01'); // arrays of one array of one array ...
    Checkpoints<Reals> deep(file, "", true);
    CHECK_THROWS_WITH(run(evolving, Reals{}, {}, {}, {}, &deep),
                      "checkpoint '" + file.string() + "' nests too deep; give one that a run wrote");
    CHECK(read_cbor(std::string(63, '\x81') + '\x80', file).size() == 1); // 64 arrays
    CHECK_THROWS_AS(read_cbor(std::string(64, '\x81') + '\x80', file), UsageError);
    const json good = stopped(file, evolving);
    const auto refused = [&](const std::string& place, const json& value, const std::string& words) {
        json altered = good;
        altered[json::json_pointer(place)] = value;
        CHECK_THROWS_WITH(forged(file, altered, evolving), words);
    };
    for (const auto& [place, value] : std::vector<std::pair<std::string, json>>{
             {"/snapshot/0/0/0", 99}, {"/snapshot/0/1/2", json::array()}, {"/snapshot/0/1/3", json::array()}})
        refused(place, value, "the checkpoint does not fit its pipeline; use one that this pipeline has written");
    // Whole numbers of their range only: every other conversion is undefined or another number.
    for (const auto& [place, value] : std::vector<std::pair<std::string, json>>{{"/snapshot/0/0/0", 1e300},
                                                                                {"/snapshot/0/0/0", std::nan("")},
                                                                                {"/snapshot/0/1/2/0/0/1", 0.5},
                                                                                {"/snapshot/2", -1}})
        refused(place, value,
                "checkpoint '" + file.string() +
                    "' has other parts than a run writes; use one that this version has written, or start again");
}

TEST_CASE("a checkpoint with a genome, fitness, outcome or count that no run writes is refused") {
    const tests::Folder folder;
    const fs::path file = folder / "run";
    const std::string pipeline =
        "sample 8 | pareto squares first | repeat 6 { mutate 1 | pareto squares first | plus 8 }";
    const json good = stopped(file, pipeline);
    const std::string one = "/snapshot/0/1/2/0/0", other = "/snapshot/3";
    const double nan = std::nan("");
    for (const auto& [place, value] : std::vector<std::pair<std::string, json>>{
             {one + "/0", Vector(5)},
             {one + "/0/3", nan},
             {one + "/3/0", "pareto squares"},
             {one + "/3/1", Vector(1)},
             {one + "/3/1/0", nan},
             {one + "/3/2", -1},
             {one + "/4", Vector(7)},
             {one + "/4", Vector(5)},
             {other + "/0", Vector(5)},
             {other + "/3/0", "second"},
             {other + "/3/1", nan},
             {other + "/3/3", Vector{1, nan}},
             {other + "/3/4", true},
             {other + "/3/5", 0},
             {"/snapshot/1/0", -1},
             {"/snapshot/1/1", std::numeric_limits<long>::max()},
             {"/snapshot/5", -1},
             {"/answer", json::array({good["snapshot"][3], good["snapshot"][0][1][2][0][0]})}}) {
        CAPTURE(place, value);
        json altered = good;
        altered[json::json_pointer(place)] = value;
        if (place == "/answer") altered[place.substr(1)][0][0] = Vector(5);
        CHECK_THROWS_WITH(forged(file, altered, pipeline),
                          "checkpoint '" + file.string() +
                              "' has values that no run writes; use one that this version has written, or "
                              "start again");
    }
    json other_parts = good;
    other_parts["snapshot"] = "text";
    CHECK_THROWS_WITH(forged(file, other_parts, pipeline), Catch::Contains("has other parts than a run writes"));
}

TEST_CASE("a checkpoint does not follow links, and a failed write does not stop the run") {
    const tests::Folder folder;
    write(folder / "victim", "precious");
    fs::create_symlink(folder / "victim", folder / "run.tmp");
    Checkpoints<Reals> kept(folder / "run", "", false);
    run("sample 3 | score", Reals{}, {}, {}, {}, &kept);
    CHECK(contents(folder / "victim") == "precious");
    Checkpoints<Reals> nowhere(folder / "gone" / "run", "", false);
    const auto result = run("sample 3 | score", Reals{}, {}, {}, {}, &nowhere);
    CHECK(result.population.size() == 3);
    REQUIRE(result.notes.size() == 1);
    CHECK(result.notes[0].find("cannot be written") != std::string::npos);
}
