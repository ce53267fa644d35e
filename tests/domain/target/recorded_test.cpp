#include "domain/errors.hpp"
#include "domain/target/target.hpp"
#include "domain/text/words.hpp"
#include "tests/catch.hpp"

using namespace rough;

namespace {

Model model_with(Kernel kernel, Index rows = 1) {
    return completed(Model{.grid = {.nodes = 65, .length = 2, .rows = rows, .width = rows > 1 ? 1.5 : 0},
                           .body = {.kernel = kernel, .effective_modulus = 3}});
}

Target recorded_with(const Model& model) { return {.name = "t.csv", .recorded = recorded_model(model)}; }

} // namespace

TEST_CASE("a recorded number that differs by more than a billionth is named alone") {
    for (const auto& [own_key, model] : {std::pair("datum_mm", model_with(Kernel::free)),
                                         {"strip_width_mm", model_with(Kernel::strip)},
                                         {"width_mm", model_with(Kernel::free, 49)}}) {
        CHECK(recorded_differences(recorded_with(model), model).empty());
        for (const char* key : {"length_mm", "effective_modulus_MPa", own_key}) {
            Target target = recorded_with(model);
            target.recorded[key] = field_text(number_from(target.recorded.at(key), key) * (1 + 1.1e-9));
            const auto found = recorded_differences(target, model);
            REQUIRE(found.size() == 1);
            CHECK(found[0].key == key);
        }
    }
}

TEST_CASE("another kernel and a missing datum are differences, unrecorded values are not") {
    Target target = recorded_with(model_with(Kernel::free));
    const Model strip = model_with(Kernel::strip);
    CHECK(in_words(recorded_differences(target, strip)) == "kernel free (here strip), datum_mm 2");
    CHECK_THROWS_AS(expect_recorded(target, strip), InputError);
    target.recorded = {{"kernel", ""}, {"nodes", "7"}};
    CHECK_NOTHROW(expect_recorded(target, strip));
    target.recorded = {{"length_mm", "long"}};
    CHECK_THROWS_AS(recorded_differences(target, strip), InputError);
}
