#pragma once

#include "domain/problem/judgement.hpp"
#include "domain/problem/pipeline.hpp"

namespace rough {

/// What coarser grids found for an area.
struct CoarseToFine {
    std::vector<Genome> starts; ///< for the set-up's own grid
    ga::Counters counters;      ///< what was spent
    std::string pipeline;       ///< as it was run, a line each grid
};

/// The set-up on grids of half the nodes a side, and half of that, coarsest first, down to 32 nodes: those on
/// which its shortest wave can still be told. A contact curve costs as many times less.
std::vector<DesignSetup> coarser_grids(const DesignSetup& setup);

/// Searches the coarsest grid by genomes made for the target, refines what it found on each finer one. `run`
/// has seed, threads and budget. Without a coarser grid the genomes are searched on the set-up's own.
CoarseToFine coarse_to_fine(const DesignSetup& setup, const ga::RunOptions& run,
                            const std::vector<ga::Observer<Genome>>& observers);

/// The way to go on from there on the set-up's own grid.
extern const char* const on_own_grid;

/// The set-up whose targets are moved by what a judged answer's curve changes on finer grids and in finer
/// steps: to meet them on the set-up's own grid is to miss the given ones by as much on the one side as on
/// the other.
DesignSetup allowing_for(DesignSetup setup, const Judgement& judged);

/// What two runs spent together.
ga::Counters sum(const ga::Counters& a, const ga::Counters& b);

} // namespace rough
