#include "apps/experiments/compare/race_pipeline.hpp"

namespace app {

template Reached raced(const RealInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const RealInstance&, const std::string&);

} // namespace app
