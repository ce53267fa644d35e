#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// A curve at each requested displacement: solved, or interpolated between solved load steps.
struct LoadRows {
    std::vector<LoadStep> steps;       ///< one per displacement; zeros before the profile touches
    double error = 0;                  ///< bound of the error of interpolated rows, relative to a row's exact
                                       ///< pressure and secant
    double area_error = 0;             ///< relative bound for the contact fraction, which never falls
    double tangent_error = 0;          ///< relative bound for the tangent stiffness, which never falls
    int solved = 0;                    ///< number of solved rows
    Solver solver = Solver::automatic; ///< the one that was used
    std::vector<int> last_contact;     ///< nodes that touch at the last displacement
};

/// Solves the contact at as few of the displacements (mm, increasing; <= 0: no contact) as `accuracy` allows.
/// Between solved rows the pressure is a cubic with the tangents of both rows. Since P is convex, it is kept
/// within exact bounds: the chord above, both tangents below. Secants there lie between the two tangents.
/// `accuracy` 0 solves every row.
LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy = 0);

} // namespace rough
