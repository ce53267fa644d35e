#pragma once

#include "ga/base/errors.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace ga {

/// What is known of a population at a place of a pipeline before anything runs. Each stage checks what it
/// needs and leaves what it makes known; a pipeline that cannot work is refused here, with a UsageError.
struct CheckState {
    std::vector<std::string> objectives;     ///< of the problem; the first is the default
    std::optional<std::string> scored;       ///< the policy under which every individual is scored
    bool in_generation = false;              ///< inside a repeat or until
    std::optional<std::string> start_scored; ///< the policy under which the generation's start is scored
    bool nobody = false;                     ///< the population is empty yet
    bool on_islands = false;                 ///< inside islands
    bool several_objectives() const {
        return scored && scored->find(' ') != std::string::npos;
    } ///< as by pareto

    /// Throws UsageError, naming the stage, where individuals may be unscored.
    [[gnu::cold]] void need_score(const std::string& stage) const {
        if (!scored)
            throw UsageError("stage '" + stage + "' needs a scored population; expected score before it");
    }
    /// Throws UsageError, naming the stage, where fitness is no single number.
    [[gnu::cold]] void need_one_objective(const std::string& stage) const {
        need_score(stage);
        if (several_objectives())
            throw UsageError("stage '" + stage +
                             "' needs one objective's fitness, the population is ranked by '" + *scored +
                             "'; expected score before it");
    }
    /// Throws UsageError, naming the stage and what it does there, outside a generation.
    [[gnu::cold]] void need_generation(const std::string& stage,
                                       const std::string& does = "reads the start of a generation") const {
        if (!in_generation)
            throw UsageError("stage '" + stage + "' " + does + "; expected it inside repeat or until");
    }
    /// The same of a stage that learns.
    [[gnu::cold]] void need_repetition(const std::string& stage) const {
        need_generation(stage, "learns from one generation to the next");
    }
    /// Throws UsageError, naming the stage, outside a generation, or where its start was scored otherwise
    /// than the population, so that the two cannot be compared.
    [[gnu::cold]] void need_comparable_start(const std::string& stage) const {
        need_generation(stage);
        need_score(stage);
        if (scored != start_scored)
            throw UsageError("stage '" + stage + "' compares the population, scored by '" + *scored +
                             "', with the generation's start, " +
                             (start_scored ? "scored by '" + *start_scored + "'" : "unscored") +
                             "; expected the same for both");
    }
    /// The objective's own name; an empty one stands for the problem's first.
    [[gnu::cold]] std::string objective(const std::string& stage, const std::string& name) const {
        if (name.empty())
            return objectives.front();
        if (std::find(objectives.begin(), objectives.end(), name) != objectives.end())
            return name;
        std::string list;
        for (const auto& each : objectives)
            list += (list.empty() ? "" : ", ") + each;
        throw UsageError("stage '" + stage + "': unknown objective '" + name + "'; expected one of " + list);
    }
};

} // namespace ga
