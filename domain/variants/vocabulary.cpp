#include "domain/variants/vocabulary.hpp"

#include <cmath>

namespace rough {

namespace {

/// A variable for each phase of the chromosomes that are chosen: choose(series, chromosome).
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

} // namespace

ga::Variables<Genome> all_phases(PhaseReach reach) {
    return {"phases", [reach](const Genome& genome) {
                return phases_of(genome, reach, [](std::size_t, std::size_t) { return true; });
            }};
}

ga::Variables<Genome> dominant_phases(std::shared_ptr<const DominanceRule> rule, PhaseReach reach) {
    return {"dominant", [rule, reach](const Genome& genome) {
                const Dominance dominance = (*rule)(genome);
                return phases_of(genome, reach,
                                 [&](std::size_t s, std::size_t c) { return dominance.at(s, c); });
            }};
}

ga::Variables<Genome> other_phases(std::shared_ptr<const DominanceRule> rule, PhaseReach reach) {
    return {"others", [rule, reach](const Genome& genome) {
                const Dominance dominance = (*rule)(genome);
                return phases_of(genome, reach,
                                 [&](std::size_t s, std::size_t c) { return !dominance.at(s, c); });
            }};
}

ga::Combine<Genome> unite() {
    return {"unite", [](const ga::Individual<Genome>& left, const ga::Individual<Genome>& right) {
                return std::optional(sum(left.genome, right.genome));
            }};
}

} // namespace rough
