// morph [NODES [SEED]]: a process drifts 1,000 times and is corrected each time. Every phase and amplitude of
// a surface of two series drifts about its nominal value. Then the phases of four chromosomes are changed as
// little as restores the response. They are those with the largest effect on the target. Prints the time of
// one morph, and the similarity before and after.

#include "domain/design/morph.hpp"

#include "domain/numerics/statistics.hpp"
#include "tests/benchmarks/measure.hpp"

#include <cstdio>
#include <cstdlib>
#include <numbers>

using namespace rough;

namespace {

Genome surface(double shortest) {
    ga::Stream random(7);
    Genome genome{1e-3, {}};
    for (const double gamma : {1.5, 1.7}) {
        Series series{1, 0.9, gamma, standard_length, {}};
        for (int n = 1; n <= last_chromosome(standard_length, gamma, shortest); ++n)
            series.chromosomes.push_back({n, {random.uniform(0, 2 * std::numbers::pi)}});
        genome.series.push_back(std::move(series));
    }
    return genome;
}

/// The chromosomes whose phases move the curve most, the greatest first.
std::vector<ChromosomeName> felt_most(const DesignSetup& setup, const Genome& genome, std::size_t count) {
    const ga::Sensitivity rows = DesignProblem(setup).sensitivity(genome, "similarity");
    const auto places = gene_places(genome);
    std::vector<std::pair<double, ChromosomeName>> felt;
    for (std::size_t g = 0; g < places.size(); ++g)
        if (places[g].kind == GenePlace::Kind::phase)
            felt.push_back({-rows.jacobian.col(static_cast<Index>(g)).norm(),
                            {places[g].series + 1,
                             genome.series[places[g].series].chromosomes[places[g].chromosome].n}});
    std::sort(felt.begin(), felt.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<ChromosomeName> names;
    for (std::size_t i = 0; i < std::min(count, felt.size()); ++i)
        names.push_back(felt[i].second);
    return names;
}

} // namespace

int main(int count, char** arguments) {
    DesignSetup setup{.model = completed({.grid = {count > 1 ? std::atoi(arguments[1]) : 512}})};
    const Genome wanted = surface(8 * setup.model.grid.spacing());
    setup.targets = {target_like(sample(wanted, setup.model.grid), setup.model, "wanted")};
    const auto control = felt_most(setup, wanted, 4);
    std::printf("%d nodes, controlled:", static_cast<int>(setup.model.grid.nodes));
    for (const auto& name : control)
        std::printf(" %d:%d", static_cast<int>(name.series), name.n);

    ga::Stream random(count > 2 ? static_cast<std::uint64_t>(std::atoi(arguments[2])) : 1);
    const auto own = genes(wanted);
    const auto places = gene_places(wanted);
    auto now = own;
    std::vector<double> seconds, before, after, change, gradients;
    constexpr int drifts = 1000;
    for (int drift = 0; drift < drifts; ++drift) {
        for (std::size_t g = 0; g < now.size(); ++g) { // Ornstein and Uhlenbeck's wandering
            const double size = places[g].kind == GenePlace::Kind::phase ? 0.02
                                : places[g].kind == GenePlace::Kind::A   ? 0.005 * own[g]
                                                                         : 0;
            now[g] += -0.1 * (now[g] - own[g]) + size * random.normal();
        }
        const double start = testing::processor_seconds();
        const Morphed back = morph(setup, with_genes(wanted, now), control, 0.05);
        seconds.push_back(testing::processor_seconds() - start);
        before.push_back(back.before);
        after.push_back(back.after);
        gradients.push_back(static_cast<double>(back.gradients));
        double sum = 0;
        for (const PhaseChange& one : back.changes)
            sum += (one.after - one.before) * (one.after - one.before);
        change.push_back(std::sqrt(sum));
        for (const PhaseChange& one : back.changes) // the process continues from the morphed surface
            for (std::size_t g = 0; g < places.size(); ++g)
                if (places[g].kind == one.place.kind && places[g].series == one.place.series &&
                    places[g].chromosome == one.place.chromosome && places[g].ridge == one.place.ridge)
                    now[g] = one.after;
    }
    std::printf("\n%-28s %10s %10s %10s\n", "", "median", "5 %", "95 %");
    for (const auto& [name, values, factor] :
         {std::tuple("milliseconds a morph", &seconds, 1e3),
          std::tuple("curves with gradients", &gradients, 1.), std::tuple("similarity before", &before, 1.),
          std::tuple("similarity after", &after, 1.), std::tuple("change, rad", &change, 1.)})
        std::printf("%-28s %10.4f %10.4f %10.4f\n", name, factor * median(*values),
                    factor * quantile(*values, 0.05), factor * quantile(*values, 0.95));
    const auto met = [](const std::vector<double>& values) {
        return std::count_if(values.begin(), values.end(),
                             [](double s) { return s >= default_required_similarity; });
    };
    std::printf("at %g or more: %d of %d before, %d after\n", default_required_similarity,
                static_cast<int>(met(before)), drifts, static_cast<int>(met(after)));
}
