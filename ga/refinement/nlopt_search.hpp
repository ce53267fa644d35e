#pragma once

#include "ga/base/errors.hpp"

#include <Eigen/Core>
#include <nlopt.hpp>

#include <exception>
#include <functional>

namespace ga {

/// Runs one NLopt optimisation (NLopt 2.7) in a box. An exception of a callback stops the search and is
/// thrown again at its end. If rounding limits the search, it ends without an error. The optimiser is never
/// copied, because its callbacks point at it.
class NloptSearch {
  public:
    /// A search in the box with at most `evaluations` evaluations.
    NloptSearch(nlopt::algorithm algorithm, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int evaluations)
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
                return static_cast<NloptSearch*>(self)->value_(Eigen::Map<const Eigen::VectorXd>(x, n), gradient);
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
        } catch (const std::runtime_error&) {
            // stopped, limited by rounding, or "nlopt failure": the points seen until then still count
        } catch (const std::invalid_argument& error) {
            throw UsageError(std::string("refine nlopt ") +
                             nlopt_algorithm_to_string(static_cast<nlopt_algorithm>(search_.get_algorithm())) + ": " +
                             error.what() + "; use another algorithm, or finite bounds");
        }
        if (error_) std::rethrow_exception(error_);
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

} // namespace ga
