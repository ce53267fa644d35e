#include "domain/database/store.hpp"
#include "ga/base/stopwatch.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <thread>
#include <unistd.h>

using namespace app::testing;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// Whether there is nothing to run these tests with; says so.
bool has_no_mpi() {
    if (*RUGOSA_MPIRUN && fs::exists(RUGOSA_MPIRUN))
        return false;
    WARN("skipped: no mpirun, or a build without MPI");
    return true;
}

std::string mpirun(const std::string& ranks) {
    return "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
           "timeout -k 20 200 " RUGOSA_MPIRUN " -n " +
           ranks;
}

/// Runs the program on so many ranks; on one without mpirun.
Ended on_ranks(int ranks, const std::string& words, const fs::path& where) {
    return app::testing::rugosa(words, where, ranks == 1 ? "" : mpirun(std::to_string(ranks)));
}

/// The program's own lines of what stood on stderr.
std::vector<std::string> own_lines(const Ended& ended) { return found(ended.err, "(rugosa: [^\n]*)"); }

/// How many tasks each rank did, as --verbose tells.
std::vector<long> tasks(const Ended& ended) {
    std::vector<long> all;
    for (const std::string& count : found(ended.out, "rank [0-9]+: ([0-9]+) tasks"))
        all.push_back(std::stol(count));
    return all;
}

/// The same on 1, 2, 3 and 4 ranks of one thread or two; every rank took part.
void expect_the_same(const std::string& words, const std::function<json(const fs::path&)>& result) {
    const Folder folder;
    const auto run = [&](int ranks, int threads) {
        const fs::path where = folder / (std::to_string(ranks) + "-" + std::to_string(threads));
        fs::create_directory(where);
        const Ended ended = on_ranks(ranks, words + " --verbose --threads " + std::to_string(threads), where);
        INFO(ended.err);
        REQUIRE((ended.code == 0 || ended.code == 3));
        const auto each = tasks(ended);
        CHECK(each.size() == (ranks == 1 ? 0u : static_cast<std::size_t>(ranks)));
        for (const long count : each)
            CHECK(count > 0);
        return result(where);
    };
    const json alone = run(1, 1);
    for (const auto& [ranks, threads] : {std::pair(2, 1), {3, 2}, {4, 1}}) {
        INFO(ranks << " ranks of " << threads << " threads");
        CHECK(run(ranks, threads) == alone);
    }
}

const std::string design =
    "design --target '" RUGOSA_TEST_DATA "/target_paper.csv' --nodes 512 --pictures off --pipeline "
    "'shape 12 | score | best 4 | refine lm 6 | repeat 3 { tournament 2 | cross uniform | mutate 0.1 | "
    "score | refine lm 6 | elite 1 } | best 2 | score verified' --out o";

const std::string longer =
    std::string(design).replace(design.find("repeat 3"), 8, "repeat 30") + " --threads 1";

json of_design(const fs::path& where) { return timeless(result_in(where / "o")); }

json of_database(const fs::path& where) {
    const rough::GenomeStore store = rough::GenomeStore::open(where / "g.db");
    const rough::StoredCurves curves = store.curves(true);
    return {curves.index, curves.range, curves.pressure, curves.fraction};
}

/// The process of a rank on this machine, once it is there.
pid_t process_of(const std::string& rank, const fs::path& where) {
    for (const ga::Stopwatch clock; clock.seconds() < 60;
         std::this_thread::sleep_for(std::chrono::milliseconds(20)))
        for (const auto& entry : fs::directory_iterator("/proc")) {
            std::error_code none;
            if (entry.path().filename().string().find_first_not_of("0123456789") != std::string::npos ||
                !fs::equivalent(entry.path() / "cwd", where, none) ||
                !fs::equivalent(entry.path() / "exe", RUGOSA_PROGRAM, none))
                continue;
            const std::string environment = rough::read_whole(entry.path() / "environ");
            if (environment.find("OMPI_COMM_WORLD_RANK=" + rank + std::string(1, '\0')) != std::string::npos)
                return static_cast<pid_t>(std::stol(entry.path().filename().string()));
        }
    FAIL("no rank " << rank << " has begun");
    return 0;
}

/// Runs on three ranks and, once `sign` is there, sends one a signal.
Ended stricken(const std::string& words, const fs::path& where, const std::string& rank, int signal,
               const std::string& sign) {
    Ended ended;
    std::thread run([&] { ended = on_ranks(3, words, where); });
    const pid_t victim = process_of(rank, where);
    for (const ga::Stopwatch clock; !fs::exists(where / sign) && clock.seconds() < 60;)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ::kill(victim, signal);
    run.join();
    return ended;
}

/// Runs on two ranks; on one a call of MPI does not return.
Ended with_hanging(int rank, const std::string& call, const std::string& words, const fs::path& where) {
    const std::string hanging = " env LD_PRELOAD='" RUGOSA_HANGING_MPI "' RUGOSA_HANGS=" + call;
    return app::testing::rugosa(words, where,
                                mpirun("1" + (rank == 0 ? hanging : "") + " '" RUGOSA_PROGRAM "' " + words +
                                       " : -n 1" + (rank == 1 ? hanging : "")));
}

/// A design of which a rank is stricken once it has written a checkpoint.
Ended stricken_design(const Folder& folder, const std::string& rank, int signal) {
    const Ended ended = stricken(longer + " --patience 2", folder.path(), rank, signal, "o/checkpoint.cbor");
    INFO((signal == SIGKILL ? "killed: " : "stopped: ") << ended.err);
    CHECK(ended.code != 0);
    REQUIRE(fs::exists(folder / "o/checkpoint.cbor"));
    return ended;
}

} // namespace

TEST_CASE("a design is the same to the bit on any number of ranks and threads", "[ranks]") {
    if (!has_no_mpi())
        expect_the_same(design, of_design);
}

TEST_CASE("the paper's experiment is the same to the bit on any number of ranks and threads", "[ranks]") {
    if (!has_no_mpi())
        expect_the_same("run '" RUGOSA_SOURCE "/experiments/paper.ini' --pictures off --nodes 256 --set "
                        "database.pairs=12 --set paper.sweep-points=0 --out o",
                        of_design);
}

TEST_CASE("a comparison is the same to the bit on any number of ranks and threads", "[ranks]") {
    if (!has_no_mpi())
        expect_the_same("compare --problems bbob5-1,zdt1,knapsack50,tsp14 --budget 300 --seeds 3 --out o",
                        of_design);
}

TEST_CASE("a database is the same to the bit on any number of ranks and threads", "[ranks]") {
    if (!has_no_mpi())
        expect_the_same("database build g.db --genomes 333 --batch 10 --nodes 128", of_database);
}

TEST_CASE(
    "a rank that dies or hangs ends the run with one line and a checkpoint, from which any number of ranks "
    "reaches the uninterrupted result",
    "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder whole;
    REQUIRE(on_ranks(1, longer, whole.path()).code == 3);
    for (const int signal : {SIGKILL, SIGSTOP}) {
        const Folder folder;
        const auto lines = own_lines(stricken_design(folder, "2", signal));
        REQUIRE(lines.size() == 1);
        CHECK_THAT(lines[0],
                   Catch::Contains("rank 2 (") && Catch::Contains("process ") && Catch::Contains("--resume"));
        const Ended again = on_ranks(2, longer + " --resume", folder.path());
        INFO(again.err);
        REQUIRE(again.code == 3);
        CHECK(of_design(folder.path()) == of_design(whole.path()));
    }
}

TEST_CASE("a rank 0 that is killed or hangs leaves a checkpoint that one process goes on from", "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder whole;
    REQUIRE(on_ranks(1, longer, whole.path()).code == 3);
    for (const int signal : {SIGKILL, SIGSTOP}) {
        const Folder folder;
        CHECK(own_lines(stricken_design(folder, "0", signal)).size() <= 1); // mpirun, too, tells of a death
        REQUIRE(on_ranks(1, longer + " --resume", folder.path()).code == 3);
        CHECK(of_design(folder.path()) == of_design(whole.path()));
    }
}

TEST_CASE("a database whose build lost a rank goes on to the same one", "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder folder, whole;
    const std::string words = "database build g.db --genomes 4000 --batch 20 --threads 1";
    REQUIRE(on_ranks(1, words, whole.path()).code == 0);
    const Ended ended = stricken(words + " --patience 2", folder.path(), "1", SIGSTOP, "g.db");
    CHECK(ended.code == 130);
    CHECK(own_lines(ended).size() == 1);
    REQUIRE(on_ranks(2, words, folder.path()).code == 0);
    CHECK(of_database(folder.path()) == of_database(whole.path()));
}

TEST_CASE("a rank whose MPI does not come back ends the run with one line, and what was stored is there",
          "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder folder, whole;
    const std::string words = "database build g.db --genomes 400 --batch 20 --nodes 64 --patience 2";
    REQUIRE(on_ranks(1, words, whole.path()).code == 0);
    const Ended ended = with_hanging(0, "MPI_Improbe", words, folder.path());
    INFO(ended.err);
    CHECK(ended.code == 130);
    REQUIRE(own_lines(ended).size() == 1);
    CHECK_THAT(own_lines(ended)[0], Catch::Contains("rank 0: MPI") && Catch::Contains("--resume"));
    REQUIRE(on_ranks(2, words, folder.path()).code == 0);
    CHECK(of_database(folder.path()) == of_database(whole.path()));
}

TEST_CASE("a rank that hangs as it ends keeps no other, and what was done is there", "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder folder;
    const std::string words = "database build g.db --genomes 40 --nodes 64 --patience 2";
    const Ended ended = with_hanging(1, "MPI_Finalize", words, folder.path());
    INFO(ended.err);
    CHECK(ended.code != 124); // the limit's
    CHECK(own_lines(ended).empty());
    CHECK(rough::GenomeStore::open(folder / "g.db").curves(true).index.size() == 40);
}

TEST_CASE("ranks that were not given the same words end at once with one line and exit code 2", "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder folder;
    const std::string program = "'" RUGOSA_PROGRAM "' ";
    const Ended ended =
        app::testing::rugosa("operators", folder.path(), mpirun("1 " + program + "operators --quiet : -n 1"));
    CHECK(ended.code == 2);
    REQUIRE(own_lines(ended).size() == 1);
    CHECK_THAT(own_lines(ended)[0],
               Catch::Contains("rank 1 (") && Catch::Contains("words 'operators', expected "
                                                              "'operators --quiet'"));
}

TEST_CASE("what one rank does alone is done once, and wrong use has its line and exit code on many",
          "[ranks]") {
    if (has_no_mpi())
        return;
    const Folder folder;
    const Ended version = on_ranks(3, "--version", folder.path());
    CHECK(version.code == 0);
    CHECK(version.out == app::testing::rugosa("--version").out);
    for (const std::string words : {"design --target none.csv", "operators --patience soon"}) {
        const Ended wrong = on_ranks(2, words, folder.path());
        INFO(wrong.err);
        CHECK(wrong.code == 2);
        CHECK(own_lines(wrong).size() == 1);
    }
}
