#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

const std::vector<std::string>& kernel_names(); ///< in the order of Kernel
const std::string& name_of(Kernel kernel);      ///< free, periodic or strip
/// The kernel of that name. Throws InputError that begins with `where` for another word.
Kernel kernel_named(const std::string& name, const std::string& where = "kernel");

const std::vector<std::string>& solver_names(); ///< in the order of Solver
const std::string& name_of(Solver solver);      ///< auto, nested, nnls, polonsky-keer or active-set
bool is_direct(Solver solver); ///< whether it solves to rounding, by a factor, and has no tolerance

} // namespace rough
