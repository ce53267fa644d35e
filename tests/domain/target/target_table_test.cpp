#include "domain/errors.hpp"
#include "domain/target/target.hpp"
#include "domain/target/target_table.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE(
    "a target reads the same with commas, with semicolons or tabs and decimal commas, and after a mark") {
    const tests::Folder folder;
    const std::string names = "pressure_MPa,stiffness_MPa_per_mm";
    for (const std::string& text :
         {names + "\n1e-6,0.5\n2.5e-6,1.25\n", "\xEF\xBB\xBF" + names + "\r\n1e-6, 0.5\r\n2.5e-6,1.25\r\n",
          std::string("pressure_MPa;stiffness_MPa_per_mm\n1e-6;0,5\n2,5e-6;1,25\n"),
          std::string("pressure_MPa;stiffness_MPa_per_mm\n1e-6;0.5\n2.5e-6;1.25\n"),
          std::string("pressure_MPa\tstiffness_MPa_per_mm\n1e-6\t0,5\n2,5e-6\t1.25\n\n")}) {
        INFO(text);
        const Target target = read_target(folder.write("t.csv", text));
        REQUIRE(target.points() == 2);
        CHECK(target.x == Eigen::Vector2d(1e-6, 2.5e-6));
        CHECK(target.y == Eigen::Vector2d(0.5, 1.25));
    }
}

TEST_CASE("a target's line that is no row is named") {
    const tests::Folder folder;
    const auto read = [&](const std::string& text) { read_target_table(folder.write("t.csv", text)); };
    CHECK_THROWS_WITH(read("a,b\n1,2\n0,5,1\n"),
                      Catch::Contains("t.csv:3: \"0,5,1\" given, expected 2 numbers"));
    CHECK_THROWS_WITH(read("a;b\n\n1;x\n"),
                      Catch::Contains("t.csv:3: \"x\" given, expected a finite number"));
    CHECK_THROWS_WITH(read("a;b\n1;nan\n"), Catch::Contains("t.csv:2: \"nan\" given"));
}
