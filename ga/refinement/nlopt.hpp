#pragma once

#include "ga/errors.hpp"
#include "ga/refinement/landscape.hpp"

#include <nlopt.hpp>

#include <exception>

namespace ga {

/// Runs one NLopt optimisation (NLopt 2.7) over the landscape's box, or a box given, and heeds its traps: an
/// exception of a callback is kept, the search stopped, the exception thrown again; rounding limits end a
/// search quietly. The optimiser is never copied, since its callbacks point at it.
class NloptSearch {
  public:
    /// A search in the box with at most so many evaluations.
    NloptSearch(nlopt::algorithm algorithm, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                int evaluations)
        : search_(algorithm, static_cast<unsigned>(lower.size())) {
        search_.set_lower_bounds({lower.begin(), lower.end()});
        search_.set_upper_bounds({upper.begin(), upper.end()});
        search_.set_maxeval(evaluations);
        // A bound optimum with a tolerance on x alone never stops.
        search_.set_ftol_rel(1e-12);
        search_.set_ftol_abs(1e-14);
    }
    NloptSearch(const NloptSearch&) = delete;

    /// NLopt's own object, for settings of the method.
    nlopt::opt& operator*() { return search_; }
    /// NLopt's own object, for settings of the method.
    nlopt::opt* operator->() { return &search_; }

    /// Minimises value(x, gradient), where gradient is null or to be filled.
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
    /// Adds m constraints c(x) <= 0; fill(x, c, gradient) with gradient null or m rows of n, row after row.
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

    /// Searches from a point. What the search found is what its callbacks saw; its own answer is not needed.
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
            throw UsageError(std::string("refine ") + search_.get_algorithm_name() + ": " + error.what());
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

/// The best point a search has seen, by a merit that is greater for the better.
struct BestPoint {
    Eigen::VectorXd x;        ///< none before the first offer
    double merit = -HUGE_VAL; ///< of x; -HUGE_VAL before the first offer

    /// Takes the point where its merit is greater; of equal ones the first.
    void offer(const Eigen::VectorXd& point, double value) {
        if (value > merit) {
            x = point;
            merit = value;
        }
    }
};

/// The refinement `nlopt NAME n`: any NLopt algorithm that needs neither constraints nor a subsidiary
/// optimiser, maximising the fitness in the box.
/// @param name         NLopt's own, e.g. "LN_COBYLA"; LD_ and GD_ algorithms need a gradient
/// @param evaluations  at most, after the start; >= 1
inline Method nlopt_method(const std::string& name, int evaluations) {
    const nlopt_algorithm found = nlopt_algorithm_from_string(name.c_str());
    if (static_cast<int>(found) < 0)
        throw UsageError("refine nlopt: unknown algorithm '" + name +
                         "'; expected one of NLopt's, e.g. LN_COBYLA");
    if (evaluations < 1)
        throw UsageError("refine nlopt: evaluations are " + std::to_string(evaluations) +
                         "; expected 1 at least");
    Method method;
    method.text = "nlopt " + name + " " + std::to_string(evaluations);
    method.needs_gradient = name[1] == 'D';
    method.improve = [=](const Landscape& land) {
        nlopt::srand(static_cast<unsigned long>(land.seed));
        NloptSearch search(static_cast<nlopt::algorithm>(found), land.lower, land.upper, evaluations + 1);
        BestPoint best{land.start, -HUGE_VAL};
        search.minimize([&](const Eigen::VectorXd& x, double* gradient) {
            if (land.exhausted()) {
                search->force_stop();
                return HUGE_VAL;
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
    };
    return method;
}

} // namespace ga
