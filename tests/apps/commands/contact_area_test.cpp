#include "domain/text/atomic_file.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

using namespace app::testing;

TEST_CASE("a genome of one ridge pressed as a periodic area has its profile's curve") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const std::string common = "contact --genome g.json --kernel periodic --steps 6 --solver nested ";
    succeeded(rugosa(common + "--nodes 40x6 --length 0.84942x0.1 --out area.csv", folder.path()));
    succeeded(rugosa(common + "--nodes 40 --out line.csv", folder.path()));
    const auto of_area = rows_of(folder / "area.csv"), of_line = rows_of(folder / "line.csv");
    REQUIRE(of_area.size() == 6);
    for (std::size_t j = 0; j < 6; ++j)
        for (const std::size_t column : {0, 1, 2, 3, 5})
            CHECK(of_area[j][column] == Approx(of_line[j][column]).epsilon(1e-9));
    const auto spots = rows_of(folder / "area-spots.csv"); // the wave's one stripe, whole round the period
    REQUIRE(spots.size() == 1);
    CHECK(spots[0][0] / 240 == Approx(of_line[5][2]));
}

TEST_CASE("a map in micrometres is pressed on its own nodes, and scales as its unit") {
    const Folder folder;
    folder.write("um.txt", "0 1 0.5\n0.25 3 1\n0 1.5 2.5\n0.5 0 1\n");
    folder.write("mm.txt", "0 0.001 0.0005\n0.00025 0.003 0.001\n0 0.0015 0.0025\n0.0005 0 0.001\n");
    succeeded(rugosa("contact --surface um.txt --unit um --spacing 10x20 --detrend none --out um.csv",
                     folder.path()));
    succeeded(
        rugosa("contact --surface mm.txt --spacing 0.01x0.02 --detrend none --out mm.csv", folder.path()));
    const auto one = rows_of(folder / "um.csv"), other = rows_of(folder / "mm.csv");
    REQUIRE(one.size() == 20);
    for (std::size_t j = 0; j < 20; ++j) {
        CHECK(one[j][1] == Approx(other[j][1]).epsilon(1e-12));
        CHECK(one[j][5] > one[j][3]); // K_i
    }
    CHECK(one.back()[0] == Approx(0.003));
}

TEST_CASE("an area's page shows where it touches, with as many spots as the table beside the curve") {
    const Folder folder;
    folder.write("m.txt", "0 1 0 0\n0 0 0 0.9\n0 0 0 0\n0.8 0 0 0\n"); // peaks that are no neighbours
    succeeded(rugosa("contact --surface m.txt --spacing 1 --steps 2 --reach 0.5 --out c.csv --report c.html",
                     folder.path()));
    CHECK(rows_of(folder / "c-spots.csv").size() == 3);
    const std::string page = rough::read_whole(folder / "c.html");
    std::size_t pictures = 0;
    for (auto at = page.find("<image"); at != std::string::npos; at = page.find("<image", at + 1))
        ++pictures;
    CHECK(pictures == 3); // heights, and the pressure of two steps
    REQUIRE(rugosa("report c.json --out again.html", folder.path()).code == 0);
    CHECK(rough::read_whole(folder / "again.html") == page);
}

TEST_CASE("within an accuracy one line answers for a map whose ridges it follows, and says so") {
    const Folder folder;
    folder.write("g.json", one_wave);
    const std::string common = "contact --genome g.json --kernel periodic --steps 5 ";
    const Ended line = rugosa(common + "--nodes 40 --out line.csv", folder.path()),
                area = rugosa(common + "--nodes 40x16 --length 0.84942x0.1 --accuracy 1e-3 --out area.csv",
                              folder.path());
    INFO(area.err);
    REQUIRE(area.code == 0);
    CHECK_THAT(area.out, Catch::Contains("One line, the mean along the lay, answers for the map"));
    const auto of_area = rows_of(folder / "area.csv"), of_line = rows_of(folder / "line.csv");
    for (std::size_t j = 0; j < 5; ++j)
        for (const std::size_t column : {0, 1, 2, 3})
            CHECK(of_area[j][column] == Approx(of_line[j][column]).epsilon(1e-6));
    CHECK(rows_of(folder / "area-spots.csv")[0][0] == Approx(of_line[4][2] * 640));
    CHECK_THAT(rough::read_whole(folder / "area.json"), Catch::Contains("\"by_line\": true"));
    std::string bumps; // of every direction
    for (int j = 0; j < 12; ++j) {
        for (int i = 0; i < 12; ++i)
            bumps += std::to_string(std::cos(i * M_PI / 6) * std::cos(j * M_PI / 6) +
                                    0.1 * std::cos(i * M_PI / 6)) +
                     " ";
        bumps += "\n";
    }
    folder.write("map.txt", bumps);
    const Ended map =
        succeeded(rugosa("contact --surface map.txt --spacing 1 --kernel periodic --reach 0.05 --steps 4 "
                         "--accuracy 0.01 --out m.csv",
                         folder.path()));
    CHECK_THAT(map.out, Catch::Contains("would not have answered"));
}
