#include "apps/report/map_page.hpp"

#include "apps/report/units.hpp"

namespace app {

std::string map_page(const MapShown& shown) {
    const auto [columns, rows] = shown.map.shape();
    const double length = shown.map.spacing * static_cast<double>(columns - 1),
                 width = shown.map.row_spacing * static_cast<double>(rows - 1);
    Plot spectrum = spectrum_plot(shown.spectrum);
    spectrum.alt = "Radially averaged power spectral density of the surface against wave number";
    spectrum.y.label = "Power spectral density C (mm⁴)";
    return surface_page({"Surface: " + shown.name,
                         shown.account,
                         shown.parameters,
                         {"Sa", "Sq", "Sz", "Str"},
                         {"heights",
                          "Heights.",
                          readable(length) + " mm along x, " + readable(width) + " mm along y.",
                          {shown.heights}},
                         {"curves",
                          "Material ratio and spectrum.",
                          "Left, how much of the area is higher than a height; right, the areal power "
                          "spectral density, averaged over directions.",
                          {bearing_plot(shown.map.heights), spectrum}},
                         "By ISO 25178-2 over the whole map, about its mean plane.",
                         shown.files});
}

} // namespace app
