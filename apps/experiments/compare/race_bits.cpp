#include "apps/experiments/compare/race_pipeline.hpp"

namespace app {

Reached raced(const BitsInstance& instance, const std::string& pipeline, const std::vector<double>& targets,
              const Attempt& attempt) {
    return raced_by_pipeline(instance, pipeline, targets, attempt);
}

void expect_fits(const BitsInstance& instance, const std::string& pipeline) {
    expect_pipeline_fits(instance, pipeline);
}

} // namespace app
