#include "apps/report/page.hpp"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace app;

TEST_CASE("a page holds what was put into it, in order, and shows no mark-up that was meant as text") {
    Page page("R < 1 & more", Html::raw("A <em>lead</em>."));
    page.section("One & two");
    page.prose(Html::raw("<i>K</i>"));
    page.figure({"figure-a", "Title.", "Caption.", {}});
    page.table({"Runs", {"name", "value"}, {{"a", "1"}, {"b", "2"}}, {false, true}});
    page.code("rugosa run x --set a.b=<c>");
    const std::string html = page.html();
    std::size_t at = 0;
    for (const char* piece :
         {"<!doctype html>", "lang=\"en\"", "name=\"viewport\"", "<title>R &lt; 1 &amp; more</title>",
          "A <em>lead</em>.", "href=\"#section-1\"", "<h2 id=\"section-1\">One &amp; two</h2>",
          "<p><i>K</i></p>", "id=\"figure-a\"", "<caption>Runs</caption>", "class=\"number\">2",
          "--set a.b=&lt;c&gt;", "</html>"}) {
        INFO(piece);
        const std::size_t found = html.find(piece, at);
        REQUIRE(found != std::string::npos);
        at = found;
    }
}

TEST_CASE("a table's rows are as wide as its header") {
    Page page("t", "l");
    CHECK_THROWS_AS(page.table({"Runs", {"name", "value"}, {{"a"}}}), std::logic_error);
}

TEST_CASE("text from a file shows as it is written, wherever it stands in a page") {
    const std::string evil = "<script>x</script>\"&";
    Page page(evil, evil);
    page.section(evil);
    page.prose(evil);
    page.prose(Html::raw("<b>") + evil + Html::raw("</b>"));
    page.figure({"f", evil, evil, {}});
    page.table({evil, {evil}, {{evil}}});
    page.tiles({{evil, evil}});
    page.code(evil);
    const std::string html = page.html();
    CHECK(html.find("<script") == std::string::npos);
    CHECK(html.find("\"&\"") == std::string::npos);
    CHECK(html.find("<b>&lt;script&gt;x&lt;/script&gt;&quot;&amp;</b>") != std::string::npos);
}
