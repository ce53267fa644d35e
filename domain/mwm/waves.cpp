#include "domain/mwm/waves.hpp"

#include "domain/errors.hpp"

#include <complex>
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
        refuse("shortest wave ", shortest, " mm, gamma ", gamma, "; use a length above 0 and a gamma above 1");
    int n = 0; // counted, as a floor of log_gamma loses the last chromosome of an exact power
    while (lambda * std::pow(gamma, -n) >= shortest * (1 - 1e-12)) ++n;
    return n;
}

std::vector<LengthScale> length_scales(const Genome& genome) {
    std::vector<LengthScale> scales;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c) {
            const double k = wave_number(genome.series[s], genome.series[s].chromosomes[c].n);
            auto known = std::ranges::find_if(
                scales, [&](const LengthScale& scale) { return std::abs(scale.wave_number - k) <= 1e-12 * k; });
            if (known == scales.end()) known = scales.insert(scales.end(), LengthScale{k, {}});
            known->members.emplace_back(s, c);
        }
    return scales;
}

Genome only(const Genome& genome, const LengthScale& scale) {
    return filtered(
        genome, [&](std::size_t s, std::size_t c) { return std::ranges::count(scale.members, std::pair(s, c)) > 0; });
}

std::vector<SpectralLine> discrete_spectrum(const Genome& genome) {
    std::vector<Wave> all = waves(genome);
    std::sort(all.begin(), all.end(), [](const Wave& a, const Wave& b) { return a.wave_number < b.wave_number; });
    std::vector<SpectralLine> lines;
    for (auto wave = all.begin(); wave != all.end();) {
        const double k = wave->wave_number;
        std::complex<double> sum = 0;
        for (; wave != all.end() && wave->wave_number <= k * (1 + 1e-12); ++wave)
            sum += std::polar(1.0, wave->phase) * wave->amplitude;
        lines.push_back({k, std::norm(sum) / 2});
    }
    return lines;
}

} // namespace rough
