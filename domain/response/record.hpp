#pragma once

#include "domain/response/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rough {

/// (name with unit, value) in a fixed order.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A number as fields hold it: 17 digits, read back without loss.
std::string field_text(double value);

/// A set-up as names with units and values, what was left at 0 filled in. Solver and tolerance are left out:
/// solvers agree to the tolerance of their certificate.
Fields fields(const Model& model);

} // namespace rough
