#include "apps/report/csv.hpp"
#include "tests/apps/results.hpp"

#include <cmath>
#include <numbers>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string caps = "design --asperities 3x3 --pitch 1.5 --radius 0.526 --heights 0:0.12:0.001 --modulus 1.36 "
                         "--nodes 64 --target law.csv ";

/// About twice the area of one cap.
void write_law(const Folder& folder) {
    folder.write("law.csv", "load_N,area_mm2\n0.01,0.1\n0.02,0.17\n0.03,0.23\n0.04,0.28\n");
}

} // namespace

TEST_CASE("a design of caps writes its array, spots, solids and page") {
    const Folder folder;
    write_law(folder);
    const json result = result_of(folder, caps + "--reach-similarity 0.9 --seed 2 --evaluations 400");
    const json& best = result["variants"]["default"];
    CHECK(result["summary"]["found"] == true);
    CHECK(best["similarity_worst"] <= best["similarity"]);
    CHECK(best["similarity_worst"] >= 0.9);
    CHECK(best["verification"]["loads"].size() == 3);
    CHECK(best["tolerance"].size() == 3);
    const auto rows = app::csv_rows(rough::read_whole(folder / "r" / "asperities.csv"));
    REQUIRE(rows.size() == 10);
    CHECK(rows[0] == std::vector<std::string>{"x_mm", "y_mm", "height_mm", "radius_mm"});
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double micrometres = 1000 * std::stod(rows[i][2]);
        CHECK(std::abs(micrometres - std::round(micrometres)) < 1e-9);
        CHECK(std::stod(rows[i][3]) == 0.526);
    }
    for (const char* file : {"spots.csv", "curves.csv", "tile.stl", "mould.3mf"})
        CHECK(std::filesystem::file_size(folder / "r" / file) > 0);
    CHECK_THAT(rough::read_whole(folder / "r" / "report.html"), Catch::Contains("Heights of the caps"));
}

TEST_CASE("a law below the area of one cap is reported as out of reach") {
    const Folder folder;
    folder.write("law.csv", "load_N,area_mm2\n0.01,0.0388\n0.04,0.28\n");
    const Ended ended = rugosa(caps + "--pipeline 'sample 4 | score | round | score' --out r", folder.path());
    CHECK(ended.code == 3);
    CHECK_THAT(ended.out, Catch::StartsWith("note: out of reach of these caps") || // before the search
                              Catch::Contains("\nnote: out of reach of these caps"));
    const double one_cap = std::numbers::pi * std::pow(3 * 0.01 * 0.526 / (4 * 1.36), 2. / 3); // Hertz
    CHECK(result_in(folder / "r")["out_of_reach"][0]["highest_similarity"].get<double>() ==
          Approx(2 - one_cap / 0.0388).epsilon(1e-9));
}

TEST_CASE("wrong settings of caps are refused in one line") {
    const Folder folder;
    write_law(folder);
    for (const auto& [flags, words] : {std::pair("--heights 0.1", "--heights: 0.1 is not a range"),
                                       {"--heights 1:0", "is not a range"},
                                       {"--radii 0.1:0.2", "--radii"},
                                       {"--noise 1e-6", "--noise: given with --asperities"},
                                       {"--variant sog", "--variant: \"sog\" given"},
                                       {"--pitch 0", "--pitch"},
                                       {"--pipeline 'reduce dominant'", "reduce"}}) {
        const std::string given = flags;
        std::string command = caps;
        if (given.starts_with("--heights")) command.replace(command.find("--heights 0:0.12:0.001 "), 23, "");
        if (given.starts_with("--pitch")) command.replace(command.find("--pitch 1.5 "), 12, "");
        check_refused(rugosa(command + given, folder.path()), words);
    }
    check_refused(rugosa("design --target law.csv --pitch 1", folder.path()), "given without --asperities");
}
