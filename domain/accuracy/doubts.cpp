#include "domain/accuracy/doubts.hpp"

#include "domain/errors.hpp"
#include "domain/profile/outliers.hpp"

namespace rough {

ElasticEnd elastic_end(const Profile& surface, const Model& model, const Response& response, double limit) {
    ContactOptions options = model.contact;
    options.states = true;
    const Body body = completed(model.body, model.grid.length);
    const auto largest_at = [&](Index step) {
        return solve_contact(surface, body, {response.displacement[step]}, options)
            .states.front()
            .pressure.maxCoeff();
    };
    const Index last = response.steps() - 1;
    const double largest = largest_at(last);
    Index below = -1, beyond = largest > limit ? last : last + 1;
    while (beyond <= last && beyond - below > 1) {
        const Index middle = below + (beyond - below) / 2;
        (largest_at(middle) > limit ? beyond : below) = middle;
    }
    return {beyond, largest};
}

OutlierCost outlier_cost(const Profile& scan, const std::vector<Index>& outliers, const Model& model,
                         const Response& response) {
    Profile clean = scan;
    clean.heights = interpolated(scan.heights, outliers);
    // A periodic body may be in full contact with the clean surface before the last of these pressures.
    for (Index rows = response.steps(); rows > 0; rows /= 2)
        try {
            Model at = model;
            at.loading.pressures = {response.pressure.begin(), response.pressure.begin() + rows};
            const Response found = respond(clean, at);
            Index row = 0;
            const Eigen::ArrayXd factors =
                found.contact_fraction.array() / response.contact_fraction.head(rows).array();
            const double factor = factors.maxCoeff(&row);
            return {factor, found.tangent_stiffness[row] / response.tangent_stiffness[row],
                    response.pressure[row]};
        } catch (const InputError&) {
        }
    return {};
}

} // namespace rough
