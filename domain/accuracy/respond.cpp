#include "domain/accuracy/respond.hpp"

#include "domain/accuracy/respond_within.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sampling.hpp"

namespace rough {

void expect_waves(const Genome& genome, const Profile& profile) {
    if (is_flat(profile, genome))
        refuse("profile: all heights are equal at its ", profile.nodes(),
               " nodes, expected waves that the grid can show");
}

Response respond(const Genome& genome, const Model& given) {
    const Model model = completed(given);
    if (model.accuracy > 0)
        return respond_within(genome, model, model.accuracy).response;
    const Profile profile = sample(genome, model.grid);
    expect_waves(genome, profile);
    return respond(profile, model.body, model.loading, model.contact);
}

} // namespace rough
