#pragma once

#include "domain/response/response.hpp"

/// @file
/// Reasons to doubt the curve of a measured surface: its resolution, its outliers, its local pressures.
namespace rough {

/// How heights between nodes are interpolated.
enum class Interpolation {
    linear, ///< linear on a line, bilinear on a map
    spline, ///< cubic spline, on a map along x and then along y
    kinked, ///< parabolas, with kinks at sharp crests between nodes, along x and then y
};

/// The surface on a finer grid, with `times` (>= 1) elements for each element along each axis, as refined(Grid). The
/// nodes of the surface keep their heights. On a map that is not periodic, `times` must therefore be odd, otherwise
/// InputError is thrown; heights continue straight over the outer half cells. Splines end with the slope of the
/// parabola through the last three nodes; along an axis of two nodes they are linear. Across the ends of a periodic
/// surface heights are linear, so that splines do not oscillate at a jump there.
Profile finer(const Profile& surface, Index times, Interpolation by, bool periodic = false);

/// Whether contact is also computed on interpolated heights of a measured surface. `automatic` does so unless
/// the interpolated surface has more than 2e6 nodes (map) or 1e7 nodes (line).
enum class Resolution { automatic, on, off };
/// In the order of Resolution: auto, on, off.
const std::vector<std::string>& resolution_names();

/// Width in nodes from which a contact spot is resolved. The contact area of narrower spots depends on the
/// node spacing.
constexpr Index resolved_spot_nodes = 4;

/// One response of a scan or map for each interpolation. The grid is 4 times finer, 5 times on the cells of a
/// free map. Empty if `resolution` omits them. The displacements are those of the measured response, so
/// that the pressures are nearly equal, too. Throws as solve_contact().
std::vector<Response> finer_responses(const Profile& scan, const Model& model, const Response& measured,
                                      Resolution resolution);

/// The uncertainty of a measured surface's curve from its node spacing (scan/README.md), one entry per load
/// step; empty if it was not computed.
struct ResolutionBand {
    Eigen::VectorXd contact_fraction_low = {};   ///< lower edge for the contact fraction
    Eigen::VectorXd contact_fraction_high = {};  ///< upper edge for the contact fraction
    Eigen::VectorXd tangent_stiffness_low = {};  ///< lower edge for the tangent stiffness, MPa/mm
    Eigen::VectorXd tangent_stiffness_high = {}; ///< upper edge for the tangent stiffness, MPa/mm
    std::string omitted = {};                    ///< why a requested band was not computed, in words; otherwise ""

    bool is_computed() const { return contact_fraction_low.size() > 0; } ///< whether there is a band
};

/// The band of a scan or map that gave this response under the model. If an interpolated surface cannot be
/// solved, `omitted` states the reason. Throws NotConverged if ContactOptions::stop ends the solution.
ResolutionBand resolution_band(const Profile& scan, const Model& model, const Response& measured,
                               Resolution resolution = Resolution::automatic);

/// The load step from which a curve is no longer elastic.
struct ElasticEnd {
    Index step = 0;              ///< first load step, from 0, at which a node's pressure exceeds the limit
    double largest_pressure = 0; ///< highest pressure of a node at the last load step, MPa

    /// Whether the response's load steps include `step`.
    bool is_reached(const Response& response) const { return step < response.steps(); }
};
/// The elastic end of a response that was computed without a hardness; `limit` in MPa. If no pressure exceeds
/// the limit, `step` is the number of load steps. A load step of the bisection whose largest pressure is not
/// known is solved again. Throws as solve_contact().
ElasticEnd elastic_end(const Profile& surface, const Model& model, const Response& response, double limit);

/// The effect of outliers: values without them divided by values with them, at the load step at which the
/// contact fractions differ most.
struct OutlierCost {
    double contact_fraction = 1; ///< factor of the contact fraction
    double stiffness = 1;        ///< factor of the tangent stiffness
    double pressure = 0;         ///< mean pressure of this load step, MPa

    /// Whether one of the two factors is above 1.1.
    bool matters() const { return contact_fraction > 1.1 || stiffness > 1.1; }
};
/// The effect of outliers of a scan or map that gave this response. Replaces the heights at these nodes and solves the
/// contact at the same mean pressures, as far as they can be reached. Throws NotConverged as respond().
OutlierCost outlier_cost(const Profile& surface, const std::vector<Index>& outliers, const Model& model,
                         const Response& response);

/// The effect of filled points on the contact, in words. Example: "filled points: at 5 MPa the contact
/// is 12.3 %, and 11.9 % with the holes as lowest points". Solves for both surfaces. The mean pressure is
/// that of the last load step that both reach. Throws NotConverged as respond().
std::string describe_fill_effect(const Profile& surface, const std::vector<Index>& filled, const Model& model);

} // namespace rough
