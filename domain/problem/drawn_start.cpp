#include "domain/problem/drawn_start.hpp"

#include "domain/problem/harmonics.hpp"
#include "domain/problem/response.hpp"
#include "domain/target/similarity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rough {

namespace {

double within(double value, double from, double to) { return std::clamp(value, from, std::max(from, to)); }

} // namespace

Series drawn_series(const DesignSetup& setup, double H, double gamma, double lambda) {
    const GeneBounds& b = setup.bounds;
    Series series{1,
                  within(H, b.H_from, b.H_to),
                  within(gamma, b.gamma_from, b.gamma_to),
                  within(lambda, std::max(b.lambda_from, setup.limits.shortest_wave), b.lambda_to),
                  {}};
    return series;
}

Genome drawn_start(const DesignSetup& given, ga::Stream random) {
    const DesignSetup setup = completed(given);
    Genome genome{1, {}};
    const double shortest = setup.limits.shortest_wave;
    const auto with_chromosomes = [&](Series series) {
        for (int n = 1; n <= last_chromosome(series.lambda, series.gamma, shortest); ++n) {
            Chromosome chromosome{n, {}};
            for (int m = 0; m < setup.ridges; ++m)
                chromosome.phases.push_back(random.uniform(0, 2 * std::numbers::pi));
            series.chromosomes.push_back(std::move(chromosome));
        }
        genome.series.push_back(std::move(series));
    };
    if (setup.model.grid.periodic && !setup.model.grid.is_2d()) {
        for (Series& series :
             harmonic_series(setup.model.grid.length, shortest,
                             within(random.uniform(0.5, 1.5), setup.bounds.H_from, setup.bounds.H_to)))
            with_chromosomes(std::move(series));
        return genome;
    }
    for (int s = 0; s < 2; ++s) {
        Series series = drawn_series(setup, random.uniform(0.5, 1.5), random.uniform(1.4, 2.0),
                                     setup.model.grid.length * (s == 0 ? 1 : random.uniform(0.6, 1.6)));
        series.A = s == 0 ? 1 : std::exp(random.uniform(-1.5, 1.5));
        with_chromosomes(std::move(series));
    }
    return genome;
}

Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome) {
    if (setup.max_pressure)
        return genome;
    const Target& target = setup.targets.front();
    Model model = setup.model;
    // A start need not be read so finely where a curve costs much.
    const int steps = model.grid.is_2d() ? model.loading.steps : std::max(40, model.loading.steps);
    model.loading = {steps, model.loading.reach};
    const Response response = respond(folded(genome), model);
    const double own =
        target.against_pressure() ? response.pressure.tail(1)[0] : response.displacement.tail(1)[0];
    // Misfit over the part of the target that this amplitude covers; what it does not counts as missed
    // wholly.
    const auto misfit_at = [&](double scale) {
        const Curve curve = curve_of(target.quantity, scaled(response, scale));
        double worst = 0;
        for (Index k = 0; k < target.points(); ++k)
            worst = std::max(worst,
                             target.x[k] > curve.to ? 1 : std::abs(misfit(target, k, curve.at(target.x[k]))));
        return worst;
    };
    const double least = target.last() / own;
    double best = least, nearest = std::numeric_limits<double>::infinity(), ratio = std::pow(2.0, 0.5);
    for (int i = 0; i < 33; ++i) {
        const double scale = least * std::pow(ratio, i);
        if (const double here = misfit_at(scale); here < nearest)
            best = scale, nearest = here;
    }
    for (int round = 0; round < 12; ++round) {
        ratio = std::sqrt(ratio);
        for (const double scale : {best * ratio, best / ratio})
            if (const double here = misfit_at(scale); here < nearest)
                best = scale, nearest = here;
    }
    Genome fitted = folded(genome);
    fitted.scale = best;
    return folded(fitted);
}

} // namespace rough
