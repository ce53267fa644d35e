#include "apps/experiments/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace app {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What `difference` says of the two curves at each point of `a` within the range of `b`.
template <class Difference>
std::vector<double> differences(const rough::Curve& a, const rough::Curve& b, Difference difference) {
    std::vector<double> all;
    for (Eigen::Index i = 0; i < a.x.size(); ++i)
        if (a.x[i] >= b.from && a.x[i] <= b.to && a.y[i] != 0)
            all.push_back(difference(a.y[i], b.at(a.x[i])));
    return all;
}

} // namespace

double median(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty())
        return none;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    int count = 0;
    for (double value : values)
        if (!std::isnan(value)) {
            sum += value;
            ++count;
        }
    return sum / count;
}

double relative_gap(const rough::Curve& a, const rough::Curve& b) {
    return mean(differences(a, b, [](double here, double there) { return std::abs(there / here - 1); }));
}

double gap(const rough::Curve& a, const rough::Curve& b) {
    const auto all = differences(a, b, [](double here, double there) { return std::abs(there - here); });
    return all.empty() ? none : *std::max_element(all.begin(), all.end());
}

double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    if (x.size() < 2)
        return none;
    const Eigen::ArrayXd dx = x.array() - x.mean();
    return (dx * (y.array() - y.mean())).sum() / dx.square().sum();
}

} // namespace app
