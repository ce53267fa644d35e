#include "domain/mwm/response.hpp"

#include "domain/errors.hpp"

namespace rough {
namespace {

/// The genome's profile on a grid. Throws InputError if it is flat.
Profile rough_profile(const Genome& genome, const Grid& grid) {
    Profile profile = sample(genome, grid);
    if (is_flat(profile, genome))
        refuse("profile: all heights are equal at its ", profile.nodes(), " nodes; use waves that this grid can show");
    return profile;
}

/// All chromosomes of a genome, in order.
std::vector<PlacedWave> places(const Genome& genome) {
    std::vector<PlacedWave> all;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (const Chromosome& chromosome : genome.series[s].chromosomes)
            all.push_back({s, chromosome.n, wave_length(genome.series[s], chromosome.n),
                           std::abs(genome.scale * wave(genome.series[s], chromosome).amplitude)});
    return all;
}

auto sampler(Genome genome) {
    return [genome = std::move(genome)](const Grid& grid) { return sample(genome, grid); };
}

/// Omits the shortest waves, which need the finest grids, as long as the window on `grid` is at most `widest`
/// (mm) wide. `whole` is the genome's profile on `grid`.
SumOfWaves without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest) {
    std::vector<PlacedWave> order = places(genome);
    std::ranges::stable_sort(order, {}, &PlacedWave::wave_length_mm);
    SumOfWaves best{sampler(genome), places(genome)};
    double amplitude = 0;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        amplitude += order[k].amplitude_mm;
        if (amplitude > 2 * widest) // hopeless: the window is about twice the amplitudes' sum
            break;
        const double shortest = order[k + 1].wave_length_mm;
        if (shortest == order[k].wave_length_mm) // waves of equal length stay or go together
            continue;
        const auto stays = [&](std::size_t s, std::size_t c) {
            return wave_length(genome.series[s], genome.series[s].chromosomes[c].n) >= shortest;
        };
        Profile reduced = whole;
        reduced.heights -= sample(filtered(genome, std::not_fn(stays)), grid).heights;
        const Window window = window_between(whole, reduced);
        if (window.width() <= widest) {
            const auto cut = order.begin() + static_cast<std::ptrdiff_t>(k) + 1;
            best = {sampler(filtered(genome, stays)), {cut, order.end()}, {order.begin(), cut}, window};
        }
    }
    return best;
}

} // namespace

Grid resolved_grid(const Genome& genome, double length, bool periodic) {
    const double elements = std::clamp(std::ceil(64 * length / shortest_wave(genome) - 1e-9), 4096.0, 1048576.0);
    return {static_cast<Index>(elements) + (periodic ? 0 : 1), length, periodic};
}

Response respond(const Genome& genome, const Model& model) {
    if (model.accuracy > 0) return respond_within(genome, model).response;
    return respond(rough_profile(genome, model.grid), model.body, model.loading, model.contact);
}

ReportedResponse respond_within(const Genome& genome, const Model& model) {
    const Grid& grid = model.grid;
    const Profile whole = rough_profile(genome, grid);
    return respond_within(
        whole, {sampler(genome), places(genome)},
        [&](double widest) { return without_short_waves(genome, grid, whole, widest); }, model);
}

} // namespace rough
