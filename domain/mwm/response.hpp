#pragma once

#include "domain/accuracy/respond_within.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

/// A genome's response within the model's accuracy. Throws InputError if all heights at the grid's nodes are
/// equal, e.g. because the wavelength is the node spacing.
Response respond(const Genome& genome, const Model& model = {});

/// The grid that counts as resolved for a genome: 64 elements per shortest wavelength, 4096 to 2^20.
Grid resolved_grid(const Genome& genome, double length, bool periodic);

/// A genome's response within model.accuracy of the response on the model's grid, and its account. A wave of
/// the account is a chromosome. Throws what respond() and respond_within() of a sum of waves throw.
ReportedResponse respond_within(const Genome& genome, const Model& model);

} // namespace rough
