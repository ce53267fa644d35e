#pragma once

#include "domain/design/problem.hpp"

namespace rough {

/// How the goals are loaded: one loading for those against pressure, one for those against displacement, or
/// one for all under Eq. 11.
struct Loadings {
    std::vector<Loading> each;        ///< the ways
    std::vector<std::size_t> of_goal; ///< which of them serves each goal
};

/// The ways a set-up's goals are loaded, `loading` giving the steps.
Loadings loadings_of(const DesignSetup& setup, const Loading& loading);

/// Under Eq. 11 the genome with scale 1: the shape alone decides, so equal keys give equal bits.
Genome at_scale_one(Genome genome, const DesignSetup& setup);

/// The factor of Eq. 11 for the response of a genome at scale 1; 1 where it does not apply.
double eq_11(const DesignSetup& setup, const Response& response);

/// Misfits of each goal at its points.
std::vector<Eigen::VectorXd> misfits_of(const DesignSetup& setup, const DesignResponse& response);

} // namespace rough
