#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

const std::vector<std::string>& kernel_names(); ///< in the order of Kernel
/// free, periodic or strip
const std::string& name_of(Kernel kernel);
/// The kernel of that name. Throws InputError that begins with `where` for another word.
Kernel kernel_named(const std::string& name, const std::string& where = "kernel");

const std::vector<std::string>& solver_names(); ///< in the order of Solver
/// auto, nested, nnls, polonsky-keer or active-set
const std::string& name_of(Solver solver);
/// Whether a solver solves to rounding, by a factor, and has no tolerance.
bool is_direct(Solver solver);

} // namespace rough
