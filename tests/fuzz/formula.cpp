#include "apps/prompt/targets.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(formula) {
    const auto f = app::formula(std::string(bytes), "p", "--formula");
    f(0.5);
}
