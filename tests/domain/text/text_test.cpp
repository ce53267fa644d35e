#include "domain/errors.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"
#include "ga/base/json.hpp"
#include "tests/catch.hpp"

using namespace rough;

TEST_CASE("a word that is not a finite number is refused with its place") {
    CHECK(number_from("+1.5", "here") == 1.5);
    CHECK(number_from("-2e-3", "here") == -2e-3);
    for (const char* word : {"", "+", "1x", "1 2", "inf", "nan", "1e999", "x1"})
        CHECK_THROWS_WITH(number_from(word, "there"),
                          Catch::StartsWith("there: \"" + std::string(word) + "\" is not a finite number"));
}

TEST_CASE("bytes outside UTF-8 become replacement characters in JSON, other text stays") {
    const nlohmann::json value{{"caf\xE9", "\xFF"}, {"µm", {1.5, "Å"}}};
    const auto read = nlohmann::json::parse(rough::json_text(value));
    CHECK(read.at("caf\xEF\xBF\xBD") == "\xEF\xBF\xBD");
    CHECK(read.at("µm") == value.at("µm"));
    CHECK(rough::json_text({{"µ", {1}}}, true) == R"({"µ":[1]})");
    CHECK(rough::json_text({{"µ", {1}}}) == "{\n \"µ\": [\n  1\n ]\n}"); // one blank per level
}

TEST_CASE("JSON deeper than 64 brackets or broken is refused in one line") {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    CHECK_NOTHROW(rough::parsed_json(nested(64), "g.json"));
    CHECK_THROWS_WITH(rough::parsed_json(nested(65), "g.json"), Catch::Contains("g.json: brackets"));
    const auto objects = [](std::size_t depth) {
        std::string text = "1";
        while (depth-- > 0) text = "{\"a\":" + text + "}";
        return text;
    };
    CHECK_NOTHROW(rough::parsed_json(objects(64), "g.json"));
    CHECK_THROWS_WITH(rough::parsed_json(objects(65), "g.json"), Catch::Contains("g.json: brackets"));
    CHECK_THROWS_AS(rough::parsed_json(std::string(1'000'000, '['), "g.json"), rough::InputError);
    CHECK(rough::parsed_json(R"(["[[\"[[", "]"])", "g.json").size() == 2); // brackets in words do not count
    CHECK_THROWS_WITH(rough::parsed_json("[\"a\"," + nested(64) + "]", "g.json"),
                      Catch::Contains("g.json: brackets")); // brackets after a word count
    CHECK_THROWS_WITH(rough::parsed_json("{\"a\":\n", "g.json"),
                      Catch::Contains("g.json: not JSON") && !Catch::Contains("\n"));
}
