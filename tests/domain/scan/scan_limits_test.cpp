#include "domain/errors.hpp"
#include "domain/scan/scan.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace rough;
using tests::Folder;

namespace {

const std::string rows = "1 2\n2 3\n3 5\n4 1\n";

void check_refused(const std::string& content, const std::string& part) {
    const Folder folder;
    INFO(content.substr(0, 80));
    CHECK_THROWS_WITH(read_scan(folder.write("scan.txt", content), {}), Catch::Contains(part));
}

} // namespace

TEST_CASE("a number of twenty digits is no count of points") {
    check_refused("12345678901234567890\n" + rows, "missing value");
    const Folder folder;
    CHECK(read_scan(folder.write("scan.txt", "4\n" + rows), {}).profile.nodes() == 4);
}

TEST_CASE("an export's count above 1e9 is refused") {
    check_refused("SigmaSurf_Data\nSPACING_UM: 0.25\nNUMBER_OF_POINTS: 1e300\nPROFILE_UM:\n1\n2\n",
                  "up to 1e9");
}

TEST_CASE("empty quotes in a header, half a pair of UTF-16 and a tiny exponent leave a scan readable") {
    const Folder folder;
    for (const std::string head : {"x z\n\"\"\n", "\"\" height\n", "\"\"\n\"\" \"\"\n"})
        CHECK(read_scan(folder.write("scan.txt", head + rows), {}).profile.nodes() == 4);
    CHECK(read_scan(folder.write("scan.txt", "0.0e-2147483647 2\n" + rows), {}).profile.nodes() == 5);
    std::string wide("\xFF\xFE#\0\x00\xD8x\0\n\0", 10);
    for (const char c : rows)
        wide += {c, '\0'};
    CHECK(read_scan(folder.write("scan.txt", wide), {}).profile.nodes() == 4);
}

TEST_CASE("a line of more numbers than a scan may have points is refused") {
    std::string line;
    for (int i = 0; i < 10'000'002; ++i)
        line += "1 ";
    check_refused(line, "more than 1e7 numbers");
}
