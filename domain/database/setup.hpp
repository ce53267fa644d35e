#pragma once

#include "domain/database/law.hpp"
#include "domain/response/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rough {

/// What all genomes and responses of a database have in common.
struct DatabaseSetup {
    Model model;   ///< grid, body, load steps and contact options of every response
    GenomeLaw law; ///< how the genomes are drawn
};

/// (name with unit, value) in a fixed order.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A set-up as names with units and values in 17 digits, and back. Solver and tolerance are left out: solvers
/// agree to the tolerance of their certificate. setup_from throws InputError naming `where` on a missing or
/// unreadable field.
Fields fields(const DatabaseSetup& setup);
/// The model's part alone.
Fields fields(const Model& model);
/// Undoes fields().
DatabaseSetup setup_from(const Fields& fields, const std::string& where);

/// The first difference as "nodes is 512, not 256"; empty where all of `wanted` is in `there`.
std::string difference(const Fields& there, const Fields& wanted);

} // namespace rough
