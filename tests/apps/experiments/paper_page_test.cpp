#include "apps/report/units.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/response/curve.hpp"
#include "domain/target/similarity.hpp"
#include "tests/apps/experiments/finished.hpp"
#include "tests/apps/found.hpp"

#include <set>

using app::testing::Ended;
using app::testing::finished;
using app::testing::Folder;
using app::testing::found;
using app::testing::rugosa;
using nlohmann::json;

namespace {

const std::string small =
    "run '" RUGOSA_SOURCE "/experiments/paper.ini' --seed 11 --set model.nodes=64 --set database.pairs=";

std::string page_in(const Folder& folder) { return rough::read_whole(folder / "r/report.html"); }

std::vector<std::string> figures_in(const std::string& html) {
    return found(html, "<figure id=\"figure-(\\d+)\"");
}

} // namespace

TEST_CASE(
    "each number of the report's first screen follows from result.json, similarities from the genomes") {
    const Folder folder;
    const json result = finished(small + "6 --set paper.sweep-points=2", folder);
    const json second = app::testing::result_in(folder / "r/heldout");
    const auto tiles = found(page_in(folder), "<dd>([^<]*)</dd></div>");
    REQUIRE(tiles.size() == 6);
    const std::array<const json*, 2> results{&result, &second};
    for (std::size_t t = 0; t < 2; ++t) {
        double best = -1;
        for (const auto& [name, variant] : (*results[t])["variants"].items()) {
            best = std::max(best, variant["similarity"].get<double>());
            rough::Model model;
            model.grid.nodes = 64;
            model = completed(model);
            rough::Target target;
            const auto& points = (*results[t])["target"]["points"];
            target.x.resize(static_cast<rough::Index>(points.size())), target.y.resize(target.x.size());
            for (std::size_t k = 0; k < points.size(); ++k) {
                target.x[static_cast<rough::Index>(k)] = points[k]["pressure_MPa"];
                target.y[static_cast<rough::Index>(k)] = points[k]["stiffness_MPa_per_mm"];
            }
            const auto response = respond(rough::genome_from_json(variant["genome"], name), model);
            CHECK(rough::similarity(target, secant_stiffness(response)) ==
                  Approx(variant["similarity"].get<double>()).margin(1e-9));
        }
        CHECK(tiles[t] == app::readable(best));
    }
    std::map<std::string, int> verdicts;
    for (const json& claim : result["claims"])
        ++verdicts[claim["verdict"]];
    CHECK(tiles[2] == std::to_string(verdicts["reproduced"]));
    CHECK(tiles[3] == std::to_string(verdicts["contradicted"]));
    CHECK(tiles[4] == std::to_string(verdicts["undecidable"]));
    CHECK(tiles[5] == app::readable(result["seconds"].get<double>(), 2) + " s");
}

TEST_CASE("the report shows all figures, a verdict with its rule for every claim, and needs nothing else") {
    const Folder folder;
    const json result = finished(small + "6 --set paper.sweep-points=2", folder);
    const std::string html = page_in(folder);
    CHECK(figures_in(html).size() == 11);
    CHECK(html.find("No picture") == std::string::npos);
    const auto verdicts = found(html, "class=\"badge ([a-z]*)\"");
    REQUIRE(verdicts.size() == result["claims"].size());
    for (std::size_t c = 0; c < verdicts.size(); ++c)
        CHECK(verdicts[c] == result["claims"][c]["verdict"]);
    CHECK(found(html, "(<span class=\"rule\">)").size() == verdicts.size());
    CHECK(html.find("1440 readings") != std::string::npos);
    CHECK(html.find("--set model.nodes=64") != std::string::npos);
    CHECK(found(html, "([^a-z]-?(nan|inf)[^a-z])").empty());
    CHECK(found(html, "(<script|<link rel=\"stylesheet|@import|url\\()").empty());
    std::set<std::string> ids;
    for (const std::string& id : found(html, " id=\"([^\"]*)\""))
        CHECK(ids.insert(id).second);
    for (const std::string& link : found(html, "href=\"#([^\"]*)\""))
        CHECK(ids.contains(link));
}

TEST_CASE("a report on a handful of nodes, another body, the other reading or one target is whole, too") {
    for (const std::string other :
         {"--set model.nodes=4", "--set model.kernel=periodic", "--set model.kernel=strip",
          "--set paper.dominance=step", "--set heldout.file= --set paper.sweep-points=0"}) {
        const Folder folder;
        INFO(other);
        finished(small + "2 --set paper.sweep-points=1 " + other, folder);
        const std::string html = page_in(folder);
        CHECK(figures_in(html).size() == 11);
        CHECK((html.find("Datum of the half-plane") == std::string::npos) ==
              (other.find("kernel") != std::string::npos));
        CHECK((html.find("held-out target") == std::string::npos) ==
              (other.find("heldout") != std::string::npos));
    }
}

TEST_CASE("an experiment's own variants stand in the report by their names, with the paper's answers") {
    const Folder folder;
    finished(small + "2 --set paper.sweep-points=0 --set heldout.file= --set 'variants.myOwn=score | best 1'",
             folder);
    const std::string html = page_in(folder);
    for (int figure = 9; figure <= 11; ++figure) {
        const auto from = html.find("<figure id=\"figure-" + std::to_string(figure) + "\"");
        const std::string drawn = html.substr(from, html.find("</figure>", from) - from);
        for (const char* name : {"SOG", "GCO", "CCO", "myOwn"})
            CHECK(drawn.find(name) != std::string::npos);
    }
    for (const char* cell : {">myOwn</td>", ">SOG, minimax</td>"})
        CHECK(html.find(cell) != std::string::npos);
}

TEST_CASE("a file that holds no other readings is refused by its name") {
    const Folder folder;
    for (const char* text : {"{", "{\"claims\":3}", "[]"}) {
        folder.write("bad.json", text);
        const Ended ended =
            rugosa("run '" RUGOSA_SOURCE "/experiments/paper.ini' --set paper.readings=bad.json --out r",
                   folder.path());
        CHECK(ended.code == 2);
        CHECK(ended.error_lines() == 1);
        CHECK(ended.err.find("bad.json") != std::string::npos);
    }
}
