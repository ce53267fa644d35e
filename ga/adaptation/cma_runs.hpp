#pragma once

#include "ga/base/random.hpp"

#include <Eigen/Eigenvalues>

#include <numeric>
#include <vector>

namespace ga {

/// The constants of CMA-ES for n variables and `lambda` children (Hansen, The CMA Evolution Strategy: A
/// Tutorial, arXiv:1604.00772, 2016; also for equation numbers).
struct CmaConstants {
    std::size_t lambda; ///< number of children per generation
    Eigen::Index mu;    ///< number of parents: children whose weight is above 0
    Eigen::VectorXd
        weights;        ///< size lambda, best child first; the first mu sum to 1, later ones are 0 or less
    double mu_eff;      ///< variance-effective number of parents, Eq. 8
    double c_c;         ///< decay of C's path, Eq. 56
    double c_sigma;     ///< decay of sigma's path, Eq. 55
    double c_1;         ///< rate of the rank-one update, Eq. 57
    double c_mu;        ///< rate of the rank-mu update, Eq. 58
    double d_sigma;     ///< damping of sigma, Eq. 55
    double chi;         ///< expected length of a standard normal vector
    Eigen::Index every; ///< generations between two decompositions of the covariance, 1 or more

    /// The number of children by Eq. 48.
    static std::size_t usual_children(Eigen::Index n) {
        return 4 + static_cast<std::size_t>(3 * std::log(static_cast<double>(n)));
    }
    /// The constants for n = `variables` >= 1 and lambda = `children` >= 2.
    CmaConstants(Eigen::Index variables, std::size_t children)
        : lambda(children), mu(static_cast<Eigen::Index>(children / 2)),
          weights(static_cast<Eigen::Index>(children)) {
        const auto n = static_cast<double>(variables);
        for (Eigen::Index i = 0; i < weights.size(); ++i) // Eq. 49
            weights[i] =
                std::log((static_cast<double>(children) + 1) / 2) - std::log(static_cast<double>(i + 1));
        const auto effective = [](const auto& w) { return w.sum() * w.sum() / w.squaredNorm(); };
        auto above = weights.head(mu), below = weights.tail(weights.size() - mu);
        mu_eff = effective(above);
        c_sigma = (mu_eff + 2) / (n + mu_eff + 5);                                        // Eq. 55
        d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma; // Eq. 55
        c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);                                // Eq. 56
        c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);                                       // Eq. 57
        c_mu =
            std::min(1 - c_1, 2 * (0.25 + mu_eff + 1 / mu_eff - 2) / ((n + 2) * (n + 2) + mu_eff)); // Eq. 58
        chi = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
        above /= above.sum();
        const double least = std::min({1 + c_1 / c_mu,                                             // Eq. 50
                                       1 + 2 * effective(below) / (mu_eff + 2),                    // Eq. 51
                                       (1 - c_1 - c_mu) / (n * c_mu)});                            // Eq. 52
        below *= below.sum() < 0 && std::isfinite(least) ? least / -below.sum() : 0;               // Eq. 53
        every = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(1 / (10 * n * (c_1 + c_mu)))); // B.2
    }
};

/// The normal distribution of CMA-ES. Equation numbers as in CmaConstants.
struct Cloud {
    Eigen::VectorXd mean;       ///< mean, n values
    double sigma = 0;           ///< step size
    Eigen::MatrixXd covariance; ///< covariance C, n x n
    Eigen::VectorXd path_sigma; ///< evolution path of sigma, n values
    Eigen::VectorXd path_c;     ///< evolution path of C, n values
    Eigen::MatrixXd axes;       ///< B, eigenvectors of C as it was last decomposed
    Eigen::VectorXd scales;     ///< D, square roots of the eigenvalues of C
    Eigen::Index learnt = 0;    ///< number of generations from which it has learnt
    Eigen::Index drawn = 0;     ///< value of `learnt` when C was last decomposed

    Cloud() = default;
    /// An isotropic distribution with this mean and step size.
    Cloud(Eigen::VectorXd middle, double step)
        : mean(std::move(middle)), sigma(step),
          covariance(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
          path_sigma(Eigen::VectorXd::Zero(mean.size())), path_c(path_sigma), axes(covariance),
          scales(Eigen::VectorXd::Ones(mean.size())) {}

    /// The point for a standard normal vector (Eq. 38-40).
    Eigen::VectorXd at(const Eigen::VectorXd& z) const {
        return mean + sigma * (axes * scales.cwiseProduct(z));
    }
    /// C^(-1/2) y.
    Eigen::VectorXd whitened(const Eigen::VectorXd& y) const {
        return axes * (axes.transpose() * y).cwiseQuotient(scales);
    }
    /// Learns from steps (x - mean)/sigma, one or more columns, best first. With fewer than lambda steps the
    /// last weights are not used and the positive ones sum to 1 again. Negative weights of `altered` steps
    /// (of any size) are not used either: Eq. 46 assumes that their length is random.
    void learn(const CmaConstants& c, const Eigen::MatrixXd& steps, const std::vector<bool>& altered = {}) {
        const Eigen::Index n = mean.size(), used = std::min(steps.cols(), c.weights.size());
        const Eigen::Index parents = std::min(c.mu, used);
        Eigen::VectorXd weights = c.weights.head(used);
        weights.head(parents) /= weights.head(parents).sum();
        for (Eigen::Index i = parents; i < used; ++i)
            if (const auto k = static_cast<std::size_t>(i); k < altered.size() && altered[k])
                weights[i] = 0;
        const Eigen::VectorXd step = steps.leftCols(parents) * weights.head(parents); // Eq. 41
        mean += sigma * step;                                                         // Eq. 42
        path_sigma = (1 - c.c_sigma) * path_sigma +
                     std::sqrt(c.c_sigma * (2 - c.c_sigma) * c.mu_eff) * whitened(step); // Eq. 43
        ++learnt;
        const double length = path_sigma.norm() / c.chi;
        const double settled = 1 - std::pow(1 - c.c_sigma, 2 * static_cast<double>(learnt));
        const bool calm = length / std::sqrt(settled) < 1.4 + 2 / (static_cast<double>(n) + 1);
        path_c = (1 - c.c_c) * path_c;
        if (calm)
            path_c += std::sqrt(c.c_c * (2 - c.c_c) * c.mu_eff) * step; // Eq. 45
        const double decay = 1 + (calm ? 0 : c.c_1 * c.c_c * (2 - c.c_c)) - c.c_1 - c.c_mu * weights.sum();
        for (Eigen::Index i = parents; i < used; ++i) // Eq. 46
            weights[i] *= static_cast<double>(n) / std::max(whitened(steps.col(i)).squaredNorm(), 1e-300);
        const auto columns = steps.leftCols(used);
        covariance = (decay * covariance + c.c_1 * path_c * path_c.transpose() +
                      c.c_mu * columns * weights.asDiagonal() * columns.transpose())
                         .eval();                                               // Eq. 47
        sigma *= std::exp(std::min(1.0, c.c_sigma / c.d_sigma * (length - 1))); // Eq. 44
        if (learnt - drawn >= c.every)
            decompose();
    }

  private:
    void decompose() {
        covariance = (0.5 * (covariance + covariance.transpose())).eval();
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
        axes = solver.eigenvectors();
        scales = solver.eigenvalues().cwiseMax(1e-40 * solver.eigenvalues().maxCoeff()).cwiseSqrt();
        drawn = learnt;
    }
};

/// The progress of one run of CMA-ES, with higher values being better.
struct CmaRecord {
    std::vector<double> best;   ///< best value per generation, as far back as the rules need
    std::vector<double> median; ///< median value per generation
    std::vector<double> equal;  ///< 1 if the best and the k-th best value were equal
    long spent = 0;             ///< number of children that were scored

    /// Adds the values of a generation, best first.
    void note(const std::vector<double>& values, std::size_t lambda) {
        const auto k = static_cast<std::size_t>(1 + std::ceil(0.1 + static_cast<double>(lambda) / 4));
        best.push_back(values.front());
        median.push_back(values[values.size() / 2]);
        equal.push_back(values.size() >= k && values[k - 1] == values.front() ? 1 : 0);
        spent += static_cast<long>(values.size());
    }
    /// Forgets generations that no rule needs.
    void forget(std::size_t window) {
        for (auto* each : {&best, &median, &equal})
            if (each->size() > 2 * window)
                each->erase(each->begin(), each->end() - static_cast<std::ptrdiff_t>(window));
    }
};

/// Why a run of CMA-ES is over, or null. The rules are those of Hansen (2009, Benchmarking a BI-population
/// CMA-ES on the BBOB-2009 function testbed, sec. 2.1); Stagnation has a window of 120 + 30 n/lambda
/// generations. `scale` is the run's first sigma.
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

/// The sequence of runs. In IPOP each has four times the children of the previous one; Auger and Hansen
/// (2005) double them. In BIPOP (Hansen 2009) the large runs double, and as many evaluations are spent on
/// additional runs with few children and small steps.
struct CmaPlan {
    std::size_t usual = 0;    ///< number of children of the first run
    std::size_t restarts = 0; ///< number of large runs after the first
    long large = 0;           ///< evaluations spent in large runs
    long small = 0;           ///< evaluations spent in small runs
    long last_large = 0;      ///< evaluations of the last large run
    bool now_large = false;   ///< whether the current run is large
    bool begun = false;       ///< whether the first run is over

    /// Settings of a run.
    struct Run {
        std::size_t lambda; ///< number of children
        double shrink;      ///< factor of the first sigma
        long most;          ///< maximum number of evaluations; 0 for no limit
    };
    /// The next run, after one that spent this number of evaluations.
    Run next(long spent, bool both, Stream& random) {
        if (begun)
            (now_large ? large : small) += spent;
        if (now_large)
            last_large = spent;
        begun = true;
        now_large = !both || large <= small;
        if (now_large)
            return {usual << std::min<std::size_t>((both ? 1 : 2) * ++restarts, 20), 1, 0};
        const double ratio = 0.5 * std::pow(2, static_cast<double>(restarts)), u = random.uniform();
        const double children = static_cast<double>(usual) * std::pow(ratio, u * u);
        return {static_cast<std::size_t>(children), std::pow(10, -2 * random.uniform()), last_large / 2};
    }
};

} // namespace ga
