#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

// Nanoseconds on the machine that they were fitted on, by benchmark_choice; only their ratios matter. It
// takes random profiles on every kernel with 5 to 80 load steps. A curve counts if its two costs differ by
// less than a factor of seven, because otherwise the choice is plain.
constexpr double per_elimination = 0.05; ///< a multiplication of the factor
constexpr double per_transform = 0.6;    ///< a node of an FFT apply, times log2 of the padded length
constexpr double applies_per_step = 36;  ///< applies per step of the active set at 1e-6, which stand for all its work
constexpr double checks_per_step = 3;    ///< checks per step of the nested factor
constexpr double regrowth = 1.5;         ///< eliminations over those of the final factor

/// Predictions err by a factor of four in cost at most, as contact sets do by 1.6.
constexpr double patience = 4;
/// A sample has missed the nodes that keep the surfaces apart if its highest node is too low. The limit is
/// this share of the approach below the profile's highest node.
constexpr double missed = 0.1;

/// Share of the active set's predicted cost that choosing may take.
constexpr double cost_of_choice = 0.05;

/// The share of nodes that touch at the last step, on a coarse grid. It is 1 if that grid's factor would need
/// more than `work_limit` multiplications.
double expected_contact(const ContactProblem& problem, ContactOptions options, double work_limit = unlimited_work) {
    // Every sixteenth node, and more of a small grid, so that summits of short waves stay apart. The limit of
    // 2048 nodes takes a few milliseconds.
    const Index sample = std::clamp<Index>(problem.nodes() / 16, std::min<Index>(problem.nodes() / 4, 512), 2048);
    const Index area_stride =
        static_cast<Index>(std::ceil(std::sqrt(static_cast<double>(problem.nodes()) / static_cast<double>(sample))));
    const Index stride = problem.shape.rows > 1 ? area_stride : (problem.nodes() + sample - 1) / sample;
    ContactProblem coarse = coarsened(problem, stride);
    const bool loaded = !problem.load.empty();
    if (loaded || coarse.gap.minCoeff() > missed * problem.approach.back()) {
        Index highest = 0;
        problem.gap.minCoeff(&highest);
        coarse = coarsened(problem, stride, highest);
    }
    std::vector<double>& steps = loaded ? coarse.load : coarse.approach;
    steps = {steps.back()};
    options.states = false;
    coarse.work_limit = work_limit;
    try {
        Solution solution;
        solve_nested(coarse, options, solution);
        return static_cast<double>(solution.steps.back().nodes.size()) / static_cast<double>(coarse.nodes());
    } catch (const NotConverged&) { // too much work, or no solution of the coarse grid near full contact
        check_stop(options);
        return 1;
    }
}

double apply_cost(double nodes) { return per_transform * nodes * std::log2(2 * nodes); }

double nested_cost(double nodes, double contact, double steps) {
    return regrowth * per_elimination * contact * contact * contact / 6 +
           steps * checks_per_step * (apply_cost(nodes) + per_elimination * contact * contact);
}

double active_set_cost(double nodes, double steps) { return steps * applies_per_step * apply_cost(nodes); }

/// Numbers in an area's transforms over those of a line with as many nodes, which is padded to twice its
/// length. An area is padded along both axes, or not at all if it is periodic.
double turned(const ContactProblem& problem) {
    return !problem.is_2d() ? 1 : problem.kernel == Kernel::periodic ? 0.5 : 2;
}

} // namespace

double predicted_cost(double nodes, double contact, double steps) {
    return std::min(nested_cost(nodes, contact, steps), active_set_cost(nodes, steps));
}

double max_nested_work(const ContactProblem& problem) {
    if (problem.nodes() <= always_nested) return std::numeric_limits<double>::infinity();
    const double steps = static_cast<double>(problem.steps());
    return patience * turned(problem) * active_set_cost(static_cast<double>(problem.nodes()), steps) / per_elimination;
}

Solver choose_solver(const ContactProblem& problem, const ContactOptions& options) {
    if (options.solver != Solver::automatic) return options.solver;
    if (std::isfinite(problem.cap)) return Solver::active_set;
    if (!contact_sets_nest(problem, problem.shape))
        return problem.is_2d() || problem.nodes() > always_nested ? Solver::active_set : Solver::nnls;
    if (problem.nodes() <= always_nested || problem.steps() == 0 ||
        (problem.load.empty() && problem.approach.back() == 0))
        return Solver::nested;
    const double n = static_cast<double>(problem.nodes()), steps = static_cast<double>(problem.steps());
    const double active_set = turned(problem) * active_set_cost(n, steps);
    // At the limit the whole grid's factor, at least 64 times as costly, would not be chosen either.
    const double limit = cost_of_choice * active_set / per_elimination,
                 m = std::ceil(expected_contact(problem, options, limit) * n);
    // Half as much again, because the estimate comes from a coarse grid.
    const double memory = 1.5 * GrowingFactor::bytes(static_cast<Index>(m));
    const bool fits = memory <= options.memory_limit;
    return fits && nested_cost(n, m, steps) <= active_set ? Solver::nested : Solver::active_set;
}

void expect_factor_to_fit(const ContactProblem& problem, const ContactOptions& options) {
    if (GrowingFactor::bytes(problem.nodes()) <= options.memory_limit || problem.steps() == 0)
        return; // even with every node in contact
    const double nodes = std::ceil(expected_contact(problem, options) * static_cast<double>(problem.nodes()));
    refuse_factor(static_cast<Index>(nodes), options);
}

} // namespace rough
