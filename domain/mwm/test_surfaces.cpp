#include "domain/mwm/test_surfaces.hpp"

#include <cmath>
#include <numbers>

namespace rough {

namespace {

constexpr double turn = 2 * std::numbers::pi;

constexpr double golden_angle = 2.399963; // its multiples fill the turn evenly and never repeat

double drawn(const Uniform& uniform, double from, double to) { return from < to ? uniform(from, to) : from; }

} // namespace

Genome random_genome(const Uniform& uniform, int series, std::size_t ridges, double length, double shortest,
                     const SeriesLaw& law) {
    Genome genome;
    for (int s = 0; s < series; ++s) {
        Series one{drawn(uniform, law.A_from, law.A_to),
                   drawn(uniform, law.H_from, law.H_to),
                   drawn(uniform, law.gamma_from, law.gamma_to),
                   length,
                   {}};
        for (int n = 1; n <= last_chromosome(length, one.gamma, shortest); ++n) {
            one.chromosomes.push_back({n, std::vector<double>(ridges)});
            for (double& phase : one.chromosomes.back().phases)
                phase = uniform(0, turn);
        }
        genome.series.push_back(one);
    }
    return genome;
}

std::vector<Wave> self_affine_waves(double length, double amplitude, double hurst, double ratio, int count,
                                    bool periodic) {
    std::vector<Wave> waves;
    for (int n = 0; n < count; ++n) {
        const double number = std::pow(ratio, n);
        waves.push_back({-amplitude * std::pow(ratio, -n * hurst),
                         turn * (periodic ? std::floor(number) : number) / length, golden_angle * n, 0});
    }
    return waves;
}

std::vector<Wave> brownian_waves(double length, double amplitude, double hurst, int count) {
    std::vector<Wave> waves;
    for (int n = 1; n <= count; ++n)
        waves.push_back({-amplitude * std::pow(n, -(hurst + 0.5)), turn * n / length,
                         golden_angle * (n - 1) * (n - 1), 0}); // squares: the crests meet nowhere
    return waves;
}

double height_at(const std::vector<Wave>& waves, double x) {
    double height = 0;
    for (const Wave& wave : waves)
        height -= wave.amplitude * std::cos(wave.wave_number * x + wave.phase);
    return height;
}

Profile sampled(const Grid& grid, const std::function<double(double)>& height) {
    Profile profile{Eigen::VectorXd(grid.nodes), grid.spacing()};
    for (Index i = 0; i < grid.nodes; ++i)
        profile.heights[i] = height(static_cast<double>(i) * profile.spacing);
    return profile;
}

} // namespace rough
