#pragma once

#include "domain/accuracy/error_bounds.hpp"

/// @file
/// Reduced models: one line in place of a map, and interpolated load steps.

namespace rough {

/// One line in place of a map: the mean of its rows or of its columns, whichever has the narrower window.
struct LineOfMap {
    Profile line;        ///< heights of the line, mm
    bool along_x = true; ///< whether the line is the mean of the rows; the grooves then run along y
    Window window;       ///< window between the map and the map that repeats the line
};
/// The line that replaces a map. Throws InputError if `map` is a line.
LineOfMap line_of_map(const Profile& map);

/// A curve with a row for each requested displacement: solved, or interpolated between solved rows. Rows
/// before the profile touches are zeros.
struct LoadRows : ContactCurve {
    /// Bound of the error of interpolated rows, relative to their exact pressure and secant.
    double error = 0;
    double area_error = 0;    ///< bound of the relative error of the contact fraction
    double tangent_error = 0; ///< bound of the relative error of the tangent stiffness
    int solved = 0;           ///< number of solved rows
};

/// Solves the contact at as few of the displacements (mm, increasing) as `accuracy` allows; 0 solves every
/// row. A profile does not touch at displacements <= 0. Between two solved rows the pressure is a cubic
/// within exact bounds (README.md).
LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy = 0);

} // namespace rough
