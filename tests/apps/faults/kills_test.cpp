#include "domain/database/store.hpp"
#include "ga/base/random.hpp"
#include "ga/base/stopwatch.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <thread>
#include <unistd.h>

using app::testing::Folder;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// A piece of work that is killed and gone on with until it is done.
struct Work {
    std::string name, first, again; ///< words of the command line, with `again` from the second time on
    std::function<json(const fs::path&)> result; ///< in a folder, of what lasts
};

/// Runs the program in a folder and kills it after so many seconds. Its exit code; nothing where it was
/// killed.
std::optional<int> run_for(double seconds, const std::string& words, const fs::path& where) {
    const std::string command = "exec '" RUGOSA_PROGRAM "' " + words + " >log 2>err </dev/null";
    const pid_t child = ::fork();
    if (child == 0) {
        if (::chdir(where.c_str()) == 0) {
            ::setenv("RUGOSA_CHECKPOINTS", "0", 1);
            ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
        }
        ::_exit(127);
    }
    const ga::Stopwatch clock;
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (clock.seconds() > seconds)
            ::kill(child, SIGKILL);
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        return std::nullopt;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Whether no half of a file stands under its final name.
bool whole_or_none(const fs::path& result) {
    return !fs::exists(result) || json::accept(rough::read_whole(result));
}

json of_run(const fs::path& folder) { return app::testing::timeless(app::testing::result_in(folder / "o")); }

json of_search(const fs::path& folder) {
    json result = app::testing::result_in(folder / "o");
    for (const char* name : {"threads", "command", "seconds"})
        result.erase(name);
    return result;
}

json of_database(const fs::path& folder) {
    const rough::GenomeStore store = rough::GenomeStore::open(folder / "g.db");
    const rough::StoredCurves curves = store.curves();
    const auto steps = curves.index.empty() ? 0 : curves.pressure.size() / curves.index.size();
    std::map<std::uint64_t, std::vector<double>> rows;
    for (std::size_t i = 0; i < curves.index.size(); ++i)
        for (std::size_t j = 0; j < steps; ++j)
            rows[curves.index[i]].push_back(curves.pressure[i * steps + j]);
    return rows;
}

std::vector<Work> all_work() {
    const std::string design =
        "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 64 --pictures off --seconds 600 "
        "--pipeline 'shape 8 | score | best 4 | refine lm 4 | repeat 12 { tournament 2 | cross uniform | "
        "mutate 0.1 | score | refine lm 4 | elite 1 } | best 2 | score verified' --out o";
    const std::string run =
        "run '" RUGOSA_SOURCE "/experiments/paper.ini' --pictures off --nodes 32 --set database.pairs=20 "
        "--set paper.sweep-points=0 --set 'variants.own=score | best 5 | repeat 20 { tournament 2 | cross "
        "uniform | mutate 0.1 | score | elite 2 }' --out o";
    const std::string optimise = "optimise --genes bits:40 --evaluate \"'" +
                                 (fs::path(RUGOSA_PROGRAM).parent_path() / "tests/evaluate").string() +
                                 "' ones\" --pipeline 'sample 30 | score | repeat 40 { tournament 2 | cross "
                                 "uniform | mutate 0.02 | score | "
                                 "elite 1 } | best 1' --out o";
    const std::string database = "database build g.db --genomes 300 --batch 10 --nodes 128";
    return {{"design", design, design + " --resume", of_run},
            {"run", run, run + " --resume", of_run},
            {"optimise", optimise, optimise + " --resume", of_search},
            {"database", database, database, of_database}};
}

/// Kills the work at random moments and resumes it, time and again. Returns the number of finished results.
long kill_and_resume(const Work& work, long kills) {
    const Folder unbroken;
    const ga::Stopwatch clock;
    const auto code = run_for(1e9, work.first, unbroken.path());
    const double seconds = clock.seconds();
    INFO(work.name << ": " << rough::read_whole(unbroken / "err"));
    REQUIRE((code == 0 || code == 3));
    const json expected = work.result(unbroken.path());
    ga::Stream random(7);
    long results = 0;
    while (kills > 0) {
        const Folder folder;
        std::optional<int> ended = run_for(seconds * random.uniform(), work.first, folder.path());
        while (!ended) {
            --kills;
            REQUIRE(whole_or_none(folder / "o/result.json"));
            ended = run_for(seconds * (0.05 + random.uniform()), work.again, folder.path());
        }
        INFO(rough::read_whole(folder / "log") << rough::read_whole(folder / "err"));
        REQUIRE(ended == code); // killed between its last file and its end, too
        REQUIRE(work.result(folder.path()) == expected);
        ++results;
    }
    return results;
}

} // namespace

TEST_CASE("design, run, optimise and database build resume to the same result after being killed",
          "[kills]") {
    for (const Work& work : all_work())
        kill_and_resume(work, 3);
}

TEST_CASE("a thousand kills without warning change no result", "[long][kills]") {
    const char* const given = std::getenv("RUGOSA_KILLS");
    const long each = (given ? std::atol(given) : 1000) / 4;
    for (const Work& work : all_work())
        std::cout << work.name << ": " << each << " kills, " << kill_and_resume(work, each)
                  << " results as the uninterrupted one\n";
}
