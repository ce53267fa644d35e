#pragma once

#include "apps/report/html.hpp"
#include "apps/report/plot.hpp"

namespace app {

/// How gnuplot is told a colour: as one that stands for it and is found again in its output.
std::string gnuplot_colour(Colour colour);

/// gnuplot's SVG as a small element for a page: empty groups and fonts taken out, coordinates to a tenth,
/// colours as classes, markers under ids that begin with `id`.
std::string tidy_svg(const std::string& raw, const Plot& plot, const std::string& id);

} // namespace app
