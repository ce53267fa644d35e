#include "domain/fitness/model.hpp"

#include "domain/economy/economy.hpp"
#include "domain/errors.hpp"

#include <cmath>
#include <string>

namespace rough {

Model refined(const Model& model, Index refine) {
    Model finer = model;
    finer.grid = refined(model.grid, refine);
    return finer;
}

Model exactly(Model model) {
    model.accuracy = 0;
    return model;
}

Response respond(const Genome& genome, const Model& model) {
    if (model.accuracy > 0)
        return respond_within(genome, model, model.accuracy).response;
    const Profile profile = sample(genome, model.grid);
    if (is_flat(profile, genome))
        throw InputError("profile: all heights are equal at its " + std::to_string(model.grid.nodes) +
                         " nodes, expected waves that the grid can show");
    return respond(profile, model.body, model.loading, model.contact);
}

bool is_flat(const Profile& sampled, const Genome& genome) {
    double amplitudes = 0;
    for (const Wave& wave : waves(genome))
        amplitudes += std::abs(wave.amplitude);
    return !(sampled.heights.maxCoeff() - sampled.heights.minCoeff() > 1e-12 * amplitudes);
}

} // namespace rough
