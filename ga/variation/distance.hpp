#pragma once

#include "ga/variation/mutate.hpp"

#include <set>

namespace ga {

/// A problem whose genomes have a distance. Either the problem defines it, or genomes consist of real genes,
/// bits or whole numbers, or are permutations.
template <class P>
concept HasDistance =
    Measured<P> || HasGenes<P> || Discrete<typename P::Genome> || std::same_as<typename P::Genome, Permutation>;

/// The problem's `distance`, if it has one. For real genes it is the root mean square of the differences,
/// each divided by the distance between the first genome's bounds. Different choices differ by 1. For
/// discrete genes and permutations it is the share of the positions that differ. A gene that only one genome
/// has counts as a difference of 1.
template <HasDistance P>
double distance(const P& problem, const typename P::Genome& a, const typename P::Genome& b) {
    if constexpr (Measured<P>) {
        return problem.distance(a, b);
    } else if constexpr (HasGenes<P>) {
        const std::vector<double> first = genes_of(problem, a), second = genes_of(problem, b);
        const auto [shorter, longer] = std::minmax({first.size(), second.size()});
        std::size_t count = longer - shorter;
        double sum = static_cast<double>(count);
        for (const Variable& v : variables_of(problem, a)) {
            if (v.gene >= shorter || !(width(v) > 0)) continue;
            const double apart = first[v.gene] - second[v.gene];
            const double step = v.is_choice ? (std::abs(apart) < 0.5 ? 0 : 1) : apart / width(v);
            sum += step * step;
            ++count;
        }
        return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
    } else {
        const auto [shorter, longer] = std::minmax({a.size(), b.size()});
        const std::size_t differ = std::inner_product(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shorter),
                                                      b.begin(), longer - shorter, std::plus(), std::not_equal_to());
        return longer > 0 ? static_cast<double>(differ) / static_cast<double>(longer) : 0;
    }
}

/// The members that a problem without a distance lacks, in words, for the listing.
constexpr const char* no_distance = "real or discrete genes, a permutation, or a distance";

/// Takes the copies out of a population: the individuals whose genome an earlier one has, by the key under
/// which its outcome is stored. Returns them in their order.
template <Problem P>
PopulationOf<P> take_copies(PopulationOf<P>& population, const P& problem) {
    std::set<Fingerprint> seen;
    PopulationOf<P> distinct, copies;
    for (auto& each : population)
        (seen.insert(identify(problem, each.genome)).second ? distinct : copies).push_back(std::move(each));
    population = std::move(distinct);
    return copies;
}

} // namespace ga
