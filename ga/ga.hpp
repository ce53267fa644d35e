#pragma once

/// @file
/// The whole engine except refinement (ga/refinement/refinement.hpp), operators that learn and niches
/// (ga/adaptation/adaptation.hpp), text (ga/text/), checkpoints and observers.
#include "ga/blocks/islands.hpp"
#include "ga/blocks/pair.hpp"
#include "ga/blocks/repeat.hpp"
#include "ga/pareto/many_objectives.hpp"
#include "ga/pipeline/run.hpp"
#include "ga/pipeline/score.hpp"
#include "ga/pipeline/transform.hpp"
#include "ga/replacement/replacement.hpp"
#include "ga/selection/selection.hpp"
#include "ga/variation/sample.hpp"

/// The engine of genetic algorithms: a population passes through stages. It does not depend on a domain.
namespace ga {}
