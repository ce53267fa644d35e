#pragma once

#include "domain/problem/setup.hpp"
#include "domain/response/curve.hpp"

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

} // namespace rough
