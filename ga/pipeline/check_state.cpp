#include "ga/pipeline/stage.hpp"

#include <boost/algorithm/string/join.hpp>

namespace ga {

void CheckState::need_score(const std::string& stage) const {
    if (!scored) throw UsageError("stage '" + stage + "' needs a scored population; put score before it");
}

void CheckState::need_one_objective(const std::string& stage) const {
    need_score(stage);
    if (several_objectives())
        throw UsageError("stage '" + stage + "' needs one objective's fitness, the population is ranked by '" +
                         *scored + "'; put score before it");
}

void CheckState::need_several_objectives(const std::string& stage) const {
    if (!several_objectives())
        throw UsageError("stage '" + stage + "' needs a population ranked by pareto; put pareto before it");
}

void CheckState::need_individuals(const std::string& stage, std::size_t n) const {
    if (at_most < n)
        throw UsageError("stage '" + stage + "' has " + std::to_string(at_most) + " individuals; give " +
                         std::to_string(n) + " or more");
}

void CheckState::need_generation(const std::string& stage, const std::string& does) const {
    if (!in_generation) throw UsageError("stage '" + stage + "' " + does + "; put it inside repeat or until");
}

void CheckState::need_repetition(const std::string& stage) const {
    need_generation(stage, "learns from one generation to the next");
}

void CheckState::need_comparable_start(const std::string& stage) const {
    need_generation(stage);
    need_score(stage);
    if (scored != start_scored)
        throw UsageError("stage '" + stage + "' compares the population, scored by '" + *scored +
                         "', with the generation's start, " +
                         (start_scored ? "scored by '" + *start_scored + "'" : "unscored") +
                         "; score both by the same objective");
}

std::string CheckState::objective(const std::string& stage, const std::string& name) const {
    if (name.empty()) return objectives.front();
    if (std::ranges::count(objectives, name) > 0) return name;
    throw UsageError("stage '" + stage + "': unknown objective '" + name + "'; use one of " +
                     boost::algorithm::join(objectives, ", "));
}

} // namespace ga
