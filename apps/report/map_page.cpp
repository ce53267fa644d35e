#include "apps/report/map_page.hpp"

#include "apps/report/height_picture.hpp"
#include "apps/report/page.hpp"
#include "apps/report/units.hpp"

#include <cmath>

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
    const auto all = parameters(shown.areal);
    Page page("Surface: " + shown.name, shown.account);
    std::vector<std::pair<std::string, std::string>> tiles;
    for (const std::size_t i : {0, 1, 6, 10})
        tiles.emplace_back(all[i].name + ", " + all[i].meaning, in_words(all[i]));
    page.tiles(tiles);
    page.section("Heights");
    const auto [columns, rows] = shown.map.shape();
    const double high = shown.map.heights.maxCoeff(), low = shown.map.heights.minCoeff();
    const Unit up = length_unit(high - low);
    const std::string size = readable(shown.map.spacing * static_cast<double>(columns - 1)) +
                             " mm along x, " +
                             readable(shown.map.row_spacing * static_cast<double>(rows - 1)) + " mm along y";
    page.prose(Html::raw(embedded(shown.png, "Height map, " + size)));
    page.prose(size + "; from " + readable(up.factor * low) + " (dark) to " + readable(up.factor * high) +
               " " + up.name + " (bright), y upwards.");
    Plot spectrum = spectrum_plot(shown.spectrum);
    spectrum.alt = "Radially averaged power spectral density of the surface against wave number";
    spectrum.y.label = "Power spectral density C (mm⁴)";
    page.figure({"curves",
                 "Material ratio and spectrum.",
                 "Left, how much of the area is higher than a height; right, the areal power spectral "
                 "density, averaged over directions.",
                 {bearing_plot(shown.map.heights), spectrum}});
    page.section("Parameters");
    page.prose("By ISO 25178-2 over the whole map, about its mean plane.");
    page.table(parameter_table(all));
    page.section("Files");
    page.links(shown.files);
    return page.html();
}

} // namespace app
