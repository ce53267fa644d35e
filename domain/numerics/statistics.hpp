#pragma once

#include <Eigen/Core>

namespace rough {

/// Pearson's correlation of two series of equal length; NaN where one of them does not vary.
double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b);

} // namespace rough
