#include "domain/mwm/sobol.hpp"

#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>

#include <numbers>

namespace rough {
namespace {

/// `count` points of the Sobol sequence in [0,1)^dimension. Its first point is the middle, as Boost omits the
/// origin; it is skipped.
std::vector<std::vector<double>> sobol_points(int dimension, int count) {
    boost::random::sobol engine(static_cast<std::size_t>(dimension));
    boost::random::uniform_01<double> uniform;
    std::vector points(static_cast<std::size_t>(count) + 1, std::vector<double>(static_cast<std::size_t>(dimension)));
    for (std::vector<double>& point : points) std::ranges::generate(point, [&] { return uniform(engine); });
    points.erase(points.begin());
    return points;
}

} // namespace

std::vector<std::pair<double, double>> sobol_pairs(const DatabaseLayout& layout) {
    std::vector<std::pair<double, double>> pairs;
    for (const auto& u : sobol_points(2, layout.pairs))
        pairs.emplace_back(layout.H_from + (layout.H_to - layout.H_from) * u[0],
                           layout.gamma_from + (layout.gamma_to - layout.gamma_from) * u[1]);
    return pairs;
}

std::vector<std::vector<double>> sobol_phases(int columns, int last) {
    auto phases = sobol_points(columns, last);
    for (auto& row : phases)
        for (double& value : row) value *= 2 * std::numbers::pi;
    return phases;
}

std::vector<Genome> sobol_database(const DatabaseLayout& layout) {
    const auto pairs = sobol_pairs(layout);
    int longest = 0;
    for (const auto& [H, gamma] : pairs)
        longest = std::max(longest, last_chromosome(layout.lambda, gamma, layout.shortest));
    const auto phases = sobol_phases(layout.phase_columns * layout.ridges, longest);

    std::vector<Genome> genomes;
    for (const auto& [H, gamma] : pairs)
        for (std::size_t column = 0; column < static_cast<std::size_t>(layout.phase_columns); ++column) {
            Series series{layout.A, H, gamma, layout.lambda, {}};
            for (int n = 1; n <= last_chromosome(layout.lambda, gamma, layout.shortest); ++n) {
                const auto first = phases[static_cast<std::size_t>(n - 1)].begin() +
                                   static_cast<std::ptrdiff_t>(column) * layout.ridges;
                series.chromosomes.push_back({n, {first, first + layout.ridges}});
            }
            genomes.push_back({1, {series}});
        }
    return genomes;
}

} // namespace rough
