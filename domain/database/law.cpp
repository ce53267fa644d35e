#include "domain/database/law.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "ga/random.hpp"

#include <cmath>
#include <numbers>

namespace rough {
namespace {

void expect(bool good, const std::string& what) {
    if (!good)
        throw InputError("genome law: " + what);
}

} // namespace

void validate(const GenomeLaw& law) {
    expect(law.series >= 1 && law.series <= 16,
           "series " + std::to_string(law.series) + ", expected 1 to 16");
    expect(law.ridges >= 1 && law.ridges <= 1000,
           "ridges " + std::to_string(law.ridges) + ", expected 1 to 1000");
    expect(std::isfinite(law.H_from) && law.H_from <= law.H_to && std::isfinite(law.H_to),
           "H from " + std::to_string(law.H_from) + " to " + std::to_string(law.H_to) + ", expected a range");
    expect(law.gamma_from > 1 && law.gamma_from <= law.gamma_to && std::isfinite(law.gamma_to),
           "gamma from " + std::to_string(law.gamma_from) + " to " + std::to_string(law.gamma_to) +
               ", expected a range above 1");
    expect(law.shortest > 0 && law.shortest <= law.lambda && std::isfinite(law.lambda),
           "waves from " + std::to_string(law.shortest) + " to " + std::to_string(law.lambda) +
               " mm, expected a range above 0");
}

Genome drawn(const GenomeLaw& law, std::uint64_t index) {
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
