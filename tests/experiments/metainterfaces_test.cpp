#include "apps/report/csv.hpp"
#include "tests/apps/results.hpp"
#include "tests/environment.hpp"

using namespace app::testing;
using nlohmann::json;

TEST_CASE("an experiment's script reads settings of any length") {
    const Folder folder;
    std::string files = "no-law.csv";
    for (int i = 0; i < 14000; ++i) files += ",law-" + std::to_string(i) + ".csv";
    folder.write("long.ini", "[experiment]\nkind = metainterfaces\n[targets]\nfiles = " + files + "\n");
    check_refused(rugosa("run long.ini", folder.path()), "no-law.csv: cannot be read");
}

TEST_CASE("laws of contact area are designed by caps, verified, and shown side by side") {
    const Folder folder;
    // No module of the current folder is imported, though PYTHONPATH names it.
    for (const char* const name : {"csv.py", "json.py", "sitecustomize.py", "rugosa.py"})
        folder.write(name, "open('harm', 'w'); raise SystemExit('a module of the current folder ran')\n");
    const tests::Environment modules("PYTHONPATH", ":.");
    const json result = result_of(
        folder, "run " RUGOSA_SOURCE "/experiments/metainterfaces/metainterfaces.ini --set targets.files=" RUGOSA_SOURCE
                "/experiments/metainterfaces/laws/power_0.8.csv," RUGOSA_SOURCE
                "/experiments/metainterfaces/laws/linear_too_long.csv --set caps.nodes=512 --set caps.radii=");
    CHECK(result["summary"] == "1 of 2 laws met");
    REQUIRE(result["rows"].size() == 2);
    for (const json& row : result["rows"]) {
        const bool reachable = row["law"] == "power_0.8";
        CHECK(row["verified"].get<double>() <= row["similarity"].get<double>());
        CHECK((row["verified"].get<double>() > 0.98) == reachable);
        CHECK((row["bound"].get<double>() == 1) == reachable);
        CHECK(row["similarity"].get<double>() <= row["bound"].get<double>() + 1e-9);
    }
    const std::string page = rough::read_whole(folder / "r" / "report.html");
    CHECK_THAT(page, Catch::Contains("power_0.8") && Catch::Contains("linear_too_long"));
    CHECK_THAT(page, Catch::Contains("<svg"));
    CHECK_FALSE(std::filesystem::exists(folder / "harm"));
}
