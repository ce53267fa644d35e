#include "domain/mwm/cross.hpp"

#include "domain/mwm/waves.hpp"
#include "ga/variation/cross.hpp"

#include <algorithm>

namespace rough {

namespace {

/// A chromosome with the genes of the series that it comes from.
struct Owned {
    Series genes; ///< without chromosomes
    Chromosome chromosome;
};

std::vector<Owned> by_wave_length(const Genome& genome) {
    std::vector<Owned> scales;
    for (const auto& series : folded(genome).series)
        for (const auto& chromosome : series.chromosomes)
            scales.push_back({{series.A, series.H, series.gamma, series.lambda, {}}, chromosome});
    std::stable_sort(scales.begin(), scales.end(), [](const Owned& a, const Owned& b) {
        return wave_length(a.genes, a.chromosome.n) > wave_length(b.genes, b.chromosome.n);
    });
    return scales;
}

/// A series takes a chromosome if its genes are equal and the place n is free.
bool takes(const Series& series, const Owned& scale) {
    const auto& genes = scale.genes;
    return series.A == genes.A && series.H == genes.H && series.gamma == genes.gamma &&
           series.lambda == genes.lambda &&
           std::none_of(series.chromosomes.begin(), series.chromosomes.end(),
                        [&](const Chromosome& other) { return other.n == scale.chromosome.n; });
}

Genome genome_of(const std::vector<Owned>& scales) {
    Genome genome;
    for (const auto& scale : scales) {
        auto home = std::find_if(genome.series.begin(), genome.series.end(),
                                 [&](const Series& series) { return takes(series, scale); });
        if (home == genome.series.end())
            home = genome.series.insert(home, scale.genes);
        home->chromosomes.push_back(scale.chromosome);
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
