#pragma once

#include "domain/problem/verification.hpp"
#include "ga/refinement/sensitivity.hpp"

#include <functional>

namespace rough {

/// All targets' misfits of a genome under a model with their derivatives, target after target. Those of
/// contact fractions are of the smooth ones (contact/smooth_area.hpp), within one node an edge of contact.
struct Rows {
    ga::Sensitivity misfits;     ///< one row a point
    double factor = 1;           ///< of Eq. 11; 1 where it does not apply
    Eigen::RowVectorXd d_factor; ///< in every gene; empty without Eq. 11
};

/// Of a genome at scale 1 where Eq. 11 applies. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model);
/// The same of a profile and the loadings for the targets; `in_genes` turns derivatives in heights (rows x N)
/// into derivatives in genes. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Profile& profile, const Loadings& loadings,
                 const Model& model, const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& in_genes);
/// The same of a genome in the load steps of `finer` on a grid `refine` times finer, then in every fourth of
/// them, which are the set-up's own: one solution gives both (in_finer_steps).
std::array<Rows, 2> stepped_rows(const DesignSetup& setup, const DesignSetup& finer, const Genome& genome,
                                 Index refine);

/// The last of every `part` load steps: the response in so many times fewer. Steps are even, so these are
/// the same displacements to the bit.
Response every(Index part, Response response);

/// One's rows above the other's.
ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below);

} // namespace rough
