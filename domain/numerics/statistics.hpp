#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace rough {

/// Pearson's correlation of two series of equal length; NaN where one of them does not vary.
double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b);

/// The value below which a share of the values lies, 0 to 1, linear between neighbours in order; values that
/// are NaN are left out, NaN of none.
double quantile(std::vector<double> values, double share);
/// The quantile of one half.
double median(std::vector<double> values);
/// Arithmetic mean; values that are NaN are left out, NaN of none.
double mean(const std::vector<double>& values);

/// Slope of the least-squares line through the points (x, y); NaN for fewer than two.
double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

/// A member of each row, or what a function says of it.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value value) {
    std::vector<double> values;
    for (const Row& row : rows)
        values.push_back(std::invoke(value, row));
    return values;
}

} // namespace rough
