#include "domain/errors.hpp"
#include "domain/text/lines.hpp"
#include "domain/text/words.hpp"

#include <catch2/catch.hpp>

using namespace rough;

TEST_CASE("a word that is not a finite number is refused with its place") {
    CHECK(number_from("+1.5", "here") == 1.5);
    CHECK(number_from("-2e-3", "here") == -2e-3);
    for (const char* word : {"", "+", "1x", "1 2", "inf", "nan", "1e999", "x1"})
        CHECK_THROWS_WITH(number_from(word, "there"),
                          Catch::StartsWith("there: \"" + std::string(word) + "\" is not a finite number"));
}

TEST_CASE("a comma before a blank separates columns, a decimal comma does not") {
    using Cells = std::vector<std::string_view>;
    const auto cells = [](std::string_view line) { return split(line, Dialect::Separator::comma_and_blank); };
    CHECK(cells("1,5, 2,25") == Cells{"1,5", "2,25"});
    CHECK(cells("1,, 2") == Cells{"1,", "2"});
    CHECK(cells("1,") == Cells{"1"});
}

TEST_CASE("UTF-16 beyond 65536 is read as UTF-8, and an unpaired surrogate as a replacement") {
    std::string clef("\xFE\xFF\xD8\x34\xDD\x1E\x00!", 8), half("\xFF\xFE\x34\xD8!\x00", 6);
    CHECK(text_lines(clef, "clef") == std::vector<std::string_view>{"\xF0\x9D\x84\x9E!"});
    CHECK(text_lines(half, "half") == std::vector<std::string_view>{"\xEF\xBF\xBD!"});
}
