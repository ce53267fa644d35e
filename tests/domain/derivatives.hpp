#pragma once

#include "domain/mwm/response.hpp"
#include "domain/response/curve.hpp"
#include "tests/catch.hpp"

namespace rough::testing {

/// A quantity of a response and its derivatives: one row per value, one column per gene.
struct Derivative {
    Eigen::MatrixXd by_gene;
    std::function<Eigen::VectorXd(const Response&)> value;
};

inline ResponseJacobian jacobian_of(const Genome& genome, const Model& model) {
    return in_genes(
        respond_with_gradient(sample(genome, model.grid), model.body, model.loading, model.contact).gradient,
        [&](const Eigen::MatrixXd& rows) { return pulled_back(rows, genome, model.grid); });
}

/// The values, with the value at index g increased by `by`.
inline std::vector<double> moved(std::vector<double> values, std::size_t g, double by) {
    values[g] += by;
    return values;
}

/// Checks derivatives against central differences in every gene. A probe is omitted if the contact set or an
/// extreme node changes in between. At least a third of the probes must remain.
inline void check_derivatives(const Genome& genome, const Model& model, const std::vector<Derivative>& derivatives) {
    const auto corners = [&](const Genome& at, const Response& response) {
        Index highest, lowest;
        const Profile profile = sample(at, model.grid);
        profile.heights.maxCoeff(&highest);
        profile.heights.minCoeff(&lowest);
        return std::tuple(Eigen::VectorXd(response.contact_fraction), highest, lowest);
    };
    const auto base = corners(genome, respond(genome, model));
    const auto values = genes(genome);
    std::size_t kept = 0;
    for (std::size_t g = 0; g < values.size(); ++g) {
        const double h = 1e-5;
        const Genome above = with_genes(genome, moved(values, g, h)), below = with_genes(genome, moved(values, g, -h));
        const Response right = respond(above, model), left = respond(below, model);
        if (corners(above, right) != base || corners(below, left) != base) continue;
        ++kept;
        for (const Derivative& one : derivatives) {
            const Eigen::VectorXd difference = (one.value(right) - one.value(left)) / (2 * h);
            INFO("gene " << g);
            CHECK((difference - one.by_gene.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() <=
                  1e-5 * one.by_gene.cwiseAbs().maxCoeff());
        }
    }
    CHECK(3 * kept >= values.size());
}

} // namespace rough::testing
