#include "domain/numerics/statistics.hpp"

#include "ga/base/random.hpp"

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

double share_up_to(const std::vector<double>& values, double limit) {
    const auto count = std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; });
    return values.empty() ? none : static_cast<double>(count) / static_cast<double>(values.size());
}

Interval median_interval(std::vector<double> values, double confidence) {
    std::sort(values.begin(), values.end(),
              [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
    // The k-th from either end miss the median where fewer than k of n fair coins fall on that side.
    const std::size_t n = values.size();
    double fewer = std::ldexp(1.0, -static_cast<int>(n)), term = fewer;
    std::size_t k = 0;
    while (k + 1 < (n + 1) / 2) {
        const double next = term * static_cast<double>(n - k) / static_cast<double>(k + 1);
        if (1 - 2 * (fewer + next) < confidence)
            break;
        term = next;
        fewer += term;
        ++k;
    }
    return {values[k], values[n - 1 - k], 1 - 2 * fewer};
}

Interval bootstrap_interval(std::size_t n,
                            const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            std::size_t draws, double confidence, std::uint64_t seed) {
    std::vector<double> found;
    std::vector<std::size_t> picks(n);
    for (std::size_t draw = 0; draw < draws; ++draw) {
        ga::Stream stream(ga::fold(seed, draw));
        for (std::size_t& pick : picks)
            pick = stream.below(n);
        found.push_back(statistic(picks));
    }
    return {quantile(found, (1 - confidence) / 2), quantile(found, (1 + confidence) / 2), confidence};
}

double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    if (x.size() < 2)
        return none;
    const Eigen::ArrayXd dx = x.array() - x.mean();
    return (dx * (y.array() - y.mean())).sum() / dx.square().sum();
}

} // namespace rough
