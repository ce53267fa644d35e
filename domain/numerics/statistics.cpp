#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rough {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> known(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    return values;
}

} // namespace

double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    const Eigen::ArrayXd da = a - a.mean(), db = b - b.mean();
    const double spread = std::sqrt((da * da).sum() * (db * db).sum());
    const double noise = 1e-12 * std::sqrt((a * a).sum() * (b * b).sum());
    return spread > noise ? (da * db).sum() / spread : none;
}

double quantile(std::vector<double> values, double share) {
    values = known(std::move(values));
    if (values.empty())
        return none;
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - static_cast<double>(below)) * (above - values[below]);
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double mean(const std::vector<double>& values) {
    const std::vector<double> all = known(values);
    return all.empty() ? none
                       : std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    if (x.size() < 2)
        return none;
    const Eigen::ArrayXd dx = x.array() - x.mean();
    return (dx * (y.array() - y.mean())).sum() / dx.square().sum();
}

} // namespace rough
