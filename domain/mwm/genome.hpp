#pragma once

#include "ga/base/random.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace rough {

/// One length scale of a series: M ridges of the same wavelength, each with a phase.
struct Chromosome {
    int n = 1;                  ///< place in the series, >= 1; the wavelength is lambda gamma^(1-n)
    std::vector<double> phases; ///< phases phi_{m,n} of the ridges m = 1..M, M >= 1, rad
};

/// One multivariate Weierstrass-Mandelbrot (MWM) series (paper, Eq. 1-3). Lengths in mm.
struct Series {
    /// Amplitude, not 0, in the unit that makes G_n (Eq. 2, waves.hpp) a length in mm if lambda is in mm.
    double A = 1;
    double H = 0.5;                      ///< Hurst exponent, dimensionless
    double gamma = 1.5;                  ///< ratio of neighbouring wavenumbers, > 1
    double lambda = 1;                   ///< longest wavelength, mm
    std::vector<Chromosome> chromosomes; ///< at least one; no two have the same n
};

/// A rough surface: `scale` times the sum of its series. A positive factor on the scale needs no new contact
/// solution: pressures and displacements scale, stiffness and contact sets stay. So Eq. 11 changes only it.
struct Genome {
    double scale = 1;           ///< factor on all heights, not 0
    std::vector<Series> series; ///< at least one series
};

/// Checks every number. Throws InputError that begins with `where` on an empty genome or series, a chromosome
/// without phases, or an n that a series has twice. Also throws it on scale = 0, A = 0, gamma <= 1, lambda <=
/// 0, n < 1, and numbers that are not finite.
void validate(const Genome& genome, const std::string& where);

Genome folded(Genome genome); ///< the surface with scale 1; each A is multiplied by the scale

/// The sum of the two parents' surfaces, with scale 1. Series that differ only in amplitude become one, and
/// series whose amplitudes cancel are removed. The parents' order does not affect any bit.
Genome sum(const Genome& left, const Genome& right);

/// A key of a genome's shape: the bits of all numbers except the scale. The responses of genomes with equal
/// keys and scales of equal sign differ only by the scale.
std::string shape_key(const Genome& genome);

/// Kind and place of a gene.
struct GenePlace {
    /// Amplitude, Hurst exponent, frequency ratio, longest wavelength (mm), phase of a ridge (rad).
    enum class Kind { A, H, gamma, lambda, phase };
    Kind kind;                  ///< kind of the gene
    std::size_t series = 0;     ///< index of the series in the genome
    std::size_t chromosome = 0; ///< index of the chromosome in the series (only for phases)
    std::size_t ridge = 0;      ///< index of the phase in the chromosome (only for phases)
};

/// All genes in order: for each series A, H, gamma, lambda, then the phases chromosome by chromosome.
std::vector<GenePlace> gene_places(const Genome& genome);
/// The values of all genes in that order: A as it is given, lengths in mm, phases in rad.
std::vector<double> genes(const Genome& genome);

/// The genome with its genes replaced; `values` has as many as genes(genome).
Genome with_genes(Genome genome, const std::vector<double>& values);

/// Cross-over of length scales. Orders the chromosomes of each genome from the longest wavelength to the shortest. Cuts
/// both lists at the same random places, `cuts` or as many as fit, and exchanges every second piece. A chromosome keeps
/// its series' genes; A is multiplied by the genome's scale, which becomes 1. Afterwards, chromosomes with equal series
/// genes form one series if their n differ. Each genome keeps its number of chromosomes.
void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream);

/// Orders the chromosomes as cross_points does. At each position of the shorter list, exchanges the two
/// chromosomes with probability 1/2. Scales and series change as in cross_points.
void cross_uniform(Genome& a, Genome& b, ga::Stream& stream);

/// A genome as JSON, lengths in mm; the amplitudes A are multiplied by the scale. An example is
/// {"series":[{"A":1,"H":0.8,"gamma":1.5,"lambda":0.84942,"chromosomes":[{"n":1,"phases":[0.3]}]}]}.
nlohmann::json genome_to_json(const Genome& genome);

/// The genome in such JSON. Throws InputError that begins with `where` on a wrong key or value.
Genome genome_from_json(const nlohmann::json& json, const std::string& where);

constexpr double standard_length = 0.84942; ///< the default length of a profile, mm (the paper's)

/// The content of a genome file. The file has the JSON of genome_to_json(), and "length_mm" next to "series".
struct GenomeFile {
    Genome genome;                   ///< genome of valid numbers
    double length = standard_length; ///< length of the profile that the genome was made for, mm, > 0
};

/// Reads and validates a genome file of at most 16 MB. Throws InputError that begins with the file's name.
GenomeFile read_genome_file(const std::filesystem::path& file);
Genome read_genome(const std::filesystem::path& file); ///< reads only the genome

/// The text of a genome file. If `length` is standard_length, "length_mm" is omitted.
std::string genome_file_text(const Genome& genome, double length);

} // namespace rough
