#include "tests/apps/results.hpp"

#include <boost/algorithm/string.hpp>

#include <set>

using namespace app::testing;
using nlohmann::json;

namespace {

/// A folder with a child that evaluates by the function its word names: `./child sphere`.
class Desk : public Folder {
  public:
    Desk() {
        std::filesystem::create_symlink(std::filesystem::path(RUGOSA_PROGRAM).parent_path() / "tests/evaluate",
                                        path() / "child");
    }
    Ended optimise(const std::string& words) const { return rugosa("optimise " + words, path()); }
    json result(const std::string& folder) const { return result_in(path() / folder); }
    /// The result of a run that succeeds.
    json found(const std::string& words, const std::string& folder = "out") const {
        succeeded(optimise(words + " --out " + folder));
        return result(folder);
    }
};

} // namespace

TEST_CASE("optimise minimises a program over real vectors") {
    const Desk desk;
    const Ended ended = succeeded(
        desk.optimise("--genes real:5:-5:5 --evaluate './child sphere' --minimise --evaluations 4000 --out out"));
    const json result = desk.result("out");
    CHECK_THAT(ended.out, Catch::StartsWith("out: best ") &&
                              Catch::Contains(" after " + result["evaluations"].dump() + " evaluations ("));
    CHECK(result["best"]["objectives"][0] < 0.01);
    CHECK(result["minimise"] == json::array({1}));
    CHECK(result["evaluations"] <= 4000);
    CHECK_FALSE(result.contains("front"));
    double sum = 0;
    for (const double gene : result["best"]["genes"]) sum += gene * gene;
    CHECK(result["best"]["objectives"][0].get<double>() == Approx(sum));
}

TEST_CASE("real vectors have the variants bipop-cma-es, ipop-cma-es and lshade") {
    const Desk desk;
    for (const std::string variant : {"bipop-cma-es", "ipop-cma-es", "lshade"}) {
        const json result = desk.found("--genes real:5:-5:5 --evaluate './child sphere' --minimise --evaluations 2500 "
                                       "--variant " +
                                           variant,
                                       variant);
        CHECK(result["best"]["objectives"][0] < (variant == "lshade" ? 1e-3 : 1e-10));
        CHECK(result["evaluations"] <= 2500);
    }
}

TEST_CASE("optimise maximises over bits, and finds a permutation by a pipeline") {
    const Desk desk;
    const json best = desk.found("--genes bits:40 --evaluate './child ones' --evaluations 4000")["best"];
    CHECK(best["objectives"][0] == 40);
    CHECK(best["genes"] == json(std::vector<int>(40, 1)));
    const json order =
        desk.found("--genes permutation:8 --evaluate './child order' --pipeline 'sample 60 | score | until "
                   "fitness 7 generations 100 { tournament 3 | cross order | mutate 0.1 reverse | score | "
                   "elite 2 } | best 1'",
                   "order");
    CHECK(order["best"]["genes"] == json({0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST_CASE("genomes of whole numbers, reals and words are evaluated once if rounded alike") {
    const Desk desk;
    const json best = desk.found("--genes int:1:0:12,real:1:-5:5,choice:1:a:b:c --evaluate './child mixed' "
                                 "--evaluations 3000")["best"];
    CHECK(best["genes"][0] == 7);
    CHECK(best["genes"][1].get<double>() == Approx(0.5).margin(0.05));
    CHECK(best["genes"][2] == "b");
    const json few = desk.found("--genes int:2:0:3 --evaluate './child ones' --evaluations 2000", "few");
    CHECK(few["best"]["objectives"][0] == 6);
    CHECK(few["evaluations"] <= 17); // 16 genomes, and the one that tells the objectives
}

TEST_CASE("fixed, stepped and logarithmic genes keep their values and bounds") {
    const Desk desk;
    desk.write("counted.sh", "tee sent | ./child sphere\n");
    desk.found("--genes real:1:2:2,real:1:0:1:0.25,real:1:1e-4:100:log,int:1:3:3 --evaluate 'sh counted.sh' "
               "--threads 1 --minimise --evaluations 300");
    std::istringstream sent(rough::read_whole(desk / "sent"));
    int small = 0;
    for (std::string line; std::getline(sent, line);) {
        const json genes = json::parse(line)["genes"];
        CHECK((genes[0] == 2 && genes[3] == 3));
        CHECK(std::fmod(genes[1].get<double>(), 0.25) == 0);
        CHECK((genes[2] >= 1e-4 && genes[2] <= 100));
        small += genes[2] < 0.1 ? 1 : 0; // half of the range in logarithms
    }
    CHECK(small > 100);
    for (const std::string genes : {"real:1:0:1:log", "real:1:0:1:0.3", "real:1:0:1:-1", "int:1:0:9:3"})
        CHECK(desk.optimise("--genes " + genes + " --evaluate './child sphere'").code == 2);
}

TEST_CASE("a search begins with the genomes of --start, and names a wrong row") {
    const Desk desk;
    desk.write("start.csv", "# best first\n[0.001, 7, \"b\"]\n-3,0,c\n");
    const std::string words = "--genes real:1:-5:5,int:1:0:9,choice:1:b:c --evaluate './child sphere' --minimise ";
    const json one = desk.found(words + "--start start.csv --evaluations 2 --pipeline 'score | best 1'");
    CHECK(one["best"]["genes"] == json({-3, 0, "c"}));
    const json whole = desk.found(words + "--start start.csv --evaluations 300", "whole");
    desk.found(words + "--start start.csv --evaluations 150", "cut");
    CHECK(timeless(desk.found(words + "--start start.csv --evaluations 300 --resume", "cut")) == timeless(whole));
    for (const auto& [row, message] : {std::pair{"1,2", "start.csv, line 1: 2 genes; give 3\n"},
                                       {"1,2.5,b", "line 1, gene 2: 2.5 is out of range (whole, 0 to 9)\n"},
                                       {"6,2,b", "line 1, gene 1: 6 is out of range (-5 to 5)\n"},
                                       {"1,2,d", "line 1, gene 3: \"d\" is unknown; give b, c\n"}}) {
        desk.write("start.csv", row);
        const Ended ended = desk.optimise(words + "--start start.csv");
        CHECK(ended.code == 2);
        CHECK(ended.err.ends_with(message));
    }
}

TEST_CASE("several objectives give a front and the best by the first") {
    const Desk desk;
    const json result = desk.found("--genes real:1:-10:10 --evaluate './child schaffer' --minimise 1,2 "
                                   "--evaluations 3000");
    CHECK(result["variant"] == "nsga2");
    CHECK(result["best"] == result["front"][0]);
    CHECK(result["front"].size() > 50);
    for (std::size_t i = 0; i < result["front"].size(); ++i) {
        const double x = result["front"][i]["genes"][0];
        CHECK((x > -0.01 && x < 2.01));
        if (i > 0) // sorted by the first objective
            CHECK(result["front"][i]["objectives"][1] < result["front"][i - 1]["objectives"][1]);
    }
}

TEST_CASE("genomes that break constraints rank after those that hold them") {
    const Desk desk;
    const json best = desk.found("--genes real:1:0:1 --evaluate './child held' --evaluations 1000")["best"];
    CHECK(best["objectives"][0] <= 0.25);
    CHECK(best["objectives"][0] > 0.249);
    CHECK(best["violation"] <= 0);
}

TEST_CASE("the result depends on the seed but not on the number of children") {
    const Desk desk;
    const std::string words = "--genes real:3:-5:5 --evaluate './child sphere' --minimise --evaluations 600 ";
    const json one = desk.found(words + "--threads 1", "1");
    CHECK(timeless(one) == timeless(desk.found(words + "--threads 2", "2")));
    CHECK(timeless(one) == timeless(desk.found(words + "--threads 3", "3")));
    CHECK(one["best"] != desk.found(words + "--threads 1 --seed 2", "other")["best"]);
}

TEST_CASE("a run out of evaluations resumes to the result of an uninterrupted one") {
    const Desk desk;
    const std::string words = "--genes bits:60 --evaluate './child ones' ";
    const json whole = desk.found(words + "--evaluations 900", "whole");
    desk.found(words + "--evaluations 350", "cut");
    CHECK(desk.optimise(words + "--evaluations 900 --out cut").code == 2);
    CHECK(timeless(desk.found(words + "--evaluations 900 --resume", "cut")) == timeless(whole));
}

TEST_CASE("a history has every evaluation once, on any number of children and after a resume") {
    const Desk desk;
    const std::string words = "--genes real:1:-5:5,int:1:0:900,choice:1:b:c --evaluate './child sphere' --minimise ";
    const json result = desk.found(words + "--evaluations 900 --threads 1 --history 1.csv", "1");
    const std::string text = rough::read_whole(desk / "1.csv");
    CHECK_THAT(text, Catch::StartsWith("id,generation,level,x1,x2,x3,f1,violation,failure\n1,,,"));
    std::set<std::string> genes;
    double best = HUGE_VAL;
    int last = 0, generation = 0;
    std::istringstream lines(text.substr(text.find('\n') + 1));
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> cells;
        boost::split(cells, line, boost::is_any_of(","));
        REQUIRE(cells.size() == 9);
        CHECK(std::stoi(cells[0]) == ++last);
        if (!cells[1].empty()) {
            CHECK((std::stoi(cells[1]) == generation || std::stoi(cells[1]) == generation + 1));
            generation = std::stoi(cells[1]);
        }
        CHECK(genes.insert(cells[3] + "," + cells[4] + "," + cells[5]).second);
        best = std::min(best, std::stod(cells[6]));
        CHECK((cells[7] == "0" && cells[8].empty()));
    }
    CHECK(last == result["evaluations"]);
    CHECK(generation > 5);
    CHECK(best == result["best"]["objectives"][0]);
    desk.found(words + "--evaluations 900 --threads 3 --history 3.csv", "3");
    CHECK(rough::read_whole(desk / "3.csv") == text);
    desk.found(words + "--evaluations 300 --history cut.csv", "cut");
    const std::string cut = rough::read_whole(desk / "cut.csv");
    desk.write("cut.csv", cut + "301,9,,1,2,b,3,0,\n"); // by a process that was killed before its checkpoint
    desk.found(words + "--evaluations 900 --resume --history cut.csv", "cut");
    CHECK(rough::read_whole(desk / "cut.csv") == text);

    desk.write("other.csv", "mine\n");
    CHECK(desk.optimise(words + "--history other.csv").code == 2);
    desk.found(words + "--evaluations 300 --history again.csv", "again");
    desk.write("again.csv", "mine\n");
    CHECK(desk.optimise(words + "--evaluations 900 --resume --history again.csv --out again").code == 2);
    CHECK(rough::read_whole(desk / "again.csv") == "mine\n");
    std::filesystem::remove(desk / "again.csv");
    CHECK(desk.optimise(words + "--evaluations 900 --resume --history again.csv --out again").code == 2);
    CHECK(!std::filesystem::exists(desk / "again.csv"));
}

TEST_CASE("a failed evaluation of any kind is a failure of its genome, and the run continues") {
    const Desk desk;
    for (const std::string fault :
         {"echo '{\"id\":'$n',\"failed\":\"mesh failed\"}'", "echo '{\"id\":'$n',\"objectives\":[NaN]}'",
          "echo '{\"id\":'$n',\"objectives\":[null]}'", "exit 7", "kill -SEGV $$", "sleep 600"}) {
        CAPTURE(fault);
        desk.write("fails.sh", "while read -r line; do n=${line#*:}; n=${n%%,*}; case $line in *'[1,'*) " + fault +
                                   ";; *) echo '{\"id\":'$n',\"objectives\":[2]}';; esac; done\n");
        const json result = desk.found("--genes bits:4 --evaluate 'sh fails.sh' --timeout 0.3 --force "
                                       "--threads 2 --pipeline 'sample 9 | score | repeat 4 { mutate 0.1 | score }'");
        CHECK(result["best"]["genes"][0] == 0);
        CHECK(result["failures"] > 0);
        CHECK(result["stopped"] == "");
        CHECK_THAT(result["notes"].back().get<std::string>(), Catch::Contains(" evaluations failed; the first: "));
    }
}

TEST_CASE("failures before the first success are counted, and reach a child once") {
    const Desk desk;
    desk.write("late.sh", "while read -r line; do echo >>sent; n=${line#*:}; n=${n%%,*}; if [ $n -le 5 ]; then "
                          "echo '{\"id\":'$n',\"failed\":\"not yet\"}'; else echo "
                          "'{\"id\":'$n',\"objectives\":['$n']}'; fi; done\n");
    for (const std::string pipeline : {"sample 3 | score | repeat 4 { mutate 1 | score }", "sample 20 | score"}) {
        std::filesystem::remove(desk / "sent");
        const json result = desk.found("--genes real:2:-5:5 --evaluate 'sh late.sh' --force --threads 1 "
                                       "--history all.csv --pipeline '" +
                                       pipeline + "'");
        CHECK(rough::read_whole(desk / "sent").size() == result["evaluations"]);
        const std::string history = rough::read_whole(desk / "all.csv");
        CHECK(std::ranges::count(history, '\n') == result["evaluations"].get<long>() + 1);
        CHECK(boost::ifind_nth(history, ",,,not yet\n", 4));
        CHECK(result["best"]["objectives"][0] >= 6);
    }
}

TEST_CASE("a run of failures ends at --max-failures, and keeps the best") {
    const Desk desk;
    desk.write("rare.sh", "while read -r line; do n=${line#*:}; n=${n%%,*}; case $n in *0) echo "
                          "'{\"id\":'$n',\"objectives\":['$n']}';; *) echo '{\"id\":'$n',\"failed\":\"no "
                          "mesh\"}';; esac; done\n");
    const std::string words = "--genes real:2:-5:5 --evaluate 'sh rare.sh' --threads 1 --evaluations 400 "
                              "--force --max-failures ";
    const json ended = desk.found(words + "0.5");
    CHECK_THAT(ended["stopped"].get<std::string>(), Catch::Contains("evaluations failed; the first: no mesh"));
    CHECK(ended["best"]["objectives"][0] >= 10);
    CHECK(ended["evaluations"] < 400);
    CHECK(desk.found(words + "0.95")["stopped"] == "evaluation budget spent");
    desk.write("rare.sh", "while read -r line; do n=${line#*:}; echo '{\"id\":'${n%%,*}',\"failed\":\"no\"}'; done\n");
    check_refused(desk.optimise(words + "0.9 --out none"), "every one of 200 evaluations failed; the first: no");
}

TEST_CASE("a child that dies is started again, and a hundred deaths in a row end the run") {
    const Desk desk;
    const json result = desk.found("--genes bits:20 --evaluate './child dies' --threads 2 --evaluations 400");
    CHECK(result["failures"] > 5); // each child answers 30 times
    CHECK(result["failures"] < 40);
    desk.write("ill.sh", "read line; echo 'out of ink' >&2; exit 7\n");
    const Ended ended = desk.optimise("--genes bits:20 --evaluate 'sh ill.sh' --threads 1 --out ill");
    check_refused(ended, "out of ink");
    CHECK_THAT(ended.err, Catch::Contains("sh ill.sh") && Catch::Contains("was sent {\"id\":100,") &&
                              Catch::Contains("ended with exit code 7, the last of 100 such ends in a row"));
}

TEST_CASE("a wrong answer of a child is quoted with the request") {
    struct Nonsense {
        const char* answer;
        const char* fault;
    };
    for (const auto& [answer, fault] : {Nonsense{"hello", "not JSON"},
                                        {"{\"id\":2,\"objectives\":[1]}", "another id"},
                                        {"{\"id\":1,\"objectives\":[]}", "0 objectives"},
                                        {"{\"id\":1,\"objectives\":[1e999]}", "not JSON"},
                                        {"{\"id\":1,\"objectives\":2}", "not numbers"},
                                        {"[1]", "no object with id and objectives"}}) {
        const Desk desk;
        desk.write("says.sh", std::string("read line; echo '") + answer + "'; read line\n");
        const Ended ended = desk.optimise("--genes bits:2 --evaluate 'sh says.sh' --out out");
        check_refused(ended, std::string("(") + fault + ")");
        CHECK_THAT(ended.err, Catch::Contains("{\"id\":1,\"genes\":[") && Catch::Contains(answer));
        CHECK_FALSE(std::filesystem::exists(desk / "out"));
    }
    const Desk desk;
    desk.write("less.sh", "read a; echo '{\"id\":1,\"objectives\":[1,2]}'; read a; echo '{\"id\":2,\"objectives\":"
                          "[1]}'; read a\n");
    CHECK_THAT(desk.optimise("--genes bits:2 --evaluate 'sh less.sh' --threads 1 --out out").err,
               Catch::Contains("(1 objectives)") && Catch::Contains("[2 finite numbers]"));
}

TEST_CASE("an interrupted run ends its children and writes the best so far") {
    const Desk desk;
    desk.write("slow.sh", "n=0; while read line; do n=$((n+1)); [ $n -gt 3 ] && { echo >begun; sleep 600; }; echo "
                          "\"{\\\"id\\\":$n,\\\"objectives\\\":[$n]}\"; done\n");
    const std::string words = "optimise --genes bits:9 --evaluate 'sh slow.sh' --threads 1 --out out";
    CHECK(rugosa_stopped(0, "begun", words, desk.path()).code == 130);
    CHECK(desk.result("out")["best"]["objectives"][0] == 3);
}

TEST_CASE("children of a killed run end, and so do the processes that they started") {
    const Desk desk;
    desk.write("forks.sh", "sleep 1000 & echo $$ $! >begun; read line; sleep 1000\n");
    const Ended ended =
        disturbed("optimise --genes bits:9 --evaluate 'sh forks.sh' --out out", desk.path(), "[ -s begun ]",
                  "kill -KILL $child; for process in $(cat begun); do\n"
                  "while grep -qs 'State:.[^Z]' /proc/$process/status; do sleep 0.02; done; done");
    CHECK(ended.code == killed);
}

TEST_CASE("the log of a chatty child stays small, and its end is quoted") {
    const Desk desk;
    desk.write("chats.sh", "read line; yes 'far too much to say' | head -c 200000 >&2; echo at last >&2; exit 3\n");
    const Ended ended = desk.optimise("--genes bits:9 --evaluate 'sh chats.sh' --threads 1 --out out");
    check_refused(ended, "at last");
    CHECK(std::filesystem::file_size(desk / "out/evaluate.log") <= 10'000'000);
}
