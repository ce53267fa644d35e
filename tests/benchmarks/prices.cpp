// prices: the processor time of a contact curve and of its derivatives, on lines and maps, for numbers of
// nodes and of load steps: medians over three genomes. domain/problem/prices.cpp has the table that was
// measured.

#include "domain/numerics/statistics.hpp"
#include "domain/problem/problem.hpp"
#include "tests/domain/random_genome.hpp"

#include <cstdio>
#include <ctime>
#include <random>

using namespace rough;

namespace {

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds of one call of `work`, which is repeated for at least a tenth of a second.
template <class Work>
double time_of(Work work) {
    const double start = processor_seconds();
    int calls = 0;
    do {
        work();
        ++calls;
    } while (processor_seconds() < start + 0.1);
    return (processor_seconds() - start) / calls;
}

void print_row(bool is_map, Index nodes, int steps) {
    std::mt19937_64 random(3);
    std::vector<double> curves, gradients;
    for (int genome = 0; genome < 3; ++genome) {
        Model model{.grid = {.nodes = nodes}, .loading = {.steps = steps}};
        if (is_map) model.grid.rows = nodes, model.grid.width = model.grid.length;
        const DesignSetup setup{.model = completed(model),
                                .targets = {read_target(RUGOSA_SOURCE "/experiments/targets/drawn.csv")},
                                .max_pressure = 1.6e-4};
        const Genome surface =
            rough::testing::random_genome(random, 2, is_map ? 8 : 1, setup.model.grid.length,
                                          std::max(is_map ? 0.05 : 0.0133, 8 * setup.model.grid.spacing()));
        const DesignProblem problem(setup);
        curves.push_back(time_of([&] { problem.evaluate(surface); }));
        gradients.push_back(time_of([&] { problem.sensitivity(surface, "similarity"); }));
    }
    std::printf("%s %ld nodes %d steps: curve %.3g ms, gradient %.2f curves\n", is_map ? "map" : "line",
                static_cast<long>(nodes), steps, 1e3 * median(curves), median(gradients) / median(curves));
}

} // namespace

int main() {
    for (const int steps : {5, 20, 80}) {
        for (Index nodes = 128; nodes <= 16384; nodes *= 2) print_row(false, nodes, steps);
        for (Index side = 16; side <= 512 / (steps / 20 + 1); side *= 2) print_row(true, side, steps);
    }
}
