#include "ga/refinement/nlopt.hpp"

#include "ga/refinement/nlopt_search.hpp"

namespace ga {

int algorithm_number(const std::string& name) {
    const int found = nlopt_algorithm_from_string(name.c_str());
    if (found < 0)
        throw UsageError("refine nlopt: unknown algorithm '" + name + "'; use one of NLopt's, e.g. LN_COBYLA");
    if (name.find("AUGLAG") != std::string::npos || name.find("MLSL") != std::string::npos)
        throw UsageError("refine nlopt: algorithm '" + name +
                         "' needs a second optimiser; use one that works alone, e.g. LN_COBYLA");
    return found;
}

void Nlopt::validate() const {
    const Eigen::Vector2d lower(-1, -1), upper(1, 1); // a build of NLopt may lack an algorithm
    NloptSearch search(static_cast<nlopt::algorithm>(algorithm_number(algorithm)), lower, upper, 1);
    search.minimize([](const Eigen::VectorXd& x, double* gradient) {
        if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, 2) = 2 * x;
        return x.squaredNorm();
    });
    search.from(Eigen::Vector2d(0.5, 0.5));
}

Eigen::VectorXd Nlopt::improve(const Landscape& land) const {
    nlopt::srand(static_cast<unsigned long>(land.seed));
    NloptSearch search(static_cast<nlopt::algorithm>(algorithm_number(algorithm)), land.lower, land.upper,
                       evaluations + 1);
    BestPoint best{land.start};
    Eigen::VectorXd violations; // at the last point with a successful evaluation
    if (land.constrained && takes_constraints() && !land.exhausted()) violations = land.constrained(land.start).second;
    const Eigen::Index rows = violations.size();
    // Methods that interpolate never return if a value is infinite or too large, so they get finite ones.
    constexpr double largest = 1e60;
    const auto inside = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { // some methods leave the box
        return x.cwiseMax(land.lower).cwiseMin(land.upper);
    };
    if (rows > 0)
        search.constrain(static_cast<unsigned>(rows), [&](const Eigen::VectorXd& x, double* c, double*) {
            if (const Eigen::VectorXd there = land.constrained(inside(x)).second; there.size() == rows)
                violations = there.cwiseMax(-largest).cwiseMin(largest);
            Eigen::Map<Eigen::VectorXd>(c, rows) = violations;
        });
    int used = 0; // some algorithms exceed their limit
    double lowest = largest, highest = -largest;
    const auto value_at = [&](const Eigen::VectorXd& x, double* gradient) -> double {
        if (rows > 0) {
            const auto [fitness, there] = land.constrained(x);
            best.offer(x, fitness, there.cwiseMax(0).sum());
            return -fitness;
        }
        double fitness = land.fitness(x);
        if (gradient) {
            Eigen::Map<Eigen::VectorXd> slope(gradient, x.size());
            slope.setZero();
            if (std::isfinite(fitness)) {
                const Eigen::VectorXd ascent = land.gradient(x);
                if (ascent.size() == x.size() && ascent.allFinite())
                    slope = -ascent;
                else
                    fitness = -HUGE_VAL;
            }
        }
        best.offer(x, fitness);
        return -fitness;
    };
    search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
        double value = HUGE_VAL;
        if (used++ > evaluations || land.exhausted())
            search->force_stop();
        else if (x.allFinite())
            value = value_at(inside(x), gradient);
        if (needs_gradient()) return value;
        if (!std::isfinite(value)) return lowest > highest ? 0 : highest + std::max(1.0, highest - lowest);
        value = std::clamp(value, -largest, largest);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
        return value;
    });
    search.from(land.start);
    return best.x;
}

ResidualMerit minus_largest(const Eigen::VectorXd& residuals) {
    Eigen::Index worst = 0;
    const double largest = residuals.cwiseAbs().maxCoeff(&worst);
    return {-largest, -largest, {{worst, residuals[worst] < 0 ? 1.0 : -1.0}}};
}

Eigen::VectorXd maximised_by_mma(const Landscape& land, int evaluations,
                                 const std::function<ResidualMerit(const Eigen::VectorXd&)>& read) {
    NloptSearch search(nlopt::LD_MMA, land.lower, land.upper, evaluations + 1);
    BestPoint best{land.start, -HUGE_VAL};
    search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
        Eigen::Map<Eigen::VectorXd> slope(gradient, gradient ? x.size() : 0);
        slope.setZero();
        if (land.exhausted()) {
            search->force_stop();
            return HUGE_VAL;
        }
        const std::optional<Sensitivity> at = land.sensitivity(x);
        if (!at) return HUGE_VAL;
        const ResidualMerit reading = read(at->residuals);
        if (gradient)
            for (const auto& [row, rate] : reading.slopes) slope -= rate * at->jacobian.row(row).transpose();
        best.offer(x, reading.merit);
        return -reading.value;
    });
    search.from(land.start);
    return best.x;
}

Eigen::VectorXd Mma::improve(const Landscape& land) const { return maximised_by_mma(land, evaluations, minus_largest); }

Eigen::VectorXd Minimax::improve(const Landscape& land) const {
    const Eigen::Index n = land.start.size();
    const std::optional<Sensitivity> first = land.exhausted() ? std::nullopt : land.sensitivity(land.start);
    if (!first) return land.start;
    const Eigen::Index rows = first->residuals.size();
    const double worst = first->residuals.cwiseAbs().maxCoeff();
    if (worst == 0) return land.start;
    // The first step is about half of the box, so the box of t is as narrow as possible.
    Eigen::VectorXd lower(n + 1), upper(n + 1), start(n + 1);
    lower << land.lower, 0.0;
    upper << land.upper, worst;
    start << land.start, worst;
    NloptSearch search(nlopt::LD_MMA, lower, upper, evaluations + 1);
    // By default LD_MMA solves each step's dual to 1e-14, which takes 160 times as long for the same result.
    search->set_param("dual_ftol_rel", 1e-6);
    BestPoint best{land.start, -worst};
    bool at_start = true; // the sensitivity there is known
    search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
        if (gradient) Eigen::Map<Eigen::VectorXd>(gradient, n + 1) = Eigen::VectorXd::Unit(n + 1, n);
        return x[n];
    });
    search.constrain(static_cast<unsigned>(2 * rows), [&](const Eigen::VectorXd& x, double* c, double* gradient) {
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        Eigen::Map<Eigen::VectorXd> values(c, 2 * rows);
        Eigen::Map<Rows> slopes(gradient, gradient ? 2 * rows : 0, gradient ? n + 1 : 0);
        values.setConstant(HUGE_VAL);
        slopes.setZero();
        if (!at_start && land.exhausted()) {
            search->force_stop();
            return;
        }
        const std::optional<Sensitivity> at = at_start ? first : land.sensitivity(x.head(n));
        at_start = false;
        if (!at) return;
        values << at->residuals.array() - x[n], -at->residuals.array() - x[n];
        if (gradient) {
            slopes.topLeftCorner(rows, n) = at->jacobian;
            slopes.bottomLeftCorner(rows, n) = -at->jacobian;
            slopes.col(n).setConstant(-1);
        }
        best.offer(x.head(n), -at->residuals.cwiseAbs().maxCoeff());
    });
    search.from(start);
    return best.x;
}

} // namespace ga
