#pragma once

#include "domain/accuracy/respond_within.hpp"
#include "domain/accuracy/window.hpp"

namespace rough {

/// One line in place of a map: the mean of its rows, or of its columns, whichever leaves less.
struct LineOfMap {
    Profile line;        ///< mm
    bool along_x = true; ///< it is the mean of the rows: the ridges run along y
    Window window;       ///< of the map that repeats the line, against the map
};
/// Throws InputError where there is no map.
LineOfMap line_of_map(const Profile& map);

/// The response of a map within `accuracy` (relative, more than 0 to 1, of pressure and secants). Where it
/// repeats (periodic) and pressure_bounds() say that its line is as near as that, the line answers: the
/// displacements are the map's, or the line's where loads were asked for. The bounds rest on a capacitary
/// pressure that is nowhere negative: proven of the continuum, not of sampled maps. Otherwise the map itself
/// is solved, by a tolerance of a twentieth, and the account says how far the line would have been off. A
/// free map is no endless ridge, so no line answers for it. Throws InputError as respond_within.
AccountedResponse respond_map_within(const Profile& map, const Model& model, double accuracy);

} // namespace rough
