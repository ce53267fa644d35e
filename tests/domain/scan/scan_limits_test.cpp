#include "domain/errors.hpp"
#include "domain/scan/map.hpp"
#include "domain/scan/scan.hpp"
#include "domain/text/zip.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace rough;
using tests::Folder;

namespace {

const std::string rows = "1 2\n2 3\n3 5\n4 1\n";

void check_refused(const std::string& content, const std::string& part) {
    const Folder folder;
    INFO(content.substr(0, 80));
    CHECK_THROWS_WITH(read_scan(folder.write("scan.txt", content), {}), Catch::Contains(part));
}

std::string repeated(const std::string& part, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += part;
    return all;
}

} // namespace

TEST_CASE("a number of twenty digits is not a count of points") {
    check_refused("12345678901234567890\n" + rows, "missing value");
    const Folder folder;
    CHECK(read_scan(folder.write("scan.txt", "4\n" + rows), {}).profile.nodes() == 4);
}

TEST_CASE("a count above 1e9 is refused") {
    check_refused("SigmaSurf_Data\nSPACING_UM: 0.25\nNUMBER_OF_POINTS: 1e300\nPROFILE_UM:\n1\n2\n",
                  "up to 1e9");
}

TEST_CASE("a scan is readable with empty quotes, half a UTF-16 pair, or a tiny exponent") {
    const Folder folder;
    for (const std::string head : {"x z\n\"\"\n", "\"\" height\n", "\"\"\n\"\" \"\"\n"})
        CHECK(read_scan(folder.write("scan.txt", head + rows), {}).profile.nodes() == 4);
    CHECK(read_scan(folder.write("scan.txt", "0.0e-2147483647 2\n" + rows), {}).profile.nodes() == 5);
    std::string wide("\xFF\xFE#\0\x00\xD8x\0\n\0", 10);
    for (const char c : rows)
        wide += {c, '\0'};
    CHECK(read_scan(folder.write("scan.txt", wide), {}).profile.nodes() == 4);
}

namespace {

/// Largest number of bytes that reading adds to this process; 0 without /proc.
std::size_t peak_while(const std::function<void()>& read) {
    const auto kilobytes = [](const std::string& key) {
        std::ifstream status("/proc/self/status");
        for (std::string word; status >> word;)
            if (word == key)
                return status >> word, std::stoul(word);
        return 0UL;
    };
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak is counted from here
    const std::size_t before = kilobytes("VmRSS:");
    read();
    const std::size_t peak = kilobytes("VmHWM:");
    return 1000 * (peak > before ? peak - before : 0);
}

void check_frugal(const std::string& name, const std::string& content, const std::string& part) {
    INFO(name);
    const Folder folder;
    const auto file = folder.write(name, content);
    for (const bool as_map : {false, true}) {
        std::string said = "read";
        const std::size_t peak = peak_while([&] {
            try {
                if (as_map)
                    read_map(file, {.spacing = 1, .row_spacing = 1});
                else
                    read_scan(file, {.row = 1});
            } catch (const InputError& error) {
                said = error.what();
            }
        });
        CHECK_THAT(said, Catch::Contains(part));
        CHECK(peak < std::max<std::size_t>(20 * content.size(), 200'000'000));
    }
}

} // namespace

TEST_CASE("a small file never takes much memory") {
    check_frugal("one long row among short ones",
                 repeated("1 2 3 4\n", 100'000) + repeated("1 ", 1'000'000) + "\n", "columns, but");
    std::string widths = repeated("1 ", 1'000'000) + "\n"; // each width is as common as the widest
    for (int i = 1; i < 1000; ++i)
        widths += repeated("1 ", i) + "\n";
    check_frugal("rows of all widths", widths, "columns, but the other rows have 1000000");
    std::string places; // no two points share an x or a y
    for (int i = 0; i < 200'000; ++i)
        places += std::to_string(i) + " " + std::to_string(i) + ".5 1\n";
    const Folder folder;
    CHECK_THROWS_WITH(read_map(folder.write("grid.txt", places), {}), Catch::Contains("give a whole grid"));
    check_frugal("nodes of XML", zipped({{"main.xml", "<p>" + repeated("<a/>x", 3'000'000) + "</p>"}}),
                 "more than 1000000 elements");
}

TEST_CASE("a line with too many numbers for a scan is refused") {
    check_refused(repeated("1 ", 10'000'002), "more than 1e7 numbers");
}
