#pragma once

#include "apps/experiments/compare/race.hpp"

namespace app {

/// What libpagmo can be compared by, where rugosa was built with it: pagmo:cmaes, pagmo:cmaes-bounded,
/// pagmo:de, pagmo:sade and pagmo:sga.
const std::vector<std::string>& pagmo_variants();

/// Whether a variant's text names one of libpagmo's.
bool is_pagmos(const std::string& variant);

/// Throws ga::UsageError on a name that is none of pagmo_variants, or a problem of several objectives.
void expect_pagmos(const RealInstance& instance, const std::string& variant);

/// The same as raced, by libpagmo's algorithm with its own defaults; it ends by tolerances of 1e-12, and then
/// begins anew. Its population: 4 + 3 ln n of cmaes (Hansen), 5 at least; otherwise 20, of sga 40.
Reached raced_by_pagmo(const RealInstance& instance, const std::string& variant,
                       const std::vector<double>& targets, const Attempt& attempt);

} // namespace app
