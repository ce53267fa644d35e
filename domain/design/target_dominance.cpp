#include "domain/design/target_dominance.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"

#include <algorithm>

namespace rough {

namespace {

std::optional<Curve> curve_alone(const Genome& alone, const Model& model, const Target& target) {
    const Profile profile = sample(alone, model.grid);
    if (is_flat(profile, alone))
        return std::nullopt;
    Loading loading = model.loading;
    (target.against_pressure() ? loading.to_pressure : loading.to_displacement) = target.last();
    try {
        return curve_of(target.quantity, respond(profile, model.body, loading, model.contact));
    } catch (const InputError&) { // periodic, in full contact below that load
        return std::nullopt;
    }
}

} // namespace

Genome reduced_to_target(const DesignSetup& setup, const Genome& genome, std::size_t target,
                         double threshold) {
    const Target& asked = setup.targets[target];
    const auto scales = length_scales(genome);
    std::vector<std::optional<Curve>> alone;
    for (const LengthScale& scale : scales)
        alone.push_back(curve_alone(only(genome, scale), setup.model, asked));
    const DominantParts parts = dominant_parts({asked.x, asked.y}, alone, threshold);
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        for (std::size_t i = 0; i < scales.size(); ++i)
            if (std::count(scales[i].members.begin(), scales[i].members.end(), std::pair(s, c)))
                return parts.dominant[i] != 0;
        return false;
    });
}

} // namespace rough
