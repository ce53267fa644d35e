#pragma once

#include "ga/base/json.hpp"

#include <string>
#include <vector>

namespace app {

/// The answer of an evaluation outside the program.
struct Evaluation {
    std::vector<double> objectives;     ///< as reported
    std::vector<double> violation = {}; ///< one number per constraint; 0 or less if it holds
};

/// The answer's "violation", a number or an array, or empty. Throws nlohmann's exceptions on other types.
std::vector<double> violation_from(const nlohmann::json& answer);
/// Whether it has this many objectives, which are finite, and no violation is NaN or infinite.
bool is_valid(const Evaluation& answer, std::size_t objectives);
/// The sum of the positive violations.
double violated(const Evaluation& answer);

/// A genome that was evaluated.
struct Solution {
    std::string genes; ///< JSON array that was sent
    Evaluation answer;
};

///@{
/// The form in checkpoints.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Evaluation, objectives, violation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Solution, genes, answer)
///@}

/// The non-dominated ones of all evaluated solutions of the last level that was evaluated. They do not depend
/// on their order. Ties: the first in alphabetical order of the genes.
class BestKnown {
  public:
    /// Whether each objective is minimised.
    std::vector<bool> minimise;

    void take(const Solution& solution, std::size_t level = 0);
    std::size_t level() const { return level_; } ///< number of their level
    /// The best by Deb's rules (less violation is better), then by the first objective; or null.
    const Solution* best() const { return front_.empty() ? nullptr : &front_.front(); }
    /// The non-dominated solutions, sorted by the first objective; at most one for one objective.
    const std::vector<Solution>& front() const { return front_; }

    /// Whether every solution has genes and an answer to each objective; false after reading another file.
    bool is_valid() const;

    NLOHMANN_DEFINE_TYPE_INTRUSIVE(BestKnown, front_, level_)

  private:
    bool is_better(const Solution& a, const Solution& b) const;
    bool dominates(const Evaluation& a, const Evaluation& b) const;

    std::vector<Solution> front_;
    std::size_t level_ = 0;
};

} // namespace app
