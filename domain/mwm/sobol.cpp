#include "domain/mwm/sobol.hpp"

#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>

#include <algorithm>
#include <numbers>

namespace rough {

namespace {

/// Points of the Sobol sequence in [0,1)^dimension, its first point (the middle, as Boost leaves out the
/// origin) skipped or not.
class SobolPoints {
  public:
    SobolPoints(int dimension, bool with_first)
        : dimension_(dimension), engine_(static_cast<std::size_t>(dimension)) {
        if (!with_first)
            next();
    }
    std::vector<double> next() {
        std::vector<double> point;
        for (int i = 0; i < dimension_; ++i)
            point.push_back(boost::random::uniform_01<double>()(engine_));
        return point;
    }

  private:
    int dimension_;
    boost::random::sobol engine_;
};

} // namespace

std::vector<std::pair<double, double>> sobol_pairs(const DatabaseLayout& layout) {
    SobolPoints points(2, layout.with_first);
    std::vector<std::pair<double, double>> pairs;
    for (int i = 0; i < layout.pairs; ++i) {
        const auto u = points.next();
        pairs.emplace_back(layout.H_from + (layout.H_to - layout.H_from) * u[0],
                           layout.gamma_from + (layout.gamma_to - layout.gamma_from) * u[1]);
    }
    return pairs;
}

std::vector<std::vector<double>> sobol_phases(int columns, int last, bool with_first) {
    SobolPoints points(columns, with_first);
    std::vector<std::vector<double>> phases;
    for (int n = 1; n <= last; ++n) {
        auto row = points.next();
        for (double& value : row)
            value *= 2 * std::numbers::pi;
        phases.push_back(std::move(row));
    }
    return phases;
}

std::vector<Genome> sobol_database(const DatabaseLayout& layout) {
    const auto pairs = sobol_pairs(layout);
    int longest = 0;
    for (const auto& [H, gamma] : pairs)
        longest = std::max(longest, last_chromosome(layout.lambda, gamma, layout.shortest));
    const auto phases = sobol_phases(layout.phase_columns * layout.ridges, longest, layout.with_first);

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
