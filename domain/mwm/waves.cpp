#include "domain/mwm/waves.hpp"

#include "domain/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace rough {

using std::numbers::pi;

Ridge collapsed(const std::vector<double>& phases) {
    double g1 = 0, g2 = 0; // Eq. 6
    for (double phase : phases) {
        g1 += std::cos(phase);
        g2 += std::sin(phase);
    }
    return {g1, std::hypot(g1, g2), std::atan2(g2, g1)}; // Eq. 7, 8
}

double wave_length(const Series& series, int n) { return series.lambda * std::pow(series.gamma, 1 - n); }

double wave_number(const Series& series, int n) {
    return 2 * pi / series.lambda * std::pow(series.gamma, n - 1); // Eq. 3
}

double amplitude(const Series& series, int n, std::size_t ridges) {
    return series.A * std::sqrt(std::log10(series.gamma) / static_cast<double>(ridges)) *
           std::pow(2 * pi / series.lambda, -series.H) * std::pow(series.gamma, -(n - 1) * series.H); // Eq. 2
}

Wave wave(const Series& series, const Chromosome& chromosome) {
    const double G = amplitude(series, chromosome.n, chromosome.phases.size());
    const Ridge ridge = collapsed(chromosome.phases);
    return {G * ridge.R, wave_number(series, chromosome.n), ridge.theta, G * ridge.g1};
}

std::vector<Wave> waves(const Genome& genome) {
    std::vector<Wave> result;
    for (const auto& series : genome.series)
        for (const auto& chromosome : series.chromosomes) {
            Wave one = wave(series, chromosome);
            one.amplitude *= genome.scale;
            one.offset *= genome.scale;
            result.push_back(one);
        }
    return result;
}

double shortest_wave(const Genome& genome) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Series& series : genome.series)
        for (const Chromosome& chromosome : series.chromosomes)
            shortest = std::min(shortest, wave_length(series, chromosome.n));
    return shortest;
}

int last_chromosome(double lambda, double gamma, double shortest) {
    if (!(shortest > 0 && gamma > 1))
        throw InputError("shortest wave: expected above 0, of series whose gamma is above 1");
    int n = 0; // counted, as a floor of log_gamma loses the last chromosome of an exact power
    while (lambda * std::pow(gamma, -n) >= shortest * (1 - 1e-12))
        ++n;
    return n;
}

} // namespace rough
