#include "tests/apps/results.hpp"

using namespace app::testing;

namespace {

using nlohmann::json;

/// Every number of a value as null, at any depth.
json without_numbers(json value) {
    if (value.is_number()) return nullptr;
    if (value.is_structured())
        for (auto& part : value) part = without_numbers(std::move(part));
    return value;
}

/// The page of a run's folder, written anew.
std::string page_of(const Folder& folder) {
    answered(rugosa("report r --out page.html --force", folder.path()));
    return rough::read_whole(folder / "page.html");
}

void expect_pictures(const std::string& page) {
    CHECK_THAT(page, Catch::Contains("<svg") && !Catch::Contains("No picture"));
}

/// A folder with a target of two points and one of a single point.
struct Targets : Folder {
    Targets() {
        write("two.csv", "pressure_MPa,stiffness_MPa_per_mm\n5e-5,0.7\n1e-4,1.0\n");
        write("one.csv", "pressure_MPa,stiffness_MPa_per_mm\n1e-4,1.0\n");
    }
};

} // namespace

// The program writes these results itself; then their values are taken away.
TEST_CASE("pages of poor results have their pictures") {
    const Targets folder;
    for (const std::string& words :
         {std::string("design --target two.csv --nodes 64 --variant plain --evaluations 60"),
          std::string("design --target one.csv --nodes 64 --pipeline 'sample 3 | score | best 1' --alternatives 1"),
          std::string("design --target two.csv --nodes 16x16 --pipeline 'sample 3 | score | best 1' --seconds 0.01"),
          std::string("design --target two.csv,one.csv --nodes 64 --pipeline 'sample 4 | score | best 2'")}) {
        INFO(words);
        answered(rugosa(words + " --out r --force", folder.path()));
        expect_pictures(rough::read_whole(folder / "r/report.html"));
        json result = result_in(folder / "r");
        for (const char* key : {"variants", "summary"}) {
            INFO(key);
            json poor = result;
            poor[key] = without_numbers(poor[key]);
            folder.write("r/result.json", poor.dump());
            expect_pictures(page_of(folder));
        }
        result["version"] = "0.2.0";
        for (auto& variant : result["variants"]) variant.erase("tolerance"), variant.erase("alternatives");
        folder.write("r/result.json", result.dump());
        expect_pictures(page_of(folder));
    }
}

TEST_CASE("a comparison of 1 and of 13 variants has its pictures") {
    std::string many;
    for (int k = 1; k <= 13; ++k)
        many +=
            (k > 1 ? "," : "") + ("v" + std::to_string(k)) + "=sample " + std::to_string(4 + k) + " | score | best 1";
    for (const std::string& variants : {std::string("only=sample 9 | score | best 1"), many})
        for (const std::string problems : {"bbob5-1", "roughness --set model.nodes=32 --target two.csv --curves 30"}) {
            const Targets folder;
            const std::string words =
                "compare --variants '" + variants + "' --seeds 2 --budget 100 --problems " + problems;
            INFO(words);
            answered(rugosa(words + " --out r", folder.path()));
            expect_pictures(rough::read_whole(folder / "r/report.html"));
        }
}

TEST_CASE("pages of caps, of one load and of an interrupted design have their pictures") {
    const Targets folder;
    answered(rugosa("design --asperities 5x5 --target two.csv --evaluations 200 --out caps", folder.path()));
    expect_pictures(rough::read_whole(folder / "caps/report.html"));
    folder.write("g.json", one_wave);
    answered(rugosa("contact --genome g.json --pressures 1e-5 --out c.csv --report c.html", folder.path()));
    expect_pictures(rough::read_whole(folder / "c.html"));
    const Ended stopped = rugosa_stopped(0.2, "r", "design --target two.csv --seconds 60 --out r", folder.path());
    INFO(stopped.out << stopped.err);
    expect_pictures(rough::read_whole(folder / "r/report.html"));
}
