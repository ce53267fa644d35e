#include "tests/apps/results.hpp"

#include <cmath>

using namespace app::testing;

namespace {

struct Look {
    nlohmann::json page; ///< output of browser_probe.js
    std::string console; ///< messages of the page in the browser's log
};

/// Opens the page with the probe at its end in a headless Chromium. The page is in a frame, because no window
/// is as narrow as a phone.
Look looked_at(const Folder& folder, std::string page, int width, bool dark) {
    const std::string probe = rough::read_whole(RUGOSA_SOURCE "/tests/apps/report/browser_probe.js");
    page.insert(page.rfind("</body>"), "<script>" + probe + "</script>");
    folder.write("page.html", page);
    const auto file = folder.write(
        "frame.html", "<!doctype html><meta name=\"color-scheme\" content=\"light dark\"><pre id=\"probe\"></pre>"
                      "<script>onmessage=(event)=>probe.textContent=event.data</script>"
                      "<iframe src=\"page.html\" style=\"border:0;height:900px;width:" +
                          std::to_string(width) + "px\"></iframe>");
    const std::string command =
        "timeout 120 chromium --headless --no-sandbox --disable-gpu --hide-scrollbars "
        "--enable-logging=stderr "
        "--host-resolver-rules='MAP * ~NOTFOUND' --user-data-dir='" +
        (folder / "browser").string() +
        "' --window-size=1400,1000 --virtual-time-budget=3000 --blink-settings=preferredColorScheme=" +
        (dark ? "0" : "1") + " --dump-dom 'file://" + file.string() + "' >'" + (folder / "dom").string() + "' 2>'" +
        (folder / "log").string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    const std::string dom = rough::read_whole(folder / "dom"), mark = "<pre id=\"probe\">";
    const std::size_t at = dom.find(mark);
    REQUIRE(at != std::string::npos);
    std::string told = dom.substr(at + mark.size(), dom.find("</pre>", at) - at - mark.size());
    for (const auto& [entity, letter] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&amp;", "&"}})
        for (std::size_t i; (i = told.find(entity)) != std::string::npos;)
            told.replace(i, std::string(entity).size(), letter);
    std::string console, line;
    std::istringstream log(rough::read_whole(folder / "log"));
    while (std::getline(log, line))
        if (line.find("CONSOLE") != std::string::npos) console += line + "\n";
    return {nlohmann::json::parse(told), console};
}

struct PageCase {
    std::string command, page; ///< the command that makes the page, and its file
    std::size_t figures, pictures;
};

const std::string experiments = RUGOSA_SOURCE "/experiments/";

/// A rough scan of 3,000 points in micrometres: three waves and noise.
std::string scan_text() {
    return profile_text("x [um];z [um]", 3000, 0.3, [](int i) {
        const double x = 0.3 * i;
        return 2 * std::cos(x / 120) + 0.8 * std::cos(x / 31 + 1) + 0.3 * std::cos(x / 9) +
               0.005 * std::sin(37. * i * i);
    });
}

} // namespace

TEST_CASE("every page is readable on a phone and a desktop, light and dark, and fetches nothing", "[long]") {
    const PageCase made = GENERATE(
        PageCase{"profile --profile scan.txt --lambda-c 0.08 --out r", "r/report.html", 2, 3},
        PageCase{"contact --profile scan.txt --out c.csv --report c.html", "c.html", 3, 6},
        PageCase{"run '" + experiments + "paper/paper.ini' --out r", "r/report.html", 11, 30},
        PageCase{"run '" + experiments + "compare/variants.ini' --set compare.curves=60 --set compare.seeds=1 --out r",
                 "r/report.html", 4, 4},
        PageCase{"design --target '" + experiments +
                     "targets/drawn.csv' --max-pressure 1.6e-4 --reach-similarity 0.9 "
                     "--out r",
                 "r/report.html", 2, 3},
        PageCase{"design --like scan.txt --pipeline 'sample 20 | score | best 3' --out r", "r/report.html", 2, 4},
        PageCase{"chart --quick --out r", "r/chart.html", 1, 12},
        PageCase{"stability --scene spike --out r", "r/stability.html", 0, 0});
    const Folder folder;
    folder.write("scan.txt", scan_text());
    INFO("rugosa " << made.command);
    answered(rugosa(made.command, folder.path()));
    const std::string html = rough::read_whole(folder / made.page);
    for (const int width : {390, 1280})
        for (const bool dark : {false, true}) {
            const auto [page, console] = looked_at(folder, html, width, dark);
            INFO(width << (dark ? " dark" : " light"));
            CHECK(console == "");
            CHECK(page["fetched"].empty());
            CHECK(page["width"] == width);
            CHECK(page["dark"] == dark);
            CHECK(page["scrolls"] == false);
            CHECK(page["figures"] >= made.figures);
            CHECK(page["pictures"].size() >= made.pictures);
            for (const auto& picture : page["pictures"]) {
                INFO(picture.dump());
                CHECK(picture["width"] > 250);
                CHECK(picture["height"] > 150);
                CHECK(picture["inside"] == true);
                CHECK(picture["letters"] > 9);
                CHECK(picture["problems"].empty());
                CHECK(picture["text"] >= 4.5); // WCAG 2.1, 1.4.3
                CHECK(picture["lines"] >= 3);  // 1.4.11
            }
            INFO(page["faintest"].dump());
            CHECK(page["faintest"]["contrast"] >= 4.5);
        }
}
