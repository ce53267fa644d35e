#pragma once

#include "domain/response/response.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rough {

/// The model of a response: grid, body, load steps and solver. A target is valid for its kernel and datum.
struct Model {
    Grid grid;              ///< nodes of the surface
    Body body;              ///< elastic body
    Loading loading;        ///< load steps
    ContactOptions contact; ///< solver
    /// Largest relative error of a genome's response against this model without approximations
    /// (domain/accuracy); 0: none.
    double accuracy = 0;
};

/// The model with default values for the members at 0: the body's for the grid's length, the reach for the
/// kernel. The grid becomes periodic if the kernel is, and only then.
inline Model completed(Model model) {
    model.grid.periodic = model.body.kernel == Kernel::periodic;
    model.body = completed(model.body, model.grid.length);
    model.loading = completed(model.loading, model.body.kernel);
    return model;
}

/// Throws InputError if a completed model's body or load steps have no solution on its grid.
inline void validate(const Model& model) {
    validate(model.body, model.grid.nodes, model.grid.spacing());
    validate(model.loading, model.body.kernel);
}

/// The response of a profile under the model. Members of the body at 0 get their default for the grid's
/// length.
inline Response respond(const Profile& profile, const Model& model) {
    return respond(profile, completed(model.body, model.grid.length), model.loading, model.contact);
}

/// The model without approximations.
inline Model exactly(Model model) {
    model.accuracy = 0;
    return model;
}

/// The model on a grid with `refine` elements for each element of its grid.
inline Model refined(Model model, Index refine) {
    model = completed(model);
    model.grid = refined(model.grid, refine);
    return model;
}

/// Pairs of name with unit and value, in a fixed order.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A number with 17 digits, which reads back exactly.
std::string field_text(double value);

/// A completed model as fields. Solver and tolerance are omitted, because solvers agree to the tolerance of
/// their certificate.
Fields fields(const Model& model);

} // namespace rough
