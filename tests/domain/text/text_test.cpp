#include "domain/errors.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"
#include "tests/catch.hpp"

#include <nlohmann/json.hpp>

using namespace rough;

TEST_CASE("a word that is not a finite number is refused with its place") {
    CHECK(number_from("+1.5", "here") == 1.5);
    CHECK(number_from("-2e-3", "here") == -2e-3);
    for (const char* word : {"", "+", "1x", "1 2", "inf", "nan", "1e999", "x1"})
        CHECK_THROWS_WITH(number_from(word, "there"),
                          Catch::StartsWith("there: \"" + std::string(word) + "\" is not a finite number"));
}

TEST_CASE("the last digit of a number has the power of ten that is written") {
    for (const auto& [cell, place] :
         {std::pair("12", 0), {"1.25", -2}, {"3e4", 4}, {"1.25E-3", -5}, {"7e+2", 2}})
        CHECK(number(cell, Dialect{})->last_place == place);
}

TEST_CASE("a comma before a blank separates columns, a decimal comma does not") {
    using Cells = std::vector<std::string_view>;
    const auto cells = [](std::string_view line) { return split(line, Dialect::Separator::comma_and_blank); };
    CHECK(cells("1,5, 2,25") == Cells{"1,5", "2,25"});
    CHECK(cells("1,, 2") == Cells{"1,", "2"});
    CHECK(cells("1,") == Cells{"1"});
}

TEST_CASE("UTF-16 and Latin-1 are read as UTF-8, and an unpaired surrogate as a replacement") {
    std::string clef("\xFE\xFF\xD8\x34\xDD\x1E\x00!", 8), half("\xFF\xFE\x34\xD8!\x00", 6), latin("\xB5\xE9");
    CHECK(text_lines(clef, "clef")[0] == "\xF0\x9D\x84\x9E!");
    CHECK(text_lines(half, "half")[0] == "\xEF\xBF\xBD!");
    CHECK(text_lines(latin, "latin")[0] == "µé");
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
        while (depth-- > 0)
            text = "{\"a\":" + text + "}";
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
