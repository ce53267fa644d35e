#pragma once

/// @file
/// The whole engine but refinement (ga/refinement/refinement.hpp), operators that learn and niches
/// (ga/adaptation/adaptation.hpp), text (ga/text/), checkpoints and observers.
#include "ga/blocks/islands.hpp"
#include "ga/blocks/pair.hpp"
#include "ga/blocks/repeat.hpp"
#include "ga/blocks/restarts.hpp"
#include "ga/pareto/pareto.hpp"
#include "ga/pipeline/average.hpp"
#include "ga/pipeline/run.hpp"
#include "ga/pipeline/score.hpp"
#include "ga/pipeline/transform.hpp"
#include "ga/replacement/elite.hpp"
#include "ga/replacement/plus.hpp"
#include "ga/selection/above.hpp"
#include "ga/selection/best.hpp"
#include "ga/selection/proportional.hpp"
#include "ga/selection/random.hpp"
#include "ga/selection/tournament.hpp"
#include "ga/variation/blend.hpp"
#include "ga/variation/mutations.hpp"
#include "ga/variation/order.hpp"
#include "ga/variation/points.hpp"
#include "ga/variation/sample.hpp"
#include "ga/variation/simulated_binary.hpp"
#include "ga/variation/uniform.hpp"

/// The engine of genetic algorithms: a population flows through stages, whatever the domain. Includes nothing
/// of any domain.
namespace ga {}
