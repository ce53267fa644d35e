#pragma once

#include <string>
#include <vector>

namespace rough {

/// One length scale of a series: M ridges of the same wave length, each with its phase (rad).
struct Chromosome {
    int n = 1;                  ///< place in the series, >= 1; wave length lambda gamma^(1-n)
    std::vector<double> phases; ///< phi_{m,n}, rad, M >= 1 of them
};

/// One multivariate Weierstrass-Mandelbrot (MWM) series (paper, Eq. 1-3). Lengths in mm.
struct Series {
    double A = 1;       ///< amplitude, != 0; with lambda in mm, the unit that makes G_n a length in mm
    double H = 0.5;     ///< Hurst exponent, dimensionless
    double gamma = 1.5; ///< ratio of neighbouring wave numbers, > 1
    double lambda = 1;  ///< longest wave length, mm
    std::vector<Chromosome> chromosomes; ///< at least one, each n once
};

/// A rough profile: scale * sum of series. A cross-over adds the parents' series.
///
/// `scale` is the amplitude of the whole. It costs nothing to change: scaling a profile scales pressures and
/// displacements and leaves stiffness and contact sets as they are, so Eq. 11 is a change of `scale` alone.
struct Genome {
    double scale = 1;           ///< != 0
    std::vector<Series> series; ///< at least one
};

/// Checks every number. Throws InputError: nothing in it, A = 0, gamma <= 1, lambda <= 0, n < 1, n twice in a
/// series, no phase, or anything not finite; `where` begins the message.
void validate(const Genome& genome, const std::string& where);

/// The same profile with scale 1: the amplitudes carry it.
Genome folded(Genome genome);

/// The two parents' profiles added, each with its own scale. Series that differ in amplitude alone become
/// one; the order of the parents does not matter, not even to the bits.
Genome sum(const Genome& left, const Genome& right);

/// The bits of all but the scale: genomes of one key have responses that differ by the scale alone.
std::string shape_key(const Genome& genome);

/// What a gene is and where it stands.
struct GenePlace {
    /// Amplitude, Hurst exponent, frequency ratio, longest wave (mm), ridge phase (rad).
    enum class Kind { A, H, gamma, lambda, phase };
    Kind kind;                  ///< which gene
    std::size_t series = 0;     ///< index into the genome's list
    std::size_t chromosome = 0; ///< index into the series' list (phases only)
    std::size_t ridge = 0;      ///< index into the chromosome's phases (phases only)
};

/// All genes in order: for each series A, H, gamma, lambda, then the phases chromosome by chromosome.
std::vector<GenePlace> gene_places(const Genome& genome);
/// Their values in that order: A as it is given, lengths in mm, phases in rad.
std::vector<double> genes(const Genome& genome);

/// The genome with its genes replaced; `values` has as many as genes(genome).
Genome with_genes(Genome genome, const std::vector<double>& values);

} // namespace rough
