#pragma once

#include "ga/variation/mutations.hpp"

namespace ga {

/// A problem whose genomes ga can tell apart: by the problem's own measure, by real genes, or by bits and
/// whole numbers at positions.
template <class P>
concept HasDistance = Measured<P> || HasGenes<P> || Discrete<typename P::Genome>;

/// The problem's own `distance`; of real genes the root mean square of their differences in widths between
/// the first genome's bounds; of discrete ones the share that differs. Genes that one of them lacks differ by
/// a whole width.
template <HasDistance P>
double distance(const P& problem, const typename P::Genome& a, const typename P::Genome& b) {
    if constexpr (Measured<P>) {
        return problem.distance(a, b);
    } else if constexpr (HasGenes<P>) {
        const std::vector<double> first = genes_of(problem, a), second = genes_of(problem, b);
        double sum = 0;
        std::size_t count = std::max(first.size(), second.size()) - std::min(first.size(), second.size());
        sum += static_cast<double>(count);
        for (const Variable& v : variables_of(problem, a)) {
            if (v.gene >= std::min(first.size(), second.size()) || !(width(v) > 0))
                continue;
            const double step = (first[v.gene] - second[v.gene]) / width(v);
            sum += step * step;
            ++count;
        }
        return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
    } else {
        const std::size_t shorter = std::min(a.size(), b.size()), longer = std::max(a.size(), b.size());
        std::size_t differ = longer - shorter;
        for (std::size_t i = 0; i < shorter; ++i)
            differ += a[i] != b[i] ? 1 : 0;
        return longer > 0 ? static_cast<double>(differ) / static_cast<double>(longer) : 0;
    }
}

/// What a problem without a distance lacks, for the listing.
inline const char* const no_distance = "real genes, discrete ones, or a distance of the problem's own";

} // namespace ga
