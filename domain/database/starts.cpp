#include "domain/database/starts.hpp"

#include "domain/database/screen.hpp"

namespace rough {

std::vector<Genome> stored_starts(const GenomeStore& store, const DesignSetup& setup, std::size_t count,
                                  int threads) {
    expect_model(store, setup.model);
    const ScreenOptions options{setup.max_pressure.value_or(0), count, threads};
    std::vector<Genome> genomes;
    for (const Match& match :
         screen(store.curves(need_fractions(setup.targets)), setup.model, setup.targets, options)) {
        Genome genome = store.genome(match.index);
        genome.scale *= match.scale;
        genomes.push_back(folded(std::move(genome)));
    }
    return genomes;
}

} // namespace rough
