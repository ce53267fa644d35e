#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/bytes.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/scan/instrument_files.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

const Profile relief =
    maps::map_of({6, 4}, 0.01, 0.025, [](double x, double y) { return 1e-3 * std::sin(300 * x) - y; });

Map read(const std::string& bytes, const MapLayout& layout = {}) {
    const tests::Folder folder;
    return read_map(folder.write("map", bytes), layout);
}

std::string refusal(const std::string& bytes, const MapLayout& layout = {}) {
    try {
        read(bytes, layout);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("a map written as X3P is read back with both spacings", "[map]") {
    const Map map = read(x3p(relief));
    CHECK(map.heights.shape() == relief.shape());
    CHECK(map.heights.spacing == Approx(0.01).epsilon(1e-14));
    CHECK(map.heights.row_spacing == Approx(0.025).epsilon(1e-14));
    CHECK((map.heights.heights - relief.heights).cwiseAbs().maxCoeff() < 1e-16);
    CHECK_THAT(map.account, Catch::Contains("X3P"));
    CHECK_THAT(refusal(x3p(relief), {.spacing = 0.02}), Catch::Contains("its own spacing along x is 0.01"));
    CHECK_THAT(refusal(x3p(relief), {.unit = "um"}), Catch::Contains("heights are in m"));
}

TEST_CASE("a matrix and points x, y, height in any order are the same map", "[map]") {
    const std::string matrix = "1 2 3\n4 5 6\n";
    const Map by_rows = read(matrix, {.unit = "um", .spacing = 10, .row_spacing = 20});
    const Map by_points = read("20 20 6\n0 0 1\n10 0 2\n0 20 4\n20 0 3\n10 20 5\n", {.unit = "um"});
    for (const Map* map : {&by_rows, &by_points}) {
        CHECK(map->heights.shape() == Extent{3, 2});
        CHECK(map->heights.spacing == Approx(0.01));
        CHECK(map->heights.row_spacing == Approx(0.02));
        for (Index k = 0; k < 6; ++k)
            CHECK(map->heights.heights[k] == Approx(1e-3 * double(k + 1)));
    }
}

TEST_CASE("a text in a named format is read as that map", "[map]") {
    const Map map = read("aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-5\nYscale = 2e-5\n"
                         "Zscale = 1e-6\nDataType = 5\n*\n1 2 3\n4 5 6\n*\n");
    CHECK(map.heights.shape() == Extent{3, 2});
    CHECK(map.heights.spacing == Approx(0.01));
    CHECK(map.heights.row_spacing == Approx(0.02));
    for (Index k = 0; k < 6; ++k)
        CHECK(map.heights.heights[k] == Approx(1e-3 * double(k + 1)));
    CHECK_THAT(refusal(testing::gsf_file()), Catch::Contains("row 2: no height in column 8; give 9"));
}

TEST_CASE("an incomplete map is refused with its place", "[map]") {
    CHECK_THAT(refusal("1 2 3 4\n4 5 6 7\n"), Catch::Contains("distance of its nodes"));
    CHECK_THAT(refusal("0 0 1\n1 0 2\n0 1 3\n"), Catch::Contains("no height at x = 1, y = 1"));
    CHECK_THAT(refusal("0 0 1\n1 0 2\n0 1 3\n1 1 4\n0 0 5\n"), Catch::Contains("line 5"));
    CHECK_THAT(refusal("0 0 1\n1 0 2\n3 0 2\n0 1 3\n1 1 4\n3 1 5\n"), Catch::Contains("even steps"));
    CHECK_THAT(refusal("1 2 3 4\n", {.spacing = 1, .row_spacing = 1}), Catch::Contains("2 x 2"));
}

TEST_CASE("a map's VTK file has every point, highest byte first", "[map]") {
    const std::string bytes = vtk(relief);
    CHECK_THAT(bytes, Catch::StartsWith("# vtk DataFile Version 3.0\n"));
    CHECK_THAT(bytes, Catch::Contains("DIMENSIONS 6 4 1\nPOINTS 24 double\n"));
    const std::string mark = "POINTS 24 double\n";
    const std::size_t first = bytes.find(mark) + mark.size();
    const auto number = [&](std::size_t k) {
        const std::string word(bytes.rbegin() + long(bytes.size() - first - 8 * (k + 1)),
                               bytes.rbegin() + long(bytes.size() - first - 8 * k));
        return little_endian<double>(word, 0);
    };
    for (const std::size_t k : {0, 5, 13, 23}) {
        CHECK(number(3 * k) == Approx(0.01 * double(k % 6)).margin(1e-18));
        CHECK(number(3 * k + 1) == Approx(0.025 * double(k / 6)).margin(1e-18));
        CHECK(number(3 * k + 2) == relief.heights[Index(k)]);
    }
    CHECK_THAT(bytes.substr(first + 24 * 24),
               Catch::StartsWith("\nPOINT_DATA 24\nSCALARS height_mm double 1\n"));
}
