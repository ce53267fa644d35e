#pragma once

/// @file
/// Refinement by every method of the engine. It is not part of ga/ga.hpp, because it needs Eigen and NLopt.
#include "ga/refinement/levenberg_marquardt.hpp"
#include "ga/refinement/mma.hpp"
#include "ga/refinement/refine.hpp"
