#pragma once

#include "domain/mwm/stored.hpp"
#include "domain/numerics/stored.hpp"
#include "domain/problem/problem.hpp"

/// What checkpoints hold of a design: outcomes without loss, and the set-up that a run belongs to.
namespace rough {

/// As checkpoints hold it, without loss.
inline void to_json(nlohmann::json& j, const DesignOutcome& outcome) {
    nlohmann::json misfits = nlohmann::json::array();
    for (const Eigen::VectorXd& misfit : outcome.misfits)
        misfits.push_back(numbers_of(misfit));
    j = {outcome.scale, std::move(misfits), outcome.excess, outcome.genome};
}
/// As to_json wrote it.
inline void from_json(const nlohmann::json& j, DesignOutcome& outcome) {
    outcome = {j.at(0), {}, j.at(2), j.at(3).get<Genome>()};
    for (const auto& misfit : j.at(1))
        outcome.misfits.push_back(vector_from(misfit));
}

/// Everything of a set-up that decides a result.
inline nlohmann::json description(const DesignSetup& setup) {
    const auto& [grid, body, loading, contact, accuracy] = setup.model;
    const GeneBounds& b = setup.bounds;
    const MakingLimits& l = setup.limits;
    nlohmann::json targets = nlohmann::json::array();
    for (const Target& target : setup.targets)
        targets.push_back({static_cast<int>(target.quantity), numbers_of(target.x), numbers_of(target.y),
                           numbers_of(target.lower), numbers_of(target.upper), target.weight});
    return {{grid.nodes, grid.length, grid.wraps},
            {static_cast<int>(body.kernel), body.effective_modulus, body.datum, body.strip_width},
            {loading.steps, loading.reach},
            {static_cast<int>(contact.solver), contact.tolerance, accuracy},
            {b.H_from, b.H_to, b.gamma_from, b.gamma_to, b.lambda_from, b.lambda_to},
            {l.shortest_wave, l.largest_slope, l.largest_height, l.smallest_radius},
            setup.max_pressure.value_or(0),
            setup.threshold.value_or(0),
            setup.phases ? nlohmann::json{setup.phases->relative, setup.phases->absolute} : nlohmann::json(),
            targets};
}

} // namespace rough
