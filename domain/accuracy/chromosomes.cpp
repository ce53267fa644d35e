#include "domain/accuracy/chromosomes.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

ChromosomePlace place(const Genome& genome, std::size_t s, std::size_t c) {
    const Series& series = genome.series[s];
    const Chromosome& chromosome = series.chromosomes[c];
    return {s, chromosome.n, wave_length(series, chromosome.n),
            std::abs(genome.scale * wave(series, chromosome).amplitude)};
}

} // namespace

std::vector<ChromosomePlace> places(const Genome& genome) {
    std::vector<ChromosomePlace> all;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c)
            all.push_back(place(genome, s, c));
    return all;
}

Selection everything(const Genome& genome) { return {genome, places(genome), {}, {}}; }

Selection without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest) {
    std::vector<ChromosomePlace> order = places(genome);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.wave_length_mm < b.wave_length_mm; });
    Selection best = everything(genome);
    double amplitude = 0;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        amplitude += order[k].amplitude_mm;
        if (amplitude > 2 * widest) // hopeless: the window is about twice the amplitudes' sum
            break;
        const double least = order[k + 1].wave_length_mm;
        if (least == order[k].wave_length_mm) // waves of equal length go together
            continue;
        const auto stays = [&](std::size_t s, std::size_t c) {
            return place(genome, s, c).wave_length_mm >= least;
        };
        Profile reduced = whole;
        reduced.heights -=
            sample(filtered(genome, [&](std::size_t s, std::size_t c) { return !stays(s, c); }), grid)
                .heights;
        const Window window = window_between(whole, reduced);
        if (window.width() <= widest) {
            const auto cut = order.begin() + static_cast<std::ptrdiff_t>(k) + 1;
            best = {filtered(genome, stays), {cut, order.end()}, {order.begin(), cut}, window};
        }
    }
    return best;
}

} // namespace rough
