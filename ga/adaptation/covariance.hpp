#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ga {

/// The constants of CMA-ES for n variables and `lambda` children (Hansen, The CMA Evolution Strategy: A
/// Tutorial, arXiv:1604.00772, 2016; equation numbers are its own).
struct CmaConstants {
    std::size_t lambda;      ///< children a generation
    Eigen::Index mu;         ///< parents: children whose weight is above 0
    Eigen::VectorXd weights; ///< lambda, best child first; the first mu sum to 1, the others are 0 or less
    double mu_eff;           ///< variance-effective number of parents, Eq. 8
    double c_c;              ///< of the path of C, Eq. 56
    double c_sigma;          ///< of the path of sigma, Eq. 55
    double c_1;              ///< of the rank-one update, Eq. 57
    double c_mu;             ///< of the rank-mu update, Eq. 58
    double d_sigma;          ///< damping of sigma, Eq. 55
    double chi;              ///< expected length of a standard normal vector
    Eigen::Index every;      ///< generations between two decompositions of the covariance, 1 or more

    /// As many children as Eq. 48 proposes.
    static std::size_t usual_children(Eigen::Index n) {
        return 4 + static_cast<std::size_t>(3 * std::log(static_cast<double>(n)));
    }
    /// n >= 1, children >= 2.
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

/// The normal distribution that CMA-ES draws from and learns. Equation numbers as above.
struct Cloud {
    Eigen::VectorXd mean;       ///< n
    double sigma = 0;           ///< step size
    Eigen::MatrixXd covariance; ///< C, n x n
    Eigen::VectorXd path_sigma; ///< evolution path of sigma, n
    Eigen::VectorXd path_c;     ///< evolution path of C, n
    Eigen::MatrixXd axes;       ///< B, eigenvectors of C as it was last decomposed
    Eigen::VectorXd scales;     ///< D, roots of its eigenvalues
    Eigen::Index learnt = 0;    ///< generations
    Eigen::Index drawn = 0;     ///< of these when C was last decomposed

    Cloud() = default;
    /// Round about a point.
    Cloud(Eigen::VectorXd middle, double step)
        : mean(std::move(middle)), sigma(step),
          covariance(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
          path_sigma(Eigen::VectorXd::Zero(mean.size())), path_c(path_sigma), axes(covariance),
          scales(Eigen::VectorXd::Ones(mean.size())) {}

    /// The point of a standard normal vector (Eq. 38-40).
    Eigen::VectorXd at(const Eigen::VectorXd& z) const {
        return mean + sigma * (axes * scales.cwiseProduct(z));
    }
    /// C^(-1/2) y.
    Eigen::VectorXd whitened(const Eigen::VectorXd& y) const {
        return axes * (axes.transpose() * y).cwiseQuotient(scales);
    }
    /// Learns from steps (x - mean)/sigma, a column each, one at least, best first; where there are less than
    /// lambda, the weights of the last are not used and the positive ones sum to 1 again. Nor are weights
    /// below 0 of those that were not drawn so (`altered`, of any size): Eq. 46 takes their length for
    /// chance's.
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

} // namespace ga
