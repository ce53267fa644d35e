#pragma once

#include "apps/experiments/compare/race.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace app {

/// Things to pack, drawn by a seed: whole weights and values of 1 to 100, a value within 20 of its weight
/// (Pisinger's weakly correlated kind), half of all weight allowed.
struct Knapsack {
    std::vector<int> weights, values;
    int capacity = 0;

    Knapsack(std::size_t things, std::uint64_t seed);
    int best() const; ///< the most that can be packed, by dynamic programming
};
/// To be packed; the precision is relative.
BitsInstance knapsack_instance(std::size_t things, std::uint64_t seed);

using Town = std::array<double, 2>;

/// Towns drawn uniformly in the unit square.
std::vector<Town> scattered_towns(std::size_t count, std::uint64_t seed);
/// Towns evenly round a circle of radius 1, numbered at random: the shortest tour is the polygon.
std::vector<Town> towns_on_circle(std::size_t count, std::uint64_t seed);
/// Length of a closed tour.
double tour_length(const std::vector<Town>& towns, const std::vector<std::uint32_t>& order);
/// The shortest there is, by dynamic programming over sets (Held and Karp 1962); up to 16 towns.
double shortest_tour(const std::vector<Town>& towns);

/// A tour of scattered towns (up to 16) or of those on a circle; the precision is relative.
TourInstance scattered_instance(std::size_t count, std::uint64_t seed);
TourInstance circle_instance(std::size_t count, std::uint64_t seed);

/// Test problems of several objectives whose front is known: zdt1 to zdt4 and zdt6 of two (Zitzler, Deb and
/// Thiele 2000), dtlz1, dtlz2 and dtlz7 of three (Deb, Thiele, Laumanns and Zitzler 2005), with as many genes
/// as there.
const std::vector<std::string>& front_problems();

/// One of them by name.
RealInstance front_instance(const std::string& name);

} // namespace app
