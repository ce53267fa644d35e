#include "domain/fitness/model.hpp"

namespace rough {

Model refined(const Model& model, Index refine) {
    Model finer = model;
    finer.grid = refined(model.grid, refine);
    return finer;
}

Response respond(const Genome& genome, const Model& model) {
    return respond(sample(genome, model.grid), model.body, model.loading, model.contact);
}

} // namespace rough
