#pragma once

#include "domain/database/setup.hpp"

namespace rough::testing {

/// Of genomes that are solved in no time.
inline DatabaseSetup small_setup() {
    DatabaseSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.loading.steps = 8;
    setup.law.series = 2;
    setup.law.shortest = 0.1;
    return setup;
}

} // namespace rough::testing
