#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/model.hpp"

namespace rough {

/// A genome's response within the model's accuracy. Throws InputError where the genome's waves are flat at
/// the grid's nodes (a wave of exactly the spacing is).
Response respond(const Genome& genome, const Model& model = {});

/// Throws InputError where a genome's waves are flat at the nodes of its profile.
void expect_waves(const Genome& genome, const Profile& profile);

} // namespace rough
