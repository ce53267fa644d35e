#pragma once

#include "domain/problem/response.hpp"
#include "ga/refinement/sensitivity.hpp"

namespace rough {

/// All targets' misfits of a genome under a model with their derivatives, target after target. Those of
/// contact fractions are of the smooth ones (response/smooth_area.hpp), within one node an edge of contact.
struct Rows {
    ga::Sensitivity misfits;     ///< one row a point
    double factor = 1;           ///< of Eq. 11; 1 where it does not apply
    Eigen::RowVectorXd d_factor; ///< in every gene; empty without Eq. 11
};

/// Of a genome at scale 1 where Eq. 11 applies. Throws what respond() throws.
Rows misfit_rows(const DesignSetup& setup, const Genome& genome, const Model& model);

/// One's rows above the other's.
ga::Sensitivity stacked(const ga::Sensitivity& above, const ga::Sensitivity& below);

} // namespace rough
