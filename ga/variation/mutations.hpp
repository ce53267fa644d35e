#pragma once

#include "ga/problem/permutation.hpp"
#include "ga/variation/genes.hpp"
#include "ga/variation/mutate.hpp"

#include <algorithm>
#include <cmath>

namespace ga {

/// Puts change(gene, variable) in the place of the real genes that their chance picks; true when one came out
/// different.
template <HasGenes P, class Change>
bool mutate_genes(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream,
                  Change change) {
    bool changed = false;
    edit_genes(problem, genome, [&](std::span<double> genes) {
        const auto& variables = variables_of(problem, genome);
        chance.each(variables.size(), stream, [&](std::size_t i) {
            if (variables[i].gene >= genes.size())
                return;
            double& gene = genes[variables[i].gene];
            const double before = gene;
            gene = change(before, variables[i]);
            changed |= gene != before;
        });
    });
    return changed;
}

/// A value brought back between its bounds by mirrors at them; at the nearer one where a mirror is not
/// enough.
inline double reflected(double value, const Variable& variable) {
    if (value < variable.lower)
        value = 2 * variable.lower - value;
    if (value > variable.upper)
        value = 2 * variable.upper - value;
    return std::clamp(value, variable.lower, variable.upper);
}

/// The length a relative step refers to: the width between the bounds, or 1 where there are none.
inline double width(const Variable& variable) {
    const double width = variable.upper - variable.lower;
    return std::isfinite(width) ? width : 1;
}

/// Adds a normal step of deviation sigma times the width between the bounds.
struct Gaussian {
    double sigma = 0.1; ///< part of the width between the bounds, > 0
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() { return {"gaussian", "mutation", "adds a normal step"}; }
    static void describe(auto& self, auto visit) {
        visit(self.sigma,
              number("sigma", "0.1", above_zero, no_limit, "deviation, in widths between bounds"));
    }

    template <HasGenes P>
    bool operator()(const P& problem, typename P::Genome& genome, const Chance& chance,
                    Stream& stream) const {
        return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
            return reflected(gene + sigma * width(variable) * stream.normal(), variable);
        });
    }
    ///@}
};

/// Adds a step uniform within plus or minus `step` times the width between the bounds.
struct UniformStep {
    double step = 0.1; ///< part of the width between the bounds, > 0
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() { return {"uniform", "mutation", "adds a uniform step"}; }
    static void describe(auto& self, auto visit) {
        visit(self.step,
              number("step", "0.1", above_zero, no_limit, "largest step, in widths between bounds"));
    }

    template <HasGenes P>
    bool operator()(const P& problem, typename P::Genome& genome, const Chance& chance,
                    Stream& stream) const {
        return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
            return reflected(gene + step * width(variable) * stream.uniform(-1, 1), variable);
        });
    }
    ///@}
};

/// Polynomial mutation (Deb and Goyal 1996, as in NSGA-II's code): a step within the bounds whose density
/// falls as (1 - |step| / width)^eta. A gene outside its bounds starts from the nearer one; one without
/// bounds on both sides takes steps as if 1 were its width, and the bound it has is a wall.
struct Polynomial {
    double eta = 20; ///< greater: smaller steps
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() { return {"polynomial", "mutation", "adds a step of polynomial density"}; }
    static void describe(auto& self, auto visit) {
        visit(self.eta, number("eta", "20", above_zero, no_limit, "the greater, the smaller"));
    }

    template <HasGenes P>
    requires Bounded<P>
    bool operator()(const P& problem, typename P::Genome& genome, const Chance& chance,
                    Stream& stream) const {
        return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
            const double u = stream.uniform(), power = eta + 1, width = ga::width(variable);
            if (!(width > 0))
                return gene;
            gene = std::clamp(gene, variable.lower, variable.upper);
            const auto beyond = [&](double room) {
                return room < width ? std::pow(1 - room / width, power) : 0;
            };
            const double below = beyond(gene - variable.lower), above = beyond(variable.upper - gene);
            const double step = u < 0.5 ? std::pow(2 * u + (1 - 2 * u) * below, 1 / power) - 1
                                        : 1 - std::pow(2 * (1 - u) + (2 * u - 1) * above, 1 / power);
            return std::clamp(gene + step * width, variable.lower, variable.upper);
        });
    }
    ///@}
};

/// Genes that are whole numbers or bits.
template <class G>
concept Discrete = std::ranges::random_access_range<G> && std::integral<std::ranges::range_value_t<G>> &&
    requires(G& genome) {
    genome[0] = genome[0];
};
template <class G>
concept BitString = Discrete<G> &&(std::same_as<std::ranges::range_value_t<G>, bool>);

/// Draws the gene anew: a real one uniformly between its bounds, a whole number among its other values, a bit
/// flipped. A gene without bounds on both sides stays: there is no uniform draw of it.
struct Reset {
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() { return {"reset", "mutation", "draws the gene anew; flips a bit"}; }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires(BitString<typename P::Genome> ||
             (Bounded<P> && (Discrete<typename P::Genome> || HasGenes<P>))) bool
    operator()(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        if constexpr (BitString<typename P::Genome>) {
            bool changed = false;
            chance.each(genome.size(), stream, [&](std::size_t i) {
                genome[i] = !genome[i];
                changed = true;
            });
            return changed;
        } else if constexpr (Discrete<typename P::Genome>) {
            using Gene = std::ranges::range_value_t<typename P::Genome>;
            bool changed = false;
            const auto& variables = checked_bounds(problem, genome);
            chance.each(variables.size(), stream, [&](std::size_t i) {
                const Variable& variable = variables[i];
                if (variable.upper < variable.lower + 1 || variable.gene >= genome.size())
                    return;
                const auto others = static_cast<std::size_t>(variable.upper - variable.lower);
                const auto value = static_cast<Gene>(static_cast<Gene>(variable.lower) +
                                                     static_cast<Gene>(stream.below(others)));
                Gene& gene = genome[variable.gene];
                gene = static_cast<Gene>(value + (value >= gene ? 1 : 0));
                changed = true;
            });
            return changed;
        } else {
            return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
                const bool bounded = std::isfinite(variable.upper - variable.lower);
                return bounded ? stream.uniform(variable.lower, variable.upper) : gene;
            });
        }
    }
    ///@}
};

/// Genes that may change places within a genome: positions, or a permutation's.
template <class G>
auto& places(G& genome) {
    if constexpr (std::same_as<G, Permutation>)
        return genome.order;
    else
        return genome;
}
template <class G>
concept Ordered = std::same_as<G, Permutation> || Discrete<G> || std::same_as<G, std::vector<double>>;

/// change(i, j) at chance of each gene i, with another gene j drawn for it; true if there was any.
template <class Genes, class Change>
bool with_another(const Genes& genes, const Chance& chance, Stream& stream, Change change) {
    bool changed = false;
    if (genes.size() < 2)
        return false;
    chance.each(genes.size(), stream, [&](std::size_t i) {
        change(i, (i + 1 + stream.below(genes.size() - 1)) % genes.size());
        changed = true;
    });
    return changed;
}

/// Exchanges the gene with another one.
struct Swap {
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() { return {"swap", "mutation", "exchanges the gene with another of the genome"}; }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires Ordered<typename P::Genome>
    bool operator()(const P&, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        auto& genes = places(genome);
        return with_another(genes, chance, stream, [&](std::size_t i, std::size_t j) {
            const auto kept = genes[i];
            genes[i] = genes[j];
            genes[j] = kept;
        });
    }
    ///@}
};

/// Turns round the piece between the gene and another one: for a tour, the exchange of two edges.
struct Reverse {
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() {
        return {"reverse", "mutation", "turns round the piece between the gene and another"};
    }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires Ordered<typename P::Genome>
    bool operator()(const P&, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        auto& genes = places(genome);
        return with_another(genes, chance, stream, [&](std::size_t i, std::size_t j) {
            const auto at = [&](std::size_t k) { return genes.begin() + static_cast<std::ptrdiff_t>(k); };
            std::reverse(at(std::min(i, j)), at(std::max(i, j) + 1));
        });
    }
    ///@}
};

/// What a genome's kind makes of `mutate RATE`: the problem's own mutation; else the swap of a permutation,
/// the reset of bits and whole numbers, a gaussian step of a tenth of the width of real genes.
struct Natural {
    ///@{
    /// What every way of mutating has (Mutates).
    static Words words() {
        return {"", "mutation", "the genome's natural mutation: its own, swap, reset or gaussian 0.1"};
    }
    static void describe(auto&, auto) {}

    template <Problem P>
    requires(MutatesItself<P> || Mutates<Reset, P> || HasGenes<P> || Ordered<typename P::Genome>) bool
    operator()(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        if constexpr (MutatesItself<P>)
            return problem.mutate(genome, chance.probability(), stream);
        else if constexpr (std::same_as<typename P::Genome, Permutation>)
            return Swap()(problem, genome, chance, stream);
        else if constexpr (HasGenes<P>)
            return Gaussian{0.1}(problem, genome, chance, stream);
        else
            return Reset()(problem, genome, chance, stream);
    }
    ///@}
};

/// `gaussian sigma` of mutate.
inline Gaussian gaussian(double sigma = 0.1) { return {sigma}; }
/// `uniform step` of mutate.
inline UniformStep uniform_step(double step = 0.1) { return {step}; }
/// @param eta  distribution index: the greater, the smaller the steps
inline Polynomial polynomial(double eta = 20) { return {eta}; }
/// `reset` of mutate.
inline Reset reset() { return {}; }
/// `swap` of mutate.
inline Swap swap() { return {}; }
/// `reverse` of mutate.
inline Reverse reverse() { return {}; }

/// @param rate  a gene's chance to mutate, 0 to 1
template <class Way = Natural>
Mutate<Way> mutate(double rate, Way way = {}) {
    return checked(Mutate<Way>{{}, rate, std::move(way)});
}

} // namespace ga
