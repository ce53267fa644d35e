#pragma once

#include "domain/response/model.hpp"

#include <vector>

namespace rough {

/// Where the elastic answer of a curve ends.
struct ElasticEnd {
    Index step = 0;              ///< first load step, from 0, at which a node bears more than the limit
    double largest_pressure = 0; ///< of a node at the last load step, MPa

    /// Whether these load steps reach it.
    bool is_reached(const Response& response) const { return step < response.steps(); }
};
/// The end of a response that a surface gave under the model without a hardness; `limit` in MPa, step =
/// number of load steps if no node bears more. Local pressures grow with the load, so the end is bisected: 1
/// + log2(load steps) solutions, each of one load step. Throws as solve_contact.
ElasticEnd elastic_end(const Profile& surface, const Model& model, const Response& response, double limit);

/// What outliers cost: quantities without them over those with them, at the load step where the contact
/// fractions differ most.
struct OutlierCost {
    double contact_fraction = 1; ///< factor
    double stiffness = 1;        ///< factor of the tangent stiffness
    double pressure = 0;         ///< mean pressure of that load step, MPa

    bool matters() const { return contact_fraction > 1.1 || stiffness > 1.1; } ///< more than 10 %
};
/// The cost of the nodes that stand out of a scan, which gave this response: solves the scan with them
/// interpolated at the same mean pressures, as far as it can take them. Throws NotConverged as respond().
OutlierCost outlier_cost(const Profile& scan, const std::vector<Index>& outliers, const Model& model,
                         const Response& response);

} // namespace rough
