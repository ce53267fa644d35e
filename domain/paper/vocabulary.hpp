#pragma once

#include "domain/paper/dominance.hpp"
#include "domain/paper/gcmma.hpp"
#include "domain/problem/limits.hpp"
#include "ga/ga.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/refinement_vocabulary.hpp"

#include <memory>

namespace rough {

/// What roughness adds to the engine's words: which phases refinement moves, how genomes are joined and
/// reduced.
struct Vocabulary {
    std::shared_ptr<const DominanceRule> rule; ///< Algorithm 1
    PhaseReach reach = {};                     ///< of every refined phase
    /// Gives a sum its amplitude, where Eq. 11 does not; empty: as it is.
    std::function<Genome(const Genome&)> fitted = {};

    /// The choice `dominant`: phases of dominant chromosomes.
    ga::Variables<Genome> dominant() const { return phases_where("dominant", true); }
    /// The choice `others`: phases of all the other chromosomes.
    ga::Variables<Genome> others() const { return phases_where("others", false); }
    /// The choice `phases`: every phase.
    ga::Variables<Genome> phases() const {
        return {"phases", [*this](const Genome& genome) { return phase_variables(genome, reach); }};
    }

    /// Keeps a genome's dominant chromosomes alone, its scale as it is.
    auto reduce_dominant() const {
        return ga::transform("reduce dominant",
                             [*this](const Genome& genome) { return reduced(genome, (*rule)(genome)); });
    }

    /// The sum of the two parents as they were scaled when scored: their relative amplitude matters.
    ga::Combine<Genome> unite() const {
        return {"unite",
                [fitted = fitted](const ga::Individual<Genome>& left, const ga::Individual<Genome>& right) {
                    const Genome both = sum(left.genome, right.genome);
                    return std::optional(fitted ? fitted(both) : both);
                }};
    }

  private:
    ga::Variables<Genome> phases_where(const char* name, bool dominant) const {
        return {name, [rule = rule, reach = reach, dominant](const Genome& genome) {
                    const Dominance dominance = (*rule)(genome);
                    return phase_variables(genome, reach, [&](std::size_t s, std::size_t c) {
                        return dominance.at(s, c) == dominant;
                    });
                }};
    }
};

/// Adds those words to what text pipelines are made of.
template <ga::Problem P>
requires std::same_as<typename P::Genome, Genome>
void add_words(ga::Registry<P>& registry, const Vocabulary& vocabulary) {
    ga::add_method<Gcmma>(registry);
    registry.add("reduce dominant", "roughness", "keeps each genome's dominant chromosomes (Algorithm 1)",
                 vocabulary.reduce_dominant());
    registry.add(vocabulary.unite(), "the sum of two genomes, each as it was scaled when scored");
    registry.add(vocabulary.dominant(), "phases of the dominant chromosomes (Algorithm 1)");
    registry.add(vocabulary.others(), "phases of the other chromosomes");
    registry.add(vocabulary.phases(), "phases of all chromosomes");
}

} // namespace rough
