#pragma once

#include "ga/refinement/landscape.hpp"

#include <nlopt.hpp>

#include <exception>

namespace ga {

/// Runs one NLopt optimisation (NLopt 2.7) in a box. An exception of a callback stops the search and is
/// thrown again at its end. If rounding limits the search, it ends without an error. The optimiser is never
/// copied, because its callbacks point at it.
class NloptSearch {
  public:
    /// A search in the box with at most `evaluations` evaluations.
    NloptSearch(nlopt::algorithm algorithm, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                int evaluations)
        : search_(algorithm, static_cast<unsigned>(lower.size())) {
        search_.set_lower_bounds({lower.begin(), lower.end()});
        search_.set_upper_bounds({upper.begin(), upper.end()});
        search_.set_maxeval(evaluations);
        // With a tolerance only on x, an optimum at a bound never stops the search.
        search_.set_ftol_rel(1e-12);
        search_.set_ftol_abs(1e-14);
    }
    NloptSearch(const NloptSearch&) = delete;

    /// NLopt's object, for settings of the method.
    nlopt::opt* operator->() { return &search_; }

    /// Minimises value(x, gradient). `gradient` is null, or the function must fill it.
    template <class Value>
    void minimize(Value value) {
        value_ = [value, this](const Eigen::VectorXd& x, double* gradient) {
            return guarded(HUGE_VAL, [&] { return value(x, gradient); });
        };
        search_.set_min_objective(
            [](unsigned n, const double* x, double* gradient, void* self) {
                return static_cast<NloptSearch*>(self)->value_(Eigen::Map<const Eigen::VectorXd>(x, n),
                                                               gradient);
            },
            this);
    }
    /// Adds m constraints c(x) <= 0. fill(x, c, gradient) sets c and, unless it is null, the gradient: m rows
    /// of n values, row after row.
    template <class Fill>
    void constrain(unsigned m, Fill fill) {
        fill_ = [fill, this](const Eigen::VectorXd& x, double* c, double* gradient) {
            guarded(0, [&] { return fill(x, c, gradient), 0.0; });
        };
        search_.add_inequality_mconstraint(
            [](unsigned, double* c, unsigned n, const double* x, double* gradient, void* self) {
                static_cast<NloptSearch*>(self)->fill_(Eigen::Map<const Eigen::VectorXd>(x, n), c, gradient);
            },
            this, std::vector<double>(m, 0.0));
    }

    /// Searches from a point. The callbacks see all results; NLopt's result is not used.
    void from(const Eigen::VectorXd& start) {
        std::vector<double> x(start.begin(), start.end());
        double value = 0;
        try {
            search_.optimize(x, value);
        } catch (const nlopt::roundoff_limited&) {
        } catch (const nlopt::forced_stop&) {
        } catch (const std::runtime_error&) {
            // "nlopt failure": the points seen until then still count
        } catch (const std::invalid_argument& error) {
            throw UsageError(
                std::string("refine nlopt ") +
                nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(search_.get_algorithm())) + ": " +
                error.what());
        }
        if (error_)
            std::rethrow_exception(error_);
    }

  private:
    template <class Call>
    double guarded(double otherwise, Call call) {
        try {
            return call();
        } catch (...) {
            error_ = std::current_exception();
            search_.force_stop();
            return otherwise;
        }
    }

    nlopt::opt search_;
    std::function<double(const Eigen::VectorXd&, double*)> value_;
    std::function<void(const Eigen::VectorXd&, double*, double*)> fill_;
    std::exception_ptr error_;
};

/// NLopt's number of the algorithm with that name. Throws UsageError on another name, and on algorithms that
/// need a second optimiser.
inline int algorithm_number(const std::string& name) {
    const int found = nlopt_algorithm_from_string(name.c_str());
    if (found < 0)
        throw UsageError("refine nlopt: unknown algorithm '" + name +
                         "'; use one of NLopt's, e.g. LN_COBYLA");
    if (name.find("AUGLAG") != std::string::npos || name.find("MLSL") != std::string::npos)
        throw UsageError("refine nlopt: algorithm '" + name +
                         "' needs a second optimiser; use one that works alone, e.g. LN_COBYLA");
    return found;
}

/// Any local or global algorithm of NLopt that works in a box without a second optimiser. It maximises the
/// fitness. Algorithms that work with inequality constraints without gradients (`takes_constraints`) get the
/// problem's constraints.
struct Nlopt {
    static constexpr bool on_residuals = false; ///< whether it uses residuals; it uses the fitness

    std::string algorithm = "LN_COBYLA"; ///< NLopt's name; LD_ and GD_ algorithms need a gradient
    int evaluations = 1;                 ///< maximum number of evaluations after the start point, >= 1

    static Words words() { return {"nlopt", "refinement", "any algorithm of NLopt on the fitness"}; }
    static void describe(auto& self, auto visit) {
        visit(self.algorithm, word("algorithm", std::nullopt, "NLopt's name, e.g. LN_COBYLA"));
        visit(self.evaluations, evaluations_parameter());
    }
    void validate() const { algorithm_number(algorithm); }
    bool needs_gradient() const { return algorithm[1] == 'D'; }
    /// Whether the algorithm gets the problem's constraints. For other algorithms a point that violates a
    /// constraint has no fitness. Algorithms with gradients would need gradients of the constraints.
    bool takes_constraints() const {
        return algorithm == "LN_COBYLA" || algorithm == "GN_ISRES" || algorithm.starts_with("GN_ORIG_DIRECT");
    }

    Eigen::VectorXd improve(const auto& land) const {
        nlopt::srand(static_cast<unsigned long>(land.seed));
        NloptSearch search(static_cast<nlopt::algorithm>(algorithm_number(algorithm)), land.lower, land.upper,
                           evaluations + 1);
        BestPoint best{land.start};
        Eigen::VectorXd violations; // at the last point with a successful evaluation
        if (land.constrained && takes_constraints() && !land.exhausted())
            violations = land.constrained(land.start).second;
        const Eigen::Index rows = violations.size();
        if (rows > 0)
            search.constrain(static_cast<unsigned>(rows), [&](const Eigen::VectorXd& x, double* c, double*) {
                if (const Eigen::VectorXd there = land.constrained(x).second; there.size() == rows)
                    violations = there;
                Eigen::Map<Eigen::VectorXd>(c, rows) = violations;
            });
        int used = 0; // some algorithms exceed their limit
        search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
            if (used++ > evaluations || land.exhausted()) {
                search->force_stop();
                return HUGE_VAL;
            }
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
        });
        search.from(land.start);
        return best.x;
    }
};

/// The refinement `nlopt NAME n`. Throws UsageError if the name is unknown or needs a second optimiser.
inline Method nlopt_method(const auto& name, int evaluations) { return method_of(Nlopt{name, evaluations}); }

} // namespace ga
