#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace app {

/// Columns of equal length as CSV: header first, a row a line, 17 significant digits.
std::string csv(const std::vector<std::string>& header, const std::vector<Eigen::VectorXd>& columns);

} // namespace app
