#include "domain/contact/nested.hpp"

#include "domain/contact/certificate.hpp"
#include "domain/contact/growing_factor.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <sstream>

namespace rough {

namespace {

/// Gaps and penetrations below this, over the approach, are rounding.
constexpr double rounding = 1e-13;
constexpr double tolerance = 1e-9;
constexpr int most_rounds = 100;

/// One load step after the other on one factor.
class NestedContact {
  public:
    NestedContact(const ContactProblem& problem, double memory_limit)
        : problem_(problem), memory_limit_(memory_limit), factor_(problem.column, problem.gap),
          fourier_(fourier_operator(problem)), touching_(static_cast<std::size_t>(problem.nodes()), 0) {}

    StepSolution press(double approach, bool tangent) {
        Certificate certificate;
        for (int round = 0; round < most_rounds; ++round) {
            factor_.pressures(approach, pressure_);
            drop_tension(approach);
            const double* u = displacement();
            certificate = certify(problem_, approach, factor_.nodes(), pressure_, u);
            if (certificate.penetration <= rounding || !add_penetrating(approach, u))
                break;
        }
        if (!(certificate.residual() <= tolerance)) {
            std::ostringstream line;
            line << "nested Cholesky did not settle at approach " << approach * problem_.displacement_unit
                 << " mm: residual " << certificate.residual() << ", at most " << tolerance << " is expected";
            throw NotConverged(line.str());
        }
        StepSolution step{factor_.nodes(), pressure_, factor_.stiffness(), {}, certificate.residual()};
        if (tangent)
            factor_.tangent(step.tangent);
        return step;
    }

    long rounds() const { return rounds_; }

  private:
    const double* displacement() {
        double* p = fourier_.input();
        std::fill_n(p, problem_.nodes(), 0.0);
        for (Index k = 0; k < factor_.size(); ++k)
            p[factor_.nodes()[static_cast<std::size_t>(k)]] = pressure_[k];
        return fourier_.apply();
    }

    /// Removes nodes under tension until none is left; the factor keeps its head.
    void drop_tension(double approach) {
        for (;;) {
            Index first = 0;
            while (first < pressure_.size() && pressure_[first] > 0)
                ++first;
            if (first == pressure_.size())
                return;
            std::vector<int> kept;
            for (Index k = first; k < pressure_.size(); ++k) {
                const int node = factor_.nodes()[static_cast<std::size_t>(k)];
                if (pressure_[k] > 0)
                    kept.push_back(node);
                else
                    touching_[static_cast<std::size_t>(node)] = 0;
            }
            factor_.cut(first);
            factor_.append(kept);
            factor_.pressures(approach, pressure_);
            ++rounds_;
        }
    }

    /// Appends the penetrating nodes, deepest first; false if none could be.
    bool add_penetrating(double approach, const double* u) {
        std::vector<std::pair<double, int>> penetrating;
        for (Index i = 0; i < problem_.nodes(); ++i) {
            const double depth = approach - problem_.gap[i] - u[i];
            if (depth > rounding * approach && !touching_[static_cast<std::size_t>(i)])
                penetrating.emplace_back(-depth, static_cast<int>(i));
        }
        std::sort(penetrating.begin(), penetrating.end());
        std::vector<int> nodes;
        for (const auto& entry : penetrating)
            nodes.push_back(entry.second);
        const Index size = factor_.size() + static_cast<Index>(nodes.size());
        if (GrowingFactor::bytes(size) > memory_limit_) {
            std::ostringstream line;
            line << "nested Cholesky on " << size << " nodes would take " << GrowingFactor::bytes(size) / 1e9
                 << " GB, at most " << memory_limit_ / 1e9 << " GB is expected: take --solver active-set";
            throw InputError(line.str());
        }
        nodes.resize(static_cast<std::size_t>(factor_.append(nodes)));
        for (const int node : nodes)
            touching_[static_cast<std::size_t>(node)] = 1;
        ++rounds_;
        return !nodes.empty();
    }

    const ContactProblem& problem_;
    double memory_limit_;
    GrowingFactor factor_;
    FourierOperator fourier_;
    std::vector<char> touching_;
    Eigen::VectorXd pressure_;
    long rounds_ = 0;
};

} // namespace

Solution solve_nested(const ContactProblem& problem, bool tangents, double memory_limit) {
    NestedContact contact(problem, memory_limit);
    Solution solution;
    for (const double approach : problem.approach)
        solution.steps.push_back(contact.press(approach, tangents));
    solution.iterations = contact.rounds();
    return solution;
}

} // namespace rough
