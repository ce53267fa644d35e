#include "tests/apps/results.hpp"

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string small_accuracy =
    "run '" RUGOSA_SOURCE "/experiments/accuracy/accuracy.ini' --set accuracy.surfaces=1 --set "
    "accuracy.accuracies=3e-2,1e-2 --set accuracy.rough-waves=32 --set model.nodes=128";

} // namespace

TEST_CASE("the accuracy experiment charts every kind of scene") {
    const Folder folder;
    const json result = result_of(folder, small_accuracy);
    REQUIRE(result["savings"].size() == 16); // two surfaces, kernels, loads and accuracies
    for (const json& row : result["savings"]) {
        CHECK(row["seconds"] > 0);
        CHECK(row["estimated_error"] <= 1.01 * row["accuracy"].get<double>());
        CHECK(row["true_error"] <= 3 * row["accuracy"].get<double>());
    }
    const std::string page = rough::read_whole(folder / "r/report.html");
    CHECK(found(page, "<figure id=\"figure-(\\d)\"") == std::vector<std::string>{"1", "2"});
}
