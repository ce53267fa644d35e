#pragma once

#include "domain/database/law.hpp"
#include "domain/response/record.hpp"

namespace rough {

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
