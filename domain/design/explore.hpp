#pragma once

#include "domain/design/options.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/json.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/hall_of_fame.hpp"

namespace rough {

constexpr std::size_t max_compromises = 24; ///< largest number of genomes of a Pareto front that is returned

/// A run of a pipeline on a design problem with any type of genome, and the genomes to verify after it.
template <ga::Problem P>
struct Exploration {
    using Genome = typename P::Genome; ///< genome of the problem

    ga::HallOfFame<P> seen;             ///< best individuals of all stages
    ga::HallOfFame<P> verified;         ///< best under the objective that verifies
    ga::Population<Genome> population;  ///< final
    std::vector<Genome> front = {};     ///< the last Pareto front of a ranking by several objectives
    std::optional<Genome> nearest = {}; ///< best genome of the last population under a derived problem
    SearchRun spent = {};               ///< cost and remarks of the pipeline
    std::string nothing = {};           ///< why the run could not continue; otherwise empty

    /// Keeps the best 60 individuals, and the best `max_verified` under the objective `verifies`.
    Exploration(const P& problem, std::size_t max_verified, const std::string& verifies)
        : seen(problem, 60), verified(problem, max_verified, verifies), problem_(problem) {}

    /// Runs the pipeline from the starts for `seconds`. Version and task identify its checkpoints.
    void run(const ga::Pipeline<P>& pipeline, const std::string& name, const std::vector<Genome>& starts,
             const SearchOptionsOf<P>& options, double seconds, std::vector<ga::Observer<Genome>> observers) {
        observers.insert(observers.begin(), {[this](const ga::Event<Genome>& event) { observe(event); },
                                             verified.observer(), seen.observer()});
        std::optional<ga::Checkpoints<P>> checkpoints;
        if (options.checkpoints) {
            checkpoints.emplace(options.checkpoints->file,
                                RUGOSA_VERSION " " + json_text(description(problem_.setup()), true) +
                                    options.checkpoints->inputs,
                                options.checkpoints->resume, options.checkpoints->interval);
            checkpoints->keep("seen", seen.members);
            checkpoints->keep("verified", verified.members);
            checkpoints->keep("front", front);
            if (options.checkpoints->add_values) options.checkpoints->add_values(*checkpoints);
        }
        const ga::RunOptions run{.variant = name,
                                 .seed = options.seed,
                                 .threads = options.threads,
                                 .budget = {options.evaluations, seconds, options.stop}};
        ga::OnThreads<P> on_threads(options.threads);
        auto found = ga::run_by(options.evaluator ? *options.evaluator : on_threads, pipeline, problem_,
                                ga::population(starts), run, observers, checkpoints ? &*checkpoints : nullptr);
        for (const auto& individual : found.population) seen.offer(individual);
        if (found.best) seen.offer(*found.best);
        if (found.is_dead_end) nothing = found.stopped;
        population = std::move(found.population);
        spent = {name, pipeline.text(), found.counters, found.notes, found.stopped};
    }

    /// Adds a genome with this similarity to the best of all stages.
    void offer(const Genome& genome, double similarity) {
        seen.offer({genome, 0, {}, ga::Fitness(ga::Name("similarity"), similarity), nullptr});
    }

    /// The best individuals of all stages, then those of the final population, that differ from `answer` and
    /// each other by at least `different`. Each has its smallest difference from those before it. `view`
    /// makes a view of a genome, and `difference` compares two views. `max_count` counts the answer, too.
    template <class View, class Difference>
    std::vector<std::pair<Genome, double>> others_than(const Genome& answer, std::size_t max_count, double different,
                                                       View view, Difference difference) const {
        std::vector views{view(answer)};
        std::vector<std::pair<Genome, double>> others;
        ga::Population<Genome> all = seen.members;
        if (ga::comparable(population)) all.insert(all.end(), population.begin(), population.end());
        for (const auto& kept : all) {
            if (views.size() >= max_count || kept.value() < -1) break;
            auto candidate = view(kept.genome);
            double smallest = 2;
            for (const auto& other : views) smallest = std::min(smallest, difference(candidate, other));
            if (smallest < different) continue;
            others.emplace_back(kept.genome, smallest);
            views.push_back(std::move(candidate));
        }
        return others;
    }

  private:
    void observe(const ga::Event<Genome>& event) {
        if (event.population.empty() || !ga::comparable(event.population)) return;
        if (event.derived) {
            nearest = ga::best_of(event.population, 1).front().genome;
            return;
        }
        std::vector<Genome> ranked; // several objectives: by `pareto`
        for (const auto& individual : ga::front_of(event.population))
            if (individual.fitness.several()) ranked.push_back(individual.genome);
        if (!ranked.empty()) front = std::move(ranked);
    }

    const P& problem_;
};

} // namespace rough
