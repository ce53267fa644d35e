#pragma once

#include "domain/problem/verification.hpp"
#include "ga/refinement/sensitivity.hpp"

#include <functional>

namespace rough {

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
