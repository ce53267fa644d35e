#pragma once

#include "ga/problem/problem.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace ga {

/// A genome that is a sequence of genes at positions: those of two genomes may change places.
template <class G>
concept Positional = std::ranges::random_access_range<G> && requires(G& genome, std::size_t i) {
    genome.size();
    std::swap_ranges(genome.begin(), genome.end(), genome.begin());
    *genome.begin() = *genome.begin(); // a swap's own signature does not ask for it
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
        return checked_bounds(problem, genome);
    } else {
        std::vector<Variable> all(genes_of(problem, genome).size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = {i, -HUGE_VAL, HUGE_VAL};
        return all;
    }
}

/// Calls cross(x, y, variable) for the real genes of both parents that may move in both, with the bounds that
/// both allow, widened to where the parents are: children never leave what their parents' bounds and genes
/// span.
template <HasGenes P, class Cross>
void cross_genes(const P& problem, typename P::Genome& a, typename P::Genome& b, Cross cross) {
    const auto& of_first = variables_of(problem, a);
    const auto& of_second = variables_of(problem, b);
    edit_genes(problem, a, [&](std::span<double> first) {
        edit_genes(problem, b, [&](std::span<double> second) {
            std::size_t other = 0;
            for (Variable variable : of_first) {
                while (other < of_second.size() && of_second[other].gene < variable.gene)
                    ++other;
                if (variable.gene >= first.size() || variable.gene >= second.size() ||
                    other == of_second.size() || of_second[other].gene != variable.gene)
                    continue;
                double &x = first[variable.gene], &y = second[variable.gene];
                variable.lower = std::min({std::max(variable.lower, of_second[other].lower), x, y});
                variable.upper = std::max({std::min(variable.upper, of_second[other].upper), x, y});
                cross(x, y, variable);
            }
        });
    });
}

} // namespace ga
