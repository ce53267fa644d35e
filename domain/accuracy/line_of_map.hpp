#pragma once

#include "domain/accuracy/window.hpp"
#include "domain/response/model.hpp"

#include <optional>

namespace rough {

/// One line in place of a map: the mean of its rows, or of its columns, whichever leaves less.
struct LineOfMap {
    Profile line;        ///< mm
    bool along_x = true; ///< it is the mean of the rows: the ridges run along y
    Window window;       ///< of the map that repeats the line, against the map
};
/// Throws InputError where there is no map.
LineOfMap line_of_map(const Profile& map);

/// A line's curve in place of a map's.
struct ByLine {
    LineOfMap of;                  ///< the line, and where in the map it is
    Response response;             ///< at the map's displacements, or the line's where loads were asked for
    std::vector<int> last_contact; ///< nodes of the line that touch at the last load step
    double bound; ///< error_bounds.hpp, of pressures and secants; infinite where there is none
};
/// Presses the line of a map that repeats (a free map is no endless ridge). The bound is pressure_bounds():
/// it rests on a capacitary pressure that is nowhere negative, proven of the continuum, not of sampled maps.
/// Nothing where the line cannot be pressed as far as the map.
std::optional<ByLine> respond_by_line(const Profile& map, const Model& model);

} // namespace rough
