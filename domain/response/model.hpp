#pragma once

#include "domain/numerics/grid.hpp"
#include "domain/response/response.hpp"

namespace rough {

/// A model set-up: what turns a surface into a response. Target and kernel, datum and grid belong together.
struct Model {
    Grid grid;              ///< where profiles are sampled
    Body body;              ///< what they are pressed on
    Loading loading;        ///< how far and in how many steps
    ContactOptions contact; ///< by which solver
    /// Largest relative error that a genome's response may have against this very set-up solved throughout
    /// (domain/accuracy); 0: none.
    double accuracy = 0;
};

/// The set-up with what was left at 0 filled in: the body for the grid's length, the reach for the kernel;
/// the grid is periodic for the periodic kernel and for no other.
inline Model completed(Model model) {
    model.grid.periodic = model.body.kernel == Kernel::periodic;
    model.body = completed(model.body, model.grid.length);
    model.loading = completed(model.loading, model.body.kernel);
    return model;
}

/// Throws InputError on a completed set-up whose body or load steps have no solution on its grid.
inline void validate(const Model& model) {
    validate(model.body, model.grid.nodes, model.grid.spacing());
    validate(model.loading, model.body.kernel);
}

/// A profile's response as the set-up asks, by its own body, load steps and solver; what was left at 0 is
/// filled in for the grid's length.
inline Response respond(const Profile& profile, const Model& model) {
    return respond(profile, completed(model.body, model.grid.length), model.loading, model.contact);
}

/// The same set-up solved throughout, whatever accuracy it allows.
inline Model exactly(Model model) {
    model.accuracy = 0;
    return model;
}

/// The same set-up on a grid of `refine` elements for each of this one.
inline Model refined(Model model, Index refine) {
    model = completed(model);
    model.grid = refined(model.grid, refine);
    return model;
}

} // namespace rough
