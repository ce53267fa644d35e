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

/// The same set-up solved throughout, whatever accuracy it allows.
inline Model exactly(Model model) {
    model.accuracy = 0;
    return model;
}

/// The same set-up on a grid of `refine` elements for each of this one.
inline Model refined(Model model, Index refine) {
    model.grid = refined(model.grid, refine);
    return model;
}

} // namespace rough
