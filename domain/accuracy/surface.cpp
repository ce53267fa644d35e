#include "domain/accuracy/surface.hpp"

#include <algorithm>

namespace rough {

Surface surface_of(const Genome& genome) {
    return {[genome](const Grid& grid) { return sample(genome, grid); }, shortest_wave(genome)};
}

Surface surface_of(const Profile& scan) {
    const auto heights_on = [scan](const Grid& grid) {
        const Index points = scan.nodes();
        Profile profile{Eigen::VectorXd(grid.nodes), grid.spacing()};
        for (Index i = 0; i < grid.nodes; ++i) {
            const double place = (grid.from + static_cast<double>(i) * profile.spacing) / scan.spacing;
            const Index left = std::clamp<Index>(static_cast<Index>(place), 0, points - 1);
            const Index right = grid.wraps ? (left + 1) % points : std::min(left + 1, points - 1);
            const double weight = std::clamp(place - static_cast<double>(left), 0.0, 1.0);
            profile.heights[i] = (1 - weight) * scan.heights[left] + weight * scan.heights[right];
        }
        return profile;
    };
    return {heights_on, 32 * scan.spacing};
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
