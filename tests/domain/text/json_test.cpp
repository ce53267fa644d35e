#include "domain/text/json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

TEST_CASE("a name that is no UTF-8 can be written as JSON, and what is stays as it is") {
    const nlohmann::json value{{"caf\xE9", "\xFF"}, {"µm", {1.5, "Å"}}};
    const auto read = nlohmann::json::parse(rough::json_text(value));
    CHECK(read.at("caf\xEF\xBF\xBD") == "\xEF\xBF\xBD");
    CHECK(read.at("µm") == value.at("µm"));
    CHECK(rough::json_text({{"a", {1}}}, true) == R"({"a":[1]})");
}
