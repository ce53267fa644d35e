#include "apps/experiments/compare/race_pipeline.hpp"

namespace app {

template Reached raced(const TourInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const TourInstance&, const std::string&);

} // namespace app
