#pragma once

#include "ga/problem.hpp"

#include <span>

namespace ga {

/// A genome that is a sequence of genes at positions: those of two genomes may change places.
template <class G>
concept Positional = std::ranges::random_access_range<G> && requires(G& genome, std::size_t i) {
    genome.size();
    std::swap_ranges(genome.begin(), genome.end(), genome.begin());
};

/// Lets edit(std::span<double>) change a genome's real genes, in place where the genome is a vector of them.
template <HasGenes P, class Edit>
void edit_genes(const P& problem, typename P::Genome& genome, Edit edit) {
    if constexpr (ConvertsGenes<P>) {
        std::vector<double> genes = problem.genes(genome);
        edit(std::span<double>(genes));
        genome = problem.with_genes(genome, genes);
    } else {
        edit(std::span<double>(genome));
    }
}

/// The genes that may move with their bounds: the problem's own list, or all without bounds.
template <HasGenes P>
decltype(auto) variables_of(const P& problem, const typename P::Genome& genome) {
    if constexpr (Bounded<P>) {
        return problem.bounds(genome);
    } else {
        std::vector<Variable> all(genes_of(problem, genome).size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = {i, -HUGE_VAL, HUGE_VAL};
        return all;
    }
}

} // namespace ga
