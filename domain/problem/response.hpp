#pragma once

#include "domain/problem/setup.hpp"
#include "domain/response/curve.hpp"
#include "ga/refinement/sensitivity.hpp"

#include <array>
#include <functional>

namespace rough {

/// The loadings that the targets need: one for those against pressure, one for those against displacement, or
/// one for all under Eq. 11.
struct Loadings {
    std::vector<Loading> each;          ///< the different loadings
    std::vector<std::size_t> of_target; ///< the index of each target's loading
};
/// The loadings of a set-up's targets, with the steps of `loading`.
Loadings loadings_of(const DesignSetup& setup, const Loading& loading);
/// The load steps. They are replaced if they pass full contact of an elastic periodic body, beyond which
/// displacement is not defined. The replacements end at 0.999 of its displacement.
Loading up_to_full_contact(Loading loading, const Profile& profile, const Model& model);
/// Continues a curve that ends in full contact before its target, and its derivatives if given. The contact
/// fraction stays. Stiffness and load have no value there. They rise by 100 times the last value over a
/// further range of the curve, so that they meet no target.
void continue_beyond_full_contact(const DesignSetup& setup, const Target& target, Curve& curve,
                                  CurveJacobian* jacobian = nullptr);
/// The set-up's model with each of its targets' loadings.
std::vector<Model> loaded_models(const DesignSetup& setup);

/// The genome, under Eq. 11 with scale 1: only the shape affects its curves, so equal shapes give equal bits.
Genome at_scale_one(Genome genome, const DesignSetup& setup);

/// The bits of a genome that its outcome depends on: all, or under Eq. 11 all except the scale.
std::string key_of(const DesignSetup& setup, const Genome& genome);

/// The factor of Eq. 11 for the response of a genome at scale 1; 1 without Eq. 11. Throws InputError if it
/// does not fit double precision.
double eq_11(const DesignSetup& setup, const Response& response);

/// A genome's answer under a set-up, in final amplitude.
struct DesignResponse {
    double scale = 1;                ///< the factor of Eq. 11
    std::vector<Response> responses; ///< one for each loading (loadings_of)
    std::vector<Curve> curves;       ///< one for each target, to compare it with
};
/// The answer of a genome at scale 1 with these responses, one for each loading.
DesignResponse scored(const DesignSetup& setup, std::vector<Response> pressed);

/// The responses of a genome (at scale 1 under Eq. 11) to each loading, within the model's accuracy.
std::vector<Response> pressed(const DesignSetup& setup, const Genome& genome, const Model& model);

/// A genome's answer, within the accuracy of `model`, which may have another grid, load steps or kernel than
/// the set-up.
DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model);

/// Misfits of each target at its points.
std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response);
/// Each target's similarity.
std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response);
/// The lowest similarity over all targets, by their misfits.
double least_similarity(const std::vector<Eigen::VectorXd>& misfits);
/// The lowest similarity of a response over all targets.
double similarity(const DesignSetup& setup, const DesignResponse& response);
/// The lowest similarity of a genome over all targets, on a grid `refine` times finer, within the set-up's
/// accuracy. Eq. 11 is applied to that grid's response.
double similarity(const DesignSetup& setup, const Genome& genome, Index refine = 1);

/// The genome, under Eq. 11 with the scale for the set-up's grid, without approximations.
Genome in_final_form(const DesignSetup& setup, Genome genome);

/// All targets' misfits under a model with their derivatives, target after target. Contact fractions are the
/// smooth ones (contact/smooth_area.hpp), within one node for each edge of contact.
struct Rows {
    ga::Sensitivity misfits;     ///< one row per point
    double factor = 1;           ///< the factor of Eq. 11; 1 without it
    Eigen::RowVectorXd d_factor; ///< its derivatives in every gene; empty without Eq. 11
};

/// The rows of a genome, under Eq. 11 at scale 1. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model);
/// The rows of a profile under the targets' loadings. `in_genes` converts derivatives in heights (rows x N)
/// into derivatives in genes. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Profile& profile, const Loadings& loadings,
                 const Model& model, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& in_genes);
/// The rows of a genome on a grid `refine` times finer. The first are in the load steps of `finer`
/// (in_finer_steps), the second in every fourth of them, which are the set-up's. One solution gives both.
std::array<Rows, 2> stepped_rows(const DesignSetup& setup, const DesignSetup& finer, const Genome& genome,
                                 Index refine);

/// The response in `part` times fewer load steps: the last of every `part`. Steps are even, so these are the
/// same displacements to the bit.
Response every(Index part, Response response);

/// The rows of both, one above the other.
ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below);

} // namespace rough
