#pragma once

#include "ga/base/errors.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace ga {

/// Facts about a population at one point of a pipeline, known before the pipeline runs. Each stage checks its
/// needs against them and updates them. A pipeline that cannot work throws a UsageError here.
struct CheckState {
    std::vector<std::string> objectives;     ///< the problem's; the first is the default
    std::optional<std::string> scored;       ///< the policy under which every individual is scored
    bool in_generation = false;              ///< inside a repeat or until
    std::optional<std::string> start_scored; ///< the policy under which the generation's start is scored
    bool nobody = false;                     ///< the population is still empty
    bool on_islands = false;                 ///< inside islands
    /// Whether it is scored by pareto.
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
    /// Throws UsageError, with the stage's name and purpose, if it is not in a block of generations.
    [[gnu::cold]] void need_generation(const std::string& stage,
                                       const std::string& does = "reads the start of a generation") const {
        if (!in_generation)
            throw UsageError("stage '" + stage + "' " + does + "; put it inside repeat or until");
    }
    /// Throws UsageError if a stage that learns is not in a block of generations.
    [[gnu::cold]] void need_repetition(const std::string& stage) const {
        need_generation(stage, "learns from one generation to the next");
    }
    /// Throws UsageError, with the stage's name, if it is not in a block of generations. It also throws if
    /// the start and the population were scored by different policies.
    [[gnu::cold]] void need_comparable_start(const std::string& stage) const {
        need_generation(stage);
        need_score(stage);
        if (scored != start_scored)
            throw UsageError("stage '" + stage + "' compares the population, scored by '" + *scored +
                             "', with the generation's start, " +
                             (start_scored ? "scored by '" + *start_scored + "'" : "unscored") +
                             "; score both by the same objective");
    }
    /// The name of an objective; an empty one is the problem's first. Throws UsageError if it is unknown.
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
