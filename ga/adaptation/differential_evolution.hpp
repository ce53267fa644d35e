#pragma once

#include "ga/variation/cross.hpp"

#include <unordered_map>

namespace ga {

/// Makes trials for differential evolution. A *target* is an individual, and its *trial* is the child that
/// may replace it. The mutant is v = base + F1 (a - base) + F2 (b - c). The trial is the target with some
/// genes of v, among the genes that may move. Genes that one of the vectors lacks are not changed.
///
/// Binomial cross-over always takes one random gene of v, and each other gene with probability CR (Storn and
/// Price 1997, Eq. 2-4). Exponential cross-over takes one gene, and the next ones in a ring while draws are
/// below CR (Storn and Price 1995). A gene beyond a bound is set halfway between the target's gene and the
/// bound (Zhang and Sanderson 2009).
struct Difference {
    const std::vector<double>& base; ///< genes of base
    const std::vector<double>& a;    ///< genes of a
    const std::vector<double>& b;    ///< genes of b
    const std::vector<double>& c;    ///< genes of c
    double f1;                       ///< factor F1 of a - base
    double f2;                       ///< factor F2 of b - c
    double cr;                       ///< cross-over rate CR, in [0, 1]
    bool exponential = false;        ///< whether the cross-over is exponential; otherwise it is binomial

    /// The trial for a target. It differs from the target, unless the vectors are equal.
    template <class Moving>
    std::vector<double> trial(std::vector<double> target, const Moving& moving, Stream& stream) const {
        if (moving.empty()) return target;
        const std::size_t n = moving.size(), sure = stream.below(n);
        std::size_t in_a_row = 1; // exponential: number of genes from `sure` on
        while (exponential && in_a_row < n && stream.uniform() < cr) ++in_a_row;
        for (std::size_t i = 0; i < n; ++i) {
            const Variable& v = moving[i];
            const bool taken = exponential ? (i + n - sure) % n < in_a_row : stream.uniform() < cr || i == sure;
            if (!taken || v.gene >= std::min({target.size(), base.size(), a.size(), b.size(), c.size()})) continue;
            double& gene = target[v.gene];
            const double value = base[v.gene] + f1 * (a[v.gene] - base[v.gene]) + f2 * (b[v.gene] - c[v.gene]);
            gene = value < v.lower ? (gene + v.lower) / 2 : value > v.upper ? (gene + v.upper) / 2 : value;
        }
        return target;
    }
};

/// The genes of all individuals. Ends the run if there are fewer than the four that a trial needs.
template <Problem P>
std::vector<std::vector<double>> all_genes(const PopulationOf<P>& population, Context<P>& context) {
    if (population.size() < 4)
        context.end_with(population, std::to_string(population.size()) + " individuals; give 4 or more");
    std::vector<std::vector<double>> all;
    for (const auto& individual : population) all.push_back(genes_of(context.problem(), individual.genome));
    return all;
}

/// Differential evolution (Storn and Price 1997) by rand/1, best/1 or current-to-best/1 with binomial or
/// exponential cross-over. Every individual is replaced by its trial, which is its child.
struct DifferentialEvolution : Operator {
    std::string base = "rand";    ///< choice of base: rand, best or current-to-best
    double F = 0.5;               ///< weight of differences, above 0
    double CR = 0.9;              ///< cross-over rate, in [0, 1]
    std::string crossing = "bin"; ///< cross-over: bin (binomial) or exp (exponential)

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"de", "adaptation",
                "a trial replaces each individual by differential evolution; duel follows the score"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.base, word("base", "rand, best or current-to-best"));
        visit(self.F, number("F", above_zero, 2, "weight of differences").keyed());
        visit(self.CR, number("CR", 0, 1, "a gene's chance to be the mutant's").keyed());
        visit(self.crossing, word("crossing", "bin: each gene by itself, or exp: in a row").keyed().quiet());
    }
    void validate() const {
        if (base != "rand" && base != "best" && base != "current-to-best")
            throw UsageError("stage 'de': base is '" + base + "'; use rand, best or current-to-best");
        if (crossing != "bin" && crossing != "exp")
            throw UsageError("stage 'de': crossing is '" + crossing + "'; use bin or exp");
    }
    void check(CheckState& known) const {
        known.need_score(text_of(*this));
        known.need_individuals(text_of(*this), 4);
        known.trials = text_of(*this);
        known.scored.reset();
    }

    template <HasGenes P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const std::size_t n = population.size();
        const auto genes = all_genes(population, context);
        const std::size_t best = ranking(population, 1).front();
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            std::size_t others[3]; // different from each other and from i
            for (std::size_t k = 0; k < 3; ++k) do
                    others[k] = stream.below(n);
                while (others[k] == i || std::find(others, others + k, others[k]) != others + k);
            const bool from_current = base == "current-to-best";
            const std::size_t from = from_current ? i : base == "best" ? best : others[2];
            const Difference difference{
                genes[from], genes[best], genes[others[0]], genes[others[1]], from_current ? F : 0,
                F,           CR,          crossing == "exp"};
            auto& individual = population[i];
            individual.genome =
                with_genes(context.problem(), individual.genome,
                           difference.trial(genes[i], variables_of(context.problem(), individual.genome), stream));
            context.make_child(individual, Parents(individual.identity));
        }
        return population;
    }
};

/// The stage `de base F=f CR=cr crossing=crossing`.
inline DifferentialEvolution differential_evolution(std::string base = "rand", double f = 0.5, double cr = 0.9,
                                                    std::string crossing = "bin") {
    return checked(DifferentialEvolution{{}, std::move(base), f, cr, std::move(crossing)});
}

/// One-to-one replacement (Storn and Price 1997): a child is replaced by its first parent, if the parent is
/// in the generation's start and better. On a tie the child stays.
struct Duel : Operator {
    static Words words() { return {"duel", "replacement", "each child or its first parent, whichever is better"}; }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const { known.need_comparable_start(text_of(*this)); }

    template <Problem P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        std::unordered_map<Identity, const Individual<typename P::Genome>*> start;
        for (const auto& parent : context.generation_start()) start.emplace(parent.identity, &parent);
        for (auto& child : population) {
            const auto parent = child.parents.size() > 0 ? start.find(*child.parents.begin()) : start.end();
            if (parent != start.end() && better(parent->second->fitness, child.fitness)) child = *parent->second;
        }
        return population;
    }
};

/// The stage `duel`.
inline Duel duel() { return {}; }

} // namespace ga
