#pragma once

#include "apps/report/render.hpp"
#include "domain/profile/roughness.hpp"

/// Output of the parameters and pictures of a line or a map.
namespace app {

/// Prints parameters as lines of the terminal, heights in the unit that suits the largest (mm).
void print_parameters(const std::vector<rough::SurfaceParameter>& all, double largest);

/// Adds parameters to the values of a page: each of `rows` under its key (`Pa_mm`), and under `parameters`
/// all rows that the page shows, `more` at the end.
void add_parameters(nlohmann::json& values, const std::vector<rough::SurfaceParameter>& rows,
                    const std::vector<rough::SurfaceParameter>& more = {});

/// Writes report.html and, of each figure, an SVG file. A picture that cannot be drawn is left out with a
/// note.
void write_pages(const std::filesystem::path& folder,
                 const std::vector<std::pair<std::string, std::string>>& pictures);

} // namespace app
