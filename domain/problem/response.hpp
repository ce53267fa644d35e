#pragma once

#include "domain/problem/setup.hpp"
#include "domain/response/curve.hpp"

namespace rough {

/// How the targets are loaded: one loading for those against pressure, one for those against displacement, or
/// one for all under Eq. 11.
struct Loadings {
    std::vector<Loading> each;          ///< the ways
    std::vector<std::size_t> of_target; ///< which of them serves each target
};
/// The ways a set-up's targets are loaded, `loading` giving the steps.
Loadings loadings_of(const DesignSetup& setup, const Loading& loading);
/// Whether a profile may be in full contact before the load steps end: on an elastic periodic body.
bool may_pass_full_contact(const Loading& loading, const Body& body);
/// The load steps as they are, or, if they pass full contact, up to 0.999 of its displacement: beyond it
/// there is no displacement.
Loading up_to_full_contact(Loading loading, const Profile& profile, const Model& model);
/// Continues a curve, and its derivatives if they are given, that ends in full contact before its target. The
/// contact fraction stays. Stiffness and load, which have no value there, rise by 100 times the last one over
/// once more the range of the curve, so that no target is met there.
void continue_beyond_full_contact(const DesignSetup& setup, const Target& target, Curve& curve,
                                  CurveJacobian* jacobian = nullptr);
/// The set-up's model for each way the targets are loaded.
std::vector<Model> loaded_models(const DesignSetup& setup);

/// Under Eq. 11 the genome with scale 1: the shape alone decides, so equal keys give equal bits.
Genome at_scale_one(Genome genome, const DesignSetup& setup);

/// The factor of Eq. 11 for the response of a genome at scale 1; 1 where it does not apply. Throws InputError
/// where it does not fit double precision.
double eq_11(const DesignSetup& setup, const Response& response);

/// A genome's answer under a set-up, in final amplitude.
struct DesignResponse {
    double scale = 1;                ///< that Eq. 11 found
    std::vector<Response> responses; ///< one for each way the targets are loaded
    std::vector<Curve> curves;       ///< of each target: what it is compared with
};
/// Of a genome at scale 1 whose responses to each way of loading these are.
DesignResponse scored(const DesignSetup& setup, std::vector<Response> pressed);

/// The responses of a genome at scale 1 (where Eq. 11 applies) to each way of loading, within the model's
/// accuracy.
std::vector<Response> pressed(const DesignSetup& setup, const Genome& genome, const Model& model);

/// A genome's answer. `model` may differ from the set-up's own: a finer grid, more load steps, another
/// kernel; within its accuracy.
DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model);
/// The same for a profile, e.g. a measured one; Eq. 11 as for a genome.
DesignResponse respond(const DesignSetup& setup, const Profile& profile, const Model& model);

/// Misfits of each target at its points.
std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response);
/// Each target's similarity.
std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response);
/// The smallest similarity of all targets, by their misfits.
double least_similarity(const std::vector<Eigen::VectorXd>& misfits);
/// The same of a response.
double similarity(const DesignSetup& setup, const DesignResponse& response);
/// The same of a genome on a grid `refine` times finer, within the set-up's accuracy; Eq. 11 anew where it
/// applies.
double similarity(const DesignSetup& setup, const Genome& genome, Index refine = 1);

/// Under Eq. 11 the genome with the scale that it gives on the set-up's own grid, solved throughout; else the
/// genome.
Genome in_final_form(const DesignSetup& setup, Genome genome);

} // namespace rough
