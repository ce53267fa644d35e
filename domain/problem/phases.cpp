#include "domain/problem/phases.hpp"

#include "domain/mwm/waves.hpp"

#include <cmath>

namespace rough {

namespace {

bool is_macro(const Genome& genome, std::size_t s, std::size_t c, double length) {
    return wave_length(genome.series[s], genome.series[s].chromosomes[c].n) >= length / 8;
}

} // namespace

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

std::vector<ga::Variable> macro_phases(const Genome& genome, double length, PhaseReach reach) {
    return phase_variables(genome, reach,
                           [&](std::size_t s, std::size_t c) { return is_macro(genome, s, c, length); });
}

std::vector<ga::Variable> micro_phases(const Genome& genome, double length, PhaseReach reach) {
    return phase_variables(genome, reach,
                           [&](std::size_t s, std::size_t c) { return !is_macro(genome, s, c, length); });
}

} // namespace rough
