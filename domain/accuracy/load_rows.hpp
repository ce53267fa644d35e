#pragma once

#include "domain/contact/solve.hpp"

namespace rough {

/// A curve at every displacement asked for, solved there or between solved ones.
struct LoadRows {
    std::vector<LoadStep> steps;       ///< one a displacement; zeros where the profile does not touch yet
    double error = 0;                  ///< bound of what reading between solved rows costs, at every row over
                                       ///< its exact pressure and secant
    double area_error = 0;             ///< the same of the contact fraction, relative: it never falls
    int solved = 0;                    ///< rows that were solved
    Solver solver = Solver::automatic; ///< the one that was used
    std::vector<int> last_contact;     ///< nodes that touch at the last displacement
};

/// Solves the contact at as few of the displacements (mm, increasing; <= 0 is no contact) as `accuracy`
/// allows. Between solved rows a and b the pressure is read off a cubic with the tangents of both, held
/// within bounds that are exact, since P is convex: the chord above, both tangents below; and the secants
/// within lie between the two tangents. `accuracy` 0 solves every row.
LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy = 0);

} // namespace rough
