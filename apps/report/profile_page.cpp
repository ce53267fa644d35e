#include "apps/report/profile_page.hpp"

#include "apps/prompt/verbosity.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace app {

std::string in_words(const Parameter& one) {
    if (one.unit != "mm" || !std::isfinite(one.value))
        return readable(one.value) + (one.unit.empty() || one.unit == "°" ? "" : " ") + one.unit;
    const Unit unit = length_unit(std::abs(one.value));
    return readable(unit.factor * one.value) + " " + unit.name;
}

std::string surface_page(SurfaceShown shown) {
    Page page(shown.title, shown.account);
    std::vector<std::pair<std::string, std::string>> tiles;
    for (const std::string& name : shown.tiles)
        for (const Parameter& one : shown.parameters)
            if (one.name == name)
                tiles.emplace_back(one.name + ", " + one.meaning, in_words(one));
    page.tiles(tiles);
    page.section("Heights");
    page.figure(std::move(shown.heights));
    page.figure(std::move(shown.curves));
    page.section("Parameters");
    page.prose(shown.by);
    Table table{"", {"Parameter", "Value", "What it is"}, {}, {false, true, false}};
    for (const Parameter& one : shown.parameters)
        table.rows.push_back({one.name, in_words(one), one.meaning});
    page.table(table);
    page.section("Files");
    page.links(shown.files);
    return page.html();
}

void tell_parameters(const std::vector<Parameter>& all, double largest) {
    const Unit height = length_unit(largest);
    for (const Parameter& one : all) {
        char line[160];
        if (std::isfinite(one.value))
            std::snprintf(line, sizeof line, "  %-14s %12.6g %-5s %s", one.name.c_str(),
                          one.value * (one.unit == "mm" ? height.factor : 1),
                          one.unit == "mm" ? height.name.c_str() : one.unit.c_str(), one.meaning.c_str());
        else
            std::snprintf(line, sizeof line, "  %-14s %12s %-5s %s", one.name.c_str(), "none", "",
                          one.meaning.c_str());
        say(line);
    }
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> bearing_curve(const Eigen::VectorXd& heights) {
    constexpr Eigen::Index most = 1001;
    Eigen::VectorXd z = heights;
    std::sort(z.begin(), z.end(), std::greater<>());
    const Eigen::Index count = std::min(most, z.size());
    Eigen::VectorXd share(count), level(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Index at = count > 1 ? i * (z.size() - 1) / (count - 1) : 0;
        share[i] = (static_cast<double>(at) + 0.5) / static_cast<double>(z.size());
        level[i] = z[at];
    }
    return {share, level};
}

Plot profile_plot(const rough::Profile& profile) {
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    const Eigen::VectorXd heights = profile.heights.array() - profile.heights.mean();
    const Unit across = length_unit(length), up = length_unit(heights.cwiseAbs().maxCoeff());
    Plot plot;
    plot.alt = "Height of the profile along its length";
    plot.x = {"Position x (" + across.name + ")"};
    plot.y = {"Height z (" + up.name + ")"};
    plot.series.push_back(
        {"", Eigen::VectorXd::LinSpaced(heights.size(), 0, across.factor * length), up.factor * heights});
    plot.series.back().width = 1.2;
    plot.height = 220;
    return plot;
}

Plot spectrum_plot(const rough::Spectrum& spectrum) {
    Plot plot;
    plot.alt = "Power spectral density of the profile against wave number";
    plot.x = {"Wave number q (rad/mm)", true};
    plot.y = {"Power spectral density C (mm³)", true};
    plot.series.push_back({"", spectrum.wave_number, spectrum.density});
    plot.series.back().width = 1.2;
    return plot;
}

Plot bearing_plot(const Eigen::VectorXd& heights) {
    const auto [share, level] = bearing_curve(heights.array() - heights.mean());
    const Unit up = length_unit(level.cwiseAbs().maxCoeff());
    Plot plot;
    plot.alt = "Material ratio curve: height against the share of the length that is higher";
    plot.x = {"Material ratio (%)", false, 0, 100};
    plot.y = {"Height z (" + up.name + ")"};
    plot.series.push_back({"", 100 * share, up.factor * level});
    return plot;
}

std::string profile_page(const ProfileShown& shown) {
    const rough::Roughness& r = shown.roughness;
    const std::string letter = shown.is_roughness ? "R" : "P";
    return surface_page(
        {"Profile: " + shown.name,
         shown.account,
         r.rows,
         {letter + "a", letter + "q", letter + "z", letter + "dq"},
         {"profile", "Heights", "Counted from their mean.", {profile_plot(shown.profile)}},
         {"curves",
          "Material ratio and spectrum.",
          "Left, how much of the length is higher than a height; right, the power spectral density under "
          "a Hann window.",
          {bearing_plot(shown.profile.heights), spectrum_plot(shown.spectrum)}},
         shown.is_roughness
             ? "A roughness profile: waves over the cut-off are taken off by a Gaussian filter (ISO "
               "16610-21). Parameters by ISO 21920-2 over " +
                   std::to_string(r.sections) + " sections of " + readable(r.section_length) + " mm."
             : std::string("A primary profile: no long waves are taken off, so its parameters are Pa, Pq and "
                           "so on (ISO 21920-2), over its whole length."),
         shown.files});
}

} // namespace app
