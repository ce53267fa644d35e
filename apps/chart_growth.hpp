#pragma once

#include "apps/chart_data.hpp"

namespace app {

/// seconds = factor * nodes^by_nodes * contact_fraction^by_contact, by least squares of logarithms.
struct Growth {
    rough::Solver method;
    double factor = 0, by_nodes = 0, by_contact = 0;
    std::size_t runs = 0; ///< that it was fitted to
    double spread = 0;    ///< the runs are off the fit by this factor, root mean square

    double seconds(double nodes, double contact_fraction) const;
};

/// Whether a run counts for the growth of cost: solved, 20 load steps, the usual tolerance.
bool counts_for_growth(const ChartRun& run);

/// A method's growth over those of its runs on 512 nodes or more that count, or `factor` 0 where there are
/// fewer than four.
Growth fitted_growth(rough::Solver method, const std::vector<ChartRun>& runs);

/// scene,method,nodes,contact_fraction,seconds
std::string growth_csv(const ChartData& data);

} // namespace app
