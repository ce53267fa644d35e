#pragma once

#include "domain/mwm/genome.hpp"

namespace rough {

/// One cosine of a profile: offset - amplitude cos(wave_number x + phase).
struct Wave {
    double amplitude;   ///< G_n R_n, mm, of the sign of A
    double wave_number; ///< k_n, 1/mm
    double phase;       ///< theta, rad
    double offset;      ///< G_n g1, mm
};

/// M ridges of one wavenumber as one cosine: sum_m [cos phi_m - cos(k x + phi_m)] = g1 - R cos(k x + theta).
/// Paper, Eq. 5-10; theta by atan2, as Eq. 8's arccos loses the sign of g2.
struct Ridge {
    double g1;    ///< sum of cos phi
    double R;     ///< hypot(g1, g2), g2 = sum of sin phi
    double theta; ///< atan2(g2, g1), rad
};
/// Collapses one chromosome's phases (rad).
Ridge collapsed(const std::vector<double>& phases);

double wave_length(const Series& series, int n); ///< lambda_n = lambda gamma^(1-n), mm
double wave_number(const Series& series, int n); ///< k_n = (2 pi/lambda) gamma^(n-1), 1/mm (Eq. 3)
/// G_n = A sqrt(log10(gamma)/M) (2 pi/lambda)^(-H) gamma^(-(n-1)H), mm (Eq. 2)
double amplitude(const Series& series, int n, std::size_t ridges);

/// The wave of one chromosome of the series, without the genome's scale.
Wave wave(const Series& series, const Chromosome& chromosome);

/// All waves of a genome, scale included: one for each chromosome of each series, in order.
std::vector<Wave> waves(const Genome& genome);

/// The shortest wavelength of a genome, mm.
double shortest_wave(const Genome& genome);

/// n_f of Eq. 4: the largest n whose wavelength is at least `shortest` (mm); 0 if even the first is
/// shorter. A guard of 1e-12 keeps the last chromosome of an exact power. Throws InputError on `shortest`
/// of 0 and gamma of 1, which have no last one.
int last_chromosome(double lambda, double gamma, double shortest);

/// The genome with only the chromosomes that are kept; empty series are removed.
/// `keep` is called with the index of the series and that of the chromosome.
template <class Keep>
Genome filtered(const Genome& genome, Keep keep) {
    Genome result{genome.scale, {}};
    for (std::size_t s = 0; s < genome.series.size(); ++s) {
        Series series = genome.series[s];
        series.chromosomes.clear();
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c)
            if (keep(s, c))
                series.chromosomes.push_back(genome.series[s].chromosomes[c]);
        if (!series.chromosomes.empty())
            result.series.push_back(series);
    }
    return result;
}

/// Chromosomes of one wavenumber, of any series: one length scale of the profile.
struct LengthScale {
    double wave_number;                                       ///< rad/mm
    std::vector<std::pair<std::size_t, std::size_t>> members; ///< series, chromosome
};

/// All length scales of a genome, each once.
std::vector<LengthScale> length_scales(const Genome& genome);

/// The genome with only this length scale.
Genome only(const Genome& genome, const LengthScale& scale);

/// One cosine of a profile, as power: half its squared amplitude.
struct SpectralLine {
    double wave_number; ///< k, rad/mm
    double power;       ///< a^2/2, mm^2
};

/// The discrete power spectrum of a cosine series, exact: one line for each wavenumber, in increasing
/// order. Waves of equal wavenumber (from several series) are added with their phases. The sum of the
/// powers is the mean square height over a length that all wavelengths divide.
std::vector<SpectralLine> discrete_spectrum(const Genome& genome);

} // namespace rough
