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
/// A summit that touches anew does so where it penetrates by this share of its greatest depth.
constexpr double new_summit_share = 0.6;

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
            std::vector<Index> dropped;
            for (Index k = 0; k < pressure_.size(); ++k)
                if (!(pressure_[k] > 0))
                    dropped.push_back(k);
            if (dropped.empty())
                return;
            for (const Index k : dropped)
                touching_[static_cast<std::size_t>(factor_.nodes()[static_cast<std::size_t>(k)])] = 0;
            factor_.remove(dropped);
            factor_.pressures(approach, pressure_);
            ++rounds_;
        }
    }

    /// Appends the nodes that penetrate and will stay in contact, by their first-order estimate; false if
    /// none penetrates. A node left out for too low an estimate still penetrates in the next round, which
    /// costs a check; one taken for too high an estimate costs a new factor of the tail.
    bool add_penetrating(double approach, const double* u) {
        const double least = rounding * approach;
        auto depth = [&](Index i) { return approach - problem_.gap[i] - u[i]; };
        auto penetrates = [&](Index i) { return !in_contact(i) && depth(i) > least; };
        std::vector<std::pair<double, int>> doubt; // 0: sure to stay in contact, 1: as likely to be dropped
        auto add = [&](Index node, double share) { doubt.emplace_back(share, static_cast<int>(node)); };
        const Index n = problem_.nodes();
        for (Index first = 0; first < n; ++first) {
            if (!penetrates(first))
                continue;
            Index last = first;
            double deepest = depth(first);
            while (last + 1 < n && penetrates(last + 1))
                deepest = std::max(deepest, depth(++last));
            const bool left = first > 0 && in_contact(first - 1),
                       right = last + 1 < n && in_contact(last + 1);
            const Index length = last - first + 1;
            // An edge advancing by s gives penetration over 3s/2 before it has advanced.
            const double advance = (2 * static_cast<double>(length) + 2) / 3;
            for (Index i = first; i <= last; ++i) {
                const double from_left = static_cast<double>(i - first),
                             from_right = static_cast<double>(last - i);
                const double share = left && right
                                         ? std::min(from_left, from_right) / static_cast<double>(length)
                                     : left  ? from_left / advance
                                     : right ? from_right / advance
                                             : (1 - depth(i) / deepest) / (1 - new_summit_share);
                if (share < 1)
                    add(i, share);
            }
            first = last;
        }
        std::sort(doubt.begin(), doubt.end());
        std::vector<int> added;
        for (const auto& entry : doubt)
            added.push_back(entry.second);
        const Index size = factor_.size() + static_cast<Index>(added.size());
        if (GrowingFactor::bytes(size) > memory_limit_) {
            std::ostringstream line;
            line << "nested Cholesky on " << size << " nodes would take " << GrowingFactor::bytes(size) / 1e9
                 << " GB, at most " << memory_limit_ / 1e9 << " GB is expected: take --solver active-set";
            throw InputError(line.str());
        }
        added.resize(static_cast<std::size_t>(factor_.append(added)));
        for (const int node : added)
            touching_[static_cast<std::size_t>(node)] = 1;
        ++rounds_;
        return !added.empty();
    }

    bool in_contact(Index node) const { return touching_[static_cast<std::size_t>(node)] != 0; }

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
