// A user's problem for the engine: find the wire, coil and number of turns of a helical spring that has a
// given stiffness and mass.
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <rugosa/ga.hpp>

struct Spring {
    using Genome = std::vector<double>;    // wire diameter, coil diameter (mm), turns
    using Outcome = std::array<double, 2>; // stiffness (N/mm), mass (g)

    Outcome evaluate(const Genome& g) const {
        const double d = g[0], D = g[1], n = g[2];
        const double stiffness = 79300 * std::pow(d, 4) / (8 * std::pow(D, 3) * n);
        const double mass = 7.85e-3 * std::numbers::pi * std::numbers::pi * d * d * D * n / 4;
        return {stiffness, mass};
    }
    const std::vector<ga::Objective<Outcome>>& objectives() const {
        static const std::vector<ga::Objective<Outcome>> list{
            {"fit", [](const Outcome& made) { return 1 - std::abs(made[0] / 5 - 1) - std::abs(made[1] / 40 - 1); }}};
        return list;
    }
};

int main() {
    std::vector<std::vector<double>> start;
    for (std::size_t i = 0; i < 500; ++i) {
        ga::Stream random(i);
        start.push_back({random.uniform(1, 5), random.uniform(10, 50), random.uniform(3, 20)});
    }
    const auto result = ga::run(ga::score() | ga::best(1), Spring{}, ga::population(start));
    const auto& best = result.population.front();
    std::cout << best.genome[0] << " " << best.genome[1] << " " << best.genome[2] << " " << best.value() << "\n";
}
