#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/response.hpp"

namespace rough {

/// How the genomes of a database are drawn: as a sum of `series` series. Each has H and gamma uniform in
/// their ranges, chromosomes n = 1 .. n_f (Eq. 4, waves down to `shortest`) and phases uniform in [0, 2 pi).
/// The first series has A = 1; A of all further series is uniform in (0, 1].
struct GenomeDistribution {
    int series = 1;           ///< >= 1
    int ridges = 1;           ///< M >= 1
    double H_from = 0.5;      ///< lowest Hurst exponent
    double H_to = 1.5;        ///< highest Hurst exponent
    double gamma_from = 1.4;  ///< lowest ratio of neighbouring wavenumbers, > 1
    double gamma_to = 2.0;    ///< highest ratio of neighbouring wavenumbers
    double lambda = 0.84942;  ///< longest wavelength, mm
    double shortest = 0.0133; ///< shortest wavelength, mm
    std::uint64_t seed = 1;   ///< genome i depends only on it and on i
};

/// Throws InputError on ranges in the wrong order, gamma <= 1, no wave between shortest and lambda, or
/// genomes of more than a million phases.
void validate(const GenomeDistribution& law);

/// The largest number of phases that a genome of the distribution can have.
double most_phases(const GenomeDistribution& law);

/// Genome number `index` of a distribution. It depends on nothing else.
Genome drawn(const GenomeDistribution& law, std::uint64_t index);

/// The set-up of all genomes and responses of a database.
struct DatabaseSetup {
    Model model;            ///< grid, body, load steps and contact options of every response
    GenomeDistribution law; ///< how the genomes are drawn
};

/// A set-up as names with units and values, the model first.
Fields fields(const DatabaseSetup& setup);
/// The inverse of fields(). Throws InputError that begins with `where` on a missing or unreadable field.
DatabaseSetup setup_from(const Fields& fields, const std::string& where);

/// The first difference as "nodes is 512, not 256"; empty if `there` has all of `wanted`.
std::string difference(const Fields& there, const Fields& wanted);

} // namespace rough
