#pragma once

// The whole engine.
#include "ga/pair.hpp"
#include "ga/problem.hpp"
#include "ga/refinement/refine.hpp"
#include "ga/repeat.hpp"
#include "ga/run.hpp"
#include "ga/score.hpp"
#include "ga/selection/above.hpp"
#include "ga/selection/best.hpp"
#include "ga/transform.hpp"
