#pragma once

#include "apps/chart_runs.hpp"

namespace app {

/// seconds = factor * nodes^by_nodes * contact_fraction^by_contact, by least squares of logarithms.
struct Growth {
    std::string method;
    double factor = 0, by_nodes = 0, by_contact = 0;
    std::size_t runs = 0; ///< that it was fitted to
};

/// A method's growth over its solved runs, or none where there are fewer than four.
Growth fitted_growth(const std::string& method, const std::vector<ChartRun>& runs);

/// scene,method,nodes,contact_fraction,seconds
std::string growth_csv(const std::vector<ChartRun>& runs);

} // namespace app
