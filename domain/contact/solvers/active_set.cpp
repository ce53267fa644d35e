#include "domain/contact/solvers/advance.hpp"
#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/set_solver.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

#include <cmath>

namespace rough {
namespace {

/// Factor by which the residual falls before the contact set is examined again.
constexpr double loosening = 0.05, area_loosening = 0.1;
/// Accuracy of displacements over the approach while the residual is far above it.
constexpr double rough_accuracy = 1e-5;
constexpr int max_rounds = 200;
/// An area's contact set swings if this many rounds in a row leave more than this share of the lowest residual.
constexpr int max_swings = 2;
constexpr double share_left = 0.9;
/// Pressures whose relative sum errs by less are not scaled to it.
constexpr double sum_rounding = 1e-13;
constexpr long max_iterations = 2000;
/// Up to this many nodes a dense factor is cheaper than a coarser grid. It is lower for an area, whose grids
/// shrink faster.
constexpr Index coarsest_line = 1024, coarsest_area = 256;
/// Ratio of the spacings of one grid and the next finer one; an area's nodes grow by its square.
constexpr Index line_stride = 4, area_stride = 2;

Index coarsest(const ContactProblem& problem) { return problem.is_2d() ? coarsest_area : coarsest_line; }

enum class Purpose { curve, guess };

class ActiveSet {
  public:
    ActiveSet(const ContactProblem& problem, const ContactOptions& options, Purpose purpose)
        : problem_(problem), options_(options), purpose_(purpose), solver_(problem),
          set_(problem.nodes(), *problem.team), load_(problem.nodes()), tangent_(problem.nodes()) {}

    StepSolution solve_step(double approach, std::optional<Eigen::VectorXd> guess) {
        start(approach, std::move(guess));
        for (double tolerance = options_.tolerance;;) {
            problem_.is_2d() ? iterate_map(approach, tolerance) : iterate_line(approach, tolerance);
            if (purpose_ == Purpose::guess) return step_solution(set_, load_, tangent_, false);
            find_tangent();
            const double error =
                std::abs(missing_load(problem_, approach, set_, load_, tangent_)) / load_.pressure.sum();
            if (error <= options_.tolerance || tolerance <= finest_residual)
                return step_solution(set_, load_, tangent_, options_.states);
            tolerance = std::max(finest_residual, 0.3 * tolerance * options_.tolerance / error);
        }
    }

    /// Presses an area to a load and sets `approach` to the one found. The sum of the pressures is kept while
    /// they change, and the approach follows from them. A step along the tangent is too long, because the
    /// stiffness of rough areas grows about as the load (Persson 2007).
    StepSolution solve_load(double load, double& approach, std::optional<Eigen::VectorXd> guess) {
        sum_ = load;
        if (guess) {
            load_.pressure = *std::exchange(guess, std::nullopt); // frees the pressures before
            load_.pressure *= load / load_.pressure.sum();
            set_.assign([&](Index i) { return load_.pressure[i] > 0; });
        } else {
            const double before = sum_of(load_), growth = load / before - 1, step = (load - before) / sum_of(tangent_);
            move(step);
            ahead_ = step * (1 - std::log1p(growth) / growth);
        }
        stale_ = true;
        iterate_map(approach, options_.tolerance);
        if (purpose_ == Purpose::guess) return step_solution(set_, load_, tangent_, false);
        find_tangent();
        approach -= missing_load(problem_, approach, set_, load_, tangent_) / sum_of(tangent_);
        return step_solution(set_, load_, tangent_, options_.states);
    }
    const Eigen::VectorXd& pressure() const { return load_.pressure; }
    long applies() const { return solver_.applies(); }

  private:
    /// The sum of value(node) over the contact set.
    template <class Value>
    double sum_over_set(Value value) const {
        const std::vector<int>& nodes = set_.nodes();
        return problem_.team->sum_of(static_cast<Index>(nodes.size()),
                                     [&](Index k) { return value(nodes[static_cast<std::size_t>(k)]); });
    }
    double sum_of(const SurfaceState& x) const {
        return sum_over_set([&](int i) { return x.pressure[i]; });
    }

    /// Finds the tangent. If is_singular(), a map in full contact has none. Then the least loaded node is
    /// left out, which gives the tangent just below full contact.
    void find_tangent() {
        Index lowest = problem_.nodes();
        if (problem_.is_2d() && problem_.is_singular() && static_cast<Index>(set_.nodes().size()) == problem_.nodes()) {
            load_.pressure.minCoeff(&lowest);
            set_.erase(lowest);
            set_.collect();
        }
        solver_.tangent(set_, options_.tolerance, options_.states, tangent_);
        if (lowest < problem_.nodes()) {
            set_.insert(lowest);
            set_.collect();
        }
    }

    /// Moves the pressures along the tangent, and on an area their known product.
    void move(double by) {
        const bool product = problem_.is_2d() && load_.updated.size() > 0;
        problem_.team->each_range(problem_.nodes(), [&](Index first, Index n, int) {
            load_.pressure.segment(first, n) += by * tangent_.pressure.segment(first, n);
            if (product) {
                load_.updated.segment(first, n) = load_.pressure.segment(first, n);
                load_.displacement.segment(first, n) += by * tangent_.displacement.segment(first, n);
            }
        });
        if (product) load_.displacement_error += by * tangent_.displacement_error;
    }

    /// Starts from the step before, moved along its tangent or by the growth of a coarser grid's pressures
    /// since then, whichever leaves the smaller residual. That growth is not negative, because no node's
    /// pressure falls with the load. The first step starts from the coarser grid's pressures or from none.
    void start(double approach, std::optional<Eigen::VectorXd> guess) {
        const bool is_guided = guess.has_value(), is_first = approach_ == 0;
        std::optional<SurfaceState> grown;
        if (is_guided && !is_first) {
            grown = load_;
            grown->pressure += (*guess - *last_guess_).cwiseMax(0);
        }
        if (!problem_.is_2d()) // a map has no guess for later steps
            last_guess_ = guess;
        if (is_guided && is_first)
            load_.pressure = *std::exchange(guess, std::nullopt);
        else
            move(approach - approach_);
        approach_ = approach;
        solver_.update(load_, rough_accuracy * approach);
        stale_ = false;
        if (!is_guided) return;
        double left = residual(load_, approach);
        if (is_first && left > std::max(0.0, approach - problem_.gap.minCoeff()) / approach) {
            load_.pressure.setZero();
            solver_.update(load_);
            return;
        }
        if (grown) {
            solver_.update(*grown, rough_accuracy * approach);
            const double of_grown = residual(*grown, approach);
            if (of_grown > left) return;
            left = of_grown;
            load_ = std::move(*grown);
        }
        set_.assign([&](Index i) { return load_.pressure[i] > 0; });
        // The guess errs in its pressures more than in its set: those first.
        improve(approach, loosening * left);
    }

    void improve(double& approach, double target, bool projected = true) {
        double level = 0;
        solver_.improve(
            set_, [&](Index i) { return approach - problem_.gap[i]; }, load_,
            Enough{target * std::abs(approach), [&](double) { return check_stop(options_), false; }}, max_iterations,
            sum_ ? &level : nullptr, projected);
        approach -= level;
        stale_ = !problem_.is_2d();
    }

    /// Finds the depth of every node; under load control first the approach, the mean over the contact nodes.
    void look(double& approach) {
        const auto is_loaded = [&](int i) { return load_.pressure[i] > 0; };
        if (sum_)
            if (const double count = sum_over_set(is_loaded); count > 0)
                approach =
                    sum_over_set([&](int i) { return is_loaded(i) ? problem_.gap[i] + load_.displacement[i] : 0; }) /
                    count;
        depth_.resize(problem_.nodes());
        deepest_ = problem_.team->largest(problem_.nodes(), [&](Index first, Index n) {
            auto depth = depth_.segment(first, n);
            depth = approach - (problem_.gap.segment(first, n) + load_.displacement.segment(first, n)).array();
            return depth.maxCoeff();
        });
    }

    /// The residual of the depths found last, over the approach: the greatest depth, and gaps in contact.
    double residual(double approach) const {
        const std::vector<int>& nodes = set_.nodes();
        const double gap = problem_.team->largest_of(static_cast<Index>(nodes.size()), [&](Index k) {
            const int i = nodes[static_cast<std::size_t>(k)];
            return load_.pressure[i] > 0 ? -depth_[i] : 0;
        });
        return std::max(gap, deepest_) / std::abs(approach);
    }

    double residual(const SurfaceState& x, double approach) const {
        return problem_.team->largest_of(problem_.nodes(), [&](Index i) {
            const double depth = approach - problem_.gap[i] - x.displacement[i];
            return x.pressure[i] > 0 ? std::abs(depth) : depth;
        }) / std::abs(approach);
    }

    /// Nodes leave and join in the same round, until that makes the set swing. From then on no node joins in
    /// a round in which any leaves. On an area many nodes are at the edge of touching, and which of them
    /// touch is known no better than the residual. Steps are not projected while the set swings. A projected
    /// step takes out the nodes that have just joined, and nothing is gained.
    void iterate_map(double& approach, double tolerance) {
        double target = 1, lowest = std::numeric_limits<double>::infinity();
        int swings = 0;
        for (int round = 0; round < max_rounds; ++round) {
            check_stop(options_);
            const double size = std::abs(approach); // the mean of a poor guess may be below 0
            change_set(approach, 0.3 * tolerance * size, std::min(rough_accuracy, 0.1 * target) * size);
            double worst = residual(approach);
            if (worst <= tolerance) {
                solver_.update(load_, 0.1 * tolerance * approach); // unless it is as good already
                look(approach);
                worst = residual(approach);
            }
            if (worst <= tolerance) return;
            swings = worst < share_left * lowest ? 0 : swings + 1;
            lowest = std::min(lowest, worst);
            swinging_ = swinging_ || swings == max_swings;
            target = std::max(0.5 * tolerance, area_loosening * worst);
            improve(approach, target, swings < max_swings);
        }
    }

    void iterate_line(double& approach, double tolerance) {
        double target = 1;
        for (int round = 0; round < max_rounds; ++round) {
            check_stop(options_);
            const double min_depth = 0.3 * std::min(target, tolerance) * approach;
            const double accuracy = std::min(rough_accuracy, 0.1 * target) * approach;
            if (change_set(approach, min_depth, accuracy)) {
                double worst = 0;
                for (const int i : set_.nodes()) worst = std::max(worst, std::abs(depth_[i]) / approach);
                // The next change is looked for at a residual well under what caused this one.
                target = std::max(finest_residual, loosening * worst);
            } else if (target > tolerance) {
                target = std::max(tolerance, loosening * target);
            } else {
                const double trusted = purpose_ == Purpose::guess
                                           ? target
                                           : trusted_residual(problem_, approach, load_.pressure, load_.displacement);
                if (target <= finest_residual || target <= trusted) return;
                target = std::max(finest_residual, std::clamp(trusted, loosening * target, 0.5 * target));
            }
            improve(approach, target);
        }
    }

    /// Drops the nodes under tension and adds those that penetrate by more than `min_depth`, with
    /// displacements known to `accuracy`. Returns false if the set stays the same.
    bool change_set(double& approach, double min_depth, double accuracy) {
        std::vector<int> dropped;
        for (const int i : set_.nodes())
            if (!(load_.pressure[i] > 0)) dropped.push_back(i);
        for (const int i : dropped) {
            set_.erase(i);
            load_.pressure[i] = 0;
        }
        if (const double growth = sum_ ? *sum_ / sum_of(load_) : 1; std::abs(growth - 1) > sum_rounding) {
            for (Eigen::VectorXd* scaled : {&load_.pressure, &load_.updated, &load_.displacement})
                problem_.team->each_range(scaled->size(),
                                          [&](Index first, Index n, int) { scaled->segment(first, n) *= growth; });
            load_.displacement_error *= growth;
        }
        if (stale_ || !dropped.empty()) solver_.update(load_, accuracy);
        stale_ = false;
        look(approach);
        std::vector<int> added;
        if (dropped.empty() || problem_.is_2d())
            added = advancing_nodes(depth_, set_.touching(), problem_.shape, min_depth + ahead_, *problem_.team);
        ahead_ = 0;
        if (swinging_ && !dropped.empty()) added.clear();
        for (const int i : added) set_.insert(i);
        if (!dropped.empty() || !added.empty()) set_.collect();
        return !dropped.empty() || !added.empty();
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    Purpose purpose_;
    SetSolver solver_;
    ContactSet set_;
    SurfaceState load_, tangent_;
    double ahead_ = 0; ///< excess of the last tangent step, until nodes have joined in view of it
    Eigen::ArrayXd depth_;
    double deepest_ = 0;                        ///< the greatest depth
    std::optional<Eigen::VectorXd> last_guess_; ///< the coarser grid's pressures at the step before
    double approach_ = 0;
    std::optional<double> sum_; ///< sum of the pressures, under load control
    bool swinging_ = false;     ///< an area's contact set has done so
    bool stale_ = true;         ///< the displacement off the contact set
};

/// Interpolates squares of pressures along a coarse line, zero off contact, to the nodes of a fine one. One value
/// beyond each edge of contact is extrapolated and may be negative. Values are `step` apart, from the first on.
void refine_line(const double* squares, Index coarse, Index coarse_step, Index stride, double* fine, Index nodes,
                 Index step) {
    const auto square = [&](Index k) { return squares[k * coarse_step]; };
    auto beyond = [&](Index edge, Index inner) {
        const double slope = inner >= 0 && inner < coarse ? square(inner) - square(edge) : 0;
        return -std::max(slope, square(edge));
    };
    const double unit = static_cast<double>(stride);
    for (Index i = 0; i < nodes; ++i) {
        const Index left = i / stride, right = std::min(left + 1, coarse - 1);
        double a = square(left), b = square(right);
        fine[i * step] = 0;
        if (a == 0 && b == 0) continue;
        if (a == 0)
            a = beyond(right, right + 1);
        else if (b == 0)
            b = beyond(left, left - 1);
        const double share = static_cast<double>(i - left * stride) / unit;
        fine[i * step] = std::max(0.0, a + share * (b - a));
    }
}

/// First guess of the pressures at every node of the fine grid, from the solution on every `stride`-th one
/// from the first on. Linear in p^2 along x, then along y: near an edge p^2 falls linearly to zero, so that
/// edges are found within the coarse spacing.
Eigen::VectorXd refined_pressures(const StepSolution& coarse, Extent from, Index stride, Extent to, Team& team) {
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(from.nodes());
    for (std::size_t k = 0; k < coarse.nodes.size(); ++k)
        squares[coarse.nodes[k]] = std::pow(coarse.pressure[static_cast<Index>(k)], 2);
    Eigen::VectorXd fine(to.columns * from.rows);
    team.each_block(from.rows, [&](Index j, int) {
        refine_line(squares.data() + j * from.columns, from.columns, 1, stride, fine.data() + j * to.columns,
                    to.columns, 1);
    });
    if (to.rows > 1) {
        const Eigen::VectorXd along_x = std::move(fine);
        fine.resize(to.nodes());
        constexpr Index whole_lines = 8; // columns whose numbers are in the same lines of the cache
        team.each_range(
            to.columns,
            [&](Index first, Index count, int) {
                for (Index i = first; i < first + count; ++i)
                    refine_line(along_x.data() + i, from.rows, to.columns, stride, fine.data() + i, to.rows,
                                to.columns);
            },
            whole_lines);
    }
    team.each_range(fine.size(), [&](Index first, Index count, int) {
        for (double& value : fine.segment(first, count)) // pressures are in units of 1/delta
            value = std::sqrt(value) / static_cast<double>(stride);
    });
    return fine;
}

Solution guess(const ContactProblem& problem, ContactOptions options);

/// Limits within which the pressures of full contact are a better start than a coarser grid's: least share of
/// nodes under pressure, greatest mean width of gaps along rows. Coarser grids miss narrow gaps.
constexpr double nearly_full = 0.8, narrow_gap = 8;

/// The pressures of full contact under the problem's first load, without its tensions: the nearest pressures
/// p >= 0 with the load as their sum. Nothing if the gaps are too many or too wide.
std::optional<Eigen::VectorXd> clipped_full_contact(const ContactProblem& problem) {
    if (!problem.is_2d() || problem.kernel != Kernel::periodic || problem.load.empty()) return {};
    Eigen::VectorXd full = full_contact_pressure(problem);
    const double nodes = static_cast<double>(problem.nodes()), load = problem.load[0];
    // Newton's method on a convex piecewise linear function comes from above and ends at its solution.
    for (double mean = load / nodes;;) {
        const double excess = (full.array() + mean).cwiseMax(0).sum() - load,
                     loaded = static_cast<double>((full.array() + mean > 0).count());
        if (loaded < nearly_full * nodes) return {};
        if (!(excess > 1e-9 * load) || mean - excess / loaded == mean) {
            full = (full.array() + mean).cwiseMax(0).eval();
            const auto is_gap = full.array() == 0;
            const double gaps =
                static_cast<double>((is_gap.head(full.size() - 1) && !is_gap.tail(full.size() - 1)).count());
            return nodes - loaded <= narrow_gap * (gaps + 1) ? std::optional(std::move(full)) : std::nullopt;
        }
        mean -= excess / loaded;
    }
}

/// Solves every load step, on the coarser grid first as long as it is worth it. The first load begins with an
/// even pressure on the smallest grid, and if the coarser grid is in full contact below the load.
void solve_levels(const ContactProblem& problem, const ContactOptions& options, Purpose purpose, Solution& solution) {
    std::optional<Eigen::VectorXd> flat;
    if (purpose == Purpose::curve) // a guess would end with it
        flat = clipped_full_contact(problem);
    const bool cascade = !flat && problem.nodes() > coarsest(problem), by_load = !problem.load.empty();
    const Index stride = problem.is_2d() ? area_stride : line_stride;
    ContactProblem coarse_problem = cascade ? coarsened(problem, stride) : ContactProblem();
    std::vector<double>& coarse_steps = by_load ? coarse_problem.load : coarse_problem.approach;
    if (problem.is_2d()) // from the first step on the tangent begins as well as a coarser grid
        coarse_steps.resize(std::min<std::size_t>(1, coarse_steps.size()));
    const Solution coarse = cascade ? guess(coarse_problem, options) : Solution();
    ActiveSet solver(problem, options, purpose);
    std::optional<SplitOperator> check;
    if (purpose == Purpose::curve) check.emplace(problem.column, problem.shape, *problem.team);
    double approach = 0;
    for (std::size_t j = 0; j < problem.steps(); ++j) {
        const long before = solver.applies();
        std::optional<Eigen::VectorXd> start;
        if (j < coarse.steps.size()) {
            start = refined_pressures(coarse.steps[j], coarse_problem.shape, stride, problem.shape, *problem.team);
            approach = coarse.steps[j].approach;
        } else if (flat) {
            start = std::exchange(flat, std::nullopt);
            approach = problem.gap.mean();
        } else if (by_load && j == 0) {
            start = Eigen::VectorXd::Constant(problem.nodes(), problem.load[0] / static_cast<double>(problem.nodes()));
            approach = problem.gap.mean();
        }
        if (!by_load) approach = problem.approach[j];
        StepSolution found = by_load ? solver.solve_load(problem.load[j], approach, std::move(start))
                                     : solver.solve_step(approach, std::move(start));
        found.approach = approach;
        if (check) certify_step("active set", problem, found, *check, solver.pressure(), 2 * options.tolerance);
        solution.steps.push_back(std::move(found));
        solution.iterations += solver.applies() - before;
    }
}

/// A coarse grid's solution, as far as it is found. It is a start for the fine grid, whose solution does not
/// depend on it.
Solution guess(const ContactProblem& problem, ContactOptions options) {
    options.tolerance = 1e-2;
    options.states = false;
    Solution solution;
    try {
        if (problem.nodes() <= coarsest(problem))
            solve_nested(problem, options, solution);
        else
            solve_levels(problem, options, Purpose::guess, solution);
    } catch (const NotConverged&) {
        check_stop(options);
        return {};
    }
    return solution;
}

} // namespace

void solve_active_set(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    const std::size_t before = solution.steps.size();
    try {
        solve_levels(problem, options, Purpose::curve, solution);
    } catch (const NotConverged&) {
        check_stop(options);
        if (!problem.load.empty()) throw;
        ContactProblem rest = problem;
        rest.approach.erase(rest.approach.begin(),
                            rest.approach.begin() + static_cast<std::ptrdiff_t>(solution.steps.size() - before));
        solve_capped(rest, options, solution);
    }
}

} // namespace rough
