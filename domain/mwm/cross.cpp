#include "domain/mwm/cross.hpp"

#include "domain/mwm/waves.hpp"
#include "ga/variation/cross.hpp"

#include <algorithm>

namespace rough {

namespace {

/// The chromosomes of a genome from the longest wavelength to the shortest, each as one series.
std::vector<Series> by_wave_length(const Genome& genome) {
    std::vector<Series> scales;
    for (const Series& series : folded(genome).series)
        for (const Chromosome& chromosome : series.chromosomes)
            scales.push_back({series.A, series.H, series.gamma, series.lambda, {chromosome}});
    std::stable_sort(scales.begin(), scales.end(), [](const Series& a, const Series& b) {
        return wave_length(a, a.chromosomes[0].n) > wave_length(b, b.chromosomes[0].n);
    });
    return scales;
}

/// Whether a series has the genes of a scale, and its place n free.
bool takes(const Series& series, const Series& scale) {
    return series.A == scale.A && series.H == scale.H && series.gamma == scale.gamma &&
           series.lambda == scale.lambda &&
           std::none_of(series.chromosomes.begin(), series.chromosomes.end(),
                        [&](const Chromosome& other) { return other.n == scale.chromosomes[0].n; });
}

Genome genome_of(const std::vector<Series>& scales) {
    Genome genome;
    for (const Series& scale : scales) {
        const auto home = std::find_if(genome.series.begin(), genome.series.end(),
                                       [&](const Series& series) { return takes(series, scale); });
        if (home == genome.series.end())
            genome.series.push_back(scale);
        else
            home->chromosomes.push_back(scale.chromosomes[0]);
    }
    return genome;
}

template <class Exchange>
void crossed(Genome& a, Genome& b, Exchange exchange) {
    auto left = by_wave_length(a), right = by_wave_length(b);
    exchange(left, right);
    a = genome_of(left);
    b = genome_of(right);
}

} // namespace

void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) { ga::exchange_at_points(left, right, cuts, stream); });
}

void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) {
    crossed(a, b, [&](auto& left, auto& right) {
        for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
            if (stream.chance(0.5))
                std::swap(left[i], right[i]);
    });
}

} // namespace rough
