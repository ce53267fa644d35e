#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "tests/fuzz/reader.hpp"

FUZZ(pipeline) {
    static const auto registry = rough::design_registry(rough::DesignSetup{});
    ga::Parser<rough::DesignProblem>(registry, rough::design_variants()).parse(std::string(bytes));
}
