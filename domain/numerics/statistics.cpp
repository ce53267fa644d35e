#include "domain/numerics/statistics.hpp"

#include "ga/base/random.hpp"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <numeric>

namespace rough {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<double> known(std::vector<double> values) {
    std::erase_if(values, [](double value) { return std::isnan(value); });
    return values;
}

/// Twice a rank or a sum of ranks, which is a whole number.
std::size_t doubled(double rank) { return static_cast<std::size_t>(2 * rank); }

/// Twice the smaller tail at `seen`, of counts by value.
double two_sided(const std::vector<double>& counts, std::size_t seen) {
    double below = 0, above = 0, all = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
        all += counts[s];
        below += s <= seen ? counts[s] : 0;
        above += s >= seen ? counts[s] : 0;
    }
    return std::min(1.0, 2 * std::min(below, above) / all);
}

/// Both tails of a normal distribution, half a step nearer to its mean.
double two_sided_normal(double seen, double mean, double variance) {
    if (!(variance > 0)) return 1;
    const double away = std::max(0.0, std::abs(seen - mean) - 0.5);
    return std::erfc(away / std::sqrt(2 * variance));
}

double squares(const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
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
    if (values.empty()) return none;
    std::sort(values.begin(), values.end());
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - static_cast<double>(below)) * (above - values[below]);
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

double mean(const std::vector<double>& values) {
    const std::vector<double> all = known(values);
    return all.empty() ? none : std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

double share_up_to(const std::vector<double>& values, double limit) {
    const auto count = std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; });
    return values.empty() ? none : static_cast<double>(count) / static_cast<double>(values.size());
}

Interval median_interval(std::vector<double> values, double confidence) {
    std::sort(values.begin(), values.end(), [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
    // The k-th from either end miss the median where fewer than k of n fair coins fall on that side.
    const std::size_t n = values.size();
    double fewer = std::ldexp(1.0, -static_cast<int>(n)), term = fewer;
    std::size_t k = 0;
    while (k + 1 < (n + 1) / 2) {
        const double next = term * static_cast<double>(n - k) / static_cast<double>(k + 1);
        if (1 - 2 * (fewer + next) < confidence) break;
        term = next;
        fewer += term;
        ++k;
    }
    return {values[k], values[n - 1 - k], 1 - 2 * fewer};
}

Interval bootstrap_interval(std::size_t n, const std::function<double(const std::vector<std::size_t>&)>& statistic,
                            std::size_t draws, double confidence, std::uint64_t seed) {
    std::vector<double> found;
    std::vector<std::size_t> picks(n);
    for (std::size_t draw = 0; draw < draws; ++draw) {
        ga::Stream stream(ga::fold(seed, draw));
        for (std::size_t& pick : picks) pick = stream.below(n);
        found.push_back(statistic(picks));
    }
    return {quantile(found, (1 - confidence) / 2), quantile(found, (1 + confidence) / 2), confidence};
}

double slope(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    if (x.size() < 2) return none;
    const Eigen::ArrayXd dx = x.array() - x.mean();
    return (dx * (y.array() - y.mean())).sum() / dx.square().sum();
}

std::vector<std::size_t> ascending(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
    return order;
}

std::vector<double> ranks(const std::vector<double>& values) {
    const std::vector<std::size_t> order = ascending(values);
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < order.size();) {
        std::size_t end = i;
        while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
        for (std::size_t k = i; k < end; ++k) result[order[k]] = static_cast<double>(i + 1 + end) / 2;
        i = end;
    }
    return result;
}

double rank_sum_p(const std::vector<double>& first, const std::vector<double>& second) {
    constexpr std::size_t max_counted = 60;
    std::vector<double> all = first;
    all.insert(all.end(), second.begin(), second.end());
    const std::size_t n = first.size(), total = all.size();
    if (n == 0 || n == total) return 1;
    const std::vector<double> rank = ranks(all);
    const double seen = std::accumulate(rank.begin(), rank.begin() + static_cast<long>(n), 0.0);
    if (total > max_counted) {
        const double N = static_cast<double>(total), share = static_cast<double>(n) / N;
        const double spread = squares(rank) / N - (N + 1) * (N + 1) / 4; // variance of one rank; ties lessen it
        return two_sided_normal(seen, share * N * (N + 1) / 2, share * (1 - share) * N * N / (N - 1) * spread);
    }
    const std::size_t largest = total * (total + 1); // twice the sum of all ranks
    // counts[k][s]: number of choices of k ranks with the sum s
    std::vector<std::vector<double>> counts(n + 1, std::vector<double>(largest + 1, 0.0));
    counts[0][0] = 1;
    for (const double r : rank)
        for (std::size_t k = n; k >= 1; --k)
            for (std::size_t s = doubled(r); s <= largest; ++s) counts[k][s] += counts[k - 1][s - doubled(r)];
    return two_sided(counts[n], doubled(seen));
}

double signed_rank_p(std::vector<double> differences) {
    constexpr std::size_t max_counted = 400;
    std::erase(differences, 0.0);
    if (differences.empty()) return 1;
    std::vector<double> sizes;
    for (const double difference : differences) sizes.push_back(std::abs(difference));
    const std::vector<double> rank = ranks(sizes);
    double seen = 0;
    for (std::size_t i = 0; i < rank.size(); ++i) seen += differences[i] > 0 ? rank[i] : 0;
    if (sizes.size() > max_counted)
        return two_sided_normal(seen, std::accumulate(rank.begin(), rank.end(), 0.0) / 2, squares(rank) / 4);
    std::vector<double> chance{1.0}; // probability of each sum of the ranks with a positive sign
    for (const double r : rank) {
        std::vector<double> next(chance.size() + doubled(r), 0.0);
        for (std::size_t s = 0; s < chance.size(); ++s) {
            next[s] += chance[s] / 2;
            next[s + doubled(r)] += chance[s] / 2;
        }
        chance = std::move(next);
    }
    return two_sided(chance, doubled(seen));
}

Friedman friedman(const std::vector<std::vector<double>>& blocks) {
    const std::size_t treatments = blocks.front().size();
    const double n = static_cast<double>(blocks.size()), k = static_cast<double>(treatments);
    Friedman result;
    result.mean_ranks.assign(treatments, 0.0);
    double squared = 0;
    for (const auto& block : blocks) {
        const std::vector<double> rank = ranks(block);
        squared += squares(rank);
        for (std::size_t j = 0; j < treatments; ++j) result.mean_ranks[j] += rank[j];
    }
    double between = 0;
    for (double& mean : result.mean_ranks) {
        mean /= n;
        between += (mean - (k + 1) / 2) * (mean - (k + 1) / 2);
    }
    const double within = squared - n * k * (k + 1) * (k + 1) / 4;
    if (within > 1e-9) { // otherwise every block is one tie
        result.statistic = (k - 1) * n * n * between / within;
        result.p = boost::math::gamma_q((k - 1) / 2, result.statistic / 2);
    }
    return result;
}

std::vector<double> holm(const std::vector<double>& p) {
    std::vector<double> corrected(p.size());
    double lowest = 0;
    std::size_t left = p.size();
    for (const std::size_t i : ascending(p))
        corrected[i] = lowest = std::max(lowest, std::min(1.0, static_cast<double>(left--) * p[i]));
    return corrected;
}

} // namespace rough
