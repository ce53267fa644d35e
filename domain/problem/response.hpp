#pragma once

#include "domain/problem/setup.hpp"

namespace rough {

/// The loadings that a set-up's targets need, with the steps of `loading`: one for targets against pressure,
/// then one for targets against displacement. Under Eq. 11 all targets have the same loading.
std::vector<Loading> loadings_of(const DesignSetup& setup, const Loading& loading);
/// Returns the load steps, or steps to 0.999 of the full-contact displacement if the given steps go further.
/// Only an elastic periodic body has such a limit.
Loading up_to_full_contact(Loading loading, const Profile& profile, const Model& model);

/// Returns the genome. Under Eq. 11 its scale becomes 1, because only the shape then affects the curves.
Genome at_scale_one(Genome genome, const DesignSetup& setup);

/// The bits of a genome that its outcome depends on: all, or under Eq. 11 all except the scale.
std::string key_of(const DesignSetup& setup, const Genome& genome);

/// The factor of Eq. 11 for the response of a genome at scale 1; 1 without Eq. 11. Throws InputError if the
/// factor does not fit double precision.
double eq_11(const DesignSetup& setup, const Response& response);

/// The responses and curves of a genome under a set-up. Under Eq. 11 they belong to the rescaled genome.
struct DesignResponse {
    double scale = 1;                ///< the factor of Eq. 11
    std::vector<Response> responses; ///< one for each loading (loadings_of)
    std::vector<Curve> curves;       ///< for each target, the curve that is compared with it
};
/// The responses and curves of a genome from its responses at scale 1, one for each loading.
DesignResponse design_response(const DesignSetup& setup, std::vector<Response> responses);

/// The responses of a genome (at scale 1 under Eq. 11) to each loading.
std::vector<Response> responses_of(const DesignSetup& setup, const Genome& genome, const Model& model);

/// The responses and curves of a genome under `model`, which may differ from the set-up's model.
DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model);

/// Misfits to each target at its points.
std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response);
/// The similarity to each target, by its misfits.
std::vector<double> similarities(const std::vector<Eigen::VectorXd>& misfits);
/// The similarity of a response to each target.
std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response);
/// The lowest similarity over all targets, by their misfits.
double min_similarity(const std::vector<Eigen::VectorXd>& misfits);
/// The lowest similarity of a response over all targets.
double similarity(const DesignSetup& setup, const DesignResponse& response);
/// The lowest similarity of a genome over all targets, with Eq. 11, on a grid `refine` times finer.
double similarity(const DesignSetup& setup, const Genome& genome, Index refine = 1);

/// The genome in its final form, in which it is reported. Under Eq. 11 its scale is the factor of Eq. 11,
/// computed on the set-up's grid. Without Eq. 11 the genome is unchanged.
Genome in_final_form(const DesignSetup& setup, Genome genome);

/// The misfits to all targets under a model, target after target, and their derivatives. Contact fractions
/// are smoothed (contact/interface.hpp). They differ from the count by at most one node per contact edge.
struct Rows {
    ga::Sensitivity misfits;     ///< one row per point
    double factor = 1;           ///< the factor of Eq. 11; 1 without Eq. 11
    Eigen::RowVectorXd d_factor; ///< derivatives of the factor with respect to the genes, or empty
};

/// The rows of a genome. Under Eq. 11 its scale must be 1. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model);
/// The rows of a profile under the targets' loadings. `pull` converts derivatives with respect to heights
/// (rows x N) into derivatives with respect to genes. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Profile& profile, const std::vector<Loading>& loadings,
                 const Model& model, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& pull);
/// The rows of all parts, at least one, in order.
ga::Sensitivity stacked(const std::vector<ga::Sensitivity>& parts);

} // namespace rough
