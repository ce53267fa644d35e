#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace app {

/// Figure 1: chromosome n of a series with M = 8, gamma = 1.5, L = lambda_1 = 0.1 mm (H = 0.8, A = 1e-2), its
/// phases drawn at random, summed ridge by ridge as Eq. 1 prints it.
struct ChromosomeExample {
    int n;
    double wave_length;                  ///< lambda gamma^(1-n), mm
    Eigen::VectorXd x;                   ///< mm
    std::vector<Eigen::VectorXd> ridges; ///< G [cos(phi) - cos(k x + phi)], mm
    Eigen::VectorXd sum;                 ///< mm
    double misfit; ///< largest distance of the sum from the best cosine of that wave length, over its range
};

ChromosomeExample chromosome_example(int n, std::uint64_t seed);

} // namespace app
