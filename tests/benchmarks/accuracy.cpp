// Coverage and saving of `respond_within` on random scenes of the paper's law.
//
//   benchmark_accuracy [scenes [kernel 0-2 [first seed [shortest wave, parts of L]]]]
//   benchmark_accuracy little    (only the cost of a smooth scene against that of rough ones)
#include "domain/mwm/response.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/response/curve.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/domain/random_genome.hpp"

#include <cstdio>
#include <cstdlib>

using namespace rough;

namespace {

ReportedResponse within_accuracy(double accuracy, const Genome& genome, Model model) {
    model.accuracy = accuracy;
    return respond_within(genome, model);
}

/// The paper's genomes with waves down to the node spacing at its 512 nodes. Prints the saving of an
/// accuracy, and the error of half the nodes.
void print_own_waves() {
    Model model, half;
    half.grid.nodes = 257;
    std::vector<double> saving, off;
    for (const Genome& genome : sobol_database({.shortest = model.grid.spacing()})) {
        const std::clock_t start = std::clock();
        for (int round = 0; round < 5; ++round)
            respond_within(genome, model);
        const std::clock_t middle = std::clock();
        for (int round = 0; round < 5; ++round)
            within_accuracy(1e-2, genome, model);
        saving.push_back(static_cast<double>(middle - start) / static_cast<double>(std::clock() - middle));
        const Curve curve = secant_stiffness(respond(genome, model));
        const Curve coarse = secant_stiffness(respond(genome, half));
        const Curve stretched_coarse = stretched(coarse, curve.to / coarse.to);
        double worst = 0;
        for (int k = 1; k <= 20; ++k) {
            const double pressure = curve.to * k / 20;
            worst = std::max(worst, std::abs(stretched_coarse.at(pressure) / curve.at(pressure) - 1));
        }
        off.push_back(worst);
    }
    std::printf("the paper's database at 512 nodes within 1e-2: saving median %.2f; K at 257 nodes is off by "
                "%.1f %% in the median, at most %.1f %%\n",
                quantile(saving, 0.5), 100 * quantile(off, 0.5), 100 * quantile(off, 1));
}

/// A cheap scene, one smooth wave at light load, and rough ones that need the resolved model.
void print_least_scene(Model model, unsigned seed, double parts) {
    const double length = model.grid.length;
    const bool periodic = model.body.kernel == Kernel::periodic;
    const Genome smooth{1, {{1, 1, 1.5, length, {{1, {0.3}}}}}};
    const auto milliseconds = [](const auto& ask) { return 1e3 * testing::least_seconds(ask, 5); };
    std::vector<double> all;
    for (unsigned scene = 0; scene < 9; ++scene) {
        std::mt19937_64 random(seed + scene);
        const Genome rough = testing::random_genome(random, 1, 1, length, length / parts);
        model.grid = resolved_grid(rough, length, periodic);
        all.push_back(milliseconds([&] { respond_within(rough, model); }));
    }
    const double everything = quantile(all, 0.5), least = quantile(all, 0);
    model.grid = resolved_grid(smooth, length, periodic);
    model.loading.reach = 0.1;
    const double little = milliseconds([&] { within_accuracy(1e-2, smooth, model); });
    std::printf(
        "one smooth wave, light load, accuracy 1e-2: %.2f ms; nine rough scenes resolved: %.1f ms in the "
        "median, %.0f times as much (%.0f at least)\n",
        little, everything, everything / little, least / little);
}

} // namespace

int main(int count, char** words) {
    const auto word = [&](int i, double fallback) { return count > i ? std::atof(words[i]) : fallback; };
    const int scenes = static_cast<int>(word(1, 100));
    const auto first_seed = static_cast<unsigned>(word(3, 1));
    const double length = 0.84942, parts = word(4, 64);
    Model model;
    model.body.kernel = static_cast<Kernel>(static_cast<int>(word(2, 0)));
    model.body.strip_width = length / 511;
    const bool periodic = model.body.kernel == Kernel::periodic;
    model.loading.reach = periodic ? 0.95 : 1;
    if (count > 1 && std::string_view(words[1]) == "little")
        return print_least_scene(model, first_seed, parts), 0;
    for (const double accuracy : {1e-2, 1e-3, 1e-4}) {
        std::vector<double> saving, true_error, seconds, exact_seconds;
        int covered = 0, within = 0, cheaper = 0;
        double worst = 0, worst_ratio = 0;
        for (int scene = 0; scene < scenes; ++scene) {
            std::mt19937_64 random(first_seed + static_cast<unsigned>(scene));
            const Genome genome = testing::random_genome(random, 1, 1, length, length / parts);
            model.grid = resolved_grid(genome, length, periodic);
            // Processor time: other programs' load does not count.
            const std::clock_t start = std::clock();
            const ReportedResponse exact = respond_within(genome, model);
            const std::clock_t middle = std::clock();
            const ReportedResponse cheap = within_accuracy(accuracy, genome, model);
            const std::clock_t end = std::clock();
            const double resolved_ms = 1e3 * static_cast<double>(middle - start) / CLOCKS_PER_SEC;
            const double cheap_ms = 1e3 * static_cast<double>(end - middle) / CLOCKS_PER_SEC;
            const double error = relative_error(cheap.response.pressure, exact.response.pressure);
            const double estimate = cheap.account.estimated_error;
            covered += error <= estimate + exact.account.estimated_error;
            within += error <= accuracy;
            cheaper += cheap.account.extrapolated();
            worst = std::max(worst, error / accuracy);
            if (cheap.account.extrapolated())
                worst_ratio = std::max(worst_ratio, error / estimate);
            saving.push_back(resolved_ms / cheap_ms);
            seconds.push_back(cheap_ms);
            exact_seconds.push_back(resolved_ms);
            true_error.push_back(error);
        }
        std::printf(
            "accuracy %.0e: estimate covers %.1f %%, within %.1f %%, worst error %.2f of the accuracy, "
            "%.2f of the estimate; by coarser grids %.0f %%; error median %.1e; resolved %.1f ms, cheap "
            "%.2f ms; saving median %.1f, tenth percentile %.2f\n",
            accuracy, 100.0 * covered / scenes, 100.0 * within / scenes, worst, worst_ratio,
            100.0 * cheaper / scenes, quantile(true_error, 0.5), quantile(exact_seconds, 0.5),
            quantile(seconds, 0.5), quantile(saving, 0.5), quantile(saving, 0.1));
    }
    print_least_scene(model, first_seed, parts);
    print_own_waves();
}
