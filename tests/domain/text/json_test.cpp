#include "domain/errors.hpp"
#include "domain/text/json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

TEST_CASE("bytes outside UTF-8 become replacement characters in JSON, other text stays") {
    const nlohmann::json value{{"caf\xE9", "\xFF"}, {"µm", {1.5, "Å"}}};
    const auto read = nlohmann::json::parse(rough::json_text(value));
    CHECK(read.at("caf\xEF\xBF\xBD") == "\xEF\xBF\xBD");
    CHECK(read.at("µm") == value.at("µm"));
    CHECK(rough::json_text({{"a", {1}}}, true) == R"({"a":[1]})");
}

TEST_CASE("JSON deeper than 64 brackets or broken is refused in one line") {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    CHECK_NOTHROW(rough::parsed_json(nested(64), "g.json"));
    CHECK_THROWS_WITH(rough::parsed_json(nested(65), "g.json"), Catch::Contains("g.json: brackets"));
    CHECK_THROWS_AS(rough::parsed_json(std::string(1'000'000, '['), "g.json"), rough::InputError);
    CHECK(rough::parsed_json(R"(["[[\"[[", "]"])", "g.json").size() == 2); // brackets in words do not count
    CHECK_THROWS_WITH(rough::parsed_json("[\"a\"," + nested(64) + "]", "g.json"),
                      Catch::Contains("g.json: brackets")); // brackets after a word count
    CHECK_THROWS_WITH(rough::parsed_json("{\"a\":\n", "g.json"),
                      Catch::Contains("g.json: not JSON") && !Catch::Contains("\n"));
}
