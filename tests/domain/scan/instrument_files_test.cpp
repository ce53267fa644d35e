#include "domain/scan/map.hpp"
#include "domain/scan/scan.hpp"
#include "domain/text/bytes.hpp"
#include "domain/text/zip.hpp"
#include "tests/domain/contact/maps.hpp"
#include "tests/domain/scan/refusal.hpp"
#include "tests/folder.hpp"

using namespace rough;

/// Files in the formats of instruments, byte by byte from their descriptions. They hold a map of 2 rows of 9
/// points, 2 µm and 3 µm apart, with heights in steps of 10 nm. The last but one point of the second row was
/// not measured.
namespace rough::testing {
namespace {

constexpr int map_columns = 9, map_rows = 2;
const std::vector<int> map_heights{3, -2, 4, 1, -5, 9, 2, 6, 5, 7, -3, 5, 3, -1, 0, 4, -8, 2};
constexpr std::size_t map_gap = 16;

void put(std::string& bytes, std::size_t at, auto value) {
    std::string part;
    append_little_endian(part, value);
    bytes.replace(at, part.size(), part);
}

/// ISO 25178-71, binary; `type` as in missing_mark().
std::string sdf_file(int type = 5) {
    std::string bytes = "bISO-1.0" + std::string(73, ' ');
    put(bytes, 42, std::uint16_t(map_columns)), put(bytes, 44, std::uint16_t(map_rows));
    put(bytes, 46, 2e-6), put(bytes, 54, 3e-6), put(bytes, 62, 1e-8), put(bytes, 70, 0.0);
    bytes[78] = 0, bytes[79] = char(type), bytes[80] = 0;
    for (std::size_t i = 0; i < map_heights.size(); ++i)
        if (type == 4)
            append_little_endian(bytes, std::int8_t(map_heights[i])); // has no mark of a missing value
        else if (type == 5)
            append_little_endian(bytes, std::int16_t(i == map_gap ? -32768 : map_heights[i]));
        else if (type == 6)
            append_little_endian(bytes, i == map_gap ? std::numeric_limits<int>::min() : map_heights[i]);
        else
            append_little_endian(bytes, i == map_gap ? std::nan("") : double(map_heights[i]));
    return bytes;
}

/// Digital Surf, 16 or 32 bits, with a comment and a private zone before the heights.
std::string sur_file(int bits = 32) {
    std::string bytes(512, '\0');
    bytes.replace(0, 12, "DIGITAL SURF");
    put(bytes, 14, std::int16_t(1)), put(bytes, 18, std::int16_t(2));
    put(bytes, 86, std::int16_t(1)), put(bytes, 98, std::int16_t(bits));
    put(bytes, 100, -8), put(bytes, 104, 9), put(bytes, 108, map_columns), put(bytes, 112, map_rows);
    put(bytes, 120, 0.002f), put(bytes, 124, 3.f), put(bytes, 128, 0.01f);
    bytes.replace(180, 2, "mm"), bytes.replace(196, 2, "\xB5m"), bytes.replace(212, 2, "\xB5m");
    put(bytes, 334, std::int16_t(5)), put(bytes, 336, std::int16_t(3));
    bytes += "notes...";
    for (std::size_t i = 0; i < map_heights.size(); ++i) {
        const int height = i == map_gap ? -10 : map_heights[i];
        if (bits == 16)
            append_little_endian(bytes, std::int16_t(height));
        else
            append_little_endian(bytes, height);
    }
    return bytes;
}

/// Gwyddion's simple field.
std::string gsf_file(const std::string& title = "t") {
    std::string bytes = "Gwyddion Simple Field 1.0\nXRes = 9\nYRes = 2\nXReal = 1.8e-5\nYReal = 6e-6\n"
                        "XYUnits = m\nZUnits = m\nTitle = " +
                        title + "\n";
    bytes.append(4 - bytes.size() % 4, '\0');
    for (std::size_t i = 0; i < map_heights.size(); ++i)
        append_little_endian(bytes, i == map_gap ? std::nanf("") : float(1e-8 * map_heights[i]));
    return bytes;
}

/// main.xml of an X3P file of 16 bit heights with a mask of the valid points.
std::string x3p_xml() {
    return "<?xml version=\"1.0\"?>\n<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">"
           "<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>"
           "<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>2e-6</Increment></CX>"
           "<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>3e-6</Increment></CY>"
           "<CZ><AxisType>A</AxisType><DataType>I</DataType><Increment>1e-8</Increment></CZ></Axes></Record1>"
           "<Record3><MatrixDimension><SizeX>9</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
           "<DataLink><PointDataLink>bindata/data.bin</PointDataLink>"
           "<ValidPointsLink>bindata/valid.bin</ValidPointsLink></DataLink></Record3></p:ISO5436_2>";
}

template <class Number = std::int16_t>
std::string x3p_data() {
    std::string data;
    for (const int height : map_heights) append_little_endian(data, Number(height));
    return data;
}

/// Heights of a type other than I, the archive's paths from here.
std::string x3p_file(char type = 'I') {
    std::string valid(3, '\xFF'), xml = x3p_xml();
    valid[map_gap / 8] = char(~(1 << map_gap % 8));
    xml[xml.find("<DataType>I") + 10] = type;
    if (type != 'I')
        for (const std::string path : {"bindata/data", "bindata/valid"}) xml.replace(xml.find(path), 0, "./");
    return zipped({{"main.xml", xml},
                   {"bindata/data.bin", type == 'L'   ? x3p_data<std::int32_t>()
                                        : type == 'F' ? x3p_data<float>()
                                        : type == 'D' ? x3p_data<double>()
                                                      : x3p_data()},
                   {"bindata/valid.bin", valid}});
}

} // namespace
} // namespace rough::testing

namespace {

Scan read_file(const std::string& bytes, ScanOptions options) {
    const tests::Folder folder;
    options.detrend = Detrend::none;
    return open_scan(folder.write("scan.bin", bytes), options);
}

const Profile line{1e-3 * Eigen::VectorXd::Random(300), 0.002};
const Profile relief =
    maps::map_of({6, 4}, 0.01, 0.025, [](double x, double y) { return 1e-3 * std::sin(300 * x) - y; });

Scan as_map(const std::string& bytes, ScanOptions options = {}) {
    const tests::Folder folder;
    options.detrend = Detrend::none;
    return read_map(folder.write("map", bytes), options);
}

/// The heights as stored.
std::optional<HeightMap> any_map(const std::string& bytes) {
    return bytes.starts_with("PK") ? read_x3p(Zip(bytes, "map"), "map") : binary_map(bytes, "map");
}

std::string refusal_of_file(const std::string& bytes, ScanOptions options = {.row = 1}) {
    return testing::refusal_of([&] { return read_file(bytes, options); });
}

std::string map_refusal(const std::string& bytes, const ScanOptions& options = {}) {
    return testing::refusal_of([&] { return as_map(bytes, options); });
}

std::string changed(std::string bytes, const std::string& what, const std::string& to) {
    const auto at = bytes.find(what);
    REQUIRE(at != std::string::npos);
    return bytes.replace(at, what.size(), to);
}

std::string x3p_of(const std::string& xml, const std::string& data = testing::x3p_data()) {
    return zipped({{"main.xml", xml}, {"bindata/data.bin", data}});
}

} // namespace

TEST_CASE("every instrument's format gives the same map in mm, rows along x") {
    for (const auto& [name, bytes] : {std::pair("SDF of bytes", testing::sdf_file(4)),
                                      {"SDF of integers", testing::sdf_file()},
                                      {"SDF of long integers", testing::sdf_file(6)},
                                      {"SDF of doubles", testing::sdf_file(7)},
                                      {"SUR of 32 bits", testing::sur_file()},
                                      {"SUR of 16 bits", testing::sur_file(16)},
                                      {"GSF", testing::gsf_file()},
                                      {"GSF, padded by 4", testing::gsf_file("four")},
                                      {"GSF, padded by 2", testing::gsf_file("of")},
                                      {"X3P", testing::x3p_file()},
                                      {"X3P of long integers", testing::x3p_file('L')},
                                      {"X3P of floats", testing::x3p_file('F')},
                                      {"X3P of doubles", testing::x3p_file('D')}}) {
        INFO(name);
        const bool has_mark = bytes != testing::sdf_file(4); // a byte has no mark of a missing value
        const auto map = any_map(bytes);
        REQUIRE(map);
        CHECK((map->rows == 2 && map->columns() == 9));
        CHECK(map->spacing == Approx(2e-3));
        CHECK(map->row_spacing == Approx(3e-3));
        for (Index i = 0; i < map->heights.size(); ++i) {
            INFO(i);
            const double height = map->heights[i] * map->height_factor * map->height_unit.in_mm;
            if (std::size_t(i) == testing::map_gap && has_mark)
                CHECK(std::isnan(height));
            else
                CHECK(height == Approx(1e-5 * testing::map_heights[std::size_t(i)]).epsilon(1e-6));
        }
        const Scan scan = read_file(bytes, {.row = 1});
        CHECK(scan.measured.nodes() == 9);
        CHECK(scan.measured.heights[5] == Approx(9e-5).epsilon(1e-6));
        CHECK_THAT(scan.account, Catch::Contains("row 1 of 2 rows of 9 heights"));
        CHECK(read_file(bytes, {.fill = true, .row = 2}).measured.heights[7] ==
              Approx(has_mark ? 3e-5 : -8e-5).epsilon(1e-6));
        CHECK_THAT(refusal_of_file(bytes, {.row = 2}), Catch::Contains(has_mark ? "missing value" : "read as"));
        for (const Index row : {0, 3})
            CHECK_THAT(refusal_of_file(bytes, {.row = row}), Catch::Contains("the row to take, 1 to 2"));
        CHECK_THAT(refusal_of_file(bytes, {.spacing = 7, .row = 1}), Catch::Contains("spacing"));
    }
    const auto metre = binary_map(changed(testing::gsf_file(), "XReal = 1.8e-5\nYReal = 6e-6\n", ""), "map");
    CHECK(metre->spacing == Approx(1e3 / 9)); // a GSF file without sizes is 1 m x 1 m, as in Gwyddion
    CHECK(metre->row_spacing == Approx(1e3 / 2));
    CHECK(stored_numbers("\x07\xFF", 2, 0, missing_mark(0), "map") == Eigen::Vector2d(7, 255));
}

TEST_CASE("an ASCII surface data file of several profiles is a map") {
    const std::string text = "aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-6\nYscale = 2e-6\n"
                             "Zscale = 1e-6\nDataType = 5\n*\n1 2 1\n4 -32768 5\n*\n";
    CHECK(read_file(text, {.row = 1}).measured.heights == Eigen::Vector3d(1e-3, 2e-3, 1e-3));
    CHECK(read_file(text, {.fill = true, .max_filled = 0.5, .row = 2}).measured.heights[1] == Approx(4.5e-3));
    CHECK_THAT(refusal_of_file(text, {.row = 2}), Catch::Contains("line 10") && Catch::Contains("missing"));
    CHECK_THAT(refusal_of_file(text, {}), Catch::Contains("the row to take"));
    const Scan map = as_map(changed(text, "-32768", "3"));
    CHECK((map.measured.shape() == Extent{3, 2} && map.measured.spacing == Approx(1e-3)));
    CHECK(map.measured.row_spacing == Approx(2e-3));
    CHECK(map.measured.heights.isApprox(1e-3 * Eigen::Vector<double, 6>(1, 2, 1, 4, 3, 5)));
}

TEST_CASE("a profile written as X3P is read back to the last bit") {
    Profile profile{1e-3 * Eigen::VectorXd::Random(500), 0.84942 / 511};
    const std::string bytes = x3p(profile);
    CHECK(bytes == x3p(profile)); // without a date
    const Scan scan = read_file(bytes, {});
    CHECK(scan.measured.spacing == Approx(profile.spacing).epsilon(1e-15));
    CHECK((scan.measured.heights - profile.heights).cwiseAbs().maxCoeff() < 1e-18);
    CHECK_THAT(scan.account, Catch::Contains("X3P"));
    CHECK_THAT(refusal_of_file(bytes), Catch::Contains("omit the row"));
    CHECK_THAT(refusal_of_file(bytes, {.spacing = -1}),
               Catch::Contains("spacing: -1 is out of range (a length above 0)"));
    CHECK_THAT(refusal_of_file(bytes, {.row = -1}), Catch::Contains("row: -1 is out of range (1 or more)"));
    const Zip zip(bytes, "x");
    // the MD5 of md5sum
    const tests::Folder folder;
    folder.write("main.xml", zip.entry("main.xml", 10000).value());
    folder.write("md5checksum.hex", zip.entry("md5checksum.hex", 1000).value());
    CHECK(std::system(("cd '" + folder.path().string() + "' && md5sum --status -c md5checksum.hex").c_str()) == 0);
}

TEST_CASE("an X3P with a wrong check sum or mask is refused") {
    const std::string xml = testing::x3p_xml(), data = testing::x3p_data(), valid(3, '\xFF');
    const auto refused = [&](const std::string& description, std::vector<std::pair<std::string, std::string>> more) {
        more.insert(more.begin(), {{"main.xml", description}, {"bindata/data.bin", data}});
        return refusal_of_file(zipped(more));
    };
    const auto with_sum = [&](const std::string& name, const std::string& sum) {
        return changed(xml, "</DataLink>", "<" + name + ">" + sum + "</" + name + "></DataLink>");
    };
    const std::string zeros(32, '0');
    CHECK_THAT(refused(with_sum("MD5ChecksumPointData", zeros), {{"bindata/valid.bin", valid}}),
               Catch::Contains("its bindata/data.bin has the MD5 "));
    CHECK_THAT(refused(xml, {}), Catch::Contains("'bindata/valid.bin', which is not in the archive"));
    CHECK_THAT(refused(xml, {{"bindata/valid.bin", "\xFF"}}), Catch::Contains("valid points end early"));
    CHECK_THAT(refused(xml, {{"bindata/valid.bin", "\xFE\xFF\xFF"}}), Catch::Contains("missing value"));
    const std::string written = x3p({1e-3 * Eigen::VectorXd::Random(20), 0.1});
    const Zip zip(written, "x");
    std::string other = zip.entry("bindata/data.bin", 1000).value();
    other[3] ^= 1;
    CHECK_THAT(
        refusal_of_file(zipped({{"main.xml", zip.entry("main.xml", 10000).value()}, {"bindata/data.bin", other}}), {}),
        Catch::Contains("but the archive gives"));
}

TEST_CASE("X3P with heights in its XML is read under any namespace") {
    std::string list = "<q:Record3 xmlns:q='u'><q:ListDimension>4</q:ListDimension><q:DataList><q:Datum>1;0;3</q:Datum>"
                       "<q:Datum>2;0;4.5</q:Datum><q:Datum/><q:Datum>-1</q:Datum></q:DataList></q:Record3>";
    std::string xml = testing::x3p_xml();
    const auto from = xml.find("<Record3>"), to = xml.find("</Record3>") + 10;
    xml.replace(from, to - from, list);
    const auto map = any_map(x3p_of(xml));
    REQUIRE(map->heights.size() == 4);
    CHECK(map->heights[1] == 4.5);
    CHECK(std::isnan(map->heights[2]));
    CHECK_THAT(refusal_of_file(x3p_of(changed(xml, "<q:Datum>-1</q:Datum>", ""))), Catch::Contains("lists 3 heights"));
    CHECK_THAT(refusal_of_file(x3p_of(changed(xml, "<q:Datum>-1<", "<q:Datum>0</q:Datum><q:Datum>-1<"))),
               Catch::Contains("lists 5 heights"));
    CHECK_THAT(refusal_of_file(x3p_of(changed(xml, "4.5", "high"))), Catch::Contains("'high'"));
}

TEST_CASE("a damaged instrument's file is refused in one line with its fault") {
    const std::string sdf = testing::sdf_file(), sur = testing::sur_file(), gsf = testing::gsf_file(),
                      xml = testing::x3p_xml();
    const auto with = [](std::string bytes, std::size_t at, auto value) {
        testing::put(bytes, at, value);
        return bytes;
    };
    const std::vector<std::pair<std::string, std::string>> damaged{
        {sdf.substr(0, 60), "header of 81"},
        {sdf.substr(0, 100), "ends early, with 19 of 36 bytes"},
        {with(sdf, 46, std::nan("")), "Xscale"},
        {with(sdf, 79, '\x9'), "type 9"},
        {with(sdf, 42, std::uint16_t(0)), "rows of 0 heights"},
        {with(sur, 108, 2'000'000'000), "2000000000 heights"},
        {with(sur, 112, -2), "-2 rows"},
        {with(sur, 98, std::int16_t(24)), "24 bits"},
        {with(sur, 180, 'q'), "not a length unit"},
        {"DSCOMPRESSED" + sur.substr(12), "compressed heights"},
        {changed(gsf, "XRes = 9", "XRes = 9999999"), "ends early"},
        {changed(gsf, "ZUnits = m", "ZUnits = V"), "'V'"},
        {testing::x3p_file().substr(0, 300), "damaged zip"},
        {zipped({{"xl/workbook.xml", "<a/>"}}), "without main.xml or sheets"},
        {x3p_of("<a"), "not XML"},
        {x3p_of("<a/>"), "no axes"},
        {x3p_of(changed(xml, "<SizeX>9", "<SizeX>1e9")), "SizeX"},
        {x3p_of(changed(xml, "<SizeZ>1", "<SizeZ>2")), "several layers"},
        {x3p_of(changed(xml, "<DataType>I", "<DataType>Q")), "type 'Q'"},
        {x3p_of(changed(xml, "data.bin", "none.bin")), "not in the archive"},
        {x3p_of(changed(changed(xml, "<SizeX>9", "<SizeX>1.5e7"), "<SizeY>2", "<SizeY>1")),
         "1 rows of 15000000 heights"},
        {x3p_of(xml, "short"), "ends early"},
        {x3p_of(xml, std::string(1000, ' ')), "too large"},
        {"Wyko ASCII Data File Format 0 1 1\n\"\"\n", "ends early, before RAW_DATA"},
        {"GWYP" + std::string(8, '\0'), "without heights"},
        {"GWYPx" + std::string("\0\xFF\xFF\0\0", 5), "ends early"},
        {"\x89HDF\r\n" + std::string(8, '\0'), "(an HDF5 file, as Zygo's DATX)"},
    };
    for (const auto& [bytes, fault] : damaged) CHECK_THAT(refusal_of_file(bytes), Catch::Contains(fault));
}

TEST_CASE("surfaces written as X3P or SUR are read back", "[map]") {
    const double largest = relief.heights.cwiseAbs().maxCoeff();
    for (const auto& [format, write, spacing_error, height_error] :
         {std::tuple("X3P", &x3p, 1e-14, 1e-15), {"SUR", &sur, 1e-7, 1e-9}}) {
        INFO(format);
        const Scan map = as_map(write(relief));
        CHECK(map.measured.shape() == relief.shape());
        CHECK(map.measured.spacing == Approx(0.01).epsilon(spacing_error));
        CHECK(map.measured.row_spacing == Approx(0.025).epsilon(spacing_error));
        CHECK((map.measured.heights - relief.heights).cwiseAbs().maxCoeff() <= height_error * largest);
        CHECK_THAT(map.account, Catch::Contains(format));
        CHECK((read_file(write(line), {}).measured.heights - line.heights).cwiseAbs().maxCoeff() <=
              height_error * line.heights.cwiseAbs().maxCoeff());
    }
    CHECK_THAT(map_refusal(x3p(relief), {.spacing = 0.02}),
               Catch::Contains("the file gives a spacing along x of 0.01"));
    CHECK_THAT(map_refusal(x3p(relief), {.unit = "um"}), Catch::Contains("heights in m, but the given unit is µm"));
    CHECK(sur(relief)[88] == 1); // the header's mark of absolute heights
}

TEST_CASE("a matrix and points x, y, height in any order are the same map", "[map]") {
    const std::string matrix = "1 2 3\n4 5 6\n";
    const Scan by_rows = as_map(matrix, {.unit = "um", .spacing = 10, .row_spacing = 20});
    const Scan by_points = as_map("20 20 6\n0 0 1\n10 0 2\n0 20 4\n20 0 3\n10 20 5\n", {.unit = "um"});
    for (const Scan* map : {&by_rows, &by_points}) {
        CHECK((map->measured.shape() == Extent{3, 2} && map->measured.spacing == Approx(0.01)));
        CHECK(map->measured.row_spacing == Approx(0.02));
        for (Index k = 0; k < 6; ++k) CHECK(map->measured.heights[k] == Approx(1e-3 * double(k + 1)));
    }
}

TEST_CASE("an incomplete map is refused with its place", "[map]") {
    CHECK_THAT(map_refusal(testing::gsf_file()),
               Catch::Contains("row 2, column 8: a missing value") && Catch::Contains("(5.56 %)"));
    CHECK_THAT(map_refusal("1 2 3 4\n4 5 6 7\n"), Catch::Contains("distance of its nodes"));
    CHECK_THAT(map_refusal("0 0 1\n1 0 2\n0 1 3\n"), Catch::Contains("row 2, column 2: a missing value"));
    CHECK_THAT(map_refusal("0 0 1\n1 0 2\n0 1 3\n1 1 4\n0 0 5\n"), Catch::Contains("line 5"));
    CHECK_THAT(map_refusal("0 0 1\n1 0 2\n3 0 2\n0 1 3\n1 1 4\n3 1 5\n"), Catch::Contains("even steps"));
    CHECK_THAT(map_refusal("1 2 3 4\n", {.spacing = 1}), Catch::Contains("2 x 2"));
    CHECK_THAT(map_refusal(x3p(line)), Catch::Contains("2 x 2"));
}
