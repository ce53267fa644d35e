#pragma once

#include "apps/experiments/chart/data.hpp"

#include <Eigen/Core>

namespace app {

/// How the time of a curve of 20 load steps grows with the nodes N and those in contact at the last step, m.
/// Of the direct methods a N log2(2N) + b m^3 (nested) or a N log2(2N) + b m^2 N (NNLS, which checks all
/// nodes for each that it adds): the FFTs, and the factor. Of the iterative ones c N^a f^b, f = m/N.
struct Growth {
    Eigen::VectorXd coefficients; ///< a, b in s; or c in s, a, b. None where there are too few runs
    std::string law;              ///< the same as HTML
    double spread = 0;            ///< the runs are off the law by this factor, root mean square of logarithms
    std::size_t runs = 0;         ///< that it was fitted to
};

/// Whether a run counts for the growth of cost: solved, 20 load steps, the usual tolerance.
bool counts_for_growth(const ChartRun& run);

/// A method's growth over those of its runs on 512 nodes or more that count, by least squares of relative
/// errors (of logarithms, for the powers).
Growth fitted_growth(rough::Solver method, const std::vector<ChartRun>& runs);

/// scene,method,nodes,contact_fraction,seconds
std::string growth_csv(const ChartData& data);

} // namespace app
