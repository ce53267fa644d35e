#include "experiments/compare/problems/problems.hpp"

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
    for (Town& town : towns) town = {stream.uniform(), stream.uniform()};
    return towns;
}

double tour_length(const std::vector<Town>& towns, const std::vector<std::uint32_t>& order) {
    double length = distance(towns[order.back()], towns[order.front()]);
    for (std::size_t i = 1; i < order.size(); ++i) length += distance(towns[order[i - 1]], towns[order[i]]);
    return length;
}

double shortest_tour(const std::vector<Town>& towns) {
    const std::size_t others = towns.size() - 1; // the last town begins and ends
    std::vector<std::vector<double>> paths(std::size_t{1} << others, std::vector<double>(others, HUGE_VAL));
    for (std::size_t i = 0; i < others; ++i) paths[std::size_t{1} << i][i] = distance(towns[others], towns[i]);
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

TourInstance berlin_instance() {
    static constexpr int coordinates[52][2] = {
        {565, 575},   {25, 185},   {345, 750},  {945, 685},  {845, 655},  {880, 660}, {25, 230},  {525, 1000},
        {580, 1175},  {650, 1130}, {1605, 620}, {1220, 580}, {1465, 200}, {1530, 5},  {845, 680}, {725, 370},
        {145, 665},   {415, 635},  {510, 875},  {560, 365},  {300, 465},  {520, 585}, {480, 415}, {835, 625},
        {975, 580},   {1215, 245}, {1320, 315}, {1250, 400}, {660, 180},  {410, 250}, {420, 555}, {575, 665},
        {1150, 1160}, {700, 580},  {685, 595},  {685, 610},  {770, 610},  {795, 645}, {720, 635}, {760, 650},
        {475, 960},   {95, 260},   {875, 920},  {700, 500},  {555, 815},  {830, 485}, {1170, 65}, {830, 610},
        {605, 625},   {595, 360},  {1340, 725}, {1740, 245}};
    TourInstance instance;
    instance.genes = 52;
    instance.best = instance.scale = 7542;
    instance.evaluate = [](const ga::Permutation& tour) {
        double length = 0;
        for (std::size_t i = 0; i < 52; ++i) {
            const auto &a = coordinates[tour.order[i]], &b = coordinates[tour.order[(i + 1) % 52]];
            length += std::floor(std::hypot(a[0] - b[0], a[1] - b[1]) + 0.5);
        }
        return Evaluation{{length}};
    };
    return instance;
}

TourInstance grid_instance(std::size_t side) {
    std::vector<Town> towns;
    for (std::size_t i = 0; i < side * side; ++i)
        towns.push_back({static_cast<double>(i / side), static_cast<double>(i % side)});
    return tour_instance(towns, static_cast<double>(side * side));
}

TourInstance job_shop_instance() {
    constexpr std::size_t jobs = 10, machines = 10;
    static constexpr std::array<int, 2> steps[jobs][machines] = {
        // machine and time, in each job's order
        {{0, 29}, {1, 78}, {2, 9}, {3, 36}, {4, 49}, {5, 11}, {6, 62}, {7, 56}, {8, 44}, {9, 21}},
        {{0, 43}, {2, 90}, {4, 75}, {9, 11}, {3, 69}, {1, 28}, {6, 46}, {5, 46}, {7, 72}, {8, 30}},
        {{1, 91}, {0, 85}, {3, 39}, {2, 74}, {8, 90}, {5, 10}, {7, 12}, {6, 89}, {9, 45}, {4, 33}},
        {{1, 81}, {2, 95}, {0, 71}, {4, 99}, {6, 9}, {8, 52}, {7, 85}, {3, 98}, {9, 22}, {5, 43}},
        {{2, 14}, {0, 6}, {1, 22}, {5, 61}, {3, 26}, {4, 69}, {8, 21}, {7, 49}, {9, 72}, {6, 53}},
        {{2, 84}, {1, 2}, {5, 52}, {3, 95}, {8, 48}, {9, 72}, {0, 47}, {6, 65}, {4, 6}, {7, 25}},
        {{1, 46}, {0, 37}, {3, 61}, {2, 13}, {6, 32}, {5, 21}, {9, 32}, {8, 89}, {7, 30}, {4, 55}},
        {{2, 31}, {0, 86}, {1, 46}, {5, 74}, {4, 32}, {6, 88}, {8, 19}, {9, 48}, {7, 36}, {3, 79}},
        {{0, 76}, {1, 69}, {3, 76}, {5, 51}, {2, 85}, {9, 11}, {6, 40}, {7, 89}, {4, 26}, {8, 74}},
        {{1, 85}, {0, 13}, {2, 61}, {6, 7}, {8, 64}, {9, 76}, {5, 47}, {3, 52}, {4, 90}, {7, 45}}};
    TourInstance instance;
    instance.genes = jobs * machines;
    instance.best = instance.scale = 930;
    instance.evaluate = [](const ga::Permutation& priorities) {
        std::array<std::size_t, jobs * machines> urgency{};
        for (std::size_t i = 0; i < priorities.size(); ++i) urgency[priorities.order[i]] = i;
        std::array<std::size_t, jobs> next{};
        std::array<int, jobs> ready{};    // when a job's previous step ends
        std::array<int, machines> free{}; // when a machine's previous step ends
        for (std::size_t step = 0; step < jobs * machines; ++step) {
            const auto machine_of = [&](std::size_t j) { return static_cast<std::size_t>(steps[j][next[j]][0]); };
            const auto begin_of = [&](std::size_t j) { return std::max(ready[j], free[machine_of(j)]); };
            std::size_t first = jobs; // the job whose step can end first
            int end = 0;
            for (std::size_t j = 0; j < jobs; ++j)
                if (next[j] < machines)
                    if (const int ends = begin_of(j) + steps[j][next[j]][1]; first == jobs || ends < end)
                        first = j, end = ends;
            const std::size_t machine = machine_of(first);
            std::size_t chosen = first; // the most urgent job that conflicts with it
            for (std::size_t j = 0; j < jobs; ++j)
                if (next[j] < machines && machine_of(j) == machine && begin_of(j) < end &&
                    urgency[j * machines + next[j]] < urgency[chosen * machines + next[chosen]])
                    chosen = j;
            ready[chosen] = free[machine] = begin_of(chosen) + steps[chosen][next[chosen]][1];
            ++next[chosen];
        }
        return Evaluation{{static_cast<double>(std::ranges::max(ready))}};
    };
    return instance;
}

} // namespace app
