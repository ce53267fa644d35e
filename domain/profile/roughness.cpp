#include "domain/profile/roughness.hpp"

#include "domain/errors.hpp"
#include "domain/profile/derivatives.hpp"

#include <algorithm>
#include <cmath>

namespace rough {
namespace {

constexpr Index fewest_nodes = 10;

/// The nodes of the evaluation length, about their mean line, and its sections.
Profile evaluated(const Profile& profile, double section_length, Roughness& r) {
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    r.section_length = section_length > 0 ? section_length : length;
    const double sections = std::floor(length / r.section_length * (1 + 1e-9));
    if (!(sections >= 1))
        refuse("roughness: a profile of ", length, " mm, expected one section length of ", section_length,
               " mm at least");
    if (!(2 * sections <= static_cast<double>(profile.nodes())))
        refuse("roughness: sections of ", section_length, " mm, expected two nodes or more in each");
    r.sections = static_cast<Index>(sections);
    const Index nodes =
        std::min<Index>(profile.nodes(), std::lround(sections * r.section_length / profile.spacing) + 1);
    Profile part{profile.heights.segment((profile.nodes() - nodes) / 2, nodes), profile.spacing};
    part.heights.array() -= part.heights.mean();
    return part;
}

} // namespace

Roughness roughness(const Profile& profile, double section_length) {
    if (profile.nodes() < fewest_nodes)
        refuse("roughness: a profile of ", profile.nodes(), " nodes, expected at least ", fewest_nodes);
    Roughness r;
    const Profile part = evaluated(profile, section_length, r);
    if (part.nodes() < fewest_nodes)
        refuse("roughness: ", part.nodes(), " nodes in whole sections, expected at least ", fewest_nodes);
    const Eigen::VectorXd& heights = part.heights;
    const Eigen::ArrayXd z = heights.array();
    r.Ra = z.abs().mean();
    r.m0 = z.square().mean();
    r.Rq = std::sqrt(r.m0);
    if (!(r.Rq > 1e-14 * profile.heights.cwiseAbs().maxCoeff()))
        throw InputError("roughness: the profile is constant, expected a rough one");
    r.Rsk = z.cube().mean() / (r.Rq * r.m0);
    r.Rku = z.square().square().mean() / (r.m0 * r.m0);
    for (Index s = 0; s < r.sections; ++s) {
        const Index from = heights.size() * s / r.sections, to = heights.size() * (s + 1) / r.sections;
        r.Rp += heights.segment(from, to - from).maxCoeff() / static_cast<double>(r.sections);
        r.Rv -= heights.segment(from, to - from).minCoeff() / static_cast<double>(r.sections);
    }
    r.Rz = r.Rp + r.Rv;
    r.Rt = z.maxCoeff() - z.minCoeff();
    r.Rmr = material_ratio(part, 0);
    r.elements = profile_elements(part);
    r.core = core_heights(heights);
    const Derivatives slopes = derivatives(part);
    r.m2 = slopes.x.square().mean();
    r.m4 = slopes.xx.square().mean();
    r.Rdq = std::sqrt(r.m2);
    r.rms_curvature = std::sqrt(r.m4);
    r.bandwidth = r.m0 * r.m4 / (r.m2 * r.m2);
    if (!std::isfinite(r.Rsk + r.Rku + r.m2 + r.m4 + r.bandwidth))
        throw InputError(
            "roughness: its parameters do not fit double precision, expected heights and a length "
            "nearer to 1 mm");
    return r;
}

} // namespace rough
