#include "domain/contact/solvers/nested.hpp"

#include "domain/contact/solvers/advance.hpp"
#include "domain/contact/solvers/certificate.hpp"
#include "domain/errors.hpp"

#include <algorithm>

namespace rough {

namespace {

/// Gaps and penetrations below this, over the approach, are rounding.
constexpr double rounding = 1e-13;
constexpr int most_rounds = 200;
constexpr std::size_t least_batch = 64;

} // namespace

NestedContact::NestedContact(const ContactProblem& problem, const ContactOptions& options, double most_work)
    : problem_(problem), options_(options), influence_(problem.column, problem.shape),
      factor_(influence_, problem.gap), direct_(influence_),
      touching_(static_cast<std::size_t>(problem.nodes()), 0), most_work_(most_work) {}

StepSolution NestedContact::press(double approach) {
    Certificate certificate;
    for (int round = 0; round < most_rounds; ++round) {
        check_stop(options_);
        factor_.pressures(approach, pressure_);
        drop_tension(approach);
        const double* u = displacement();
        certificate = certify(problem_, approach, factor_.nodes(), pressure_, u);
        if (certificate.penetration <= rounding || !add_penetrating(approach, u))
            break;
    }
    const double tolerance = direct_tolerance(problem_, approach, pressure_, factor_.stiffness());
    if (!(certificate.residual() <= tolerance))
        fail("nested Cholesky", problem_, approach, certificate.residual(), tolerance);
    StepSolution step{factor_.nodes(), pressure_, factor_.stiffness(), {}, certificate.residual()};
    if (options_.states)
        factor_.tangent(step.tangent);
    return step;
}

const double* NestedContact::displacement() {
    if (direct_.pays(factor_.nodes().size()))
        return direct_.apply(factor_.nodes(), pressure_);
    if (!fourier_)
        fourier_.emplace(fourier_operator(problem_));
    double* p = fourier_->input();
    std::fill_n(p, problem_.nodes(), 0.0);
    for (Index k = 0; k < factor_.size(); ++k)
        p[factor_.nodes()[static_cast<std::size_t>(k)]] = pressure_[k];
    return fourier_->apply();
}

/// Removes nodes under tension until none is left; the factor keeps its head.
void NestedContact::drop_tension(double approach) {
    for (;;) {
        std::vector<Index> dropped;
        for (Index k = 0; k < pressure_.size(); ++k)
            if (!(pressure_[k] > 0))
                dropped.push_back(k);
        if (dropped.empty())
            return;
        for (const Index k : dropped)
            touching_[static_cast<std::size_t>(factor_.nodes()[static_cast<std::size_t>(k)])] = 0;
        factor_.remove(dropped);
        eliminate(factor_.size() - std::min(dropped.front(), factor_.size()));
        factor_.pressures(approach, pressure_);
        ++rounds_;
    }
}

/// Appends the nodes that penetrate and will stay in contact, by their first-order estimate; false if
/// none penetrates. A node left out for too low an estimate still penetrates in the next round, which
/// costs a check; one taken for too high an estimate costs a new factor of the tail.
bool NestedContact::add_penetrating(double approach, const double* u) {
    depth_ = approach - (problem_.gap + Eigen::Map<const Eigen::VectorXd>(u, problem_.nodes())).array();
    std::vector<int> added = advancing_nodes(depth_, touching_, problem_.shape, rounding * approach);
    // The surest first: far from the solution most of what penetrates would only be dropped again.
    added.resize(std::min(added.size(), std::max(least_batch, factor_.nodes().size() / 2)));
    refuse_factor(factor_.size() + static_cast<Index>(added.size()), options_);
    added.resize(static_cast<std::size_t>(factor_.append(added)));
    eliminate(static_cast<Index>(added.size()));
    for (const int node : added)
        touching_[static_cast<std::size_t>(node)] = 1;
    ++rounds_;
    return !added.empty();
}

/// Accounts for so many last rows of the factor, of half its size squared multiplications each.
void NestedContact::eliminate(Index rows) {
    const double size = static_cast<double>(factor_.size());
    work_ += static_cast<double>(rows) * size * size / 2;
    if (work_ > most_work_)
        throw NotConverged("nested Cholesky needs far more work than was predicted");
}

void refuse_factor(Index nodes, const ContactOptions& options) {
    const double bytes = GrowingFactor::bytes(nodes);
    if (bytes <= options.memory_limit)
        return;
    refuse("nested Cholesky with ", nodes, " nodes in contact would take ", bytes / 1e9, " GB, at most ",
           options.memory_limit / 1e9,
           " GB is expected: the active set takes less, and is what auto would choose");
}

Solution solve_nested(const ContactProblem& problem, const ContactOptions& options) {
    Solution solution;
    solve_nested(problem, options, std::numeric_limits<double>::infinity(), solution);
    return solution;
}

void solve_nested(const ContactProblem& problem, const ContactOptions& options, double most_work,
                  Solution& solution) {
    NestedContact contact(problem, options, most_work);
    for (const double approach : problem.approach) {
        const long before = contact.rounds();
        solution.steps.push_back(contact.press(approach));
        solution.iterations += contact.rounds() - before;
    }
}

} // namespace rough
