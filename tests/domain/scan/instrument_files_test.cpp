#include "domain/errors.hpp"
#include "domain/scan/height_map.hpp"
#include "domain/scan/map.hpp"
#include "tests/domain/scan/instrument_files.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;

namespace {

Scan read(const std::string& bytes, ScanOptions options) {
    const tests::Folder folder;
    options.detrend = Detrend::none;
    return read_scan(folder.write("scan.bin", bytes), options);
}

std::string refusal(const std::string& bytes, ScanOptions options = {.row = 1}) {
    try {
        return "read as " + read(bytes, options).account;
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return error.what();
    }
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
        const auto map = binary_map(bytes, "map");
        REQUIRE(map);
        CHECK(map->rows == 2);
        CHECK(map->columns() == 9);
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
        const Scan scan = read(bytes, {.row = 1});
        CHECK(scan.profile.nodes() == 9);
        CHECK(scan.profile.heights[5] == Approx(9e-5).epsilon(1e-6));
        CHECK_THAT(scan.account, Catch::Contains("row 1 of 2 rows of 9 heights"));
        CHECK(read(bytes, {.fill = true, .row = 2}).profile.heights[7] ==
              Approx(has_mark ? 3e-5 : -8e-5).epsilon(1e-6));
        CHECK_THAT(refusal(bytes, {.row = 2}), Catch::Contains(has_mark ? "missing value" : "read as"));
        for (const Index row : {0, 3})
            CHECK_THAT(refusal(bytes, {.row = row}), Catch::Contains("the row to take, 1 to 2"));
        CHECK_THAT(refusal(bytes, {.spacing = 7, .row = 1}), Catch::Contains("spacing"));
    }
}

TEST_CASE("an ASCII surface data file of several profiles is a map") {
    const std::string text = "aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = 1e-6\nYscale = 2e-6\n"
                             "Zscale = 1e-6\nDataType = 5\n*\n1 2 1\n4 -32768 5\n*\n";
    CHECK(read(text, {.row = 1}).profile.heights == Eigen::Vector3d(1e-3, 2e-3, 1e-3));
    CHECK(read(text, {.fill = true, .row = 2}).profile.heights[1] == Approx(4.5e-3));
    CHECK_THAT(refusal(text, {.row = 2}), Catch::Contains("line 10") && Catch::Contains("missing"));
    CHECK_THAT(refusal(text, {}), Catch::Contains("the row to take"));
}

TEST_CASE("a profile written as X3P is read back to the last bit") {
    Profile profile{1e-3 * Eigen::VectorXd::Random(500), 0.84942 / 511};
    const std::string bytes = x3p(profile);
    CHECK(bytes == x3p(profile)); // without a date
    const Scan scan = read(bytes, {});
    CHECK(scan.profile.spacing == Approx(profile.spacing).epsilon(1e-15));
    CHECK((scan.profile.heights - profile.heights).cwiseAbs().maxCoeff() < 1e-18);
    CHECK_THAT(scan.account, Catch::Contains("X3P"));
    CHECK_THAT(refusal(bytes), Catch::Contains("omit the row"));
    CHECK_THAT(refusal(bytes, {.spacing = -1}), Catch::Contains("spacing: -1 is not a length above 0"));
    CHECK_THAT(refusal(bytes, {.row = -1}), Catch::Contains("row: -1 is out of range (1 or more)"));
    const Zip zip(bytes, "x");
    // the MD5 of md5sum
    const tests::Folder folder;
    folder.write("main.xml", zip.entry("main.xml", 10000).value());
    folder.write("md5checksum.hex", zip.entry("md5checksum.hex", 1000).value());
    CHECK(std::system(
              ("cd '" + folder.path().string() + "' && md5sum --status -c md5checksum.hex").c_str()) == 0);
}

TEST_CASE("an X3P with a wrong check sum or mask is refused") {
    const std::string xml = testing::x3p_xml(), data = testing::x3p_data(), valid(3, '\xFF');
    const auto refused = [&](const std::string& description,
                             std::vector<std::pair<std::string, std::string>> more) {
        more.insert(more.begin(), {{"main.xml", description}, {"bindata/data.bin", data}});
        return refusal(zipped(more));
    };
    const auto with_sum = [&](const std::string& name, const std::string& sum) {
        return changed(xml, "</DataLink>", "<" + name + ">" + sum + "</" + name + "></DataLink>");
    };
    const std::string zeros(32, '0');
    CHECK_THAT(refused(with_sum("MD5ChecksumPointData", zeros), {{"bindata/valid.bin", valid}}),
               Catch::Contains("its bindata/data.bin has the MD5 "));
    CHECK_THAT(refused(with_sum("MD5ChecksumValidPoints", zeros), {{"bindata/valid.bin", valid}}),
               Catch::Contains("its bindata/valid.bin has the MD5 "));
    CHECK_THAT(refused(xml, {{"bindata/valid.bin", valid}, {"md5checksum.hex", zeros + " *main.xml"}}),
               Catch::Contains("its main.xml has the MD5 "));
    CHECK_THAT(refused(xml, {}), Catch::Contains("'bindata/valid.bin', which is not in the archive"));
    CHECK_THAT(refused(xml, {{"bindata/valid.bin", "\xFF"}}), Catch::Contains("valid points end early"));
    const std::string written = x3p({1e-3 * Eigen::VectorXd::Random(20), 0.1});
    const Zip zip(written, "x");
    std::string other = zip.entry("bindata/data.bin", 1000).value();
    other[3] ^= 1;
    CHECK_THAT(
        refusal(zipped({{"main.xml", zip.entry("main.xml", 10000).value()}, {"bindata/data.bin", other}}),
                {}),
        Catch::Contains("but the archive gives"));
}

TEST_CASE("X3P with heights in its XML is read under any namespace") {
    std::string list =
        "<q:Record3 xmlns:q='u'><q:ListDimension>4</q:ListDimension><q:DataList><q:Datum>1;0;3</q:Datum>"
        "<q:Datum>2;0;4.5</q:Datum><q:Datum/><q:Datum>-1</q:Datum></q:DataList></q:Record3>";
    std::string xml = testing::x3p_xml();
    const auto from = xml.find("<Record3>"), to = xml.find("</Record3>") + 10;
    xml.replace(from, to - from, list);
    const auto map = binary_map(x3p_of(xml), "map");
    REQUIRE(map->heights.size() == 4);
    CHECK(map->heights[1] == 4.5);
    CHECK(std::isnan(map->heights[2]));
    CHECK_THAT(refusal(x3p_of(changed(xml, "<q:Datum>-1</q:Datum>", ""))),
               Catch::Contains("lists 3 heights"));
    CHECK_THAT(refusal(x3p_of(changed(xml, "<q:Datum>-1<", "<q:Datum>0</q:Datum><q:Datum>-1<"))),
               Catch::Contains("lists 5 heights"));
    CHECK_THAT(refusal(x3p_of(changed(xml, "4.5", "high"))), Catch::Contains("'high'"));
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
        {"DSCOMPRESSED" + sur.substr(12), "without compression"},
        {changed(gsf, "XRes = 9", "XRes = 9999999"), "ends early"},
        {changed(gsf, "ZUnits = m", "ZUnits = V"), "'V'"},
        {testing::x3p_file().substr(0, 300), "damaged zip"},
        {zipped({{"xl/workbook.xml", "<a/>"}}), "Excel"},
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
        {"GWYP" + std::string(8, '\0'), "(a Gwyddion file)"},
        {"\x89HDF\r\n" + std::string(8, '\0'), "(an HDF5 file)"},
    };
    for (const auto& [bytes, fault] : damaged)
        CHECK_THAT(refusal(bytes), Catch::Contains(fault));
}
