#include "apps/external/solution.hpp"

#include "domain/errors.hpp"
#include "domain/text/json.hpp"

#include <algorithm>
#include <cmath>

namespace app {

using nlohmann::json;

std::vector<double> violation_from(const json& answer) {
    if (!answer.contains("violation")) return {};
    const json& violation = answer.at("violation");
    return violation.is_array() ? violation.get<std::vector<double>>() : std::vector{violation.get<double>()};
}

bool is_valid(const Evaluation& answer, std::size_t objectives) {
    const auto finite = [](const std::vector<double>& values) {
        return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
    };
    return answer.objectives.size() == objectives && finite(answer.objectives) &&
           std::ranges::all_of(answer.violation, [](double value) { return value < HUGE_VAL; });
}

double violated(const Evaluation& answer) {
    double sum = 0;
    for (const double each : answer.violation) sum += std::max(0.0, each);
    return sum;
}

bool BestKnown::is_better(const Solution& a, const Solution& b) const {
    if (violated(a.answer) != violated(b.answer)) return violated(a.answer) < violated(b.answer);
    for (std::size_t k = 0; k < minimise.size(); ++k)
        if (const double x = a.answer.objectives[k], y = b.answer.objectives[k]; x != y)
            return minimise[k] ? x < y : x > y;
    return a.genes < b.genes;
}

bool BestKnown::dominates(const Evaluation& a, const Evaluation& b) const {
    if (violated(a) != violated(b)) return violated(a) < violated(b);
    bool better = false;
    for (std::size_t k = 0; k < minimise.size(); ++k) {
        const double x = a.objectives[k], y = b.objectives[k];
        if (minimise[k] ? x > y : x < y) return false;
        better |= x != y;
    }
    return better;
}

void BestKnown::take(const Solution& solution, std::size_t level) {
    if (level < level_) return;
    if (level > level_) front_.clear();
    level_ = level;
    for (Solution& other : front_) {
        if (dominates(other.answer, solution.answer)) return;
        if (other.answer.objectives == solution.answer.objectives &&
            violated(other.answer) == violated(solution.answer)) {
            if (is_better(solution, other)) other = solution;
            return;
        }
    }
    std::erase_if(front_, [&](const Solution& other) { return dominates(solution.answer, other.answer); });
    const auto place = std::ranges::find_if(front_, [&](const Solution& other) { return is_better(solution, other); });
    front_.insert(place, solution);
}

bool BestKnown::is_valid() const {
    return std::ranges::all_of(front_, [this](const Solution& solution) {
        try {
            const json genes = rough::parsed_json(solution.genes, "genes");
            return genes.is_array() && std::ranges::all_of(genes, &json::is_primitive) &&
                   app::is_valid(solution.answer, minimise.size());
        } catch (const rough::InputError&) {
            return false;
        }
    });
}

} // namespace app
