#pragma once

/// @file
/// Operators that learn from one generation to the next, and operators that keep niches. They need Eigen and
/// nlohmann's JSON.
#include "ga/adaptation/cma_es.hpp"
#include "ga/adaptation/epsilon.hpp"
#include "ga/adaptation/l_shade.hpp"
#include "ga/adaptation/self_adaptive.hpp"
#include "ga/niches/map_elites.hpp"
#include "ga/niches/niches.hpp"
