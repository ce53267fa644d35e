#pragma once

#include <Eigen/Core>

#include <vector>

/// What BBOB's functions draw by: its generator of 2009, so that instances have COCO's own optima, rotations
/// and peaks.
namespace app::bbob {

/// n numbers in (0, 1): Park and Miller's minimal generator (1988) through a shuffling table of 32 (Bays and
/// Durham 1976).
std::vector<double> uniform(std::size_t n, long seed);

/// n normal numbers (Box and Muller 1958).
std::vector<double> gauss(std::size_t n, long seed);

/// An orthogonal matrix of normal columns, made so by Gram and Schmidt.
Eigen::MatrixXd rotation(int dimension, long seed);

/// Where an optimum lies, on a lattice of 8e-4 in [-4, 4]^n.
Eigen::VectorXd place_of_optimum(int dimension, long seed);

/// The seed of a function's instance; 3 and 4, 17 and 18 share theirs.
long seed_of(int function, int instance);

/// An optimum's value: a ratio of normal numbers, times 100, to two digits behind the point, within 1000 of
/// 0.
double value_of_optimum(int function, int instance);

} // namespace app::bbob
