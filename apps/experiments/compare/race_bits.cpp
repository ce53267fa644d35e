#include "apps/experiments/compare/race_pipeline.hpp"

namespace app {

template Reached raced(const BitsInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const BitsInstance&, const std::string&);

} // namespace app
