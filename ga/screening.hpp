#pragma once

#include "ga/context.hpp"

namespace ga {

/// Leaves out of a population those whom the next stage would not keep, without evaluating them to the end:
/// every evaluation tells how good it can still become (Appraises), the most promising are worked on first,
/// and one that can no longer reach those already known is given up. Who is left, and with what fitness, is
/// just what scoring everybody would have given the next stage; what was evaluated for it is not paid twice.
/// The order of work depends on bounds alone, so the number of threads decides nothing.
template <Appraises P>
class Screening {
  public:
    using Genome = typename P::Genome;   ///< of the problem
    using Outcome = typename P::Outcome; ///< of the problem

    /// By this objective (a place in the problem's list), for a stage that keeps so many.
    Screening(Context<P>& context, std::size_t objective, Demand demand)
        : context_(context), which_(objective), objective_(context.problem().objectives()[objective]),
          name_(objective_.name), demand_(in_numbers(demand, context)), floor_(demand_) {}

    /// The population without those given up, in its order.
    Population<Genome> operator()(Population<Genome> population) {
        if (demand_.with_start)
            let_start_compete(population);
        std::vector<char> given_up(population.size(), 0);
        for (std::size_t first = 0; first < population.size(); first += at_once)
            screen(population, first, std::min(first + at_once, population.size()), given_up);
        Population<Genome> left;
        for (std::size_t i = 0; i < population.size(); ++i)
            if (!given_up[i])
                left.push_back(std::move(population[i]));
        context_.leave_out(population.size() - left.size());
        return left;
    }

  private:
    /// Evaluations under way at a time, for their memory, and worked on between two looks at the floor.
    static constexpr std::size_t at_once = 256, abreast = 8;

    struct Candidate {
        std::size_t place;
        std::unique_ptr<Appraisal<Outcome>> work;
        double bound = HUGE_VAL;
        std::optional<Outcome> outcome = {};

        /// Less promising; of equals the later.
        bool operator<(const Candidate& other) const {
            return bound != other.bound ? bound < other.bound : place > other.place;
        }
    };

    void screen(const Population<Genome>& population, std::size_t first, std::size_t last,
                std::vector<char>& given_up) {
        std::vector<Candidate> open = begin(population, first, last), chosen; // open: a heap
        std::make_heap(open.begin(), open.end());
        while (!context_.watch().expired()) {
            // Those who would be kept if everybody were as good as they can still be.
            while (!open.empty() && chosen.size() < abreast &&
                   floor_.would_keep(open.front().bound, chosen.size())) {
                std::pop_heap(open.begin(), open.end());
                chosen.push_back(std::move(open.back()));
                open.pop_back();
            }
            if (chosen.empty())
                break;
            context_.ledger().evaluator().each(chosen.size(), [&](std::size_t i) { work_on(chosen[i]); });
            for (Candidate& one : chosen) {
                if (one.outcome) {
                    take(population[one.place].genome, std::move(*one.outcome));
                } else if (one.work) {
                    open.push_back(std::move(one));
                    std::push_heap(open.begin(), open.end());
                }
            }
            chosen.clear();
        }
        for (Candidate& one : open)
            if (one.bound < floor_.value()) {
                given_up[one.place] = 1;
                context_.ledger().shelve(print_of(population[one.place]), std::move(one.work));
            }
    }

    static Demand in_numbers(Demand demand, const Context<P>& context) {
        if (demand.best == Demand::as_many_as_start)
            demand.best = context.generation_start().size();
        return demand;
    }

    /// Those of the start that are not in the population any more. One that is there in another shape is left
    /// to `score`, as it keeps its old self out.
    void let_start_compete(const Population<Genome>& population) {
        const std::vector<Identity> present = identities_of(population);
        for (const auto& old : context_.generation_start()) {
            if (std::binary_search(present.begin(), present.end(), old.identity))
                of_start_.push_back(old.identity);
            else if (old.fitness.known(name_))
                offer(old.fitness);
        }
        std::sort(of_start_.begin(), of_start_.end());
    }

    /// Whose fitness is known counts at once; whose evaluation cannot be appraised is left to `score`.
    std::vector<Candidate> begin(const Population<Genome>& population, std::size_t first, std::size_t last) {
        std::vector<Candidate> all;
        for (std::size_t i = first; i < last; ++i) {
            const auto& individual = population[i];
            if (individual.fitness.known(name_))
                offer(individual.fitness);
            else if (const auto* known = context_.ledger().memory().find(print_of(individual)))
                offer(judged(context_.problem(), *known, objective_, name_));
            else if (!std::binary_search(of_start_.begin(), of_start_.end(), individual.identity))
                all.push_back({i, context_.ledger().unshelve(print_of(individual))});
        }
        context_.ledger().evaluator().each(all.size(), [&](std::size_t i) {
            try {
                if (!all[i].work)
                    all[i].work = context_.problem().appraise(population[all[i].place].genome);
                if (all[i].work)
                    all[i].bound = all[i].work->bound(which_);
            } catch (const Stopped&) {
                throw;
            } catch (...) { // evaluate will say why
            }
        });
        std::erase_if(all, [](const Candidate& one) { return !one.work; });
        return all;
    }

    void work_on(Candidate& one) const {
        try {
            if ((one.outcome = one.work->outcome()))
                return;
            one.work->advance();
            one.bound = one.work->bound(which_);
        } catch (const Stopped&) {
            throw;
        } catch (...) { // evaluate will say why
            one.work.reset();
        }
    }
    Fingerprint print_of(const Individual<Genome>& individual) const {
        return identify(context_.problem(), individual.genome);
    }

    void take(const Genome& genome, Outcome outcome) {
        Evaluation<Outcome> evaluation(std::move(outcome));
        offer(judged(context_.problem(), evaluation, objective_, name_));
        context_.ledger().prepay(identify(context_.problem(), genome), std::move(evaluation));
    }
    void offer(const Fitness& fitness) {
        if (!fitness.has_failed())
            floor_.offer(fitness.value());
    }

    Context<P>& context_;
    std::size_t which_;
    const Objective<Outcome>& objective_;
    Name name_;
    Demand demand_;
    Floor floor_;
    std::vector<Identity> of_start_; ///< who is in the population and was at the start
};

} // namespace ga
