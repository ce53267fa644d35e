#pragma once

#include "ga/adaptation/covariance.hpp"
#include "ga/base/random.hpp"

#include <limits>
#include <numeric>
#include <vector>

namespace ga {

/// What one run of CMA-ES has come to: values turned so that greater is better.
struct CmaRecord {
    std::vector<double> best;   ///< of each generation, as far back as the rules look
    std::vector<double> median; ///< likewise
    std::vector<double> equal;  ///< 1 where the best and the k-th best were the same
    long spent = 0;             ///< children that were scored
    double to_beat = std::numeric_limits<double>::lowest(); ///< best value of the runs before

    /// Notes a generation's values, best first.
    void note(const std::vector<double>& values, std::size_t lambda) {
        const auto k = static_cast<std::size_t>(1 + std::ceil(0.1 + static_cast<double>(lambda) / 4));
        best.push_back(values.front());
        median.push_back(values[values.size() / 2]);
        equal.push_back(values.size() >= k && values[k - 1] == values.front() ? 1 : 0);
        spent += static_cast<long>(values.size());
    }
    /// Forgets what no rule looks at.
    void forget(std::size_t window) {
        for (auto* each : {&best, &median, &equal})
            if (each->size() > 2 * window)
                each->erase(each->begin(), each->end() - static_cast<std::ptrdiff_t>(window));
    }
};

/// Why a run of CMA-ES is over, or null: the rules of Hansen (2009, Benchmarking a BI-population CMA-ES on
/// the BBOB-2009 function testbed, sec. 2.1), with Stagnation over a window of 120 + 30 n/lambda generations,
/// and one rule more: Inferior, if the run is worse than an earlier one by more than ten times what its best
/// values of late differ by. `scale` is the run's first sigma.
inline const char* over(const Cloud& cloud, const CmaConstants& c, CmaRecord& record, double scale) {
    const auto n = static_cast<double>(cloud.mean.size()), lambda = static_cast<double>(c.lambda);
    const auto last = [](const std::vector<double>& all, double count) {
        return std::vector<double>(static_cast<double>(all.size()) > count
                                       ? all.end() - static_cast<std::ptrdiff_t>(count)
                                       : all.begin(),
                                   all.end());
    };
    const double few = 10 + std::ceil(30 * n / lambda), many = 120 + std::ceil(30 * n / lambda);
    record.forget(static_cast<std::size_t>(std::max(many, n)));
    const auto generations = static_cast<double>(cloud.learnt);
    const Eigen::VectorXd deviations = cloud.sigma * cloud.covariance.diagonal().cwiseSqrt();
    if (generations >= 100 + 50 * (n + 3) * (n + 3) / std::sqrt(lambda))
        return "MaxIter";
    if (generations >= few) {
        const auto recent = last(record.best, few);
        const auto [low, high] = std::minmax_element(recent.begin(), recent.end());
        if (*high - *low < 1e-12)
            return "TolHistFun";
        if (record.to_beat - *high > 10 * (*high - *low))
            return "Inferior";
    }
    const auto equal = last(record.equal, n);
    if (generations >= n && std::accumulate(equal.begin(), equal.end(), 0.0) > n / 3)
        return "EqualFunVals";
    if (deviations.maxCoeff() < 1e-12 * scale &&
        cloud.sigma * cloud.path_c.cwiseAbs().maxCoeff() < 1e-12 * scale)
        return "TolX";
    if (!(cloud.sigma <= 1e20 * scale * cloud.scales.maxCoeff()))
        return "TolUpSigma";
    if (static_cast<double>(record.best.size()) >= many) {
        const auto middle = [](std::vector<double> part) {
            std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2),
                             part.end());
            return part[part.size() / 2];
        };
        const auto better = [&](const std::vector<double>& all) {
            const auto window = last(all, many);
            return middle({window.end() - 20, window.end()}) > middle({window.begin(), window.begin() + 20});
        };
        if (!better(record.best) && !better(record.median))
            return "Stagnation";
    }
    if (std::pow(cloud.scales.maxCoeff() / cloud.scales.minCoeff(), 2) > 1e14)
        return "ConditionCov";
    const Eigen::Index axis = cloud.learnt % cloud.mean.size();
    if (cloud.mean == cloud.mean + 0.1 * cloud.sigma * cloud.scales[axis] * cloud.axes.col(axis))
        return "NoEffectAxis";
    if (((cloud.mean + 0.2 * deviations).array() == cloud.mean.array()).any())
        return "NoEffectCoord";
    return nullptr;
}

/// How runs follow each other: with twice the children each time (IPOP: Auger and Hansen 2005), or besides as
/// many evaluations in runs of few children and small steps (BIPOP: Hansen 2009).
struct CmaPlan {
    std::size_t usual = 0;     ///< children of the first run
    std::size_t doublings = 0; ///< large runs after the first
    long large = 0;            ///< evaluations spent in these
    long small = 0;            ///< evaluations spent in small runs
    long last_large = 0;       ///< of the last large run
    bool now_large = false;    ///< the run that is
    bool begun = false;        ///< whether the first is over

    /// Of a run.
    struct Run {
        std::size_t lambda; ///< children
        double shrink;      ///< of the first sigma
        long most;          ///< evaluations; 0 for no such end
    };
    /// The next, after one that spent so many evaluations.
    Run next(long spent, bool both, Stream& random) {
        if (begun)
            (now_large ? large : small) += spent;
        if (now_large)
            last_large = spent;
        begun = true;
        now_large = !both || large <= small;
        if (now_large)
            return {usual << std::min<std::size_t>(++doublings, 20), 1, 0};
        const double ratio = 0.5 * std::pow(2, static_cast<double>(doublings)), u = random.uniform();
        const double children = static_cast<double>(usual) * std::pow(ratio, u * u);
        return {static_cast<std::size_t>(children), std::pow(10, -2 * random.uniform()), last_large / 2};
    }
};

} // namespace ga
