#pragma once

#include "domain/response/model.hpp"

#include <string>
#include <utility>
#include <vector>

namespace rough {

/// Pairs of name with unit and value, in a fixed order.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// A number with 17 digits, which reads back exactly.
std::string field_text(double value);

/// A completed model as fields. Solver and tolerance are left out, because solvers agree to the tolerance of
/// their certificate.
Fields fields(const Model& model);

} // namespace rough
