#pragma once

#include "domain/response/response.hpp"
#include "ga/problem/problem.hpp"

namespace rough {

/// The time of one contact curve relative to that of another model, by a table that was measured once
/// (tests/benchmarks/prices.cpp). It depends on the numbers of nodes and of load steps, and on whether the
/// surface is a map, never on a clock.
double relative_price(const Model& model, const Model& unit);

/// Names and prices of the levels of a design (namespace level) in curves of `unit`. `points` is the number of points
/// of all targets, `draws` that of common errors of the level `made`; `smooth_area`: whether contact fractions are
/// smooth (DesignSetup).
std::vector<ga::LevelPrice> level_prices(const Model& model, const Model& unit, int points, std::size_t draws,
                                         bool smooth_area);

} // namespace rough
