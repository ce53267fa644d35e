#pragma once

#include "apps/commands/design/run.hpp"

namespace app {

/// The report of a design as a web page: what was asked and found, the surface, other answers, how far to
/// trust it, what can be made of it. Drawing takes so many seconds at most.
std::string design_page(const DesignRun& run, double seconds);

} // namespace app
