#pragma once

#include "apps/report/page.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"

namespace app {

using Parameter = rough::SurfaceParameter;

/// A parameter's value with a unit that suits.
std::string in_words(const Parameter& one);
/// Parameters as lines of the terminal, heights in the unit that suits the largest, mm.
void tell_parameters(const std::vector<Parameter>& all, double largest);

/// A page about a surface, HTML: the parameters named `tiles` first, then two figures, all parameters, and
/// the files.
struct SurfaceShown {
    std::string title;
    std::string account; ///< what was read and done
    std::vector<Parameter> parameters;
    std::vector<std::string> tiles;
    Figure heights, curves;
    std::string by;                      ///< which standard the parameters are of
    std::vector<std::string> files = {}; ///< beside the page
};
std::string surface_page(SurfaceShown shown);

/// The material ratio curve: shares of the nodes from 0 to 1, and the heights (mm) that they are higher
/// than; of more nodes than 1001, that many shares.
std::pair<Eigen::VectorXd, Eigen::VectorXd> bearing_curve(const Eigen::VectorXd& heights);

/// The profile's heights along it, from their mean.
Plot profile_plot(const rough::Profile& profile);
/// Its power spectrum.
Plot spectrum_plot(const rough::Spectrum& spectrum);
/// The material ratio curve of heights, of a profile or an area.
Plot bearing_plot(const Eigen::VectorXd& heights);

/// What a page about a profile shows.
struct ProfileShown {
    std::string name;    ///< of its file
    std::string account; ///< what was read and done
    const rough::Profile& profile;
    const rough::Roughness& roughness;
    bool is_roughness;
    const rough::Spectrum& spectrum;
    std::vector<std::string> files; ///< beside the page
};

/// The page, HTML.
std::string profile_page(const ProfileShown& shown);

} // namespace app
