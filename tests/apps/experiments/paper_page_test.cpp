#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <set>

using app::testing::Ended;
using app::testing::Folder;
using app::testing::found;
using app::testing::Outline;
using app::testing::outline;
using app::testing::rugosa;

namespace {

std::string page_of(const Folder& folder, const std::string& more) {
    const auto ended =
        rugosa("run '" RUGOSA_SOURCE "/experiments/paper.ini' --out r --seed 11 --set model.nodes=64 --set "
               "database.pairs=6 " +
                   more,
               folder.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return rough::read_whole(folder / "r/report.html");
}

} // namespace

TEST_CASE("the report shows Figures 1 to 11, a verdict for every claim, and how to repeat the run") {
    const Folder folder;
    const std::string html = page_of(folder, "--set paper.sweep-points=2");
    CHECK(html.find("Other readings") != std::string::npos);
    CHECK(html.find("of 1440 readings") != std::string::npos);
    CHECK(html.find("claims reproduced</") != std::string::npos);
    const std::string three = "SOG 0[.\\d]+, GCO 0[.\\d]+, CCO 0[.\\d]+";
    CHECK(found(html, "(drawn target: " + three + "; held-out target: " + three + ")").size() ==
          2); // readings
    for (int figure = 1; figure <= 11; ++figure)
        CHECK(found(html, "<figure (id=\"figure-" + std::to_string(figure) + "\")").size() == 1);
    CHECK(outline(html) == Outline{"# The answers",
                                   "figure figure-9",
                                   "figure figure-10",
                                   "figure figure-11",
                                   "# The runs",
                                   "table Runs on the drawn target",
                                   "table Runs on the held-out target",
                                   "figure convergence",
                                   "# Every claim",
                                   "table ",
                                   "# The search",
                                   "figure figure-7",
                                   "figure figure-8",
                                   "# Model and database",
                                   "figure figure-1",
                                   "figure figure-2",
                                   "figure figure-3",
                                   "figure figure-4",
                                   "figure figure-5",
                                   "figure figure-6",
                                   "# What rests on our reading",
                                   "table ",
                                   "# Repeat it"});
    CHECK(found(html, "(<svg )").size() >= 30);
    const auto verdicts = found(html, "class=\"badge ([a-z]*)\"");
    CHECK(verdicts.size() >= 30);
    CHECK(verdicts.size() == found(html, "(<span class=\"rule\">)").size());
    for (const char* words : {"drawn target", "held-out target", "leaves some choices open",
                              "At equal pressures", "By load step", "seed 11", "--set model.nodes=64"})
        CHECK(html.find(words) != std::string::npos);
    CHECK(found(html, "([^a-z]-?(nan|inf)[^a-z])").empty());

    // it stands alone: nothing to fetch, nothing to run, no id twice
    CHECK(found(html, "(<script|<link rel=\"stylesheet|@import|url\\()").empty());
    for (const std::string& address : found(html, "(https?://[^\"]*)"))
        CHECK(address == "http://www.w3.org/2000/svg");
    std::set<std::string> ids;
    for (const std::string& id : found(html, " id=\"([^\"]*)\""))
        CHECK(ids.insert(id).second);
    for (const std::string& link : found(html, "href=\"#([^\"]*)\""))
        CHECK(ids.contains(link));
}

TEST_CASE("a report on a handful of nodes, another body or the other reading is whole, too") {
    for (const char* model : {"--set model.nodes=4", "--set model.kernel=periodic",
                              "--set model.kernel=strip", "--set paper.dominance=step"}) {
        const Folder folder;
        INFO(model);
        const std::string html =
            page_of(folder, "--set database.pairs=2 --set paper.sweep-points=1 " + std::string(model));
        CHECK(found(html, "<figure (id=\"figure-\\d+\")").size() == 11);
        CHECK((html.find("Datum of the half-plane") != std::string::npos) ==
              !std::string(model).starts_with("--set model.kernel"));
    }
}

TEST_CASE("a report with one target and no sweep still has every figure") {
    const Folder folder;
    const std::string html = page_of(folder, "--set heldout.file= --set paper.sweep-points=0");
    CHECK(found(html, "<figure (id=\"figure-\\d+\")").size() == 11);
    CHECK(html.find("held-out target:") == std::string::npos);
}

TEST_CASE("an experiment's own variants stand in the report by their own names, with the paper's answers") {
    const Folder folder;
    const std::string html =
        page_of(folder, "--set database.pairs=2 --set paper.sweep-points=0 --set heldout.file= "
                        "--set 'variants.myOwn=score | best 1'");
    for (int figure = 9; figure <= 11; ++figure) {
        const auto from = html.find("<figure id=\"figure-" + std::to_string(figure) + "\"");
        const std::string drawn = html.substr(from, html.find("</figure>", from) - from);
        for (const char* name : {"SOG", "GCO", "CCO", "myOwn"})
            CHECK(drawn.find(name) != std::string::npos);
    }
    CHECK(html.find("MYOWN") == std::string::npos);
    CHECK(html.find(">myOwn</td>") != std::string::npos);
    CHECK(html.find(">SOG, minimax</td>") != std::string::npos);
}

TEST_CASE("a file that tells nothing of other readings is refused by its name") {
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
