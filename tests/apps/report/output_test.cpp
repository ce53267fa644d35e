#include "apps/report/output.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;

namespace fs = std::filesystem;

namespace {

const std::string quick_design = "design --target target.csv --nodes 128 --pipeline 'sample 2 | score | best 1' --out ";

/// A folder with a genome, a target and a scan.
struct Desk : Folder {
    Desk() {
        write("genome.json", genome_text(1, 0.8, 1.5, {{1, {0.3}}, {3, {1}}}));
        write("target.csv", rough::read_whole(RUGOSA_SOURCE "/experiments/targets/drawn.csv"));
        write("scan.txt", "x [um];z [um]\n0;1\n1;3\n2;0.5\n3;2\n4;1\n5;3\n6;0\n7;2\n8;1\n9;2\n10;0\n11;1\n");
    }
};

} // namespace

TEST_CASE("a command overwrites no existing file in its folder") {
    const std::string experiment = RUGOSA_SOURCE "/experiments/";
    const Desk desk;
    for (const std::string& words : {std::string("profile genome.json --nodes 64 --out "), quick_design,
                                     "run '" + experiment +
                                         "paper/paper.ini' --pictures off --nodes 64 --set database.pairs=6 --set "
                                         "paper.sweep-points=0 --out ",
                                     std::string("stability --scene spike --out ")}) {
        answered(rugosa(words + "first", desk.path()));
        for (const auto& entry : fs::directory_iterator(desk / "first")) {
            const std::string name = entry.path().filename().string();
            const Desk theirs;
            fs::create_directory(theirs / "o");
            if (entry.is_directory())
                fs::create_directory(theirs / "o" / name);
            else
                theirs.write("o/" + name, "theirs");
            check_refused(rugosa(words + "o", theirs.path()), name);
            if (!entry.is_directory()) CHECK(rough::read_whole(theirs / "o" / name) == "theirs");
            CHECK(std::distance(fs::directory_iterator(theirs / "o"), fs::directory_iterator{}) == 1);
        }
        fs::remove_all(desk / "first");
    }
}

TEST_CASE("a file that a command reads is never overwritten, even with --force") {
    const Desk desk;
    fs::create_directory(desk / "o");
    desk.write("o/answer.csv", rough::read_whole(desk / "target.csv"));
    desk.write("o/heights.csv", rough::read_whole(desk / "scan.txt"));
    fs::create_symlink("genome.json", desk / "linked.json");
    for (const auto& [words, input] : {std::pair("contact --genome genome.json --out genome.csv", "genome.json"),
                                       {"contact --genome genome.json --out genome.json", "genome.json"},
                                       {"contact --genome genome.json --out linked.csv", "genome.json"},
                                       {"contact --profile scan.txt --out scan.txt", "scan.txt"},
                                       {"target --genome genome.json --out genome.json", "genome.json"},
                                       {"design --target o/answer.csv --out o", "o/answer.csv"},
                                       {"design --target target.csv,o/answer.csv --out o", "o/answer.csv"},
                                       {"profile --profile o/heights.csv --out o", "o/heights.csv"}}) {
        const std::string before = rough::read_whole(desk / input);
        check_refused(rugosa(std::string(words) + " --force", desk.path()), "is read here");
        CHECK(rough::read_whole(desk / input) == before);
    }
}

TEST_CASE("a finished run is not run again by --resume, whatever the settings") {
    const Desk desk;
    CHECK(rugosa(quick_design + "o --reach-similarity 0.1", desk.path()).code == 0);
    const std::string before = rough::read_whole(desk / "o/result.json");
    const Ended again = rugosa(quick_design + "o --seed 5 --resume", desk.path());
    CHECK(again.code == 0);
    CHECK_THAT(again.out, Catch::Contains("finished") && Catch::Contains("found: lowest similarity"));
    CHECK(rough::read_whole(desk / "o/result.json") == before);
    CHECK(rugosa(quick_design + "o --seed 5 --force", desk.path()).code != 2);
    CHECK(app::testing::result_in(desk / "o")["seed"] == 5);
}

TEST_CASE("a run is resumed only with the contents of files that it began with") {
    const Desk desk;
    const auto change = [&](const char* file) { desk.write(file, rough::read_whole(desk / file) + "\n"); };
    rugosa(quick_design + "o", desk.path());
    change("target.csv");
    check_refused(rugosa(quick_design + "o --resume", desk.path()), "other input files");
    desk.write("ones.sh",
               "n=0; while read line; do n=$((n+1)); echo \"{\\\"id\\\":$n,\\\"objectives\\\":[1]}\"; done\n");
    const std::string optimise = "optimise --genes bits:9 --evaluate 'sh ones.sh' --threads 1 --out p --evaluations ";
    succeeded(rugosa(optimise + "50", desk.path()));
    change("ones.sh");
    check_refused(rugosa(optimise + "90 --resume", desk.path()), "another run");
}

TEST_CASE("an interrupted run is not restarted without --force") {
    const Desk desk;
    fs::create_directory(desk / "o");
    desk.write("o/checkpoint.cbor", "half done");
    check_refused(rugosa(quick_design + "o", desk.path()), "--resume");
    CHECK(rough::read_whole(desk / "o/checkpoint.cbor") == "half done");
}

TEST_CASE("a curve is written through a symbolic link, and to a device without CURVE.json") {
    const Desk desk;
    fs::create_directory(desk / "far");
    fs::create_symlink("far/curve.csv", desk / "curve.csv");
    CHECK(rugosa("contact --genome genome.json --nodes 64 --steps 2 --out curve.csv", desk.path()).code == 0);
    CHECK(fs::is_symlink(desk / "curve.csv"));
    CHECK_THAT(rough::read_whole(desk / "far/curve.csv"), Catch::StartsWith("displacement_mm,"));
    fs::create_symlink("/dev/null", desk / "nowhere");
    CHECK(rugosa("contact --genome genome.json --nodes 64 --steps 2 --out nowhere", desk.path()).code == 0);
    CHECK(fs::is_character_file(desk / "nowhere"));
    CHECK_FALSE(fs::exists(desk / "nowhere.json"));
}

TEST_CASE("a run does not follow a symbolic link out of its folder, and --force removes it") {
    const Desk desk;
    fs::create_directory(desk / "o");
    desk.write("mine.txt", "mine");
    fs::create_symlink("../mine.txt", desk / "o/.writable");
    fs::create_symlink("../new.csv", desk / "o/heights.csv");
    fs::create_symlink("../mine.txt", desk / "o/profile.json");
    const std::string words = "profile genome.json --nodes 64 --pictures off --out o";
    check_refused(rugosa(words, desk.path()), "is a symbolic link");
    CHECK(rugosa(words + " --force", desk.path()).code == 0);
    CHECK(rough::read_whole(desk / "mine.txt") == "mine");
    CHECK_FALSE(fs::exists(desk / "new.csv"));
    CHECK(fs::is_regular_file(fs::symlink_status(desk / "o/heights.csv")));
    CHECK(fs::is_symlink(desk / "o/.writable")); // not a result: kept
}

TEST_CASE("a folder in use by one run is refused to another") {
    const Desk desk;
    const app::OutputFolder one((desk / "o").string(), "", {});
    CHECK_THROWS_WITH(app::OutputFolder((desk / "o").string(), "", {}), Catch::Contains("in use"));
    check_refused(rugosa(quick_design + "o --force", desk.path()), "in use");
}

TEST_CASE("a failed write to standard output ends with exit code 2") {
    const Desk desk;
    for (const char* words : {"operators", "--help", "contact --help", "target --check target.csv"}) {
        check_refused(rugosa(words, desk.path(), R"(sh -c '"$0" "$@" >/dev/full')"), "standard output");
    }
    // A closed pipe does not stop the run.
    rugosa(quick_design + "o", desk.path(), R"(sh -c '"$0" "$@" | true')");
    CHECK(fs::exists(desk / "o/report.html"));
}
