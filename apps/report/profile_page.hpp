#pragma once

#include "apps/report/page.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"

namespace app {

/// A parameter of a profile, by the name that its filters allow.
struct Parameter {
    std::string name;    ///< "Ra", or "Pa" where no long waves were taken off
    std::string key;     ///< of profile.json, with its unit
    double value;        ///< mm where it is a height
    bool is_height;      ///< shown in a unit of length that suits
    std::string unit;    ///< of another
    std::string meaning; ///< in a few words
};

/// A parameter's value with a unit that suits.
std::string in_words(const Parameter& one);
/// Parameters as lines of the terminal, heights in the unit that suits the largest, mm.
void tell_parameters(const std::vector<Parameter>& all, double largest);

/// A page about a surface, HTML: the parameters at 0, 1, 6 and 10 first, then two figures, all of them, and
/// the files.
struct SurfaceShown {
    std::string title;
    std::string account; ///< what was read and done
    std::vector<Parameter> parameters;
    Figure heights, curves;
    std::string by;                              ///< which standard the parameters are of
    std::vector<std::vector<Html>> further = {}; ///< rows behind the parameters
    std::vector<std::string> files = {};         ///< beside the page
};
std::string surface_page(SurfaceShown shown);

/// The set of ISO 21920-2 that profile.json holds. `is_roughness`: of a roughness profile.
std::vector<Parameter> parameters(const rough::Roughness& roughness, bool is_roughness);

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
