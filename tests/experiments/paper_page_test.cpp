#include "apps/prompt/units.hpp"
#include "tests/apps/results.hpp"

#include <set>

using namespace app::testing;
using nlohmann::json;

namespace {

const std::string small_paper =
    "run '" RUGOSA_SOURCE "/experiments/paper/paper.ini' --seed 11 --set model.nodes=64 --set database.pairs=";

std::string page_in(const Folder& folder) { return rough::read_whole(folder / "r/report.html"); }

std::vector<std::string> figures_in(const std::string& html) { return found(html, "<figure id=\"figure-(\\d+)\""); }

} // namespace

TEST_CASE("the paper's report shows every number, verdict and figure of the result, and needs nothing else") {
    const Folder folder;
    const json result = result_of(folder, small_paper + "6 --set paper.sweep-points=2");
    const std::string html = page_in(folder);
    const json second = result_in(folder / "r/heldout");
    const auto tiles = found(html, "<dd>([^<]*)</dd></div>");
    REQUIRE(tiles.size() == 6);
    const std::array<const json*, 2> results{&result, &second};
    for (std::size_t t = 0; t < 2; ++t) {
        double best = -1;
        for (const auto& [name, variant] : (*results[t])["variants"].items())
            best = std::max(best, variant["similarity"].get<double>());
        CHECK(tiles[t] == app::readable(best));
    }
    std::map<std::string, int> counts;
    const auto verdicts = found(html, "class=\"badge ([a-z]*)\"");
    REQUIRE(verdicts.size() == result["claims"].size());
    for (std::size_t c = 0; c < verdicts.size(); ++c) {
        CHECK(verdicts[c] == result["claims"][c]["verdict"].get<std::string>());
        ++counts[verdicts[c]];
    }
    CHECK(tiles[2] == std::to_string(counts["reproduced"]));
    CHECK(tiles[3] == std::to_string(counts["contradicted"]));
    CHECK(tiles[4] == std::to_string(counts["undecidable"]));
    CHECK(tiles[5] == app::readable(result["seconds"].get<double>(), 2) + " s");
    CHECK(figures_in(html).size() == 11);
    CHECK(html.find("No picture") == std::string::npos);
    CHECK(found(html, "(<span class=\"rule\">)").size() == verdicts.size());
    CHECK(html.find("1440 readings") != std::string::npos);
    CHECK(html.find("--set model.nodes=64") != std::string::npos);
    CHECK(found(html, "([^a-z]-?(nan|inf)[^a-z])").empty());
    CHECK(found(html, "(<script|<link rel=\"stylesheet|@import|url\\()").empty());
    std::set<std::string> ids;
    for (const std::string& id : found(html, " id=\"([^\"]*)\"")) CHECK(ids.insert(id).second);
    for (const std::string& link : found(html, "href=\"#([^\"]*)\"")) CHECK(ids.contains(link));
}

TEST_CASE("a report on a handful of nodes, another body or one target is whole, too") {
    for (const std::string other : {"--set model.nodes=4", "--set model.kernel=periodic", "--set model.kernel=strip",
                                    "--set heldout.file= --set paper.sweep-points=0"}) {
        const Folder folder;
        INFO(other);
        result_of(folder, small_paper + "2 --set paper.sweep-points=1 " + other);
        const std::string html = page_in(folder);
        CHECK(figures_in(html).size() == 11);
    }
}
