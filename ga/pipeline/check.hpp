#pragma once

#include "ga/base/errors.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace ga {

/// Properties of a population at one point of a pipeline that are known before the pipeline runs. Each stage
/// checks whether it can work on such a population, and updates the properties. A stage that cannot work
/// throws UsageError. A policy is one objective, or several objectives (`pareto`).
struct CheckState {
    std::vector<std::string> objectives;     ///< names of the problem's objectives; the first is the default
    std::optional<std::string> scored;       ///< policy under which every individual is scored
    bool in_generation = false;              ///< whether the point is inside a `repeat` or `until`
    std::optional<std::string> start_scored; ///< policy under which the generation's start is scored
    bool nobody = false;                     ///< whether the population is still empty
    bool on_islands = false;                 ///< whether the point is inside `islands`
    /// Whether the population is scored under several objectives.
    bool several_objectives() const { return scored && scored->find(' ') != std::string::npos; }

    /// Throws UsageError, with the stage's name, if individuals may be unscored.
    [[gnu::cold]] void need_score(const std::string& stage) const {
        if (!scored)
            throw UsageError("stage '" + stage + "' needs a scored population; put score before it");
    }
    /// Throws UsageError, with the stage's name, if the fitness has several objectives.
    [[gnu::cold]] void need_one_objective(const std::string& stage) const {
        need_score(stage);
        if (several_objectives())
            throw UsageError("stage '" + stage +
                             "' needs one objective's fitness, the population is ranked by '" + *scored +
                             "'; put score before it");
    }
    /// Throws UsageError, with the stage's name and purpose, if the stage is not in a block of generations.
    [[gnu::cold]] void need_generation(const std::string& stage,
                                       const std::string& does = "reads the start of a generation") const {
        if (!in_generation)
            throw UsageError("stage '" + stage + "' " + does + "; put it inside repeat or until");
    }
    /// Throws UsageError if a stage that learns is not in a block of generations.
    [[gnu::cold]] void need_repetition(const std::string& stage) const {
        need_generation(stage, "learns from one generation to the next");
    }
    /// Throws UsageError, with the stage's name, if the stage is not in a block of generations. Also throws
    /// it if the generation's start and the population are scored under different policies.
    [[gnu::cold]] void need_comparable_start(const std::string& stage) const {
        need_generation(stage);
        need_score(stage);
        if (scored != start_scored)
            throw UsageError("stage '" + stage + "' compares the population, scored by '" + *scored +
                             "', with the generation's start, " +
                             (start_scored ? "scored by '" + *start_scored + "'" : "unscored") +
                             "; score both by the same objective");
    }
    /// The name of an objective; an empty name stands for the problem's first. Throws UsageError if the name
    /// is unknown.
    [[gnu::cold]] std::string objective(const std::string& stage, const std::string& name) const {
        if (name.empty())
            return objectives.front();
        if (std::find(objectives.begin(), objectives.end(), name) != objectives.end())
            return name;
        std::string list;
        for (const auto& each : objectives)
            list += (list.empty() ? "" : ", ") + each;
        throw UsageError("stage '" + stage + "': unknown objective '" + name + "'; use one of " + list);
    }
};

} // namespace ga
