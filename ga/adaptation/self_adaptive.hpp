#pragma once

#include "ga/base/json.hpp"
#include "ga/variation/mutate.hpp"

namespace ga {

/// Mutation with step sizes that are inherited and mutate too (Schwefel 1977; Beyer and Schwefel 2002,
/// Evolution strategies: a comprehensive introduction). Each gene has sigma_i' = sigma_i exp(t0 N + t N_i)
/// with t0 = 1/sqrt(2n), t = 1/sqrt(2 sqrt(n)), and becomes gene_i + sigma_i' N_i. With one step size for all
/// genes sigma' = sigma exp(N/sqrt(n)). A child of a cross-over has the geometric mean of its parents' sizes.
/// New individuals start with `sigma`. A gene beyond a bound is reflected at it.
struct SelfAdaptive : Operator {
    double sigma = 0.1;         ///< first standard deviation, as a fraction of the distance between bounds, > 0
    std::string steps = "each"; ///< "each": a step size for each gene; "one": one for all genes

    /// The logarithms of the step sizes of all individuals that may still have children.
    struct State {
        std::map<Identity, std::vector<double>> sizes; ///< one logarithm, or one per gene
    };

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"self-adaptive", "adaptation", "adds normal steps with sizes that are inherited and mutate too"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.sigma,
              number("sigma", above_zero, no_limit, "first step, as a fraction of the distance between bounds"));
        visit(self.steps, word("steps", "a size for each gene, or one for all: each or one").keyed());
    }
    void validate() const {
        if (steps != "each" && steps != "one")
            throw UsageError("stage 'self-adaptive': steps is '" + steps + "'; use each or one");
    }
    void check(CheckState& known) const {
        known.need_repetition(text_of(*this));
        known.scored.reset();
    }

    template <HasGenes P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context, State& state) const {
        State next;
        const auto keep = [&](const auto& individual) {
            if (const auto known = state.sizes.find(individual.identity); known != state.sizes.end())
                next.sizes.insert(*known);
        };
        for (const auto& individual : context.generation_start()) // these may come back later
            keep(individual);
        for (std::size_t i = 0; i < population.size(); ++i) {
            auto& individual = population[i];
            keep(individual);
            Stream stream = context.stream(i);
            std::vector<double> sizes;
            edit_genes(context.problem(), individual.genome, [&](std::span<double> genes) {
                const auto& variables = variables_of(context.problem(), individual.genome);
                const auto n = static_cast<double>(variables.size());
                const bool one = steps == "one";
                sizes = inherited(individual, one ? 1 : variables.size(), state);
                const double together = one ? 1 / std::sqrt(n) : 1 / std::sqrt(2 * n), common = stream.normal();
                for (double& size : sizes)
                    size += together * common + (one ? 0 : stream.normal() / std::sqrt(2 * std::sqrt(n)));
                for (std::size_t g = 0; g < variables.size(); ++g)
                    if (const Variable& v = variables[g]; v.gene < genes.size())
                        genes[v.gene] =
                            reflected(genes[v.gene] + std::exp(sizes[one ? 0 : g]) * width(v) * stream.normal(), v);
            });
            if (individual.fitness.known()) context.make_child(individual, Parents(individual.identity));
            next.sizes[individual.identity] = std::move(sizes);
        }
        state = std::move(next);
        return population;
    }

  private:
    /// The step sizes of the individual, or the mean of its parents'; `sigma` if they are unknown.
    template <class G>
    std::vector<double> inherited(const Individual<G>& individual, std::size_t count, const State& state) const {
        std::vector<double> mean(count, 0);
        double known = 0;
        const auto add = [&](Identity whose) {
            const auto found = state.sizes.find(whose);
            if (found == state.sizes.end() || found->second.size() != count) return;
            ++known;
            for (std::size_t i = 0; i < count; ++i) mean[i] += found->second[i];
        };
        add(individual.identity);
        if (known == 0)
            for (const Identity parent : individual.parents) add(parent);
        for (double& each : mean) each = known > 0 ? each / known : std::log(sigma);
        return mean;
    }
};

inline void to_json(nlohmann::json& j, const SelfAdaptive::State& state) { j = state.sizes; }
inline void from_json(const nlohmann::json& j, SelfAdaptive::State& state) { j.get_to(state.sizes); }

/// The stage `self-adaptive sigma steps=steps`.
inline SelfAdaptive self_adaptive(double sigma = 0.1, std::string steps = "each") {
    return checked(SelfAdaptive{{}, sigma, std::move(steps)});
}

} // namespace ga
