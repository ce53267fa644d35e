#include "experiments/compare/problems/problems.hpp"

#include <numbers>

namespace app {

namespace {

double distance(const Town& a, const Town& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

TourInstance tour_instance(std::vector<Town> towns, double best) {
    TourInstance instance;
    instance.genes = towns.size();
    instance.best = instance.scale = best;
    instance.evaluate = [towns = std::move(towns)](const ga::Permutation& tour) {
        return Evaluation{{tour_length(towns, tour.order)}};
    };
    return instance;
}

/// The highest value of things that fit together, by dynamic programming.
int best_packing(const std::vector<int>& weights, const std::vector<int>& values, int capacity) {
    std::vector<int> highest(static_cast<std::size_t>(capacity) + 1, 0); // value for each total weight
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const auto weight = static_cast<std::size_t>(weights[i]);
        for (auto room = highest.size(); room-- > weight;)
            highest[room] = std::max(highest[room], highest[room - weight] + values[i]);
    }
    return highest.back();
}

} // namespace

BitsInstance knapsack_instance(std::size_t things, std::uint64_t seed) {
    ga::Stream stream(seed);
    std::vector<int> weights, values;
    for (std::size_t i = 0; i < things; ++i) {
        weights.push_back(1 + static_cast<int>(stream.below(100)));
        values.push_back(std::clamp(weights.back() - 20 + static_cast<int>(stream.below(41)), 1, 100));
    }
    const int capacity = std::accumulate(weights.begin(), weights.end(), 0) / 2;
    BitsInstance instance;
    instance.genes = things;
    instance.scale = best_packing(weights, values, capacity);
    instance.best = -instance.scale;
    instance.evaluate = [weights, values, capacity](const std::vector<bool>& taken) {
        int excess = -capacity, value = 0;
        for (std::size_t i = 0; i < taken.size(); ++i)
            if (taken[i]) {
                excess += weights[i];
                value += values[i];
            }
        return Evaluation{{static_cast<double>(-value)}, {static_cast<double>(std::max(0, excess))}};
    };
    return instance;
}

std::vector<Town> scattered_towns(std::size_t count, std::uint64_t seed) {
    ga::Stream stream(seed);
    std::vector<Town> towns(count);
    for (Town& town : towns)
        town = {stream.uniform(), stream.uniform()};
    return towns;
}

std::vector<Town> towns_on_circle(std::size_t count, std::uint64_t seed) {
    ga::Stream stream(seed);
    std::vector<Town> towns;
    for (const std::uint32_t place : ga::Permutation::random(count, stream)) {
        const double angle = 2 * std::numbers::pi * place / static_cast<double>(count);
        towns.push_back({std::cos(angle), std::sin(angle)});
    }
    return towns;
}

double tour_length(const std::vector<Town>& towns, const std::vector<std::uint32_t>& order) {
    double length = distance(towns[order.back()], towns[order.front()]);
    for (std::size_t i = 1; i < order.size(); ++i)
        length += distance(towns[order[i - 1]], towns[order[i]]);
    return length;
}

double shortest_tour(const std::vector<Town>& towns) {
    const std::size_t others = towns.size() - 1; // the last town begins and ends
    std::vector<std::vector<double>> paths(std::size_t{1} << others, std::vector<double>(others, HUGE_VAL));
    for (std::size_t i = 0; i < others; ++i)
        paths[std::size_t{1} << i][i] = distance(towns[others], towns[i]);
    for (std::size_t seen = 1; seen < paths.size(); ++seen) // paths[seen][i]: shortest through `seen` to i
        for (std::size_t i = 0; i < others; ++i)
            if (std::isfinite(paths[seen][i]))
                for (std::size_t next = 0; next < others; ++next)
                    if (!(seen >> next & 1)) {
                        double& further = paths[seen | std::size_t{1} << next][next];
                        further = std::min(further, paths[seen][i] + distance(towns[i], towns[next]));
                    }
    double shortest = HUGE_VAL;
    for (std::size_t i = 0; i < others; ++i)
        shortest = std::min(shortest, paths.back()[i] + distance(towns[i], towns[others]));
    return shortest;
}

TourInstance scattered_instance(std::size_t count, std::uint64_t seed) {
    const std::vector<Town> towns = scattered_towns(count, seed);
    return tour_instance(towns, shortest_tour(towns));
}

TourInstance circle_instance(std::size_t count, std::uint64_t seed) {
    const double n = static_cast<double>(count);
    return tour_instance(towns_on_circle(count, seed), 2 * n * std::sin(std::numbers::pi / n));
}

} // namespace app
