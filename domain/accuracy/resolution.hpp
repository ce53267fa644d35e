#pragma once

#include "domain/response/model.hpp"

#include <string>
#include <vector>

namespace rough {

/// Whether a measured surface is pressed again on interpolated heights. `automatic` does so up to
/// most_finer_map_nodes and most_finer_line_nodes.
enum class Resolution { automatic, on, off };
/// In the order of Resolution: auto, on, off.
const std::vector<std::string>& resolution_names();

constexpr Index finer_times = 4; ///< elements for each one of a measured surface
/// Nodes of an interpolated map up to which `automatic` presses it.
constexpr Index most_finer_map_nodes = 2'000'000;
/// Nodes of an interpolated line up to which `automatic` presses it.
constexpr Index most_finer_line_nodes = 10'000'000;
/// Contact spots of fewer nodes across are not resolved: their area is that of the nodes that touch.
constexpr Index resolved_spot_nodes = 4;

/// Usual width of the contact spots (contact/pressure_and_gap.hpp) in nodes: half of the contact nodes lie in
/// spots of at most so many nodes on a line, of at most its square on a map. 0 without contact.
Index spot_width(const std::vector<int>& contact, Extent shape, bool periodic);

/// The responses of a scan or map with heights interpolated linearly and by a spline between its nodes;
/// nothing if `resolution` omits them. Their displacements are the measured response's, so that their
/// pressures nearly are, too. Throws as solve_contact.
std::vector<Response> finer_responses(const Profile& scan, const Model& model, const Response& measured,
                                      Resolution resolution);

/// What a scan says of its contact: a band that holds the curves of the heights as measured, interpolated
/// linearly and interpolated by a spline, each at the measured curve's mean pressures. The pressure is each
/// grid's own: the force over the length, for a free map over all of its patches. The band also holds the
/// spline's curve continued to spacing 0, v + (v - measured)/3, as node counts err in proportion to the
/// spacing (Richardson 1911), and it is wider by what one node of the finer grid changes. Roughness below the
/// spacing is not in the band. Row by row, empty if it was not computed.
struct ResolutionBand {
    Eigen::VectorXd contact_fraction_low = {};   ///< least
    Eigen::VectorXd contact_fraction_high = {};  ///< greatest
    Eigen::VectorXd tangent_stiffness_low = {};  ///< MPa/mm
    Eigen::VectorXd tangent_stiffness_high = {}; ///< MPa/mm
    std::string omitted = {}; ///< why it was not computed, in words; "": it was, or is not asked for

    bool is_computed() const { return contact_fraction_low.size() > 0; } ///< whether there is one
};

/// The band of a scan or map that gave this response under the model. If an interpolated surface cannot be
/// solved, `omitted` says why. Throws NotConverged if the options stop it.
ResolutionBand resolution_band(const Profile& scan, const Model& model, const Response& measured,
                               Resolution resolution = Resolution::automatic);

} // namespace rough
