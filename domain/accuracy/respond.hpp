#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/model.hpp"

namespace rough {

/// A genome's response within the model's accuracy. Throws InputError if the genome's waves are flat at the
/// grid's nodes, as a wave whose length is the node spacing is.
Response respond(const Genome& genome, const Model& model = {});

} // namespace rough
