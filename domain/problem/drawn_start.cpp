#include "domain/problem/drawn_start.hpp"

#include "domain/problem/prices.hpp"
#include "domain/problem/response.hpp"

#include <numbers>

namespace rough {
namespace {

double within(double value, double from, double to) { return std::clamp(value, from, std::max(from, to)); }

constexpr int max_harmonic = 32; ///< higher harmonics hardly change stiffness and cost genes

/// Curves of maps are expensive, and a start does not need finer load steps.
Model fitting_model(Model model) {
    const int steps = model.grid.is_2d() ? model.loading.steps : std::max(40, model.loading.steps);
    model.loading = {steps, model.loading.reach};
    return model;
}

} // namespace

void add_chromosomes(Series& series, double shortest, int ridges, ga::Stream& random) {
    const int last = last_chromosome(series.lambda, series.gamma, shortest);
    for (int n = 1; n <= last; ++n) {
        series.chromosomes.push_back({n, {}});
        for (int m = 0; m < ridges; ++m)
            series.chromosomes.back().phases.push_back(random.uniform(0, 2 * std::numbers::pi));
    }
}

std::vector<Series> harmonic_series(double length, double shortest, double H) {
    std::vector<Series> all;
    for (int k = 1; k <= max_harmonic && length / k >= shortest * (1 - 1e-12); k += 2)
        all.push_back({1, H, 2, length / k, {}});
    return all;
}

Genome in_harmonics(const Genome& genome, double length) {
    Genome moved{genome.scale, {}};
    for (const Series& series : genome.series) {
        const auto harmonic = [&](const Chromosome& one) {
            return std::max(1.0, std::round(length / wave_length(series, one.n)));
        };
        if (std::ranges::all_of(series.chromosomes, [&](const Chromosome& one) {
                const double k = length / wave_length(series, one.n);
                return std::abs(k - harmonic(one)) <= 1e-13 * k;
            })) {
            moved.series.push_back(series);
            continue;
        }
        for (const Chromosome& one : series.chromosomes) {
            const double k = harmonic(one);
            Series single{1, series.H, 2, length / k, {{1, one.phases}}};
            const std::size_t ridges = one.phases.size();
            single.A = amplitude(series, one.n, ridges) / amplitude(single, 1, ridges);
            moved.series.push_back(single);
        }
    }
    return moved;
}

Series drawn_series(const DesignSetup& setup, double H, double gamma, double lambda) {
    const GeneBounds& b = setup.bounds;
    return {1,
            within(H, b.H_from, b.H_to),
            within(gamma, b.gamma_from, b.gamma_to),
            within(lambda, std::max(b.lambda_from, setup.limits.shortest_wave), b.lambda_to),
            {}};
}

Genome drawn_start(const DesignSetup& setup, ga::Stream random) {
    Genome genome{1, {}};
    const double shortest = setup.limits.shortest_wave;
    const auto take = [&](Series series) {
        add_chromosomes(series, shortest, setup.ridges, random);
        genome.series.push_back(std::move(series));
    };
    if (setup.model.grid.periodic && !setup.model.grid.is_2d()) {
        for (Series& series : harmonic_series(setup.model.grid.length, shortest,
                                              within(random.uniform(0.5, 1.5), setup.bounds.H_from, setup.bounds.H_to)))
            take(std::move(series));
        return genome;
    }
    for (int s = 0; s < 2; ++s) {
        const double lambda = setup.model.grid.length * (s == 0 ? 1 : random.uniform(0.6, 1.6)),
                     gamma = random.uniform(1.4, 2.0), H = random.uniform(0.5, 1.5);
        Series series = drawn_series(setup, H, gamma, lambda);
        series.A = s == 0 ? 1 : std::exp(random.uniform(-1.5, 1.5));
        take(std::move(series));
    }
    return genome;
}

double fitting_price(const DesignSetup& setup) {
    return setup.max_pressure ? 0 : relative_price(fitting_model(setup.model), setup.model);
}

Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome) {
    constexpr double rounding = 1e-12; // a point beyond the curve by this share is at its end
    if (setup.max_pressure) return genome;
    const Target& target = setup.targets.front();
    const Model model = fitting_model(setup.model);
    const Response response = respond(folded(genome), model);
    const double end = target.against_pressure() ? response.pressure.tail(1)[0] : response.displacement.tail(1)[0];
    const double lowest = target.last() / end;
    double best = lowest, nearest = std::numeric_limits<double>::infinity(), ratio = std::pow(2.0, 0.5);
    const auto consider = [&](double scale) {
        const Curve curve = curve_of(target.quantity, scaled(response, scale));
        const double last = curve.to * (1 + rounding);
        double worst = 0; // points beyond the curve at this amplitude count as a misfit of 1
        for (Index k = 0; k < target.points(); ++k)
            worst = std::max(worst, target.x[k] > last ? 1 : std::abs(misfit(target, k, curve.at(target.x[k]))));
        if (worst < nearest) best = scale, nearest = worst;
    };
    for (int i = 0; i < 33; ++i) consider(lowest * std::pow(ratio, i));
    for (int round = 0; round < 12; ++round) {
        ratio = std::sqrt(ratio);
        for (const double scale : {best * ratio, best / ratio}) consider(scale);
    }
    Genome fitted = folded(genome);
    fitted.scale = best;
    return folded(fitted);
}

} // namespace rough
