#pragma once

#include "domain/scan/scan.hpp"

namespace rough {

/// Heights (even nodes) less their least-squares mean, line or parabola; unchanged for Detrend::none.
Eigen::VectorXd detrended(const Eigen::VectorXd& heights, Detrend form);

} // namespace rough
