#pragma once

#include "domain/mwm/sampling.hpp"
#include "domain/response/response.hpp"

namespace rough {

/// A model set-up: what turns a genome into a response. Target and kernel, datum and grid belong together.
struct Model {
    Grid grid;              ///< where profiles are sampled
    Body body;              ///< what they are pressed on
    Loading loading;        ///< how far and in how many steps
    ContactOptions contact; ///< by which solver
    /// Largest relative error that a genome's response may have against this very set-up solved throughout
    /// (domain/economy); 0: none.
    double accuracy = 0;
};

/// The same set-up solved throughout, whatever accuracy it allows.
Model exactly(Model model);

/// The same set-up on a grid of `refine` elements for each of this one.
Model refined(const Model& model, Index refine);

/// Within the model's accuracy. Throws InputError where the genome's waves are flat at the grid's nodes (a
/// wave of exactly the spacing is).
Response respond(const Genome& genome, const Model& model);

/// Whether the sampled profile's height range is rounding alone: under 1e-12 of its amplitudes' sum.
bool is_flat(const Profile& sampled, const Genome& genome);

} // namespace rough
