#pragma once

#include "domain/mwm/sampling.hpp"
#include "domain/response/response.hpp"

namespace rough {

/// A model set-up: what turns a genome into a response. Target and kernel, datum and grid belong together.
struct Model {
    Grid grid;
    Body body;
    Loading loading;
    ContactOptions contact;
};

/// The same set-up on a grid of `refine` elements for each of this one.
Model refined(const Model& model, Index refine);

Response respond(const Genome& genome, const Model& model);

} // namespace rough
