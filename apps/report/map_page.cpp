#include "apps/report/map_page.hpp"

#include "apps/report/units.hpp"

namespace app {

std::vector<Parameter> parameters(const rough::ArealParameters& s) {
    const rough::Texture& t = s.texture;
    return {{"Sa", "Sa_mm", s.Sa, true, "", "arithmetic mean height"},
            {"Sq", "Sq_mm", s.Sq, true, "", "root mean square height"},
            {"Ssk", "Ssk", s.Ssk, false, "", "skewness"},
            {"Sku", "Sku", s.Sku, false, "", "kurtosis"},
            {"Sp", "Sp_mm", s.Sp, true, "", "highest peak"},
            {"Sv", "Sv_mm", s.Sv, true, "", "deepest pit"},
            {"Sz", "Sz_mm", s.Sz, true, "", "maximum height"},
            {"Sdq", "Sdq", s.Sdq, false, "", "root mean square gradient"},
            {"Sdr", "Sdr", s.Sdr, false, "", "developed area over the map's, less 1"},
            {"Sal", "Sal_mm", t.Sal, true, "", "autocorrelation length, to 0.2"},
            {"Str", "Str", t.Str, false, "",
             t.Str_is_bound ? "texture aspect ratio, at most" : "texture aspect ratio: 0 one lay, 1 none"},
            {"Std", "Std_degrees", t.Std, false, "°", "direction of the lay, from x"},
            {"Smr", "Smr", s.Smr, false, "", "material ratio at the mean plane"},
            {"Smc(10 %)", "Smc10_mm", s.Smc10, true, "", "height that a tenth of the area exceeds"},
            {"Sk", "Sk_mm", s.core.Rk, true, "", "core height"},
            {"Spk", "Spk_mm", s.core.Rpk, true, "", "reduced peak height"},
            {"Svk", "Svk_mm", s.core.Rvk, true, "", "reduced valley depth"},
            {"Smrk1", "Smrk1", s.core.Mr1, false, "", "material ratio above the core"},
            {"Smrk2", "Smrk2", s.core.Mr2, false, "", "material ratio above the valleys"}};
}

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
                         {},
                         shown.files});
}

} // namespace app
