#include "apps/experiments/readings/readings.hpp"
#include "domain/errors.hpp"
#include "tests/apps/experiments/finished.hpp"

#include <map>
#include <regex>
#include <sstream>

using namespace app;
using app::testing::Folder;
using nlohmann::json;

namespace {

const std::string coarse =
    "run '" RUGOSA_SOURCE "/experiments/readings.ini' --pictures off --set readings.quick=on "
    "--set readings.databases=1 --nodes 32 --steps 6";

ReadingCell cell(Reading reading, std::size_t database, const std::string& holds) {
    return {reading, database, "t", holds};
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
    std::istringstream in(rough::read_whole(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

} // namespace

TEST_CASE(
    "shares are of the cells in which a claim can be said, and the reading with most claims comes first") {
    const Reading ours{}, strip{2}, far{1};
    ReadingCross cross;
    cross.cells = {cell(ours, 0, "10?"), cell(strip, 0, "11?"), cell(far, 0, "01?"), cell(ours, 1, "111")};
    const auto sobol = [](const ReadingCell& one) { return one.database == 0; };
    CHECK(cross.share(0, sobol) == Approx(2.0 / 3));
    CHECK(cross.share(2, sobol) == 0); // a cell that cannot say it does not hold
    CHECK(cross.share(2, [](const ReadingCell&) { return true; }) == 0.25);
    CHECK(cross.ranked() == std::vector<std::pair<Reading, double>>{{strip, 2}, {ours, 1}, {far, 1}});
    CHECK(deviations(ours) == 0);
    CHECK(deviations({2, 0, 1}) == 2);
}

TEST_CASE("a saved part of a run is resumed unless it is damaged or of other settings") {
    const Folder folder;
    Progress progress;
    const std::atomic<bool> stop{false};
    Conditions conditions{{}, progress, stop, folder.path(), true, "sizes=1"};
    const auto part = [&] { return part_of(conditions, "a", [] { return json{0.1, "b"}; }); };
    CHECK(part() == json{0.1, "b"});
    CHECK(part_of(conditions, "a", [] { return json(2); }) == json{0.1, "b"});
    conditions.settings = "sizes=2";
    CHECK_THROWS_AS(part(), rough::InputError);

    const auto file = folder / "checkpoints/a.json";
    const std::string whole = rough::read_whole(file);
    for (const std::string& text :
         {whole.substr(0, whole.size() - 3), std::string("[]"), std::string(R"({"settings":"sizes=2"})")}) {
        rough::write_atomically(file, text);
        INFO(text);
        CHECK_THROWS_AS(part(), rough::InputError);
    }
}

TEST_CASE(
    "readings are tried one choice at a time, each on every body's own targets, and goes on where it was") {
    const Folder folder;
    const json result = app::testing::finished(coarse, folder);
    CHECK(result["readings"].size() == 15); // ours, and each value of each choice that is not
    for (const char* table :
         {"cells.csv", "runs.csv", "claims.csv"}) { // every row as wide as the header, none cut
        const auto rows = lines_of(folder / "r" / table);
        const auto cells = [](std::string row) {
            row = std::regex_replace(row, std::regex("\"[^\"]*\""), "");
            return std::count(row.begin(), row.end(), ',');
        };
        for (const std::string& row : rows)
            CHECK(cells(row) == cells(rows[0]));
    }
    CHECK(lines_of(folder / "r/claims.csv")[1].starts_with("1,"));
    for (const ReadingAxis& axis : reading_axes())
        CHECK(result["readings"][0].contains(axis.name));
    const auto cells = lines_of(folder / "r/cells.csv");
    // Four targets; the database with other phases has no first point of Sobol's.
    CHECK(cells.size() == 1 + 4 * (15 + 14));
    // The claims' shares on the strip counted anew from the cells.
    int cells_of_strip = 0;
    std::map<int, double> held;
    for (const std::string& line : cells)
        for (const std::string target : {"median", "lower quartile", "upper quartile", "held-out"})
            if (const auto at = line.find(",0," + target + ",");
                line.starts_with("\"strip\"") && at != std::string::npos) {
                ++cells_of_strip;
                int claim = 1;
                for (const char sign : line.substr(at + target.size() + 4)) {
                    claim += sign == ',';
                    held[claim] += sign == '1';
                }
            }
    CHECK(cells_of_strip == 4);
    for (const json& row : result["claims"])
        if (!row["share_holds"].is_null()) {
            CHECK(row["share_holds"] >= 0);
            CHECK(row["share_holds"] <= 1);
            const int claim = row["claim"];
            if (row["value"] == "strip")
                CHECK(row["share_holds"] == Approx(held[claim] / 4));
        }
    CHECK(std::filesystem::exists(folder / "r/targets/strip-median.csv"));
    CHECK_FALSE(std::filesystem::exists(folder / "r/checkpoints"));
    app::testing::expect_repeated(coarse, folder, {"cells.csv", "runs.csv", "claims.csv"});
    CHECK(app::testing::rugosa(coarse + " --kernel strip --out t", folder.path()).code == 2);
}
