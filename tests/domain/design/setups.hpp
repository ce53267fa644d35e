#pragma once

#include "domain/problem/setup.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>

/// Genomes and set-ups of the tests of designs.
namespace rough::testing {

inline Genome two_waves(double first = 0.3, double second = 1, double scale = 0.01) {
    return {scale, {{1, 0.8, 1.5, two_mm, {{1, {first}}, {2, {second}}}}}};
}

/// The stiffness of the genome's profile on 65 nodes as target, up to a part of the pressure that it reaches.
inline DesignSetup like_itself(const Genome& genome, double part = 1, Kernel kernel = Kernel::free) {
    DesignSetup setup;
    setup.model.grid = {65, two_mm};
    setup.model.body.kernel = kernel;
    setup.model = completed(setup.model);
    const Profile profile = sample(genome, setup.model.grid);
    const double last = secant_stiffness(respond(profile, setup.model)).to;
    setup.targets = {target_like(profile, setup.model, "itself", Quantity::stiffness, 10, part * last)};
    return setup;
}

/// The drawn target on a line with these nodes, or on a map with these along either side.
inline DesignSetup drawn(Index nodes, bool area = false) {
    DesignSetup setup;
    setup.model.grid.nodes = nodes;
    if (area) {
        setup.model.grid.rows = nodes;
        setup.model.grid.width = setup.model.grid.length;
    }
    setup.targets = {read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")};
    setup.max_pressure = p_max;
    return completed(setup);
}

} // namespace rough::testing
