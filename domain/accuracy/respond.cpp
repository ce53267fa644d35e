#include "domain/accuracy/respond.hpp"

#include "domain/accuracy/respond_within.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

Response respond(const Genome& genome, const Model& given) {
    const Model model = completed(given);
    if (model.accuracy > 0)
        return respond_within(genome, model, model.accuracy).response;
    const Profile profile = sample(genome, model.grid);
    if (is_flat(profile, genome))
        refuse("profile: all heights are equal at its ", model.grid.nodes,
               " nodes, expected waves that the grid can show");
    return respond(profile, model);
}

} // namespace rough
