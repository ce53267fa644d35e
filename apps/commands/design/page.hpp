#pragma once

#include "apps/commands/design/run.hpp"

namespace app {

/// The report of a design as a web page: what was asked and found, the surface, other answers, how far to
/// trust it, what can be made of it. Throws rough::InputError when gnuplot is missing.
std::string design_page(const DesignRun& run);

} // namespace app
