#pragma once

#include "domain/problem/setup.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

/// Genomes and set-ups of the tests of designs.
namespace rough::testing {

inline Genome two_waves(double first = 0.3, double second = 1, double scale = 0.01) {
    return {scale, {{1, 0.8, 1.5, two_mm, {{1, {first}}, {2, {second}}}}}};
}

/// The stiffness of the genome's profile on 65 nodes as target, up to a part of the pressure that it reaches.
inline DesignSetup like_itself(const Genome& genome, double part = 1, Kernel kernel = Kernel::free) {
    const Model model = completed({.grid = {65, two_mm}, .body = {kernel}});
    const Profile profile = sample(genome, model.grid);
    const double last = secant_stiffness(respond(profile, model)).to;
    return {.model = model, .targets = {target_like(profile, model, "itself", Quantity::stiffness, {10, part * last})}};
}

/// The drawn target on a line with these nodes, or on a map with these along either side.
inline DesignSetup drawn(Index nodes, bool area = false, Kernel kernel = Kernel::free) {
    Model model{.grid = {nodes}, .body = {kernel}};
    if (area) {
        model.grid.rows = nodes;
        model.grid.width = model.grid.length;
    }
    return {.model = completed(model),
            .targets = {read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")},
            .max_pressure = p_max};
}

} // namespace rough::testing
