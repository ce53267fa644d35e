#include "domain/scan/map.hpp"
#include "domain/scan/scan.hpp"
#include "tests/domain/scan/quirk_files.hpp"
#include "tests/domain/scan/refusal.hpp"
#include "tests/folder.hpp"

#include <cstring>

using namespace rough;

namespace {

Scan read(const std::string& bytes, ScanOptions options = {.detrend = Detrend::none}) {
    const tests::Folder folder;
    return open_scan(folder.write("scan.txt", bytes), options);
}

std::string refusal(const std::string& bytes, ScanOptions options = {.detrend = Detrend::none}) {
    return testing::refusal_of([&] { return read(bytes, options); });
}

std::string rows(int count, auto height) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + " " + std::to_string(height(i)) + "\n";
    return text;
}

const std::string four_rows = "1 2\n2 3\n3 5\n4 1\n";

} // namespace

TEST_CASE("files with different quirks of real scans give the same profile") {
    const auto files = quirk_files();
    REQUIRE(files.size() >= 30);
    for (const QuirkFile& file : files) {
        INFO(file.quirk << "\n" << file.bytes);
        const Scan scan = read(file.bytes, {.unit = file.unit, .spacing = file.spacing, .detrend = Detrend::none});
        INFO(scan.account);
        CHECK(scan.measured.spacing == Approx(quirk_spacing).epsilon(1e-4));
        REQUIRE(scan.measured.nodes() == Index(quirk_heights.size()));
        for (std::size_t i = 0; i < quirk_heights.size(); ++i)
            CHECK(scan.measured.heights[Index(i)] == Approx(quirk_heights[i]).epsilon(1e-12));
        CHECK(scan.account.find('\n') == std::string::npos);
        CHECK_THAT(scan.account, Catch::Contains("8 points"));
    }
}

TEST_CASE("the requested row of an areal matrix is taken, from 1") {
    const std::string matrix = "1 2 3 4\n5 6 7 9\n0 0 1 0\n";
    ScanOptions options{.unit = "um", .spacing = 2, .detrend = Detrend::none, .row = 2};
    const Scan scan = read(matrix, options);
    CHECK(scan.measured.heights.isApprox(1e-3 * Eigen::Vector4d(5, 6, 7, 9)));
    CHECK(scan.measured.spacing == Approx(2e-3));
    CHECK_THAT(scan.account, Catch::Contains("row 2 of 3 rows of 4 heights"));
    options.row = 3;
    CHECK(read("# map\n" + matrix, options).measured.heights[2] == Approx(1e-3));
    options.row = 4;
    CHECK_THAT(refusal(matrix, options), Catch::Contains("row 4 of 3 rows"));
    options.row = 1;
    CHECK_THAT(refusal("0 1\n1 2\n2 1\n", options), Catch::Contains("row 1 of 3 rows of 2"));
    CHECK_THAT(refusal("1 NaN 3 4\n5 6 7 9\n", options), Catch::Contains("missing"));
    options.spacing = 0;
    CHECK_THAT(refusal(matrix, options), Catch::Contains("spacing"));
}

TEST_CASE("a unit is refused only if it contradicts the header") {
    CHECK_THAT(refusal("x [mm];z [um]\n0;1\n1;2\n2;1\n", {.unit = "mm"}),
               Catch::Contains("header gives heights in µm"));
    CHECK_THAT(refusal("x [um];z [um]\n0;1\n1;2\n2;1\n", {.unit = "nm"}), Catch::Contains("header gives x in µm"));
    CHECK_NOTHROW(read("x [um];z [um]\n0;1\n1;2\n2;1\n", {.unit = "micron"}));
    CHECK_THAT(refusal("0 1\n1 2\n2 1\n", {.unit = "furlong"}), Catch::Contains("'furlong'") && Catch::Contains("µm"));
    CHECK_THAT(refusal("x [mm];z [V]\n0;1\n1;2\n2;1\n"), Catch::Contains("line 1") && Catch::Contains("'V'"));
}

TEST_CASE("an unknown unit is refused by its name unless a unit is given") {
    for (const std::string header : {"x [ft]\tz [ft]", "x (ft);z (ft)"}) {
        CHECK_THAT(refusal(header + "\n0 1\n1 2\n2 1\n"),
                   Catch::Contains("a column in 'ft'") && Catch::Contains("or give one"));
        CHECK_NOTHROW(read(header + "\n0 1\n1 2\n2 1\n", {.unit = "in"}));
    }
    for (const std::string header : {"x (raw);z (filtered)", "[X];[Z]", "x [0];z [1]"})
        CHECK_NOTHROW(read(header + "\n0;1\n1;2\n2;1\n"));
}

TEST_CASE("a missing value is refused with its line, or filled linearly on request, at an end left out") {
    for (const std::string missing : {"NaN", "nan", "BAD", "--", "n/a", ""}) {
        INFO(missing);
        const std::string text = "x;z\n0;1\n1;" + missing + "\n2;3\n3;0\n";
        CHECK_THAT(refusal(text), Catch::Contains("line 3") && Catch::Contains("a height"));
        const Scan scan = read(text, {.detrend = Detrend::none, .fill = true, .max_filled = 0.5});
        CHECK(scan.measured.heights[1] == Approx(2));
        CHECK_THAT(scan.account, Catch::Contains("1 missing point (25 %), largest hole 1 mm filled linearly"));
    }
    CHECK_THAT(refusal("x;z\n0;1\n;2\n2;3\n3;0\n"), Catch::Contains("line 3") && Catch::Contains("an x"));
    const std::string invalid = "X;Y;valid\n[mm];[mm];[1/0]\n0;1;1\n1;9;0\n2;3;1\n";
    CHECK_THAT(refusal(invalid), Catch::Contains("line 4"));
    CHECK(read(invalid, {.detrend = Detrend::none, .fill = true, .max_filled = 0.5}).measured.heights[1] == Approx(2));
    CHECK_THAT(refusal("1\nnan\n3\n", {.spacing = 1}), Catch::Contains("line 2"));
    const Scan scan =
        read("0 nan\n1 2\n2 nan\n3 6\n4 1\n5 nan\n", {.detrend = Detrend::none, .fill = true, .max_filled = 0.5});
    REQUIRE(scan.measured.nodes() == 4);
    CHECK(scan.measured.heights[1] == Approx(4));
    CHECK_THAT(scan.account, Catch::Contains("2 incomplete points left out"));
}

TEST_CASE("unevenly spaced points are resampled on the straight lines between them") {
    const Scan scan = read("0 0\n1 2\n4 8\n10 20\n11 0\n");
    CHECK(scan.measured.spacing == Approx(11. / 4));
    for (Index i = 0; i < 4; ++i) CHECK(scan.measured.heights[i] == Approx(2 * 11. / 4 * double(i)));
    CHECK(scan.measured.heights[4] == Approx(0).margin(1e-12));
    CHECK_THAT(scan.account,
               Catch::Contains("spacing uneven (1 to 6 mm); resampled linearly to 5 evenly spaced nodes"));
    CHECK(read("0 0\n1 2\n4 8\n10 20\n11 0\n", {.detrend = Detrend::none, .nodes = {45}}).measured.heights[4] ==
          Approx(2));
}

TEST_CASE("a spacing rounded in its last digit is even and leaves heights unchanged") {
    const double spacing = 0.0000995587;
    std::string text;
    Eigen::VectorXd heights(5000);
    for (int i = 0; i < 5000; ++i) {
        char line[64];
        std::snprintf(line, sizeof line, "%.6f\t%.6f\n", i * spacing, std::sin(0.01 * i));
        text += line;
        heights[i] = std::strtod(std::strchr(line, '\t'), nullptr);
    }
    const Scan scan = read(text);
    CHECK(scan.measured.spacing == Approx(spacing).epsilon(1e-7));
    CHECK(scan.measured.heights == heights);
    CHECK_THAT(scan.account, Catch::Contains("treated as even"));
}

TEST_CASE("points out of order are refused with their line") {
    CHECK_THAT(refusal("0 1\n1 2\n0.5 1\n2 0\n"), Catch::Contains("line 3") && Catch::Contains("does not grow"));
    CHECK_THAT(refusal("1 1\n0.25 2\n5 1\n7 0\n"), Catch::Contains("line 2") && Catch::Contains("0.25 mm after 1 mm"));
}

TEST_CASE("a file that is not a line scan is refused in one line with the reason") {
    CHECK_THAT(refusal(""), Catch::Contains("contains no numbers"));
    CHECK_THAT(refusal(std::string("\x89PNG\0\0\1", 7)), Catch::Contains("binary"));
    CHECK_THAT(refusal("1\n2\n0\n"), Catch::Contains("give the spacing"));
    CHECK_THAT(refusal("0.5 1\n1 2\n2 1\n", {.spacing = 0.5}), Catch::Contains("two columns"));
    CHECK_THAT(refusal("1 2 3 4\n5 6 7 9\n"), Catch::Contains("the row to take of a map, or the map as a surface"));
    for (const std::string names : {"", "x z valid\n"}) // validity is 0 or 1
        CHECK_THAT(refusal(names + "0 1 1\n1 2 0.5\n3 1 0\n"), Catch::Contains("3 columns"));
    CHECK_THAT(refusal("0 1\r\n1 2\r2 here\n3 1\n"), Catch::Contains("line 3") && Catch::Contains("2 here"));
    CHECK_THAT(refusal("0 1\n1 2\n2 3 4\n3 1\n"), Catch::Contains("line 3") && Catch::Contains("3 columns"));
    CHECK_THAT(refusal("0 1\n"), Catch::Contains("1 point"));
    CHECK_THAT(refusal("0 1\n1 1\n2 1\n"), Catch::Contains("constant"));
    CHECK_THAT(refusal("dx = 0.5 um\n1\n2\n1\n", {.spacing = 7}), Catch::Contains("0.0005 mm"));
    CHECK_THAT(refusal("0 1\n1 2\n2 1\n", {.nodes = {1}}), Catch::Contains("2 to 1e7"));
    CHECK_THROWS_WITH(open_scan("no/such/scan.txt"), Catch::Contains("no/such/scan.txt"));
}

TEST_CASE("an export that is not a profile, or ends early, is refused with its line") {
    const std::string head = "aISO-1.0\nNumPoints = 3\nNumProfiles = 1\nXscale = 1e-6\nZscale = 1e-6\n";
    CHECK_THAT(refusal("aISO-1.0\nXscale = 1e-6\nNumProfiles = 4\n*\n1\n2\n1\n*\n"),
               Catch::Contains("3 heights") && Catch::Contains("NumProfiles times"));
    CHECK_THAT(refusal(head + "*\n1\n2\n"), Catch::Contains("ends early"));
    CHECK_THAT(refusal(head + "*\n1\nx\n3\n*\n"), Catch::Contains("line 8") && Catch::Contains("'x'"));
    CHECK_THAT(refusal(head + "DataType = 5\n*\n1\n-32768\n3\n*\n"),
               Catch::Contains("line 9") && Catch::Contains("missing"));
    CHECK_THAT(read(head + "*\n1\n2\n1\n2\n*\n").account, Catch::Contains("announces 3 points"));
    const std::string gauge = "ISO 5436 - 2000 a\nPRF 1 b\n";
    CHECK_THAT(refusal(gauge + "CX A 3 mm 1.0e0 D\nCZ A 3 um 1.0e0 D\n\x03\n\x03\n1\n2\n1\n\x03\n"),
               Catch::Contains("line 3") && Catch::Contains("incremental"));
    CHECK_THAT(refusal(gauge + "CX I 3 mm 1.0e0 D 1e-3\nCZ A 3 parsec 1.0e0 D\n"),
               Catch::Contains("line 4") && Catch::Contains("length unit"));
    CHECK_THAT(refusal("1 2\na 0 PRF\nCX M 3 MM 1 D\nCZ M 3 UM 1 L\nEOR\nEOR\n1\n2\n1\nEOR\n"),
               Catch::Contains("line 6") && Catch::Contains("SPACING CX"));
    CHECK_THAT(refusal("SigmaSurf_Data 1.0\nPROFILE_UM:\n1\n2\n"), Catch::Contains("SPACING_UM"));
}

TEST_CASE("only the mean, line or parabola is removed, exactly") {
    const auto polynomial = [](int i) { return 3 - 0.5 * i + 0.02 * i * i; };
    const auto bump = [](int i) { return i == 10 ? 1. : 0.; };
    const auto with_bump = [&](int i) { return polynomial(i) + bump(i); };
    const Eigen::VectorXd heights = read(rows(41, with_bump), {.detrend = Detrend::parabola}).measured.heights;
    const Eigen::VectorXd alone = read(rows(41, bump), {.detrend = Detrend::parabola}).measured.heights;
    CHECK((heights - alone).cwiseAbs().maxCoeff() < 1e-12 * polynomial(40));
    const Eigen::ArrayXd i = Eigen::ArrayXd::LinSpaced(41, 0, 40);
    for (const Detrend form : {Detrend::mean, Detrend::line, Detrend::parabola}) {
        const Eigen::ArrayXd rest = read(rows(41, with_bump), {.detrend = form}).measured.heights.array();
        CHECK(std::abs(rest.sum()) < 1e-10);
        if (form != Detrend::mean) CHECK(std::abs((rest * i).sum()) < 1e-9);
        if (form == Detrend::parabola) CHECK(std::abs((rest * i * i).sum()) < 1e-7);
    }
    CHECK(read(rows(5, polynomial)).measured.heights[2] == Approx(polynomial(2)));
}

TEST_CASE("the form of a polynomial or an arc is removed exactly") {
    Profile profile{Eigen::VectorXd(301), 0.01};
    Eigen::VectorXd quartic(301), rest(301);
    const double radius = 20, steep = 0.05; // mm; no parabola fits this arc to 1e-12
    for (Index i = 0; i < 301; ++i) {
        const double x = 0.01 * double(i) - 1.5;
        profile.heights[i] = 3 - std::sqrt(radius * radius - std::pow(x - radius * steep, 2));
        quartic[i] = 1 - x + 0.3 * x * x + 0.2 * x * x * x - 0.1 * x * x * x * x;
        rest[i] = 1e-5 * std::cos(31 * x);
    }
    CHECK(detrended(profile, Detrend::arc).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(detrended(profile, Detrend::parabola).cwiseAbs().maxCoeff() > 1e-8);
    CHECK(detrended({-profile.heights, 0.01}, Detrend::arc).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(detrended({quartic, 0.01}, Detrend::quartic).cwiseAbs().maxCoeff() < 1e-13);
    CHECK(detrended({quartic, 0.01}, Detrend::cubic).cwiseAbs().maxCoeff() > 1e-3);
    CHECK((detrended({profile.heights + rest, 0.01}, Detrend::arc) - rest).cwiseAbs().maxCoeff() < 3e-6);
    // a profile without curvature is its line
    const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(301, 0, 1);
    CHECK(detrended({line, 0.01}, Detrend::arc).cwiseAbs().maxCoeff() < 1e-12);
    CHECK_THROWS_WITH(detrended({1e3 * Eigen::VectorXd::Random(301), 1e-9}, Detrend::arc), Catch::Contains("no arc"));
}

TEST_CASE("outliers are reported, and replaced on request") {
    const auto wave = [](int i) { return std::cos(0.1 * i) + (i == 40 ? 3 : 0); };
    const Scan kept = read(rows(90, wave)),
               removed = read(rows(90, wave), {.detrend = Detrend::none, .remove_outliers = true});
    CHECK_THAT(kept.account, Catch::Contains("1 outlier (at x = 40 mm) kept"));
    CHECK_THAT(removed.account, Catch::Contains("1 outlier (at x = 40 mm) replaced"));
    CHECK(kept.measured.heights[40] > 2);
    CHECK(removed.measured.heights[40] == Approx(std::cos(4.)).margin(0.01));
    CHECK(removed.measured.heights[41] == kept.measured.heights[41]);
}

TEST_CASE("filters remove short and long waves after the form, as the account states") {
    const auto waves = [](double x) { return std::cos(2 * M_PI * x / 40) + 0.1 * std::cos(2 * M_PI * x / 4); };
    const auto text = rows(800, [&](int i) { return waves(0.1 * i); });
    ScanOptions options{.detrend = Detrend::none, .lambda_c = 80}; // mm, at a spacing of 1 mm
    const Scan scan = read(text, options);
    CHECK_THAT(scan.account, Catch::Contains("waves over lambda_c = 80 mm removed"));
    CHECK(scan.measured.heights[400] ==
          Approx(waves(40.) - std::pow(2, -std::pow(80. / 400, 2)) * 1 - 0.1 * std::pow(2, -std::pow(80. / 40, 2)))
              .margin(1e-4));
    options.lambda_s = 80;
    CHECK_THAT(refusal(text, options), Catch::Contains("less than lambda-c"));
    options.lambda_s = -1;
    CHECK_THAT(refusal(text, options), Catch::Contains("lambda-s: -1"));
}

TEST_CASE("x and heights may have different given units") {
    const Scan scan = read("0 1\n1 3\n2 1\n", {.unit = "um,nm", .detrend = Detrend::none});
    CHECK((scan.measured.spacing == Approx(1e-3) && scan.measured.heights[1] == Approx(3e-6)));
    CHECK_THAT(scan.account, Catch::Contains("x in µm (given), heights in nm (given)"));
    CHECK(read("1\n3\n1\n", {.unit = "um,nm", .spacing = 2, .detrend = Detrend::none}).measured.spacing ==
          Approx(2e-3));
    CHECK_THAT(refusal("0 1\n1 3\n2 1\n", {.unit = "um,parsec"}), Catch::Contains("parsec"));
    CHECK_THAT(refusal("x [um] z [nm]\n0 1\n1 3\n2 1\n", {.unit = "um,um"}), Catch::Contains("heights in nm"));
}

TEST_CASE("a count of points may precede them, up to 1e9") {
    CHECK_THAT(read("4\n" + four_rows).account, Catch::Contains(": 4 points") && !Catch::Contains("announces"));
    CHECK_THAT(read("5\n0 99\n1 101\n2 99\n3 101\n").account,
               Catch::Contains(": 4 points, length 3 mm, height range 2 mm, rms 1 mm; ") &&
                   Catch::Contains("the file announces 5 points"));
    CHECK_THAT(refusal("12345678901234567890\n" + four_rows), Catch::Contains("missing value"));
    CHECK_THAT(refusal("SigmaSurf_Data\nSPACING_UM: 0.25\nNUMBER_OF_POINTS: 1e300\nPROFILE_UM:\n1\n2\n"),
               Catch::Contains("up to 1e9"));
}

TEST_CASE("a map is resampled to other cells of the same area", "[map]") {
    const tests::Folder folder;
    const auto resampled = [&](Extent from, Extent to, const std::function<double(double, double)>& height) {
        std::ostringstream text;
        text.precision(17);
        for (Index j = 0; j < from.rows; ++j)
            for (Index i = 0; i < from.columns; ++i)
                text << height((static_cast<double>(i) + 0.5) / static_cast<double>(from.columns),
                               (static_cast<double>(j) + 0.5) / static_cast<double>(from.rows))
                     << (i + 1 < from.columns ? " " : "\n");
        ScanOptions options{.spacing = 1. / static_cast<double>(from.columns),
                            .row_spacing = 2. / static_cast<double>(from.rows),
                            .detrend = Detrend::none};
        options.nodes = to;
        const Scan map = read_map(folder.write("map.txt", text.str()), options);
        CHECK(map.measured.shape() == to);
        const Grid grid = grid_of(map.measured);
        CHECK((grid.length == Approx(1) && grid.width == Approx(2)));
        double worst = 0;
        for (Index node = 0; node < map.measured.nodes(); ++node)
            worst = std::max(
                worst, std::abs(map.measured.heights[node] -
                                height((static_cast<double>(node % to.columns) + 0.5) / static_cast<double>(to.columns),
                                       (static_cast<double>(node / to.columns) + 0.5) / static_cast<double>(to.rows))));
        return worst;
    };
    const auto plane = [](double x, double y) { return 0.3 * x - 0.7 * y; };
    const auto bump = [](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); };
    for (const auto& [from, to] : {std::pair(Extent{12, 9}, Extent{31, 27}), std::pair(Extent{31, 27}, Extent{12, 9}),
                                   std::pair(Extent{12, 27}, Extent{31, 9}), std::pair(Extent{8, 8}, Extent{4, 2})}) {
        INFO(from.columns << " x " << from.rows << " to " << to.columns << " x " << to.rows);
        CHECK(resampled(from, to, plane) < 1e-14);
    }
    const double coarse = resampled({32, 32}, {80, 80}, bump), fine = resampled({64, 64}, {160, 160}, bump);
    CHECK(coarse / fine == Approx(4).epsilon(0.1)); // second order, up to the edges
    const double many = resampled({64, 64}, {20, 20}, bump), more = resampled({128, 128}, {40, 40}, bump);
    CHECK(many / more == Approx(4).epsilon(0.1));

    ScanOptions holed{.spacing = 1, .fill = true, .max_filled = 0.5};
    holed.nodes = {8};
    CHECK_THROWS_WITH(read_map(folder.path() / "map.txt", holed), Catch::Contains("1 along y is out of range"));
    holed.nodes = {8, 4};
    CHECK(read_map(folder.write("holes.txt", "1 2 3 4\n5 nan 7 2\n3 1 2 1\n2 4 1 3\n"), holed).missing.nodes ==
          std::vector<Index>{8, 9, 10, 11, 12}); // height 5 continues to the edge
}

TEST_CASE("points on a diagonal are refused as a map") {
    std::string places; // a grid through them has 4e10 nodes
    for (int i = 0; i < 200'000; ++i) places += std::to_string(i) + " " + std::to_string(i) + ".5 1\n";
    const tests::Folder folder;
    CHECK_THROWS_WITH(read_map(folder.write("grid.txt", places), {}), Catch::Contains("give a whole grid"));
}

TEST_CASE("a text map's header gives units and spacings, or is refused", "[map]") {
    const std::string matrix = "1 2 3 4\n5 6 7 8\n9 8 7 6\n", list = "0 0 1\n2 0 2\n0 2 3\n2 2 5\n";
    const auto map = [](const std::string& text, ScanOptions options = {}) {
        const tests::Folder folder;
        options.detrend = Detrend::none;
        return read_map(folder.write("map.txt", text), options);
    };
    for (const std::string head :
         {"# Value units: um", "# Unit: um", "# unit = um", "# z [um]", "# Data unit: um", "\"Unit\",\"um\""}) {
        INFO(head);
        const Scan read = map(head + "\n" + matrix, {.spacing = 0.5});
        CHECK(read.measured.heights[5] == Approx(6e-3));
        CHECK_THAT(read.account, Catch::Contains("heights in µm (header), spacing in mm (assumed)"));
        CHECK_THROWS_WITH(map(head + "\n" + matrix, {.unit = "mm", .spacing = 0.5}), Catch::Contains("heights in µm"));
    }
    const std::string sides = "Width: 2.00 um\nHeight: 6.0 um\n";
    CHECK(map(sides + matrix).measured.spacing == Approx(5e-4));
    CHECK(map(sides + matrix, {.unit = "mm,nm"}).measured.row_spacing == Approx(2e-3));
    CHECK(map(sides + matrix, {.unit = "mm,nm"}).measured.heights[0] == Approx(1e-6));
    CHECK_THROWS_WITH(map(sides + matrix, {.spacing = 1}), Catch::Contains("spacing along x of 0.0005 mm"));
    const Scan wyko = map("Pixel_size\t7\t4\t0.0005\n" + matrix);
    CHECK((wyko.measured.spacing == 0.0005 && wyko.measured.row_spacing == 0.0005));

    const Scan points = map("x [um] y [um] z [nm]\n" + list, {.spacing = 0.002});
    CHECK((points.measured.shape() == Extent{2, 2} && points.measured.spacing == Approx(2e-3)));
    CHECK(points.measured.heights[3] == Approx(5e-6));
    CHECK_THROWS_WITH(map("x [um] y [um] z [V]\n" + list), Catch::Contains("'V'"));
    CHECK_THROWS_WITH(map(list + "2 2 1\n"), Catch::Contains("line 5") && Catch::Contains("second height"));
    CHECK(map("1;2;3;\n4;5;6;7\n;;;\n", {.spacing = 1, .fill = true, .max_filled = 0.5}).missing.nodes ==
          std::vector<Index>{3, 8, 9, 10, 11});
}

TEST_CASE("a count and a length on separate lines are not heights") {
    std::string heights;
    for (int i = 0; i < 30; ++i) heights += std::to_string(i % 7) + ".5\n";
    for (const std::string head : {"10.0\n30\n", "30\n10.0\n", "30\n"})
        CHECK(read(head + heights, {.spacing = 1, .detrend = Detrend::none}).measured.nodes() == 30);
    CHECK(read("10.0\n" + heights, {.spacing = 1}).measured.nodes() == 31);
    CHECK(read("0.5\n" + four_rows).measured.nodes() == 4);
}

TEST_CASE("holes of a map are filled by a plane or another harmonic function exactly", "[map]") {
    const auto hole = [](Index i, Index j) { return (i > 4 && i < 9 && j > 2 && j < 8) || (i < 2 && j < 2); };
    for (const bool plane : {true, false}) {
        Profile map{Eigen::VectorXd(15 * 12), 0.01, 12, 0.02};
        for (Index k = 0; k < map.nodes(); ++k) {
            const double x = 0.01 * double(k % 15) - 0.07, y = 0.02 * double(k / 15) - 0.1;
            map.heights[k] = plane ? 1 + 3 * x - 2 * y : x * x * x - 3 * x * y * y + 5 * x * y;
        }
        Profile holed = map;
        for (Index k = 0; k < map.nodes(); ++k)
            if (hole(k % 15, k / 15) && (plane || k % 15 > 2)) // at an edge only a plane is continued exactly
                holed.heights[k] = std::nan("");
        const MissingPoints missing = missing_points(holed);
        CHECK(missing.nodes.size() == (plane ? 24 : 20));
        CHECK(missing.share == Approx(double(missing.nodes.size()) / 180));
        CHECK(missing.largest_hole == Approx(20 * 0.01 * 0.02));
        CHECK((filled(holed, missing).heights - map.heights).cwiseAbs().maxCoeff() < 1e-12);
        CHECK_THROWS_WITH(filled(holed, missing, 0.1), Catch::Contains("share 0.1"));
    }
}
