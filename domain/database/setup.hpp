#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/model.hpp"

#include <cstdint>

namespace rough {

/// How the genomes of a database are drawn: the sum of `series` series, each with H and gamma uniform in
/// their ranges, chromosomes n = 1 .. n_f (Eq. 4, waves down to `shortest`) and phases uniform in [0, 2 pi).
/// The first series has A = 1; the others' A is uniform in (0, 1].
struct GenomeDistribution {
    int series = 1;           ///< >= 1
    int ridges = 1;           ///< M >= 1
    double H_from = 0.5;      ///< least Hurst exponent
    double H_to = 1.5;        ///< greatest Hurst exponent
    double gamma_from = 1.4;  ///< least ratio of neighbouring wave numbers, > 1
    double gamma_to = 2.0;    ///< greatest ratio of neighbouring wave numbers
    double lambda = 0.84942;  ///< longest wave length, mm
    double shortest = 0.0133; ///< shortest wave length, mm
    std::uint64_t seed = 1;   ///< genome i depends on it and on i alone
};

/// Throws InputError on ranges in the wrong order, gamma <= 1, no wave between shortest and lambda, or
/// genomes of more than a million phases.
void validate(const GenomeDistribution& law);

/// The most phases that a genome of the law can have.
double most_phases(const GenomeDistribution& law);

/// Genome number `index` of a law: it depends on nothing else.
Genome drawn(const GenomeDistribution& law, std::uint64_t index);

/// What all genomes and responses of a database have in common.
struct DatabaseSetup {
    Model model;            ///< grid, body, load steps and contact options of every response
    GenomeDistribution law; ///< how the genomes are drawn
};

/// A set-up, its model's part first, as names with units and values, and back. setup_from throws InputError
/// naming `where` on a missing or unreadable field.
Fields fields(const DatabaseSetup& setup);
/// Undoes fields().
DatabaseSetup setup_from(const Fields& fields, const std::string& where);

/// The first difference as "nodes is 512, not 256"; empty where all of `wanted` is in `there`.
std::string difference(const Fields& there, const Fields& wanted);

} // namespace rough
