#include "apps/prompt/targets.hpp"
#include "tests/apps/results.hpp"

using namespace app::testing;

TEST_CASE("formulas follow the rules of arithmetic") {
    const auto value = [](const std::string& text, double p) { return app::formula(text, "p", "here")(p); };
    CHECK(value("1 + 2 * 3 ^ 2", 0) == 19);
    CHECK(value("-2 ^ 2", 0) == -4);
    CHECK(value("2 ^ 3 ^ 2", 0) == 512);
    CHECK(value("8 / 4 / 2 - 1 - 1", 0) == -1);
    CHECK(value("max(p, 2) * sqrt(x) + 1e-1", 9) == Approx(27.1));
    CHECK(value("tanh(log(exp(p))) - cos(pi)", 0.5) == Approx(std::tanh(0.5) + 1));
    for (const std::string bad :
         {"", "1 +", "q", "sqrt p", "(1", "1 2", "min()", "1,5", "p = 2", "p > 1 ? 1 : 2", "\"p\""})
        CHECK_THROWS_AS(value(bad, 1), rough::InputError);
    CHECK(value(std::string(5000, '(') + "p" + std::string(5000, ')'), 3) == 3);
    CHECK_THROWS_WITH(value(std::string(110'000, '('), 1), Catch::Contains("a formula of 110000 characters"));
}

TEST_CASE("a target from a formula, a genome or a scan is read back with its model") {
    const Folder folder;
    done(folder, "target --formula '0.3 + 0.8 * sqrt(p / 1.6e-4)' --to 1.6e-4 --points 10 --band 0.02 --out f.csv");
    const rough::Target made = rough::read_target(folder / "f.csv");
    CHECK(made.points() == 10);
    CHECK(made.y[9] == Approx(1.1));
    CHECK(made.upper[9] == Approx(1.122));
    CHECK(made.lower[9] == Approx(1.078));
    CHECK(made.recorded.empty()); // a formula belongs to no body
    const Ended conducts =
        rugosa("target --formula '3e4 * p^0.95' --quantity conductance --conductivity 167,200 --modulus 5e4 "
               "--from 0.1 --to 5 --points 5 --spaced log --out h.csv",
               folder.path());
    CHECK(conducts.code == 3); // one node of the grid is stiffer
    CHECK_THAT(conducts.out, Catch::Contains("conductance_W_per_m2K") && !Catch::Contains("without effect"));
    const rough::Target wanted =
        rough::read_target(folder / "h.csv", {.effective_modulus = 5e4, .thermal_resistivity = 1 / 167.0 + 1 / 200.0});
    CHECK(wanted.x[0] == Approx(0.1));
    CHECK(wanted.x[1] / wanted.x[0] == Approx(std::pow(50, 0.25)));
    CHECK(wanted.y[4] == Approx(3e4 * std::pow(5, 0.95) * 0.5e-3 * 5e4 * (1 / 167.0 + 1 / 200.0)));
    check_refused(rugosa("target --formula p --quantity conductance --to 1 --out x.csv", folder.path()),
                  "--conductivity: ");

    folder.write("g.json", genome_text(1e-3, 1, 1.6, {{1, {0.3}}, {2, {1}}, {3, {4}}}));
    for (const char* quantity : {"stiffness", "area", "area-displacement", "load", "interface_stiffness"}) {
        done(folder, std::string("target --genome g.json --kernel periodic --quantity ") + quantity + " --out " +
                         quantity + ".csv");
        CHECK(rough::read_target(folder / (std::string(quantity) + ".csv")).recorded.at("kernel") == "periodic");
    }
    const auto height = [](int i) { return 100 * std::sin(0.3 * i) + 30 * std::cos(1.1 * i); };
    folder.write("scan.txt", profile_text("x [um];z [nm]", 100, 1, height));
    done(folder, "target --like scan.txt --out s.csv");
    const rough::Target measured = rough::read_target(folder / "s.csv");
    CHECK(measured.points() == 20);
    REQUIRE(measured.has_band()); // from its resolution
    CHECK((measured.upper - measured.lower).minCoeff() >= 0);
    CHECK((measured.upper - measured.lower).maxCoeff() > 0);
    done(folder, "target --like scan.txt --resolution off --out n.csv");
    CHECK(!rough::read_target(folder / "n.csv").has_band());
    folder.write("map.csv", "1;2;3\n4;9;6\n7;2;7\n");
    for (const std::string source :
         {"--like map.csv --spacing 0.1x0.2", "--like map.csv --spacing 0.1", "--genome g.json --nodes 8x6"}) {
        done(folder, "target " + source + " --quantity area --out map-target.csv --force");
        CHECK(rough::read_target(folder / "map-target.csv").recorded.contains("width_mm"));
    }
}

TEST_CASE("a target is checked against its model, and reported if out of reach") {
    const Folder folder;
    REQUIRE(rugosa("target --formula '0.9 - 0.3 * p / 1e-4' --to 1e-4 --out falls.csv", folder.path()).code == 3);
    const Ended falls = rugosa("target --check falls.csv", folder.path());
    CHECK(falls.code == 3);
    CHECK(falls.out.find("falls from") != std::string::npos);
    CHECK_THAT(falls.out, Catch::Contains("of every profile: "));
    CHECK(rough::read_target(folder / "falls.csv").recorded.empty()); // a formula belongs to no body
    const Ended on_map = rugosa("target --check falls.csv --nodes 16x16 --length 1", folder.path());
    CHECK(on_map.code == 3);
    CHECK_THAT(on_map.out, Catch::Contains("of every map: ") && !Catch::Contains("profile"));
    folder.write("g.json", genome_text(1e-3, 1, 1.6, {{1, {0.3}}, {2, {1}}, {3, {4}}}));
    done(folder, "target --genome g.json --out recorded.csv");
    check_refused(rugosa("target --check recorded.csv --kernel strip", folder.path()), "kernel");
    CHECK(rugosa("target --check '" RUGOSA_SOURCE "/experiments/targets/drawn.csv'").code == 0);
    folder.write("soft.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-6,0.01\n1e-5,0.02\n");
    folder.write("law.csv", "load_N,area_mm2\n1e-3,0.01\n2e-3,0.02\n");
    check_refused(rugosa("target --check law.csv", folder.path()), "or --nodes and --length as pairs");
    CHECK(rugosa("target --check law.csv --nodes 8x8 --length 1x1", folder.path()).code != 2);
    const Ended soft = rugosa("target --check soft.csv", folder.path());
    CHECK(soft.code == 3);
    CHECK_THAT(soft.out, Catch::Contains("on this grid") && Catch::Contains("single node"));
}

TEST_CASE("target writes an offline page to draw on, with the model's limits, and no second source") {
    const Folder folder;
    done(folder, "target --draw 'my <page>.html' --quantity load --to 2e-3 --kernel strip --points 30");
    const std::string page = rough::read_whole(folder / "my <page>.html");
    const std::string begin = "id=\"data\">";
    const std::size_t at = page.find(begin) + begin.size();
    const auto data = nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
    CHECK(data["file"] == "my <page>.csv");
    CHECK(data["quantity"] == "load");
    CHECK(data["to"] == 2e-3);
    CHECK(data["points"] == 30);
    CHECK(data["recorded"]["kernel"] == "strip");
    CHECK(data["full_contact"] > 0);
    for (std::size_t q = 0; q < rough::quantity_names().size(); ++q)
        CHECK(data["quantities"][q]["y"] == columns_of(static_cast<rough::Quantity>(q)).y);
    CHECK_THAT(page, !Catch::Contains("src=") && !Catch::Contains("{{"));
    done(folder, "target --draw periodic.html --kernel periodic");
    CHECK_THAT(rough::read_whole(folder / "periodic.html"), Catch::Contains("\"full_contact\":null"));
    check_refused(rugosa("target --draw periodic.html", folder.path()), "--draw: periodic.html exists");
    done(folder, "target --draw periodic.html --force");
    check_refused(rugosa("target --draw a.html --check b.csv", folder.path()), "not exactly one of");
    check_refused(rugosa("target --draw a.html --out b.csv", folder.path()), "--out: given with --draw");
}
