#include "domain/problem/phases.hpp"

#include "domain/mwm/waves.hpp"

#include <cmath>

namespace rough {

std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach,
                                          const ChosenChromosomes& chosen) {
    std::vector<ga::Variable> variables;
    const auto places = gene_places(genome);
    const auto values = genes(genome);
    for (std::size_t g = 0; g < places.size(); ++g)
        if (places[g].kind == GenePlace::Kind::phase &&
            (!chosen || chosen(places[g].series, places[g].chromosome))) {
            const double half = reach.relative * std::abs(values[g]) + reach.absolute;
            variables.push_back({g, values[g] - half, values[g] + half});
        }
    return variables;
}

std::vector<ga::Variable> phases_of_waves(const Genome& genome, double from, double to, PhaseReach reach) {
    return phase_variables(genome, reach, [&](std::size_t s, std::size_t c) {
        const double length = wave_length(genome.series[s], genome.series[s].chromosomes[c].n);
        return length >= from && length < to;
    });
}

} // namespace rough
