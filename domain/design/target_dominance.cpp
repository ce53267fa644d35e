#include "domain/design/target_dominance.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/length_scales.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>

namespace rough {

namespace {

/// Of no chromosome that answers.
constexpr double none = -2;

double correlation(const Genome& alone, const Model& model, const Goal& goal) {
    const Profile profile = sample(alone, model.grid);
    if (is_flat(profile, alone))
        return none;
    Loading loading = model.loading;
    (goal.against_pressure() ? loading.to_pressure : loading.to_displacement) = goal.last();
    try {
        const Curve curve = curve_of(goal.quantity, respond(profile, model.body, loading, model.contact));
        const double found = pearson(goal.x.unaryExpr([&](double x) { return curve.held_at(x); }), goal.y);
        return std::isnan(found) ? none : found;
    } catch (const InputError&) { // periodic, in full contact below that load
        return none;
    }
}

} // namespace

Genome reduced_to_goal(const DesignSetup& setup, const Genome& genome, std::size_t goal, double threshold) {
    const auto scales = length_scales(genome);
    std::vector<double> found;
    for (const LengthScale& scale : scales)
        found.push_back(correlation(only(genome, scale), setup.model, setup.goals[goal]));
    const double best = *std::max_element(found.begin(), found.end());
    std::vector<std::pair<std::size_t, std::size_t>> kept;
    for (std::size_t i = 0; i < scales.size(); ++i)
        if (found[i] > threshold || (best <= threshold && found[i] == best))
            kept.insert(kept.end(), scales[i].members.begin(), scales[i].members.end());
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return std::find(kept.begin(), kept.end(), std::pair(s, c)) != kept.end();
    });
}

} // namespace rough
