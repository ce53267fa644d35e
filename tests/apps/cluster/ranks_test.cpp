#include "apps/cluster/cluster.hpp"
#include "domain/numerics/vector_loops.hpp"
#include "ga/base/stopwatch.hpp"
#include "tests/apps/results.hpp"

#include <thread>

using namespace app::testing;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// Whether these tests cannot run here; prints the reason.
bool has_no_mpi() {
    if (*RUGOSA_MPIRUN && fs::exists(RUGOSA_MPIRUN)) return false;
    WARN("skipped: no mpirun, or a build without MPI");
    return true;
}

const std::string mpirun = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
                           "timeout -k 20 200 " RUGOSA_MPIRUN " --oversubscribe -n ";

/// Runs `program` on ranks, e.g. "3" or "1 PROGRAM WORDS : -n 1".
Ended under_mpirun(const std::string& ranks, const std::string& words, const fs::path& where) {
    return app::testing::rugosa(words, where, mpirun + ranks);
}

/// One rank runs without mpirun.
Ended on_ranks(int ranks, const std::string& words, const fs::path& where) {
    return ranks == 1 ? app::testing::rugosa(words, where) : under_mpirun(std::to_string(ranks), words, where);
}

/// The lines of the program on stderr, without those of mpirun.
std::vector<std::string> program_lines(const Ended& ended) { return found(ended.err, "(rugosa: [^\n]*)"); }

const std::string design =
    "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 128 --pictures off --pipeline "
    "'shape 12 | score | best 4 | refine lm 6 | repeat 3 { tournament 2 | cross uniform | mutate 0.1 | "
    "score | refine lm 6 | elite 1 } | best 2 | score verified' --out o";

/// A design that is long enough to be stopped.
const std::string longer = std::string(design).replace(design.find("repeat 3"), 8, "repeat 60") + " --threads 1";

/// The process of a rank, after it has begun.
pid_t process_of(const std::string& rank, const fs::path& where) {
    for (const ga::Stopwatch clock; clock.seconds() < 60; std::this_thread::sleep_for(std::chrono::milliseconds(20)))
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
    FAIL("rank " << rank << " has not begun");
    return 0;
}

/// Runs on three ranks, and sends one of them a signal when the file `sign` exists.
Ended signalled(const std::string& words, const fs::path& where, const std::string& rank, int signal,
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

} // namespace

TEST_CASE("a run has the same bits on 1, 2 and 3 ranks", "[ranks]") {
    if (has_no_mpi()) return;
    struct Case {
        const char* name;
        std::string words;
        json (*result)(const fs::path&);
        bool is_shared = true;
    };
    const Case cases[] = {
        {"design", design, of_run},
        {"run",
         "run '" RUGOSA_SOURCE "/experiments/paper/paper.ini' --pictures off --nodes 64 --set database.pairs=3 "
         "--set paper.sweep-points=0 --out o",
         of_run},
        {"compare", "compare --problems bbob5-1,zdt1,knapsack50,tsp14 --budget 200 --seeds 2 --out o", of_run},
        {"database build", "database build g.db --genomes 333 --batch 10 --nodes 64", of_database},
        {"optimise",
         "optimise --genes real:3:-5:5 --evaluate \"'" + fs::path(RUGOSA_PROGRAM).parent_path().string() +
             "/tests/evaluate' sphere\" --minimise --evaluations 200 --out o",
         of_run, false}};
    for (const Case& one : cases) DYNAMIC_SECTION(one.name) {
            json alone;
            for (const int ranks : {1, 2, 3}) {
                const Folder folder;
                const Ended ended =
                    on_ranks(ranks, one.words + " --verbose --threads " + (ranks == 2 ? "2" : "1"), folder.path());
                INFO(ranks << " ranks: " << ended.err);
                REQUIRE((ended.code == 0 || ended.code == 3));
                for (const std::string& count : found(ended.out, "rank [0-9]+: ([0-9]+) tasks"))
                    CHECK((count != "0") == one.is_shared);
                if (ranks == 1)
                    alone = one.result(folder.path());
                else
                    CHECK(one.result(folder.path()) == alone);
            }
        }
}

TEST_CASE("a stopped design resumes on any number of ranks to the same result", "[ranks]") {
    if (has_no_mpi()) return;
    const Folder whole;
    REQUIRE(on_ranks(1, longer, whole.path()).code == 3);
    for (const auto& [rank, signal, resumed_on] : {std::tuple("0", SIGTERM, 1), {"2", SIGKILL, 2}, {"0", SIGKILL, 1}}) {
        INFO("rank " << rank << ", signal " << signal);
        const Folder folder;
        const Ended ended = signalled(longer, folder.path(), rank, signal, "o/checkpoint.cbor");
        INFO(ended.err);
        if (signal == SIGTERM) {
            CHECK(ended.code == 130);
            CHECK(fs::exists(folder / "o/result.json"));
        } else {
            CHECK(ended.code != 0);
        }
        const Ended again = on_ranks(resumed_on, longer + " --resume", folder.path());
        INFO(again.err);
        REQUIRE(again.code == 3);
        CHECK(of_run(folder.path()) == of_run(whole.path()));
    }
}

TEST_CASE("a database whose build lost a rank continues on another number of ranks", "[ranks]") {
    if (has_no_mpi()) return;
    const Folder folder, whole;
    const std::string words = "database build g.db --genomes 2000 --batch 20 --threads 1";
    REQUIRE(on_ranks(1, words, whole.path()).code == 0);
    CHECK(signalled(words, folder.path(), "1", SIGKILL, "g.db").code != 0);
    REQUIRE(on_ranks(2, words, folder.path()).code == 0);
    CHECK(of_database(folder.path()) == of_database(whole.path()));
}

TEST_CASE("ranks that compute with other vectors are refused in one line", "[ranks]") {
    if (has_no_mpi() || !rough::vector_loops("avx2")) return;
    const Folder folder;
    const Ended ended = under_mpirun("2 sh -c '[ $OMPI_COMM_WORLD_RANK = 1 ] && export RUGOSA_VECTORS=avx2 || "
                                     "export RUGOSA_VECTORS=baseline; exec \"$0\" \"$@\"'",
                                     "operators", folder.path());
    CHECK(ended.code == 2);
    REQUIRE(program_lines(ended).size() == 1);
    CHECK_THAT(program_lines(ended)[0], Catch::Contains("rank 1: ") && Catch::Contains("avx2"));
}

TEST_CASE("only rank 0 prints and refuses", "[ranks]") {
    if (has_no_mpi()) return;
    const Folder folder;
    const Ended version = on_ranks(3, "--version", folder.path());
    CHECK(version.code == 0);
    CHECK(version.out == app::testing::rugosa("--version").out);
    const Ended wrong = on_ranks(2, "design --target none.csv", folder.path());
    CHECK(wrong.code == 2);
    CHECK(program_lines(wrong).size() == 1);
}

TEST_CASE("one of two ranks takes texts, then refuses them for numbers", "[.][a-rank]") {
    namespace cluster = app::cluster;
    if (cluster::join({{"echo", [](const json&) { return cluster::Work([](const json& task) { return task; }); }}}))
        return cluster::leave(0);
    cluster::Job job{"echo", {}, 1, 40, {}, {}};
    job.task = [](std::size_t i) -> std::optional<json> { return std::to_string(i); };
    std::vector<std::string> taken(job.count);
    job.take = [&](std::size_t i, const json& answer) { taken[i] = answer.get<std::string>(); };
    cluster::hand_out(job);
    for (std::size_t i = 0; i < job.count; ++i) CHECK(taken[i] == std::to_string(i));
    job.take = [](std::size_t, const json& answer) { static_cast<void>(answer.get<double>()); };
    CHECK_THROWS_WITH(cluster::hand_out(job), Catch::Contains("a message has another form"));
    cluster::leave(0);
}

TEST_CASE("two ranks together solve the curves whose price is reported", "[ranks]") {
    if (has_no_mpi()) return;
    const Folder folder;
    const std::string self = fs::read_symlink("/proc/self/exe").string();
    REQUIRE(std::system(("cd '" + folder.path().string() + "' && " + mpirun + "2 '" + self +
                         "' '[counted-rank]' >/dev/null 2>&1")
                            .c_str()) == 0);
    double solved = 0;
    int ranks = 0;
    for (const auto& file : fs::directory_iterator(folder.path()))
        if (file.path().filename().string().starts_with("solved-")) {
            const double one = std::stod(rough::read_whole(file.path()));
            CHECK(one > 0);
            solved += one;
            ++ranks;
        }
    CHECK(ranks == 2);
    CHECK(std::stod(rough::read_whole(folder / "reported")) == Approx(solved).epsilon(1e-9));
}

TEST_CASE("an answer of another form ends a job on several ranks with the reason", "[ranks]") {
    if (has_no_mpi()) return;
    const std::string self = fs::read_symlink("/proc/self/exe").string();
    CHECK(std::system((mpirun + "2 '" + self + "' '[a-rank]' >/dev/null 2>&1").c_str()) == 0);
}
