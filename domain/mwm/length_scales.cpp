#include "domain/mwm/length_scales.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

std::vector<LengthScale> length_scales(const Genome& genome) {
    std::vector<LengthScale> scales;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c) {
            const double k = wave_number(genome.series[s], genome.series[s].chromosomes[c].n);
            auto known = std::find_if(scales.begin(), scales.end(), [&](const LengthScale& scale) {
                return std::abs(scale.wave_number - k) <= 1e-12 * k;
            });
            if (known == scales.end())
                known = scales.insert(scales.end(), LengthScale{k, {}});
            known->members.emplace_back(s, c);
        }
    return scales;
}

Genome only(const Genome& genome, const LengthScale& scale) {
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return std::find(scale.members.begin(), scale.members.end(), std::pair(s, c)) != scale.members.end();
    });
}

} // namespace rough
