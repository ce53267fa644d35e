#include "domain/problem/harmonics.hpp"

#include "domain/mwm/waves.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Higher ones hardly move stiffness and cost genes.
constexpr int highest = 32;

double nearest_harmonic(double length, double wave) { return std::max(1.0, std::round(length / wave)); }

bool is_harmonic(double length, double wave) {
    const double k = length / wave;
    return std::abs(k - nearest_harmonic(length, wave)) <= 1e-13 * k;
}

} // namespace

std::vector<Series> harmonic_series(double length, double shortest, double H) {
    std::vector<Series> all;
    for (int k = 1; k <= highest && length / k >= shortest * (1 - 1e-12); k += 2)
        all.push_back({1, H, 2, length / k, {}});
    return all;
}

Genome in_harmonics(const Genome& genome, double length) {
    Genome moved{genome.scale, {}};
    for (const Series& series : genome.series) {
        if (std::all_of(series.chromosomes.begin(), series.chromosomes.end(), [&](const Chromosome& one) {
                return is_harmonic(length, wave_length(series, one.n));
            })) {
            moved.series.push_back(series);
            continue;
        }
        for (const Chromosome& one : series.chromosomes) {
            const double k = nearest_harmonic(length, wave_length(series, one.n));
            Series own{1, series.H, 2, length / k, {{1, one.phases}}};
            const std::size_t ridges = one.phases.size();
            own.A = amplitude(series, one.n, ridges) / amplitude(own, 1, ridges);
            moved.series.push_back(own);
        }
    }
    return moved;
}

} // namespace rough
