#include "tests/apps/results.hpp"

using namespace app::testing;

namespace fs = std::filesystem;

namespace {

const std::string keeping = "RUGOSA_CHECKPOINTS=0 ";
const std::string design =
    "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 64 --threads 1 --pictures off "
    "--pipeline 'sample 30 | score | repeat 40 { tournament 2 | cross uniform | mutate 0.1 | score } | best "
    "1' ";

/// Runs the design in a folder "o", and commands of the shell as soon as it holds a checkpoint.
Ended moved(const Folder& folder, const std::string& commands) {
    return disturbed(design + "--out o", folder.path(), "[ -s o/checkpoint.cbor ]", commands, keeping);
}

} // namespace

TEST_CASE("a checkpoint without room on the disk is reported once, and the result is written") {
    const Folder folder;
    // A checkpoint holds the outcomes of all genomes, which take more room than the result.
    const std::string design = "design --target '" RUGOSA_SOURCE "/experiments/targets/drawn.csv' --nodes 64 "
                               "--threads 1 --pictures off --pipeline 'sample 3000 | score | best 20 | "
                               "repeat 4 { tournament 2 | mutate 0.1 | score } | best 1' ";
    const Ended whole = rugosa(design + "--out whole", folder.path());
    REQUIRE(whole.code != 2);
    // The limit is as many blocks as the result needs.
    const auto blocks = fs::file_size(folder / "whole/result.json") / 512 + 4;
    const Ended full = rugosa(design + "--out full", folder.path(),
                              keeping + "sh -c 'ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\"'");
    INFO(full.err);
    CHECK(full.code == whole.code);
    const std::string note = "checkpoint 'full/checkpoint.cbor' cannot be written";
    const auto at = full.out.find(note);
    REQUIRE(at != std::string::npos);
    CHECK(full.out.find(note, at + 1) == std::string::npos);
    auto found = timeless(result_in(folder / "full")), expected = timeless(result_in(folder / "whole"));
    CHECK(found["variants"]["pipeline"]["notes"].size() == 1);
    found["variants"]["pipeline"]["notes"] = expected["variants"]["pipeline"]["notes"];
    CHECK(found == expected);
    for (const auto& entry : fs::directory_iterator(folder / "full")) CHECK(entry.path().extension() != ".tmp");
}

TEST_CASE("a run whose folder is removed continues and writes its result to a new one") {
    const Folder folder;
    const Ended whole = rugosa(design + "--out whole", folder.path());
    const Ended gone = moved(folder, "until rm -r o 2>/dev/null; do :; done");
    INFO(gone.err);
    CHECK(gone.code == whole.code);
    CHECK_THAT(gone.out, Catch::Contains("cannot be written") && Catch::Contains("new"));
    auto found = timeless(result_in(folder / "o")), expected = timeless(result_in(folder / "whole"));
    for (auto* result : {&found, &expected}) (*result)["variants"]["pipeline"].erase("notes");
    CHECK(found == expected);
}

TEST_CASE("a run whose folder is replaced by a link writes to its folder, not to the link's") {
    const Folder folder;
    fs::create_directory(folder / "other");
    const std::vector<std::string> names{"result.json", "genome.json", "answer.csv", "checkpoint.cbor"};
    for (const std::string& name : names) folder.write("other/" + name, "precious");
    const Ended ended = moved(folder, "mv o own; ln -s other o");
    INFO(ended.err);
    CHECK((ended.code == 0 || ended.code == 3));
    CHECK_THAT(ended.out, Catch::Contains("was moved") && Catch::Contains("own"));
    for (const std::string& name : names) CHECK(rough::read_whole(folder / "other" / name) == "precious");
    CHECK(std::distance(fs::directory_iterator(folder / "other"), {}) == 4);
    CHECK(result_in(folder / "own").contains("variants"));
}
