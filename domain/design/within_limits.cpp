#include "domain/design/within_limits.hpp"

#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/mwm/length_scales.hpp"

#include <algorithm>

namespace rough {

namespace {

const char* const to_limits = "score | refine lm 40 | best 1";

/// Without its shortest wave; nothing of a genome with one wave alone.
std::optional<Genome> without_shortest(const Genome& genome) {
    const auto scales = length_scales(genome);
    if (scales.size() < 2)
        return std::nullopt;
    const auto shortest =
        std::max_element(scales.begin(), scales.end(), [](const LengthScale& a, const LengthScale& b) {
            return a.wave_number < b.wave_number;
        });
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return std::find(shortest->members.begin(), shortest->members.end(), std::pair(s, c)) ==
               shortest->members.end();
    });
}

/// The genome without so many of its shortest waves that it exceeds the limits least.
Genome least_in_excess(const DesignProblem& problem, Genome genome) {
    Genome best = genome;
    double least = problem.evaluate(genome).excess;
    try {
        for (auto next = without_shortest(genome); next && least > 0; next = without_shortest(*next)) {
            const Genome fitted = with_fitting_amplitude(problem.setup(), *next);
            const double excess = problem.evaluate(fitted).excess;
            if (excess < least)
                best = fitted, least = excess;
        }
    } catch (const std::exception&) { // what is left has no answer to the load: those before it stand
    }
    return best;
}

} // namespace

std::optional<Genome> brought_within(const DesignProblem& problem, const std::vector<Genome>& genomes,
                                     const ga::RunOptions& run, ga::Counters& spent) {
    std::vector<Genome> starts = genomes;
    starts.resize(2 * genomes.size());
    try {
        ga::parallel_for(genomes.size(), ga::thread_count(run.threads), [&](std::size_t i) {
            starts[genomes.size() + i] = least_in_excess(problem, genomes[i]);
        });
    } catch (const ga::Stopped&) { // no time is left
        return std::nullopt;
    }
    const auto found =
        ga::run(design_pipeline(problem.setup(), to_limits), problem, ga::population(starts), run);
    spent.evaluations += found.counters.evaluations;
    spent.gradients += found.counters.gradients;
    if (!found.best || !holds_limits(problem.setup(), folded(found.best->genome)))
        return std::nullopt;
    return found.best->genome;
}

} // namespace rough
