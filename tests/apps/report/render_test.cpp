#include "apps/report/csv.hpp"
#include "apps/report/render.hpp"
#include "domain/errors.hpp"
#include "tests/apps/results.hpp"

#include <cmath>
#include <set>

using namespace app;
using app::testing::found;
using tests::Folder;

namespace {

const char* const evil = "<script>x</script>\"&";

/// The values of a profile's page with names that are mark-up.
nlohmann::json profile_values() {
    return {{"kind", "profile"},
            {"name", evil},
            {"account", evil},
            {"lambda_c_mm", nullptr},
            {"files", {"a b.csv", evil}},
            {"parameters",
             {{{"name", "Pa"}, {"value", 0.00123}, {"unit", "mm"}, {"meaning", evil}},
              {{"name", "PSm"}, {"value", nullptr}, {"unit", "mm"}, {"meaning", "width"}}}}};
}

} // namespace

TEST_CASE("text from a file is escaped, and the page fetches nothing") {
    const Folder folder;
    rough::Profile wave{Eigen::VectorXd::LinSpaced(50, 0, 6).array().sin(), 0.01};
    folder.write("profile.json", profile_values().dump());
    folder.write("heights-drawn.csv", heights_csv(wave));
    folder.write("bearing.csv", bearing_csv(wave.heights));
    folder.write("spectrum-drawn.csv", "wave_number_rad_per_mm,density\n1,1\n10,0.01\n");
    const std::string page = render(page_source(folder.path()));
    CHECK(page.find("<script") == std::string::npos);
    CHECK(page.find("&lt;script&gt;x&lt;/script&gt;&quot;&amp;") != std::string::npos);
    CHECK_THAT(page, Catch::Contains("href=\"a%20b.csv\"") && Catch::Contains("1.23 µm") &&
                         Catch::Contains("prefers-color-scheme:dark") && !Catch::Contains("No picture"));
    for (const std::string& address : found(page, "(?:href|src)=\"([^\"]*)\""))
        CHECK(address.find("//") == std::string::npos);
    std::set<std::string> ids;
    for (const std::string& id : found(page, " id=[\"']([^\"']*)[\"']")) CHECK(ids.insert(id).second);
    CHECK(page_of(page_source(folder.path())) == folder / "report.html");
}

TEST_CASE("a user's file replaces a built-in template or figure") {
    const Folder folder, mine;
    folder.write("curve.json", profile_values().dump());
    mine.write("profile.mustache", "<h1>{{name}}</h1>{{#tables.a}}[{{x|2}} {{n|by}}]{{/tables.a}}{{{figures.f:q@row}}}"
                                   "{{sides|by}}{{files|count}}{{^nothing}}none{{/nothing}}");
    mine.write("f.gp", "# F\nset xlabel arg\nplot [0:1] x notitle\n");
    folder.write("curve-a.csv", "x,n\n0.123,7\n,\n");
    PageSource source = page_source(folder / "curve.json");
    source.values["sides"] = {20, 18.5};
    source.values["row"] = "z";
    const std::string page = render(source, {.templates = mine.path()});
    CHECK_THAT(page, Catch::Contains("[0.12 7][ ]") && Catch::Contains("20 x 18.52none") && Catch::Contains(">qz<") &&
                         Catch::Contains("</html>"));
    CHECK(page_of(source) == folder / "curve.html");
    for (const auto& [text, problem] : {std::pair("{{#a}}", "profile.mustache"),
                                        {"{{>profile}}", "must not include itself"},
                                        {"{{height|brief:x}}", "brief:x"},
                                        {"{{height|brief:99}}", "1 to 17"},
                                        {"{{height|99}}", "99"},
                                        {"{{height|wide}}", "wide"},
                                        {"{{#height|above:}}a{{/height|above:}}", "above:"},
                                        {"{{height|length:1e3}}", "length:1e3"}}) {
        INFO(text);
        source.values["height"] = 0.25;
        mine.write("profile.mustache", text);
        CHECK_THROWS_WITH(render(source, {.templates = mine.path()}), Catch::Contains(problem));
    }
    CHECK_THROWS_WITH(render(source, {.templates = mine / "none"}), Catch::Contains("is not a folder"));
}

TEST_CASE("a folder without a valid result is refused with the name of its file") {
    const Folder folder;
    CHECK_THROWS_AS(page_source(folder.path()), rough::InputError);
    for (const char* text : {"[]", "{}", R"({"kind":3})", R"({"kind":"../x"})", "{"}) {
        folder.write("result.json", text);
        CHECK_THROWS_WITH(page_source(folder.path()), Catch::Contains("result.json"));
    }
    folder.write("result.json", R"({"kind":"nothing"})");
    CHECK_THROWS_AS(render(page_source(folder.path())), rough::InputError);
}

TEST_CASE("a line of a million points is drawn through its visible extremes") {
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(1'000'000, 1, 1e6);
    Eigen::VectorXd y = x.array().sin();
    y[345'678] = 50;
    for (const bool logarithmic : {false, true}) {
        const std::string table = drawn_csv({"x", "y"}, {x, y}, logarithmic);
        const auto rows = std::ranges::count(table, '\n') - 1;
        CHECK(rows <= 4000);
        CHECK(rows > 1000);
        CHECK_THAT(table, Catch::Contains("\n345679,50\n") && Catch::Contains(",-0.9999")); // the extremes
    }
    CHECK(std::ranges::count(drawn_csv({"x", "y"}, {x.head(4000), y.head(4000)}), '\n') == 4001);
}

TEST_CASE("a large map is drawn as block means, at most 256 along an axis") {
    rough::Profile map{Eigen::VectorXd::Constant(600 * 3, 2), 0.5};
    map.rows = 3;
    map.row_spacing = 1;
    map.heights.segment(0, 3) << 2, 5, NAN;
    map.heights.segment(600, 3) << 2, 5, NAN;
    map.heights.segment(1200, 3) << 2, 5, NAN;
    const std::string table = map_csv(map, {"height_mm"}, {map.heights});
    CHECK_THAT(table, Catch::StartsWith("x_mm,y_mm,height_mm\n0.5,1,3.5\n2,1,2\n"));
    map.heights.segment(0, 2).setConstant(NAN);
    map.heights.segment(600, 2).setConstant(NAN);
    map.heights.segment(1200, 2).setConstant(NAN);
    CHECK_THAT(map_csv(map, {"height_mm"}, {map.heights}), Catch::Contains("\n0.5,1,\"\"\n"));
    CHECK(std::ranges::count(table, '\n') == 1 + 200);
}
