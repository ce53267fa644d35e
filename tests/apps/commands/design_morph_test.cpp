#include "domain/mwm/genome_json.hpp"
#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace app::testing;
using nlohmann::json;

namespace {

std::string genome_of(double second, double fourth) {
    return "{\"series\":[{\"A\":1,\"H\":0.9,\"gamma\":1.6,\"lambda\":0.84942,\"chromosomes\":[{\"n\":1,"
           "\"phases\":[0.3]},{\"n\":2,\"phases\":[" +
           std::to_string(second) + "]},{\"n\":3,\"phases\":[4]},{\"n\":4,\"phases\":[" +
           std::to_string(fourth) + "]}]}]}";
}

/// A folder with a target and a surface that has drifted away from it.
void prepare(const Folder& folder) {
    folder.write("wanted.json", genome_of(1.9, 2.2));
    folder.write("drifted.json", genome_of(2.2, 1.9));
    REQUIRE(rugosa("target --genome wanted.json --out T.csv", folder.path()).code == 0);
}

/// Brings it back in the folder r by two of its chromosomes.
Ended bring_back(const Folder& folder, const std::string& more) {
    return rugosa("design --from drifted.json --control 1:2,1:4 --largest-change 0.1 --target T.csv --out r" +
                      more,
                  folder.path());
}

} // namespace

TEST_CASE("a drifted surface is brought back by the chromosomes that may be changed, and by no others") {
    const Folder folder;
    prepare(folder);
    const Ended ended = bring_back(folder, "");
    INFO(ended.err << ended.out);
    REQUIRE(ended.code != 2);
    const json result = result_in(folder / "r");
    const json& answer = result["variants"]["morph"];
    CHECK(answer["morph"]["similarity_before"].get<double>() < 0.97);
    CHECK(answer["similarity"].get<double>() >= 0.99);
    CHECK(answer["morph"]["changes"].size() == 2);
    CHECK(answer["morph"]["out_of_reach"].empty());
    CHECK(ended.code == 0);
    const rough::Genome before = rough::read_genome(folder / "drifted.json"),
                        after = rough::read_genome(folder / "r" / "genome.json");
    for (const std::size_t kept : {0, 2})
        CHECK(before.series[0].chromosomes[kept].phases == after.series[0].chromosomes[kept].phases);
    for (const std::size_t moved : {1, 3})
        CHECK(std::abs(before.series[0].chromosomes[moved].phases[0] -
                       after.series[0].chromosomes[moved].phases[0]) <= 0.2 * std::numbers::pi);
    const std::string page = rough::read_whole(folder / "r" / "report.html");
    CHECK(page.find("The change") != std::string::npos);
}

TEST_CASE("a morph has its time, too") {
    const Folder folder;
    prepare(folder);
    const Ended ended = bring_back(folder, " --seconds 20 --pictures off");
    INFO(ended.err << ended.out);
    CHECK(ended.code == 0);
    CHECK(result_in(folder / "r")["variants"]["morph"]["similarity"].get<double>() >= 0.99);
}

TEST_CASE("a morph asked for amiss is refused in one line that says how it is asked for") {
    const Folder folder;
    prepare(folder);
    for (const auto& [words, expected] : std::vector<std::pair<std::string, std::string>>{
             {"--from drifted.json --control 1:9", "1:1 to 1:4"},
             {"--from drifted.json --control 3", "SERIES:CHROMOSOME"},
             {"--from drifted.json", "--control"},
             {"--from drifted.json --control 1:2 --largest-change 0", "--largest-change"},
             {"--from drifted.json --control 1:2 --variant sog", "--variant"},
             {"--from none.json --control 1:2", "none.json"},
             {"--control 1:2", "--from"}}) {
        const Ended ended = rugosa("design --target T.csv " + words, folder.path());
        INFO(words << ": " << ended.err);
        check_refused(ended, expected);
    }
}
