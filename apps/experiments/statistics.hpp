#pragma once

#include "domain/response/curve.hpp"

#include <functional>
#include <vector>

namespace app {

/// A member of each row, or what a function says of it.
template <class Row, class Value>
std::vector<double> column(const std::vector<Row>& rows, Value value) {
    std::vector<double> values;
    for (const Row& row : rows)
        values.push_back(std::invoke(value, row));
    return values;
}

double median(std::vector<double> values);      ///< NaN of none; those that are NaN are left out
double mean(const std::vector<double>& values); ///< the same

/// Mean relative difference |b - a|/a at the points of `a` that both can be read at; NaN if there is none, or
/// a is 0.
double relative_gap(const rough::Curve& a, const rough::Curve& b);

/// Largest difference |b - a| at the points of `a` that both can be read at.
double gap(const rough::Curve& a, const rough::Curve& b);

/// Slope of a least-squares line through the points; NaN for fewer than two.
double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y);

} // namespace app
