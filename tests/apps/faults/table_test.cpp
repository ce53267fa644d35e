#include "domain/text/atomic_file.hpp"

#include <catch2/catch.hpp>

#include <regex>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

/// The names of all test cases, of sources and of scripts' own tests; a name may be broken over lines.
std::set<std::string> names_of_tests() {
    static const std::regex title("TEST_CASE\\(\\s*((?:\"(?:[^\"\\\\]|\\\\.)*\"\\s*)+)"), joint("\"\\s*\"");
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(RUGOSA_SOURCE "/tests"))
        if (entry.path().extension() == ".cpp") {
            const std::string text = rough::read_whole(entry.path());
            for (std::sregex_iterator match(text.begin(), text.end(), title), end; match != end; ++match) {
                std::string name = std::regex_replace((*match)[1].str(), joint, "");
                name.erase(name.find_last_of('"'));
                names.insert(name.substr(1));
            }
        }
    return names;
}

} // namespace

TEST_CASE("every row of the table of faults names a test that there is") {
    const std::set<std::string> names = names_of_tests();
    REQUIRE(names.count("every row of the table of faults names a test that there is"));
    std::istringstream page(rough::read_whole(RUGOSA_SOURCE "/tests/README.md"));
    int rows = 0;
    for (std::string line; std::getline(page, line);) {
        static const std::regex row("\\| .* \\| .* \\| .* \\| (.*) \\|");
        std::smatch cells;
        if (!std::regex_match(line, cells, row) || cells[1] == "Test" || cells[1] == "---")
            continue;
        ++rows;
        std::istringstream tests(cells[1].str());
        for (std::string test; std::getline(tests >> std::ws, test, ';');) {
            INFO(test);
            CHECK(names.count(test) == 1);
        }
    }
    CHECK(rows >= 40);
}

TEST_CASE("no source reads a clock that can jump") {
    static const std::regex wall(
        "system_clock|high_resolution_clock|gettimeofday|CLOCK_REALTIME|\\btime\\((nullptr|NULL|0)\\)");
    for (const char* folder : {"/ga", "/domain", "/apps"})
        for (const auto& entry : fs::recursive_directory_iterator(std::string(RUGOSA_SOURCE) + folder))
            if (const auto kind = entry.path().extension(); kind == ".cpp" || kind == ".hpp") {
                INFO(entry.path().string());
                CHECK_FALSE(std::regex_search(rough::read_whole(entry.path()), wall));
            }
}
