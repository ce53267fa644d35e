#pragma once

#include "domain/mwm/genome.hpp"

namespace rough {

/// One cosine of a profile: offset - amplitude cos(wave_number x + phase).
struct Wave {
    double amplitude;   ///< G_n R_n, mm; negative if A is negative
    double wave_number; ///< k_n, 1/mm
    double phase;       ///< theta, rad
    double offset;      ///< G_n g1, mm
};

/// M ridges of one wavenumber as one cosine: sum_m [cos phi_m - cos(k x + phi_m)] = g1 - R cos(k x + theta).
/// Source: Eq. 5-10 of the paper. theta is computed by atan2, because arccos in Eq. 8 loses the sign of g2.
struct Ridge {
    double g1;    ///< sum of cos phi_m
    double R;     ///< hypot(g1, g2), where g2 is the sum of sin phi_m
    double theta; ///< atan2(g2, g1), rad
};
Ridge collapsed(const std::vector<double>& phases); ///< cosine of one chromosome's ridges; phases in rad

double wave_length(const Series& series, int n); ///< wavelength lambda_n = lambda gamma^(1-n), mm
double wave_number(const Series& series, int n); ///< wavenumber k_n = (2 pi/lambda) gamma^(n-1), 1/mm (Eq. 3)
/// Amplitude G_n = A sqrt(log10(gamma)/M) (2 pi/lambda)^(-H) gamma^(-(n-1)H), mm (Eq. 2); M is `ridges`.
double amplitude(const Series& series, int n, std::size_t ridges);

/// The wave of one chromosome of the series, without the genome's scale.
Wave wave(const Series& series, const Chromosome& chromosome);

/// All waves of a genome, scale included: one for each chromosome of each series, in order.
std::vector<Wave> waves(const Genome& genome);

double shortest_wave(const Genome& genome); ///< the shortest wavelength of a genome, mm

/// The number n_f of Eq. 4: the largest n whose wavelength is at least `shortest` (mm). It is 0 if even the
/// first wavelength is shorter. A margin of 1e-12 keeps the last chromosome if its wavelength equals
/// `shortest`. Throws InputError if all n fulfil the condition: on `shortest` of 0 and on gamma of 1.
int last_chromosome(double lambda, double gamma, double shortest);

/// The genome with only the chromosomes for which `keep` is true; empty series are removed. `keep` is called
/// with the index of the series and the index of the chromosome.
template <class Keep>
Genome filtered(const Genome& genome, Keep keep) {
    Genome result{genome.scale, {}};
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        Series series = genome.series[s];
        series.chromosomes.clear();
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c)
            if (keep(s, c)) series.chromosomes.push_back(genome.series[s].chromosomes[c]);
        if (!series.chromosomes.empty()) result.series.push_back(series);
    }
    return result;
}

/// Chromosomes of one wavenumber, of any series: one length scale of the profile.
struct LengthScale {
    double wave_number; ///< wavenumber, rad/mm
    /// Indices of the series and of the chromosome in it, for each chromosome.
    std::vector<std::pair<std::size_t, std::size_t>> members;
};

std::vector<LengthScale> length_scales(const Genome& genome); ///< all length scales, without duplicates

Genome only(const Genome& genome, const LengthScale& scale); ///< the genome with only this length scale

/// One cosine of a profile, as power: half its squared amplitude.
struct SpectralLine {
    double wave_number; ///< wavenumber k, rad/mm
    double power;       ///< a^2/2 for the amplitude a, mm^2
};

/// The discrete power spectrum of a genome's profile, exact: one line for each wavenumber, in increasing
/// order. Waves of equal wavenumber (from several series) are added with their phases. Over a length that all
/// wavelengths divide, the mean square height is the sum of the powers.
std::vector<SpectralLine> discrete_spectrum(const Genome& genome);

} // namespace rough
