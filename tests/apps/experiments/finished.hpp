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

/// Repeats the run in r on one thread, and with an interrupt after the first checkpoint and a resume. All
/// must write equal files. A resume with other settings must be refused.
inline void expect_repeated(const std::string& words, const Folder& where,
                            const std::vector<std::string>& files) {
    finished(words + " --threads 1", where, "one");
    rugosa_stopped(0.05, "s/checkpoints", words + " --out s", where.path());
    const Ended refused = rugosa(words + " --seed 9 --out s --resume", where.path());
    INFO(refused.err);
    CHECK(refused.code == 2);
    CHECK(refused.error_lines() == 1);
    finished(words + " --resume", where, "s");
    CHECK_FALSE(std::filesystem::exists(where / "s/checkpoints"));
    for (const std::string& file : files)
        for (const char* other : {"one/", "s/"})
            CHECK(rough::read_whole(where / (other + file)) == rough::read_whole(where / ("r/" + file)));
}

} // namespace app::testing
