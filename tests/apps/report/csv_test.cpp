#include "apps/report/csv.hpp"
#include "tests/catch.hpp"

#include <cmath>

using app::Csv;

TEST_CASE("an unknown number is an empty cell") {
    Csv table("a,b,c");
    table.row(std::nan(""), nullptr, 1.5);
    table.row(std::nan(""), 2, std::string("x"));
    CHECK(table.text() == "a,b,c\n,,1.5\n,2,x\n");
    CHECK(app::csv({"a", "b"}, {Eigen::Vector2d(1, std::nan("")), Eigen::Vector2d(2, 3)}) == "a,b\n1,2\n,3\n");
}

TEST_CASE("no word in a cell is a formula to a spreadsheet, and numbers stay numbers") {
    const auto cell = [](const std::string& word) {
        Csv table("a");
        table.row(word);
        return table.text().substr(2);
    };
    CHECK(cell("=1+1") == "\"'=1+1\"\n");
    CHECK(cell("+cmd|' /C calc'!A0") == "\"'+cmd|' /C calc'!A0\"\n");
    CHECK(cell("@sum(\"a\")") == "\"'@sum(\"\"a\"\")\"\n");
    CHECK(cell("-x") == "\"'-x\"\n");
    CHECK(cell("-1.5e-3") == "-1.5e-3\n");
    CHECK(cell("+2") == "+2\n");
    CHECK(cell("sog") == "sog\n");
}
