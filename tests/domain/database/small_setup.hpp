#pragma once

#include "domain/database/build.hpp"

namespace rough::testing {

/// A set-up whose genomes are solved very quickly.
inline DatabaseSetup small_setup() {
    DatabaseSetup setup;
    setup.model.grid.nodes = 64;
    setup.model.loading.steps = 8;
    setup.law.series = 2;
    setup.law.shortest = 0.1;
    return setup;
}

/// The same for maps of 16 x 12 nodes.
inline DatabaseSetup small_map_setup() {
    DatabaseSetup setup = small_setup();
    Grid& grid = setup.model.grid;
    grid.nodes = 16, grid.rows = 12, grid.width = 0.75 * grid.length;
    setup.model.body.datum.reset();
    setup.law.ridges = 3;
    return setup;
}

/// A database built with these options.
inline GenomeStore built(const std::filesystem::path& file, const BuildOptions& options,
                         const DatabaseSetup& setup = small_setup()) {
    GenomeStore store = GenomeStore::create(file, setup);
    build(store, options);
    return store;
}

/// Reads everything from a database.
inline void read_all(const std::filesystem::path& file) {
    const GenomeStore store = GenomeStore::open(file);
    store.curves(true);
    for (const Span& span : store.batches()) store.responses(span);
}

} // namespace rough::testing
