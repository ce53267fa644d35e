#include "apps/prompt/formula.hpp"
#include "domain/errors.hpp"
#include "domain/target/target.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace app::testing;

TEST_CASE("formulas follow the rules of arithmetic") {
    const auto value = [](const std::string& text, double p) { return app::formula(text, "p", "here")(p); };
    CHECK(value("1 + 2 * 3 ^ 2", 0) == 19);
    CHECK(value("-2 ^ 2", 0) == -4);
    CHECK(value("2 ^ 3 ^ 2", 0) == 512);
    CHECK(value("8 / 4 / 2 - 1 - 1", 0) == -1);
    CHECK(value("max(p, 2) * sqrt(x) + 1e-1", 9) == Approx(27.1));
    CHECK(value("tanh(log(exp(p))) - cos(pi)", 0.5) == Approx(std::tanh(0.5) + 1));
    for (const char* bad : {"", "1 +", "q", "sqrt p", "(1", "1 2", "min(1)"})
        CHECK_THROWS_AS(value(bad, 1), rough::InputError);
}

TEST_CASE("a formula as deep as may be is read, a long one too, a deeper or longer one is refused") {
    const auto value = [](const std::string& text) { return app::formula(text, "p", "here")(1); };
    CHECK(value(std::string(99, '(') + "p" + std::string(99, ')')) == 1);
    CHECK(value(std::string(98, '-') + "p") == 1);
    std::string sum = "p";
    while (sum.size() < 9998)
        sum += "+p";
    CHECK(value(sum) == 5000);
    for (const std::string& bad :
         {std::string(100000, '-') + "p", std::string(101, '(') + "p" + std::string(101, ')'), sum + "+p+p"})
        CHECK_THROWS_AS(value(bad), rough::InputError);
}

TEST_CASE("a target made of a formula, a genome or a scan is read back with its model") {
    const Folder folder;
    REQUIRE(
        rugosa(
            "target --formula '0.3 + 0.8 * sqrt(p / 1.6e-4)' --to 1.6e-4 --points 10 --band 0.02 --out f.csv",
            folder.path())
            .code == 0);
    const rough::Target made = rough::read_target(folder / "f.csv");
    CHECK(made.points() == 10);
    CHECK(made.y[9] == Approx(1.1));
    CHECK(made.upper[9] == Approx(1.122));
    CHECK(made.lower[9] == Approx(1.078));
    CHECK(made.recorded.at("kernel") == "free");

    folder.write("g.json", R"({"series":[{"A":1e-3,"H":1,"gamma":1.6,"lambda":0.84942,"chromosomes":[)"
                           R"({"n":1,"phases":[0.3]},{"n":2,"phases":[1]},{"n":3,"phases":[4]}]}]})");
    for (const char* quantity : {"stiffness", "area", "area-displacement", "load", "interface_stiffness"}) {
        const Ended ended = rugosa(std::string("target --genome g.json --kernel periodic --quantity ") +
                                       quantity + " --out " + quantity + ".csv",
                                   folder.path());
        INFO(ended.err);
        REQUIRE(ended.code == 0); // what a profile answers is in reach
        CHECK(rough::read_target(folder / (std::string(quantity) + ".csv")).recorded.at("kernel") ==
              "periodic");
    }
    std::string scan = "x [um]\tz [nm]\n";
    for (int i = 0; i < 100; ++i)
        scan += std::to_string(i) + "\t" + std::to_string(100 * std::sin(0.3 * i) + 30 * std::cos(1.1 * i)) +
                "\n";
    folder.write("scan.txt", scan);
    CHECK(rugosa("target --like scan.txt --out s.csv", folder.path()).code == 0);
    CHECK(rough::read_target(folder / "s.csv").points() == 20);
}

TEST_CASE("a target of interface stiffness serves other datums and lengths, and says so") {
    const Folder folder;
    folder.write("g.json", R"({"series":[{"A":1e-3,"H":1,"gamma":1.6,"lambda":0.84942,"chromosomes":[)"
                           R"({"n":1,"phases":[0.3]},{"n":2,"phases":[1]},{"n":3,"phases":[4]}]}]})");
    REQUIRE(rugosa("target --genome g.json --quantity interface_stiffness --out i.csv", folder.path()).code ==
            0);
    const Ended same = rugosa("target --check i.csv", folder.path());
    CHECK(same.code == 0);
    CHECK(same.out.find("recorded with") == std::string::npos);
    const Ended other = rugosa("target --check i.csv --datum 3", folder.path());
    CHECK(other.code == 0);
    CHECK_THAT(other.out, Catch::Contains("i.csv: recorded with datum_mm") && Catch::Contains("(here 3)"));
    CHECK(rugosa("target --check i.csv --length 2", folder.path()).code == 0);
    CHECK(rugosa("target --check i.csv --kernel strip", folder.path()).code == 2);
    folder.write("c.csv", "# datum_mm: 9\npressure_MPa,conductance\n1e-5,1\n1e-4,2\n");
    const Ended conductance = rugosa("target --check c.csv --resistivity 2", folder.path());
    CHECK(conductance.code == 0);
    CHECK_THAT(conductance.out, Catch::Contains("2 points of interface_stiffness_MPa_per_mm from 1"));
}

TEST_CASE("a target is checked against its own model, and called out of reach where it is") {
    const Folder folder;
    REQUIRE(rugosa("target --formula '0.9 - 0.3 * p / 1e-4' --to 1e-4 --out falls.csv", folder.path()).code ==
            3);
    const Ended falls = rugosa("target --check falls.csv", folder.path());
    CHECK(falls.code == 3);
    CHECK(falls.out.find("falls from") != std::string::npos);
    check_refused(rugosa("target --check falls.csv --kernel strip", folder.path()), "kernel");
    CHECK(rugosa("target --check '" RUGOSA_TEST_DATA "/target_paper.csv'").code == 0);
    folder.write("soft.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-6,0.01\n1e-5,0.02\n");
    const Ended soft = rugosa("target --check soft.csv", folder.path());
    CHECK(soft.code == 3);
    CHECK_THAT(soft.out, Catch::Contains("on this grid") && Catch::Contains("single node"));
    for (const char* words : {"target", "target --formula p --out a.csv", "target --formula p --to 1",
                              "target --formula 'p +' --to 1 --out a.csv", "target --check nowhere.csv",
                              "target --formula '-p' --to 1 --out a.csv"}) {
        const Ended ended = rugosa(words, folder.path());
        INFO(words << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK(ended.error_lines() == 1);
    }
}
