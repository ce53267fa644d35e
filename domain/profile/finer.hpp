#pragma once

#include "domain/profile/profile.hpp"

namespace rough {

/// How heights between nodes are taken to run.
enum class Interpolation {
    linear, ///< straight, on a map bilinear
    spline, ///< cubic spline, on a map along x and then along y
};

/// A surface on `times` (>= 1) elements for each of its own along each axis: times (N-1) + 1 nodes, or times
/// N if it is `periodic`. The nodes of the surface keep their heights. Splines end with the slope of the
/// parabola through the last three nodes, so that a jump at the ends of a surface that is periodic does not
/// make them swing: between its last node and its first one the heights are linear. Along an axis of two
/// nodes a spline is linear.
Profile finer(const Profile& surface, Index times, Interpolation by, bool periodic = false);

} // namespace rough
