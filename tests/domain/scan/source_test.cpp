#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/scan/source.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("a genome file and a scan are sources, each with its grid") {
    const tests::Folder folder;
    const auto genome = folder.write("g.json", R"({"length_mm":2,"series":[{"A":1,"H":0.8,"gamma":1.5,)"
                                               R"("lambda":2,"chromosomes":[{"n":1,"phases":[0.3]}]}]})");
    const auto scan = folder.write("s.txt", "1\n3\n0.5\n2\n1\n");
    const Source waves = open_genome(genome),
                 points = open_scan(scan, {.spacing = 0.1, .detrend = Detrend::none});

    CHECK(waves.grid().length == 2);
    CHECK(waves.on(waves.grid()).heights == sample(*waves.genome, waves.grid()).heights);
    CHECK(points.grid().nodes == 5);
    CHECK(points.grid().length == 4 * 0.1);
    CHECK(points.grid(true).length == 5 * 0.1);
    CHECK(points.on(points.grid()).spacing == 0.1);
    CHECK(points.on(points.grid()).heights == (Eigen::VectorXd(5) << 1, 3, 0.5, 2, 1).finished());

    Grid longer = points.grid();
    longer.length = 0.8;
    CHECK(points.on(longer).spacing == longer.spacing());
    longer.nodes = 6;
    CHECK_THROWS_WITH(points.on(longer), Catch::Contains("grid of 6 nodes") && Catch::Contains("scan's 5"));
}

TEST_CASE("a column of heights keeps the given spacing to the bit") {
    const tests::Folder folder;
    std::string heights;
    for (int i = 0; i < 301; ++i)
        heights += std::to_string(i % 7) + "\n";
    const auto file = folder.write("s.txt", heights);
    for (const double spacing : {0.004, 0.1, 1.0 / 3, 7e-5})
        CHECK(open_scan(file, {.spacing = spacing}).measured.spacing == spacing);
}
