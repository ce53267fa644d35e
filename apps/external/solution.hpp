#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace app {

/// What is said of a genome from outside.
struct Answer {
    std::vector<double> objectives;     ///< as they were given
    std::vector<double> violation = {}; ///< one number per constraint; 0 or less if it holds
};

/// The answer's "violation": a number or an array, none if there is none. Throws nlohmann's exceptions on
/// anything else.
std::vector<double> violation_from(const nlohmann::json& answer);
/// Sum of what is violated, 0 or more.
double violated(const Answer& answer);

/// A genome that was evaluated.
struct Solution {
    std::string genes; ///< as JSON, as it was sent
    Answer answer;
};

///@{
/// As checkpoints hold them.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Answer, objectives, violation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Solution, genes, answer)
///@}

/// The best of all that was evaluated. It depends on what that was and not on the order in which it came: of
/// equals the one whose genes come first in the alphabet stays.
class BestKnown {
  public:
    /// Whether less is better, one an objective.
    std::vector<bool> minimise;

    void take(const Solution& solution);
    /// By the first objective and Deb's rules: without violation first, then less of it. Nothing at first.
    const Solution* best() const { return best_.genes.empty() ? nullptr : &best_; }
    /// Those that none dominates, best first by the first objective; empty for one objective.
    std::vector<Solution> front() const;

    NLOHMANN_DEFINE_TYPE_INTRUSIVE(BestKnown, minimise, best_, front_)

  private:
    bool is_better(const Solution& a, const Solution& b) const;
    bool dominates(const Answer& a, const Answer& b) const;

    Solution best_;
    std::vector<Solution> front_;
};

} // namespace app
