#include "domain/database/law.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "ga/base/random.hpp"

#include <cmath>
#include <numbers>

namespace rough {
namespace {

template <typename... Parts>
void expect(bool good, const Parts&... parts) {
    if (!good)
        refuse("genome law: ", parts...);
}

} // namespace

void validate(const GenomeDistribution& law) {
    expect(law.series >= 1 && law.series <= 16, "series ", law.series, ", expected 1 to 16");
    expect(law.ridges >= 1 && law.ridges <= 1000, "ridges ", law.ridges, ", expected 1 to 1000");
    expect(law.H_from > 0 && law.H_from <= law.H_to && std::isfinite(law.H_to), "H from ", law.H_from, " to ",
           law.H_to, ", expected a range above 0");
    expect(law.gamma_from > 1 && law.gamma_from <= law.gamma_to && std::isfinite(law.gamma_to), "gamma from ",
           law.gamma_from, " to ", law.gamma_to, ", expected a range above 1");
    expect(law.shortest > 0 && law.shortest <= law.lambda && std::isfinite(law.lambda), "waves from ",
           law.shortest, " to ", law.lambda, " mm, expected a range above 0");
    expect(most_phases(law) <= 1e6, "up to ", most_phases(law),
           " phases a genome, expected 1e6 at most (fewer series or ridges, or longer waves)");
}

double most_phases(const GenomeDistribution& law) {
    const double chromosomes = 1 + std::floor(std::log(law.lambda / law.shortest) / std::log(law.gamma_from));
    return law.series * static_cast<double>(law.ridges) * chromosomes;
}

Genome drawn(const GenomeDistribution& law, std::uint64_t index) {
    ga::Stream random(ga::fold(ga::fold(law.seed, "genome database"), index));
    Genome genome;
    for (int s = 0; s < law.series; ++s) {
        Series series;
        series.A = s == 0 ? 1 : 1 - random.uniform();
        series.H = random.uniform(law.H_from, law.H_to);
        series.gamma = random.uniform(law.gamma_from, law.gamma_to);
        series.lambda = law.lambda;
        const int last = last_chromosome(law.lambda, series.gamma, law.shortest);
        for (int n = 1; n <= last; ++n) {
            Chromosome chromosome{n, {}};
            for (int m = 0; m < law.ridges; ++m)
                chromosome.phases.push_back(random.uniform(0, 2 * std::numbers::pi));
            series.chromosomes.push_back(std::move(chromosome));
        }
        genome.series.push_back(std::move(series));
    }
    return genome;
}

} // namespace rough
