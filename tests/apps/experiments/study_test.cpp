#include "apps/experiments/study.hpp"
#include "domain/errors.hpp"
#include "domain/text/atomic_file.hpp"
#include "tests/folder.hpp"

#include <catch2/catch.hpp>

using namespace app;
using nlohmann::json;
using tests::Folder;

TEST_CASE("a part of a run is gone on from, and refused where it was cut or kept under other settings") {
    const Folder folder;
    Progress progress;
    const std::atomic<bool> stop{false};
    Conditions conditions{{}, progress, stop, folder.path(), true, "sizes=1"};
    const auto part = [&] { return part_of(conditions, "a", [] { return json{0.1, "b"}; }); };
    CHECK(part() == json{0.1, "b"});
    CHECK(part_of(conditions, "a", [] { return json(2); }) == json{0.1, "b"});
    conditions.settings = "sizes=2";
    CHECK_THROWS_AS(part(), rough::InputError);

    const auto file = folder / "checkpoints/a.json";
    const std::string whole = rough::read_whole(file);
    for (const std::string& text :
         {whole.substr(0, whole.size() - 3), std::string(100, '['), std::string("[]"), std::string("{}"),
          std::string(R"({"settings":"sizes=2"})")}) {
        rough::write_atomically(file, text);
        INFO(text);
        CHECK_THROWS_AS(part(), rough::InputError);
    }
}
