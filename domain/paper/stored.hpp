#pragma once

#include "domain/mwm/stored.hpp"
#include "domain/numerics/stored.hpp"
#include "domain/paper/rescaled_problem.hpp"

namespace rough {

///@{
/// As checkpoints hold it: undone by its counterpart; from_json throws nlohmann's exceptions on anything
/// else.
inline void to_json(nlohmann::json& j, const RescaledResponse& outcome) {
    const Response& r = outcome.response;
    j = {outcome.scale,
         {numbers_of(outcome.stiffness.x), numbers_of(outcome.stiffness.y), outcome.stiffness.from,
          outcome.stiffness.to},
         {r.range, numbers_of(r.displacement), numbers_of(r.pressure), numbers_of(r.contact_fraction),
          numbers_of(r.tangent_stiffness), numbers_of(r.kkt_residual), static_cast<int>(r.solver)}};
}
inline void from_json(const nlohmann::json& j, RescaledResponse& outcome) {
    const auto &k = j.at(1), &r = j.at(2);
    outcome.scale = j.at(0);
    outcome.stiffness = {vector_from(k.at(0)), vector_from(k.at(1)), k.at(2), k.at(3)};
    outcome.response = {};
    outcome.response.range = r.at(0);
    outcome.response.displacement = vector_from(r.at(1));
    outcome.response.pressure = vector_from(r.at(2));
    outcome.response.contact_fraction = vector_from(r.at(3));
    outcome.response.tangent_stiffness = vector_from(r.at(4));
    outcome.response.kkt_residual = vector_from(r.at(5));
    outcome.response.solver = static_cast<Solver>(r.at(6).get<int>());
}
///@}

} // namespace rough
