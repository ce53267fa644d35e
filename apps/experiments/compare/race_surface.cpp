#include "apps/experiments/compare/benchmarks.hpp"
#include "domain/design/search.hpp"

namespace app {

void expect_fits(const rough::DesignSetup& setup, const std::string& variant) {
    rough::expect_searchable(setup, variant);
}

Reached raced(const rough::DesignSetup& setup, const std::string& variant, const std::vector<double>& targets,
              const Attempt& attempt) {
    Tally tally(targets, attempt);
    rough::SearchOptions options;
    options.pipeline = variant;
    options.seed = attempt.seed;
    options.threads = 1;
    options.evaluations = attempt.budget;
    options.stop = &tally.over();
    options.alternatives = options.verifying = 1;
    const ga::Name similarity("similarity");
    const auto watch = [&](const ga::Event<rough::Genome>& event) {
        double best = -HUGE_VAL;
        for (const auto& individual : event.population)
            if (individual.fitness.known(similarity) && !individual.fitness.has_failed())
                best = std::max(best, individual.fitness.value());
        tally.note(std::min(attempt.budget, event.counters.asked), 1 - best);
    };
    const rough::SearchResult found = rough::search(setup, options, {watch});
    tally.note(std::min(attempt.budget, found.counters.asked), 1 - found.best.similarity);
    return tally.reached();
}

} // namespace app
