#pragma once

#include "tests/apps/program.hpp"
#include "tests/apps/results.hpp"

#include <catch2/catch.hpp>

namespace app::testing {

/// Runs rugosa, which must succeed, and returns result.json of the folder `out` in `where`.
inline nlohmann::json finished(const std::string& words, const Folder& where, const std::string& out = "r") {
    const Ended ended = rugosa(words + " --out " + out, where.path());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK_THAT(ended.out, Catch::Contains(out + ": ") && Catch::EndsWith(" s\n"));
    return result_in(where / out);
}

} // namespace app::testing
