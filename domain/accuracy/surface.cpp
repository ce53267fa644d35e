#include "domain/accuracy/surface.hpp"

namespace rough {

Surface surface_of(const Genome& genome) {
    return {[genome](const Grid& grid) { return sample(genome, grid); }, shortest_wave(genome)};
}

Grid cells(const Grid& resolved, Index elements) {
    if (resolved.wraps)
        return {elements, resolved.length, true, resolved.from};
    const double overhang = 0.5 * resolved.spacing();
    const double spacing = (resolved.length + 2 * overhang) / static_cast<double>(elements);
    return {elements, spacing * static_cast<double>(elements - 1), false,
            resolved.from - overhang + 0.5 * spacing};
}

} // namespace rough
