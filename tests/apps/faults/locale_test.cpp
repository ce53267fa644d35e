#include "apps/commands/commands.hpp"
#include "tests/apps/results.hpp"

using app::testing::Folder;

namespace {

/// Numbers as in most of Europe: 1.234.567,5.
struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// The files that the commands write under a locale, by name.
std::map<std::string, std::string> left_by_commands(const std::locale& locale) {
    const Folder folder;
    const auto in = [&](const std::string& name) { return (folder / name).string(); };
    folder.write("genome.json", app::testing::genome_text(1, 0.8, 1.5, {{1, {0.3}}, {3, {1.25}}}));
    struct Back {
        std::locale before;
        ~Back() { std::locale::global(before); }
    } const back{std::locale::global(locale)};
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"contact", "--genome", in("genome.json"), "--out", in("curve.csv"), "--nodes", "1500"},
             {"profile", in("genome.json"), "--out", in("solid"), "--nodes", "1500", "--pictures", "off"},
             {"target", "--genome", in("genome.json"), "--out", in("target.csv")},
             {"target", "--formula", "0.3 + p / 1.6e-4", "--to", "1.6e-4", "--out", in("line.csv")},
             {"contact", "--profile", in("solid/heights.csv"), "--out", in("again.csv")},
             {"design", "--target", in("target.csv"), "--nodes", "64", "--pictures", "off", "--out", in("design"),
              "--pipeline", "sample 3 | score | refine lm 2 | best 1"}}) {
        CHECK(run_part(app::commands(), words) != 2);
    }
    const std::regex measured("\"seconds\": [^\n]*");
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file() && entry.path().filename() != "result.json")
            files[entry.path().lexically_relative(folder.path()).string()] =
                std::regex_replace(rough::read_whole(entry.path()), measured, "");
    REQUIRE(files.size() >= 8);
    return files;
}

} // namespace

TEST_CASE("the files do not depend on the decimal comma of a locale") {
    const auto expected = left_by_commands(std::locale::classic());
    const auto found = left_by_commands(std::locale(std::locale::classic(), new Comma));
    for (const auto& [name, content] : expected) {
        INFO(name);
        // Pages and accounts name their folder.
        if (!content.empty() && content.find("rugosa-test-") == std::string::npos) CHECK(found.at(name) == content);
    }
}
