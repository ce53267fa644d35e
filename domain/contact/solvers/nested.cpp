#include "domain/contact/solvers/advance.hpp"
#include "domain/contact/solvers/certificate.hpp"
#include "domain/contact/solvers/growing_factor.hpp"
#include "domain/contact/solvers/solvers.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

constexpr int max_sweeps = 200;
constexpr std::size_t min_batch = 64;

/// Solves one load step after the other on one factor.
class NestedContact {
  public:
    NestedContact(const ContactProblem& problem, const ContactOptions& options)
        : problem_(problem), options_(options), influence_(problem.column, problem.shape),
          factor_(influence_, problem.gap), direct_(influence_),
          touching_(static_cast<std::size_t>(problem.nodes()), 0) {}

    /// The solution at an approach that is above the one before, or at a load (a sum of pressures) that is.
    StepSolution solve_step(double approach, std::optional<double> load) {
        double residual = 0;
        if (load && factor_.size() == 0) { // the highest node first
            Index highest = 0;
            problem_.gap.minCoeff(&highest);
            factor_.append({static_cast<int>(highest)});
            touching_[static_cast<std::size_t>(highest)] = 1;
        }
        for (int round = 0; round < max_sweeps; ++round) {
            check_stop(options_);
            find_pressures(approach, load);
            drop_tension(approach, load);
            const double* u = displacement();
            const Certificate certificate = certify(problem_, approach, factor_.nodes(), pressure_, u);
            residual = certificate.residual();
            if (certificate.penetration <= gap_rounding || !add_penetrating(approach, u, load.has_value())) break;
        }
        StepSolution step{factor_.nodes(), pressure_, factor_.stiffness(), {}, residual, 0, approach};
        expect_residual("nested Cholesky", problem_, step, direct_tolerance(problem_, step));
        if (options_.states) factor_.tangent(step.tangent);
        return step;
    }
    /// Sweeps of additions or removals so far.
    long iterations() const { return rounds_; }

  private:
    const double* displacement() {
        if (direct_.pays(factor_.nodes().size())) return direct_.apply(factor_.nodes(), pressure_);
        if (!fourier_) fourier_.emplace(fourier_operator(problem_));
        return fourier_->apply(factor_.nodes(), pressure_);
    }

    /// Finds the pressures of the nodes in contact; under load control first the approach at which they carry the load.
    void find_pressures(double& approach, std::optional<double> load) {
        if (load) approach = factor_.approach_at(*load);
        factor_.pressures(approach, pressure_);
    }

    /// Removes nodes under tension until none is left; the factor keeps its head.
    void drop_tension(double& approach, std::optional<double> load) {
        for (;;) {
            std::vector<Index> dropped;
            for (Index k = 0; k < pressure_.size(); ++k)
                if (!(pressure_[k] > 0)) dropped.push_back(k);
            if (dropped.empty()) return;
            remove(dropped);
            find_pressures(approach, load);
            ++rounds_;
        }
    }

    /// Appends the nodes that penetrate and will stay in contact, by a first-order estimate. Returns false if
    /// none penetrates. A node left out wrongly still penetrates in the next round, which costs one check. A
    /// node taken wrongly costs a new factor of the tail.
    bool add_penetrating(double approach, const double* u, bool by_load) {
        depth_ = approach - (problem_.gap + Eigen::Map<const Eigen::VectorXd>(u, problem_.nodes())).array();
        std::vector<int> added = advancing_nodes(depth_, touching_, problem_.shape, gap_rounding * approach);
        // Only the most certain ones, because most of the other nodes would be removed again far from the solution.
        added.resize(std::min(added.size(), std::max(min_batch, factor_.nodes().size() / 2)));
        refuse_factor(factor_.size() + static_cast<Index>(added.size()), options_);
        Index appended = factor_.append(added);
        if (appended == 0 && !added.empty() && by_load) {
            // All nodes of a periodic body have a singular matrix: the last node takes the place of the least
            // loaded one.
            Index lowest = 0;
            pressure_.minCoeff(&lowest);
            remove({lowest});
            appended = factor_.append(added);
        }
        added.resize(static_cast<std::size_t>(appended));
        eliminate(appended);
        for (const int node : added) touching_[static_cast<std::size_t>(node)] = 1;
        ++rounds_;
        return !added.empty();
    }

    void remove(const std::vector<Index>& positions) {
        for (const Index k : positions)
            touching_[static_cast<std::size_t>(factor_.nodes()[static_cast<std::size_t>(k)])] = 0;
        factor_.remove(positions);
        eliminate(factor_.size() - std::min(positions.front(), factor_.size()));
    }

    /// Counts the multiplications of the last `rows` rows of the factor, half its size squared each.
    void eliminate(Index rows) {
        const double size = static_cast<double>(factor_.size());
        work_ += static_cast<double>(rows) * size * size / 2;
        if (work_ > problem_.work_limit) throw NotConverged("nested Cholesky needs far more work than was predicted");
    }

    const ContactProblem& problem_;
    const ContactOptions& options_;
    Influence influence_;
    GrowingFactor factor_;
    DirectOperator direct_;                  ///< while contact is slight
    std::optional<FourierOperator> fourier_; ///< beyond
    std::vector<char> touching_;
    Eigen::VectorXd pressure_;
    Eigen::ArrayXd depth_;
    long rounds_ = 0;
    double work_ = 0;
};

} // namespace

void refuse_factor(Index nodes, const ContactOptions& options) {
    const double bytes = GrowingFactor::bytes(nodes);
    if (bytes <= options.memory_limit) return;
    refuse("nested Cholesky with ", nodes, " nodes in contact would take ", bytes / 1e9, " GB, at most ",
           options.memory_limit / 1e9, " GB are allowed; choose auto or active-set, which needs less");
}

void solve_nested(const ContactProblem& problem, const ContactOptions& options, Solution& solution) {
    solve_steps<NestedContact>(problem, options, solution);
}

} // namespace rough
