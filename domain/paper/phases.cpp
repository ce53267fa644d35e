#include "domain/paper/phases.hpp"

#include "domain/mwm/waves.hpp"

#include <cmath>

namespace rough {

namespace {

template <class Choose>
std::vector<ga::Variable> phases_of(const Genome& genome, PhaseReach reach, Choose choose) {
    std::vector<ga::Variable> variables;
    const auto places = gene_places(genome);
    const auto values = genes(genome);
    for (std::size_t g = 0; g < places.size(); ++g)
        if (places[g].kind == GenePlace::Kind::phase && choose(places[g].series, places[g].chromosome)) {
            const double half = reach.relative * std::abs(values[g]) + reach.absolute;
            variables.push_back({g, values[g] - half, values[g] + half});
        }
    return variables;
}

bool is_macro(const Genome& genome, std::size_t s, std::size_t c, double length) {
    return wave_length(genome.series[s], genome.series[s].chromosomes[c].n) >= length / 8;
}

} // namespace

std::vector<ga::Variable> phase_variables(const Genome& genome, PhaseReach reach) {
    return phases_of(genome, reach, [](std::size_t, std::size_t) { return true; });
}

std::vector<ga::Variable> dominant_phase_variables(const Genome& genome, const Dominance& dominance,
                                                   PhaseReach reach) {
    return phases_of(genome, reach, [&](std::size_t s, std::size_t c) { return dominance.at(s, c); });
}

std::vector<ga::Variable> other_phase_variables(const Genome& genome, const Dominance& dominance,
                                                PhaseReach reach) {
    return phases_of(genome, reach, [&](std::size_t s, std::size_t c) { return !dominance.at(s, c); });
}

std::vector<ga::Variable> macro_phases(const Genome& genome, double length, PhaseReach reach) {
    return phases_of(genome, reach,
                     [&](std::size_t s, std::size_t c) { return is_macro(genome, s, c, length); });
}

std::vector<ga::Variable> micro_phases(const Genome& genome, double length, PhaseReach reach) {
    return phases_of(genome, reach,
                     [&](std::size_t s, std::size_t c) { return !is_macro(genome, s, c, length); });
}

} // namespace rough
