#include "ga/checkpoint/checkpoint.hpp"
#include "tests/apps/results.hpp"

#include <iostream>

using namespace app::testing;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

/// A command that is killed and resumed until it is done.
struct Work {
    std::string name, first, again;              ///< command lines: of the first run, and of all further ones
    std::function<json(const fs::path&)> result; ///< the result in a folder, without times
};

/// Runs the program in a folder and kills it after `seconds`, if they are finite.
Ended run_for(double seconds, const std::string& words, const fs::path& where) {
    const std::string limit = std::isfinite(seconds) ? "timeout -s KILL " + std::to_string(seconds + 1e-6) : "";
    return rugosa(words, where, "RUGOSA_CHECKPOINTS=0 " + limit);
}

/// Whether a result is complete, or does not exist.
bool whole_or_none(const fs::path& result) { return !fs::exists(result) || json::accept(rough::read_whole(result)); }

std::vector<Work> all_work() {
    const std::string design =
        "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 64 --pictures off --seconds 600 "
        "--pipeline 'shape 8 | score | best 4 | refine lm 4 | repeat 12 { tournament 2 | cross uniform | "
        "mutate 0.1 | score | refine lm 4 | elite 1 } | best 2 | score verified' --out o";
    const std::string run =
        "run '" RUGOSA_SOURCE "/experiments/paper/paper.ini' --pictures off --nodes 32 --set database.pairs=20 "
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
            {"optimise", optimise, optimise + " --resume", of_run},
            {"database", database, database, of_database}};
}

/// Kills the work at random moments and resumes it, time and again. Returns the number of finished results.
long kill_and_resume(const Work& work, long kills) {
    const Folder unbroken;
    const Ended whole = run_for(HUGE_VAL, work.first, unbroken.path());
    INFO(work.name << ": " << whole.err);
    REQUIRE((whole.code == 0 || whole.code == 3));
    const json expected = work.result(unbroken.path());
    ga::Stream random(7);
    long results = 0;
    while (kills > 0) {
        const Folder folder;
        Ended ended = run_for(whole.seconds * random.uniform(), work.first, folder.path());
        while (ended.code == killed) {
            --kills;
            REQUIRE(whole_or_none(folder / "o/result.json"));
            ended = run_for(whole.seconds * (0.05 + random.uniform()), work.again, folder.path());
        }
        INFO(ended.out << ended.err);
        REQUIRE(ended.code == whole.code); // also if it was killed between its last file and its end
        REQUIRE(work.result(folder.path()) == expected);
        ++results;
    }
    return results;
}

} // namespace

TEST_CASE("design, run, optimise and database build resume to the same result after being killed", "[kills]") {
    for (const Work& work : all_work()) kill_and_resume(work, 3);
}

TEST_CASE("a design that is interrupted in its checks resumes to the same result") {
    const std::string grid = GENERATE("96", "16x16 --length 0.84942 --max-pressure 1.6e-4");
    const std::string words = "design --target '" RUGOSA_SOURCE
                              "/experiments/targets/drawn.csv' --threads 1 --draws 400 --out o --pipeline "
                              "'shape 4 | score | best 2 | refine lm 4 | best 1 | score verified' --nodes " +
                              grid + " ";
    const Folder undisturbed;
    const Ended whole = answered(rugosa(words, undisturbed.path()));
    enum Moment { in_tolerance, after_tolerance, before_damage };
    for (const Moment moment : {in_tolerance, after_tolerance, before_damage}) {
        INFO(moment);
        const Folder folder;
        const auto kept = folder / "o/tolerance.cbor";
        const std::string sign = moment == in_tolerance ? "o/result.json" : "o/tolerance.cbor";
        const std::string stop = moment == in_tolerance ? "kill -HUP $child" : "kill -TERM $child";
        int code = 0;
        for (int attempt = 0; attempt < 20 && code != 130; ++attempt) { // the checks may end before the signal
            fs::remove_all(folder / "o");
            code = disturbed(words + "--force ", folder.path(), "[ -s " + sign + " ]", stop).code;
        }
        REQUIRE(code == 130);
        CHECK(result_in(folder / "o")["interrupted"] == true);
        CHECK(fs::exists(folder / "o/report.html"));
        if (moment == before_damage) folder.write("o/tolerance.cbor", "damaged");
        if (moment == after_tolerance) { // one draw less shows that it is read
            json content = ga::read_cbor(ga::opened(kept), kept);
            content["tolerance"]["draws"] = content["tolerance"]["draws"].get<int>() - 1;
            const auto bytes = json::to_cbor(content);
            ga::seal(kept, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        }
        CHECK(rugosa(words + "--resume", folder.path()).code == whole.code);
        json expected = of_run(undisturbed.path());
        json& draws = expected["variants"]["pipeline"]["tolerance"]["draws"];
        draws = draws.get<int>() - (moment == after_tolerance);
        CHECK(of_run(folder.path()) == expected);
        CHECK(fs::exists(folder / "o/report.html"));
        CHECK(rough::read_whole(folder / "o/tolerance.csv") == rough::read_whole(undisturbed / "o/tolerance.csv"));
        for (const char* const file : {"o/checkpoint.cbor", "o/tolerance.cbor"}) CHECK_FALSE(fs::exists(folder / file));
    }
}

TEST_CASE("results stay the same after a thousand kills", "[long][kills]") {
    const char* const given = std::getenv("RUGOSA_KILLS");
    const long each = (given ? std::atol(given) : 1000) / 4;
    for (const Work& work : all_work())
        std::cout << work.name << ": " << each << " kills, " << kill_and_resume(work, each)
                  << " results as the uninterrupted one\n";
}
