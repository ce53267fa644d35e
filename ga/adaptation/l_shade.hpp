#pragma once

#include "ga/adaptation/differential_evolution.hpp"
#include "ga/base/json.hpp"

#include <numbers>

namespace ga {

/// The history of successful F and CR (Tanabe and Fukunaga 2014, Improving the search performance of SHADE
/// using linear population size reduction, Algorithm 1).
struct SuccessHistory {
    std::vector<double> F;  ///< H means of F, the weight of differences
    std::vector<double> CR; ///< H means of CR, the cross-over rate; a value below 0 is the terminal value
    std::size_t next = 0;   ///< index of the entry that is replaced next

    SuccessHistory() = default;
    /// A history in which all means are 0.5.
    explicit SuccessHistory(std::size_t entries) : F(entries, 0.5), CR(entries, 0.5) {}

    /// A pair of F and CR that gave a better trial.
    struct Success {
        double F;    ///< weight of differences
        double CR;   ///< cross-over rate
        double gain; ///< improvement of the fitness, above 0
    };
    /// Learns from the successes of one generation.
    void learn(const std::vector<Success>& successes) {
        if (successes.empty()) return;
        const auto lehmer = [&](double Success::*part) { // Eq. 7-9, weighted by the gains
            double squares = 0, sum = 0;
            for (const Success& s : successes) {
                squares += s.gain * (s.*part) * (s.*part);
                sum += s.gain * (s.*part);
            }
            return sum > 0 ? squares / sum : 0;
        };
        const double mean_CR = lehmer(&Success::CR);
        CR[next] = CR[next] < 0 || mean_CR == 0 ? -1 : mean_CR;
        F[next] = lehmer(&Success::F);
        next = (next + 1) % F.size();
    }
    /// A random pair near a random entry: F in (0, 1] and CR in [0, 1] (Eq. 1-2).
    std::pair<double, double> draw(Stream& stream) const {
        const std::size_t entry = stream.below(F.size());
        const double cr = CR[entry] < 0 ? 0 : std::clamp(CR[entry] + 0.1 * stream.normal(), 0.0, 1.0);
        double f = 0;
        while (!(f > 0)) // Cauchy
            f = F[entry] + 0.1 * std::tan(std::numbers::pi * (stream.uniform() - 0.5));
        return {std::min(f, 1.0), cr};
    }
};

/// L-SHADE (Tanabe and Fukunaga 2014): differential evolution by current-to-pbest/1/bin with an archive of
/// replaced parents. It learns F and CR from successful trials, and shrinks its population linearly to 4 over
/// `evaluations`. Without a limit on evaluations the population keeps its size, which is SHADE.
struct LShade : Operator {
    long evaluations = 0;   ///< number of evaluations after which the population is 4; 0 for the run's budget
    std::size_t memory = 6; ///< number H of entries of the success history
    double archive = 2.6;   ///< size of the archive, in populations
    double p = 0.11;        ///< share of the best in current-to-pbest

    /// A trial before it has a fitness.
    struct Trial {
        Identity child;             ///< identity of the trial
        double F;                   ///< F of the trial
        double CR;                  ///< CR of the trial
        double violation;           ///< violation of the parent
        double merit;               ///< merit of the parent
        std::vector<double> parent; ///< genes of the parent
    };
    /// The learnt state.
    struct State {
        SuccessHistory history;                  ///< history of F and CR
        std::vector<std::vector<double>> beaten; ///< archive of replaced parents
        std::vector<Trial> trials;               ///< last trials
        std::size_t initial = 0;                 ///< size of the first population
        long spent = 0;                          ///< evaluations spent so far
    };

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"l-shade", "adaptation",
                "differential evolution that learns F and CR and shrinks its population; duel follows the score"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.evaluations,
              whole("evaluations", 0, "when the population has shrunk to 4; 0 for the run's budget").keyed().quiet());
        visit(self.memory, whole("memory", 1, "entries of the success history").up_to(1e6).keyed().quiet());
        visit(self.archive, number("archive", 0, 100, "size of the archive, in populations").keyed().quiet());
        visit(self.p, number("p", above_zero, 1, "share of the best in current-to-pbest").keyed().quiet());
    }
    void check(CheckState& known) const {
        known.need_repetition(text_of(*this));
        known.need_one_objective(text_of(*this));
        known.need_individuals(text_of(*this), 4);
        known.trials = text_of(*this);
        known.scored.reset();
    }

    template <HasGenes P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context, State& state) const {
        Stream random = context.stream(all_individuals);
        if (state.initial == 0) {
            state.initial = population.size();
            state.spent = static_cast<long>(population.size());
            state.history = SuccessHistory(memory);
        }
        learn(population, state, random);
        shrink(population, context.ledger().budget().evaluations, state);
        const std::size_t n = population.size();
        while (state.beaten.size() > room(n)) drop(state.beaten, random.below(state.beaten.size()));

        auto genes = all_genes(population, context);
        const auto order = ranking(population, std::max<std::size_t>(2, rounded(p * static_cast<double>(n))));
        state.trials.clear();
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            const auto [f, cr] = state.history.draw(stream);
            std::size_t first, second;
            do first = stream.below(n);
            while (first == i);
            do second = stream.below(n + state.beaten.size());
            while (second == i || second == first);
            const std::size_t towards = order[stream.below(order.size())];
            const auto& last = second < n ? genes[second] : state.beaten[second - n];
            const Difference difference{genes[i], genes[towards], genes[first], last, f, f, cr};
            auto& individual = population[i];
            const Fitness& fitness = individual.fitness;
            Trial trial{0, f, cr, fitness.violation(), merit(fitness), genes[i]};
            individual.genome =
                with_genes(context.problem(), individual.genome,
                           difference.trial(genes[i], variables_of(context.problem(), individual.genome), stream));
            context.make_child(individual, Parents(individual.identity));
            trial.child = individual.identity;
            state.trials.push_back(std::move(trial));
        }
        state.spent += static_cast<long>(n);
        return population;
    }

  private:
    static std::size_t rounded(double x) { return static_cast<std::size_t>(std::max(0.0, std::round(x))); }
    std::size_t room(std::size_t n) const { return rounded(archive * static_cast<double>(n)); }
    static void drop(std::vector<std::vector<double>>& from, std::size_t i) {
        std::swap(from[i], from.back());
        from.pop_back();
    }
    static double merit(const Fitness& f) { return f.feasible() ? f.merit() : 0; }

    template <class G>
    void learn(const Population<G>& population, State& state, Stream& random) const {
        std::vector<SuccessHistory::Success> successes;
        std::unordered_map<Identity, const Fitness*> of;
        for (const auto& individual : population) of.emplace(individual.identity, &individual.fitness);
        for (Trial& trial : state.trials) {
            const auto child = of.find(trial.child);
            if (child == of.end()) continue;
            const Fitness& fitness = *child->second;
            double gain = trial.violation - fitness.violation();
            if (!(gain > 0 || gain < 0)) // both feasible, or equally infeasible
                gain = merit(fitness) - trial.merit;
            if (!(gain > 0)) continue;
            successes.push_back({trial.F, trial.CR, std::min(gain, std::numeric_limits<double>::max())});
            if (const std::size_t max = room(population.size()); max > 0) {
                if (state.beaten.size() >= max) drop(state.beaten, random.below(state.beaten.size()));
                state.beaten.push_back(std::move(trial.parent));
            }
        }
        double largest = 0; // the sum of gains stays finite
        for (const auto& success : successes) largest = std::max(largest, success.gain);
        for (auto& success : successes) success.gain /= largest;
        state.history.learn(successes);
    }

    /// Removes the worst (Eq. 10).
    template <class G>
    void shrink(Population<G>& population, long budget, const State& state) const {
        const long end = evaluations > 0 ? evaluations : budget;
        if (end == std::numeric_limits<long>::max()) return;
        const auto initial = static_cast<double>(state.initial);
        const double share = static_cast<double>(state.spent) / static_cast<double>(std::max(end, 1L));
        const std::size_t target = std::max<std::size_t>(4, rounded(initial + (4 - initial) * share));
        if (target >= population.size()) return;
        auto order = ranking(population, target);
        std::sort(order.begin(), order.end());
        population = individuals_at(order, population);
    }
};

inline void to_json(nlohmann::json& j, const LShade::Trial& t) {
    j = {t.child, t.F, t.CR, t.violation, t.merit, t.parent};
}
inline void from_json(const nlohmann::json& j, LShade::Trial& t) {
    read_parts(j, t.child, t.F, t.CR, t.violation, t.merit, t.parent);
}
inline void to_json(nlohmann::json& j, const LShade::State& s) {
    j = {s.history.F, s.history.CR, s.history.next, s.beaten, s.trials, s.initial, s.spent};
}
inline void from_json(const nlohmann::json& j, LShade::State& s) {
    read_parts(j, s.history.F, s.history.CR, s.history.next, s.beaten, s.trials, s.initial, s.spent);
    const std::size_t entries = s.history.F.size(); // 0 before the first generation
    expect_fit(s.history.CR.size() == entries && s.history.next < entries + (s.initial == 0 ? 1 : 0));
    expect_fit(s.spent >= 0 && s.spent <= 1L << 53);
    for (std::size_t i = 0; i < entries; ++i)
        expect_fit(s.history.F[i] >= 0 && s.history.F[i] <= 2 && std::abs(s.history.CR[i]) <= 2);
}

/// The stage `l-shade evaluations=evaluations`.
inline LShade l_shade(long evaluations = 0) { return checked(LShade{{}, evaluations}); }

} // namespace ga
