#pragma once

#include "domain/accuracy/chromosomes.hpp"
#include "domain/response/response.hpp"

#include <limits>
#include <string>

namespace rough {

/// What was modelled to answer a question, and how wrong the answer may be. Errors are relative, the worst
/// over the rows in pressure and secant stiffness, against the resolved answer; at `light_rows` they are
/// relative to 1 % of the last pressure.
struct Account {
    double accuracy = 0;               ///< asked for; 0: the exact model as given
    Index resolved_nodes = 0;          ///< nodes of the grid that counts as resolved
    std::vector<Index> grids;          ///< nodes of every grid solved, in order
    int read_grids = 1;                ///< the last of them that the answer is read off: several extrapolate
    int rows = 0;                      ///< load steps asked for
    int solved_rows = 0;               ///< those solved on the last grid
    int resolved_rows = 0;             ///< the first ones, taken from the resolved grid
    int light_rows = 0;                ///< the first ones, if their own pressures are no scale of the errors
    std::vector<ChromosomePlace> used; ///< chromosomes modelled; empty for a measured profile
    std::vector<ChromosomePlace> dropped; ///< chromosomes left out; empty for a measured profile
    Window window;                        ///< of the chromosomes dropped, mm
    Solver solver = Solver::automatic;    ///< on the last grid
    double tolerance = 0;                 ///< of an iterative solver
    double estimated_error = 0;           ///< all sources together, the worst row
    double grid_error = 0;                ///< estimated
    double step_error = 0;                ///< bounded
    double dropped_error = 0;             ///< bounded
    double solver_error = 0;              ///< bounded
    /// Of the contact fraction, relative, the worst row; estimated where grids were read, else bounded. Not
    /// part of `estimated_error`.
    double area_error = 0;
    Index held_nodes = 0; ///< at the last load step, nodes that bear the hardness
    bool by_line = false; ///< of a map: one line answered for it
    double aspect_ratio = std::numeric_limits<double>::quiet_NaN(); ///< of a map that repeats: Str
    /// Of a map, how far its line is off, relative: bounded where it answered, measured where it did not; no
    /// number where no line was pressed.
    double line_error = std::numeric_limits<double>::quiet_NaN();
    double seconds = 0; ///< wall time

    bool extrapolated() const { return read_grids > 1; } ///< whether several grids give the answer together
};

/// The same in a few sentences.
std::string in_words(const Account& account);

} // namespace rough
