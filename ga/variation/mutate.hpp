#pragma once

#include "ga/variation/cross.hpp"

namespace ga {

/// A method to mutate a genome in place, each gene by its chance. It has words() and describe() like an
/// operator. It also has this member. Its requires-clause states which members of the problem it uses.
///
/// @code
///     bool operator()(const P&, Genome&, const Chance&, Stream&) const;   true if a gene changed
/// @endcode
template <class Method, class P>
concept Mutates = Problem<P> &&
    requires(const Method& method, const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) {
    { method(problem, genome, chance, stream) } -> std::same_as<bool>;
};

/// Mutates every individual. An individual that changes loses its fitness. If it was scored, the result is a
/// new individual with the old one as parent.
template <class Method>
struct Mutate : Operator {
    double rate = 0; ///< probability for each gene, in [0, 1]
    Method method;   ///< method that changes a genome (Mutates)
    static constexpr const char* needs = Method::needs;
    static Words words() {
        const Words of_method = Method::words();
        return {"mutate" + (of_method.name.empty() ? "" : " " + of_method.name), "mutation", of_method.meaning};
    }
    static void describe(auto& self, auto visit) {
        visit(self.rate, number("rate", std::nullopt, 0, 1, "a gene's chance to mutate"));
        Method::describe(self.method, visit);
    }
    std::string text() const {
        std::string text = "mutate " + number(rate);
        Method copy = method;
        for (const std::string& part : {Method::words().name, values_in_words(bound_parameters(copy))})
            text += (part.empty() ? "" : " ") + part;
        return text;
    }
    void check(CheckState& known) const { known.scored.reset(); }

    template <class P>
    requires Mutates<Method, P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        const Chance chance(rate);
        Stream next = context.stream(0); // computed ahead, while the processor waits for the previous one
        for (std::size_t i = 0; i < population.size(); ++i) {
            auto& individual = population[i];
            Stream stream = std::exchange(next, context.stream(i + 1));
            if (!method(context.problem(), individual.genome, chance, stream)) continue;
            if (individual.fitness.known()) context.make_child(individual, Parents(individual.identity));
        }
        return population;
    }
};

/// Another whole number between a choice's bounds, or the gene itself if it is the only one.
inline double other_choice(double gene, const Variable& variable, Stream& stream) {
    const double lower = std::ceil(variable.lower), upper = std::floor(variable.upper);
    if (!(upper > lower && upper - lower < 0x1p53)) return gene;
    const double drawn = lower + static_cast<double>(stream.below(static_cast<std::size_t>(upper - lower)));
    return drawn + (drawn >= std::clamp(std::round(gene), lower, upper) ? 1 : 0);
}

/// Replaces the real genes that `chance` picks by change(gene, variable), and choices by another one; true if
/// a gene has changed.
template <HasGenes P, class Change>
bool mutate_genes(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream, Change change) {
    bool changed = false;
    edit_genes(problem, genome, [&](std::span<double> genes) {
        const auto& variables = variables_of(problem, genome);
        chance.each(variables.size(), stream, [&](std::size_t i) {
            if (variables[i].gene >= genes.size()) return;
            double& gene = genes[variables[i].gene];
            const double before = gene;
            gene = variables[i].is_choice ? other_choice(before, variables[i], stream) : change(before, variables[i]);
            changed |= gene != before;
        });
    });
    return changed;
}

/// Reflects a value once at the bound that it exceeds, then cuts it at the bounds.
inline double reflected(double value, const Variable& variable) {
    if (value < variable.lower) value = 2 * variable.lower - value;
    if (value > variable.upper) value = 2 * variable.upper - value;
    return std::clamp(value, variable.lower, variable.upper);
}

/// The unit of relative steps: the width between the bounds, or 1 if one of them is infinite.
inline double width(const Variable& variable) {
    const double width = variable.upper - variable.lower;
    return std::isfinite(width) ? width : 1;
}

/// Adds a random step to a gene, reflected at the bounds: normal with standard deviation `size`, or uniform
/// within plus or minus `size`.
template <bool normal>
struct GeneStep {
    double size = 0.1; ///< size of a step as a fraction of the distance between the bounds, > 0
    static constexpr const char* needs = real_genes;
    static Words words() {
        return {normal ? "gaussian" : "uniform", "mutation", normal ? "adds a normal step" : "adds a uniform step"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.size, number(normal ? "sigma" : "step", above_zero, no_limit,
                                normal ? "standard deviation, in widths between bounds"
                                       : "largest step, in widths between bounds"));
    }

    template <HasGenes P>
    bool operator()(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
            const double draw = normal ? stream.normal() : stream.uniform(-1, 1);
            return reflected(gene + size * width(variable) * draw, variable);
        });
    }
};
using Gaussian = GeneStep<true>;     ///< the method of `mutate RATE gaussian`
using UniformStep = GeneStep<false>; ///< the method of `mutate RATE uniform`

/// Polynomial mutation (Deb and Goyal 1996, as in NSGA-II's code): a step within the bounds with a density
/// that falls as (1 - |step| / width)^eta. A gene outside its bounds starts at the nearer bound. If a bound
/// is infinite, the width is 1. A finite bound is never passed.
struct Polynomial {
    double eta = 20; ///< distribution index; a greater eta gives smaller steps
    static constexpr const char* needs = "real genes with bounds";
    static Words words() { return {"polynomial", "mutation", "adds a step of polynomial density"}; }
    static void describe(auto& self, auto visit) {
        visit(self.eta, number("eta", above_zero, no_limit, "greater values give smaller steps"));
    }

    template <HasGenes P>
    requires Bounded<P>
    bool operator()(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        return mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
            const double u = stream.uniform(), power = eta + 1, width = ga::width(variable);
            if (!(width > 0)) return gene;
            gene = std::clamp(gene, variable.lower, variable.upper);
            const auto beyond = [&](double room) { return room < width ? std::pow(1 - room / width, power) : 0; };
            const double below = beyond(gene - variable.lower), above = beyond(variable.upper - gene);
            const double step = u < 0.5 ? std::pow(2 * u + (1 - 2 * u) * below, 1 / power) - 1
                                        : 1 - std::pow(2 * (1 - u) + (2 * u - 1) * above, 1 / power);
            return std::clamp(gene + step * width, variable.lower, variable.upper);
        });
    }
};

/// A genome whose genes are whole numbers or bits.
template <class G>
concept Discrete = std::ranges::random_access_range<G> && std::integral<std::ranges::range_value_t<G>> &&
    requires(G& genome) {
    genome[0] = genome[0];
};
template <class G>
concept BitString = Discrete<G> &&(std::same_as<std::ranges::range_value_t<G>, bool>);

/// Replaces a gene at random: a real one uniformly between its bounds, a whole number by another value. A bit
/// is flipped. A gene with an infinite bound, or a bound beyond its type, stays as it is.
struct Reset : NoParameters {
    static constexpr const char* needs = "bits, or genes with bounds";
    static Words words() { return {"reset", "mutation", "replaces the gene at random; flips a bit"}; }

    template <Problem P>
    requires(BitString<typename P::Genome> || (Bounded<P> && (Discrete<typename P::Genome> || HasGenes<P>))) bool
    operator()(const P& problem, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        bool changed = false;
        if constexpr (BitString<typename P::Genome>) {
            chance.each(genome.size(), stream, [&](std::size_t i) {
                genome[i] = !genome[i];
                changed = true;
            });
        } else if constexpr (Discrete<typename P::Genome>) {
            using Gene = std::ranges::range_value_t<typename P::Genome>;
            const auto& variables = checked_bounds(problem, genome);
            chance.each(variables.size(), stream, [&](std::size_t i) {
                const Variable& variable = variables[i];
                const double lower = std::ceil(variable.lower), upper = std::floor(variable.upper);
                if (!(std::max(-lower, upper) < 0x1p63 && upper >= lower + 1) ||
                    !std::in_range<Gene>(std::int64_t(lower)) || !std::in_range<Gene>(std::int64_t(upper)) ||
                    variable.gene >= genome.size())
                    return;
                const std::uint64_t first = static_cast<std::uint64_t>(std::int64_t(lower)),
                                    others = static_cast<std::uint64_t>(std::int64_t(upper)) - first;
                const auto value = static_cast<Gene>(first + stream.below(others));
                Gene& gene = genome[variable.gene];
                gene = static_cast<Gene>(value + (value >= gene ? 1 : 0));
                changed = true;
            });
        } else {
            changed = mutate_genes(problem, genome, chance, stream, [&](double gene, const Variable& variable) {
                const bool bounded = std::isfinite(variable.upper - variable.lower);
                return bounded ? stream.uniform(variable.lower, variable.upper) : gene;
            });
        }
        return changed;
    }
};

/// The genes of a genome that may exchange their positions.
template <class G>
auto& places(G& genome) {
    if constexpr (std::same_as<G, Permutation>)
        return genome.order;
    else
        return genome;
}
template <class G>
concept Ordered = std::same_as<G, Permutation> || Discrete<G> || std::same_as<G, std::vector<double>>;

/// Exchanges the gene with another gene, or reverses the piece from one gene to the other (inversion, Holland
/// 1975). For a tour a reversed piece exchanges two edges, which is a 2-opt move (Croes 1958).
template <bool piece>
struct Exchange : NoParameters {
    static constexpr const char* needs = "genes that may change places";
    static Words words() {
        if (piece) return {"reverse", "mutation", "reverses the piece between the gene and another (2-opt for tours)"};
        return {"swap", "mutation", "exchanges the gene with another of the genome"};
    }

    template <Problem P>
    requires Ordered<typename P::Genome>
    bool operator()(const P&, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        auto& genes = places(genome);
        const auto at = [&](std::size_t k) { return genes.begin() + static_cast<std::ptrdiff_t>(k); };
        bool changed = false;
        if (genes.size() < 2) return false;
        chance.each(genes.size(), stream, [&](std::size_t i) {
            const std::size_t j = (i + 1 + stream.below(genes.size() - 1)) % genes.size();
            if (piece)
                std::reverse(at(std::min(i, j)), at(std::max(i, j) + 1));
            else
                std::iter_swap(at(i), at(j));
            changed = true;
        });
        return changed;
    }
};
using Swap = Exchange<false>;   ///< the method of `mutate RATE swap`
using Reverse = Exchange<true>; ///< the method of `mutate RATE reverse`

/// Moves the gene to another position (insertion, Fogel 1988), or one to three genes from it on, which may
/// also be reversed (or-opt, Or 1976).
template <bool piece>
struct Move : NoParameters {
    static constexpr const char* needs = Swap::needs;
    static Words words() {
        if (piece) return {"or_opt", "mutation", "moves one to three genes to another place, perhaps reversed"};
        return {"insertion", "mutation", "moves the gene to another place"};
    }

    template <Problem P>
    requires Ordered<typename P::Genome>
    bool operator()(const P&, typename P::Genome& genome, const Chance& chance, Stream& stream) const {
        auto& genes = places(genome);
        const std::size_t n = genes.size();
        if (n < 2) return false;
        const auto at = [&](std::size_t k) { return genes.begin() + static_cast<std::ptrdiff_t>(k); };
        bool changed = false;
        chance.each(n, stream, [&](std::size_t i) {
            const std::size_t length = piece ? std::min(1 + stream.below(std::min<std::size_t>(3, n - 1)), n - i) : 1;
            const std::size_t to = (i + 1 + stream.below(n - length)) % (n - length + 1);
            std::rotate(at(std::min(i, to)), at(to < i ? i : i + length), at(std::max(i, to) + length));
            if (piece && stream.chance(0.5)) std::reverse(at(to), at(to + length));
            changed = true;
        });
        return changed;
    }
};
using Insertion = Move<false>; ///< the method of `mutate RATE insertion`
using OrOpt = Move<true>;      ///< the method of `mutate RATE or_opt`

/// The mutation that `mutate RATE` uses: the problem's `mutate` if it has one. Otherwise it depends on the
/// genome: `swap` for permutations, `gaussian 0.1` for real genes, `reset` for bits and whole numbers.
struct Natural : NoParameters {
    static constexpr const char* needs = "a member mutate, or genes";
    static Words words() {
        return {"", "mutation", "the genome's natural mutation: the problem's, swap, reset or gaussian 0.1"};
    }

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
};

///@{ The methods for `mutate`.
inline Gaussian gaussian(double sigma = 0.1) { return {sigma}; }
inline UniformStep uniform_step(double step = 0.1) { return {step}; }
inline Polynomial polynomial(double eta = 20) { return {eta}; }
inline Reset reset() { return {}; }
inline Swap swap() { return {}; }
inline Reverse reverse() { return {}; }
inline Insertion insertion() { return {}; }
inline OrOpt or_opt() { return {}; }
///@}

/// The stage `mutate` with a method.
/// @param rate  probability that a gene mutates, 0 to 1
template <class Method = Natural>
Mutate<Method> mutate(double rate, Method method = {}) {
    return checked(Mutate<Method>{{}, rate, std::move(method)});
}

} // namespace ga
