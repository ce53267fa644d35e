#pragma once

#include "ga/base/errors.hpp"
#include "ga/problem/fingerprint.hpp"

#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace ga {

/// A genome that contains each of 0 .. n-1 once. Only operators that preserve this apply.
struct Permutation {
    std::vector<std::uint32_t> order; ///< each of 0 .. n-1 once

    auto begin() const { return order.begin(); }      ///< the first number
    auto end() const { return order.end(); }          ///< past the last number
    std::size_t size() const { return order.size(); } ///< length n
    /// Whether both permutations are equal.
    bool operator==(const Permutation&) const = default;
    /// Whether `order` contains each of 0 .. n-1 once.
    bool is_valid() const {
        std::vector<char> seen(order.size(), 0);
        return std::all_of(begin(), end(), [&](std::uint32_t number) {
            return number < seen.size() && !std::exchange(seen[number], char{1});
        });
    }

    /// Any order with equal probability.
    static Permutation random(std::size_t n, Stream& stream) {
        Permutation permutation;
        permutation.order.resize(n);
        std::iota(permutation.order.begin(), permutation.order.end(), 0u);
        for (std::size_t i = n; i > 1; --i) std::swap(permutation.order[i - 1], permutation.order[stream.below(i)]);
        return permutation;
    }
};

/// Number of a level of evaluation, for example of a coarse or a fine model; 0 unless a problem has several.
enum class Level : std::uint8_t {};

/// A level of evaluation: its name, and what it costs in evaluations of level 0.
struct LevelPrice {
    std::string name;      ///< name of the level in logs and results
    double evaluation = 1; ///< price of one evaluation, above 0
    double gradient = 1;   ///< price of one derivative of an objective of this level, above 0
};

/// A function of an evaluation's outcome. It must be pure and only read the outcome: the engine evaluates
/// what its level misses. NaN, infinity or an exception marks the individual as failed.
template <class Outcome>
struct Objective {
    std::string name;                              ///< name of the objective in pipelines
    std::function<double(const Outcome&)> fitness; ///< function that returns the value for an outcome
    bool minimise = false;                         ///< whether lower is better
    Level level = {};                              ///< level of evaluation whose outcome it reads
};

/// The interface of ga to a domain: a type of genome, the expensive call `evaluate`, and objectives of the
/// outcome. `evaluate` must be pure, because several threads call it and its outcomes are stored. It may
/// throw. There is at least one objective; `score()` uses the first.
template <class P>
concept Problem = requires(const P& problem, const typename P::Genome& genome) {
    requires std::copyable<typename P::Genome>;
    requires std::copyable<typename P::Outcome>;
    { problem.evaluate(genome) } -> std::same_as<typename P::Outcome>;
    { problem.objectives() } -> std::same_as<const std::vector<Objective<typename P::Outcome>>&>;
};

/// Optional: several levels of evaluation. `levels` lists their prices; `evaluate(genome)` is level 0.
/// Outcomes of different levels are stored separately.
template <class P>
concept Levelled = Problem<P> && requires(const P& problem, const typename P::Genome& genome, Level level) {
    { problem.evaluate(genome, level) } -> std::same_as<typename P::Outcome>;
    { problem.levels() } -> std::same_as<const std::vector<LevelPrice>&>;
};

/// The bit of a level in a set of at most eight levels.
constexpr std::uint8_t bit_of(Level level) { return static_cast<std::uint8_t>(1u << static_cast<unsigned>(level)); }

/// The price of a level; 1 for each call of a problem that states none.
template <Problem P>
LevelPrice price_of(const P& problem, Level level) {
    if constexpr (Levelled<P>)
        return problem.levels().at(static_cast<std::size_t>(level));
    else
        return {};
}

/// Optional: an evaluation with noise, for `average`. Each replicate is a pure function of its number;
/// `evaluate(genome)` is replicate 0.
template <class P>
concept Noisy = Problem<P> && requires(const P& problem, const typename P::Genome& genome, std::uint64_t replicate) {
    { problem.evaluate(genome, replicate) } -> std::same_as<typename P::Outcome>;
};

/// Optional: bytes that identify the genome, if ga cannot read its bits or several genomes have the same outcome.
template <class P>
concept Keyed = requires(const P& problem, const typename P::Genome& genome) {
    { problem.key(genome) } -> std::convertible_to<std::string>;
};

/// Optional: the final form of a genome after its evaluation. `score` replaces an evaluated genome by this
/// final form. Both must have the same key, so that results do not depend on what the memory has forgotten.
template <class P>
concept HasFinalGenome = requires(const P& problem, const typename P::Genome& genome,
                                  const typename P::Outcome& outcome) {
    { problem.final_genome(genome, outcome) } -> std::same_as<typename P::Genome>;
};

/// Optional: the genome moved into the feasible set, or towards it. The engine calls `repair` before each
/// evaluation, and keeps the result. It must be pure, must not throw, and must not change its results.
template <class P>
concept Repairs = requires(const P& problem, const typename P::Genome& genome) {
    { problem.repair(genome) } -> std::same_as<typename P::Genome>;
};

/// Optional: whether operators can work with a genome from outside the run, e.g. by its length and numbers.
template <class P>
concept ValidatesGenomes = requires(const P& problem, const typename P::Genome& genome) {
    { problem.valid(genome) } -> std::same_as<bool>;
};

/// Optional: whether the objectives can read an outcome from a file, e.g. by its size.
template <class P>
concept ValidatesOutcomes = requires(const P& problem, const typename P::Outcome& outcome) {
    { problem.valid_outcome(outcome) } -> std::same_as<bool>;
};

/// Optional: a genome as a vector of real genes, and back.
template <class P>
concept ConvertsGenes = requires(const P& problem, const typename P::Genome& genome, const std::vector<double>& genes) {
    { problem.genes(genome) } -> std::same_as<std::vector<double>>;
    { problem.with_genes(genome, genes) } -> std::same_as<typename P::Genome>;
};

/// A problem with real genes: it converts its genomes, or they are vectors of double.
template <class P>
concept HasGenes = ConvertsGenes<P> || std::same_as<typename P::Genome, std::vector<double>>;

/// The genome's genes by the problem's `genes`, or the genome itself if it is a vector of double.
template <HasGenes P>
std::vector<double> genes_of(const P& problem, const typename P::Genome& genome) {
    if constexpr (ConvertsGenes<P>)
        return problem.genes(genome);
    else
        return genome;
}
/// The genome with other genes; the inverse of genes_of.
template <HasGenes P>
typename P::Genome with_genes(const P& problem, const typename P::Genome& genome, std::vector<double> genes) {
    if constexpr (ConvertsGenes<P>)
        return problem.with_genes(genome, genes);
    else
        return genes;
}

/// Residuals and their derivatives, defined in ga/refinement/landscape.hpp.
struct Sensitivity;

/// Optional: residuals and Jacobian, used by `lm`, `mma`, `minimax`, `emit` and methods of the domain.
template <class P>
concept Sensitive = HasGenes<P> &&
    requires(const P& problem, const typename P::Genome& genome, const std::string& objective) {
    { problem.sensitivity(genome, objective) } -> std::same_as<Sensitivity>;
};

/// Optional: the fitness's derivatives with respect to all genes.
template <class P>
concept Differentiable = HasGenes<P> &&
    requires(const P& problem, const typename P::Genome& genome, const std::string& objective) {
    { problem.gradient(genome, objective) } -> std::same_as<std::vector<double>>;
};

/// Whether derivatives of the fitness are known: the member `has_gradient()`, or else Differentiable.
template <class P>
bool has_gradient(const P& problem) {
    if constexpr (requires { problem.has_gradient(); }) return problem.has_gradient();
    return Differentiable<P>;
}

/// Optional: the violation of the problem's constraints by an outcome, as one number or one per constraint. A
/// number is 0 or less if its constraints hold. Individuals are then compared by Deb's rules (2000). Feasible
/// ones are better than infeasible ones. Infeasible ones are compared by the sum of violations, feasible ones
/// by the fitness. An equality h = 0 with a tolerance is the number |h| - tolerance.
template <class P>
concept Constrained = requires(const P& problem, const typename P::Outcome& outcome) {
    requires std::convertible_to<decltype(problem.violation(outcome)), double> ||
        std::convertible_to<decltype(problem.violation(outcome)), std::vector<double>>;
};

/// The violations, one per constraint.
template <Constrained P>
std::vector<double> violations_of(const P& problem, const typename P::Outcome& outcome) {
    if constexpr (std::convertible_to<decltype(problem.violation(outcome)), double>)
        return {static_cast<double>(problem.violation(outcome))};
    else
        return problem.violation(outcome);
}

/// Optional: bytes that an outcome owns outside the object itself, e.g. on the heap.
template <class P>
concept Weighed = requires(const P& problem, const typename P::Outcome& outcome) {
    { problem.bytes(outcome) } -> std::convertible_to<std::size_t>;
};

/// A gene that may move, between its bounds.
struct Variable {
    std::size_t gene; ///< index of the gene
    double lower;     ///< lower bound, in the gene's unit
    double upper;     ///< upper bound, at least `lower`
    /// Whether the gene is a choice: rounded, it is one of the whole numbers between the bounds, which have
    /// no order. Mutation draws another of these, and cross-over exchanges them.
    bool is_choice = false;
};

/// The cost of a problem's function that computes more than its result shows, for example curves to compare.
/// The function takes it as its last argument and adds to it. It then counts as evaluations do.
struct Work {
    double price = 0; ///< price, in evaluations of level 0
};

/// Whether a function gives a result from these arguments, with a Work or none as the last one.
template <class Function, class Result, class... Arguments>
concept gives_with_work = std::is_invocable_r_v<Result, const Function&, Arguments...> ||
    std::is_invocable_r_v<Result, const Function&, Arguments..., Work&>;

/// The function's result. The function may take a Work as its last argument.
template <class Function, class... Arguments>
decltype(auto) with_work(const Function& function, Work& work, Arguments&&... arguments) {
    if constexpr (std::is_invocable_v<const Function&, Arguments..., Work&>)
        return function(std::forward<Arguments>(arguments)..., work);
    else
        return function(std::forward<Arguments>(arguments)...);
}

/// A function that text pipelines name.
template <class Result, class... Arguments>
struct NamedFunction {
    std::string name;                              ///< name in pipelines
    std::function<Result(Arguments..., Work&)> of; ///< the function; it adds to the Work

    /// @param function  may take a Work as its last argument
    template <gives_with_work<Result, Arguments...> Function>
    NamedFunction(std::string word, Function function)
        : name(std::move(word)), of([function](Arguments... arguments, Work& work) {
              return Result(with_work(function, work, arguments...));
          }) {}
};

/// A choice of genes for refinement, from a genome to the genes that may move and how far.
template <class G>
using Variables = NamedFunction<std::vector<Variable>, const G&>;

/// Optional: the genes that operators (and refinement with `genes=all`) may move, with their bounds, in
/// ascending order. The member may return a reference.
template <class P>
concept Bounded = requires(const P& problem, const typename P::Genome& genome) {
    { problem.bounds(genome) } -> std::convertible_to<const std::vector<Variable>&>;
};

/// The problem's bounds. Throws UsageError if genes are not in ascending order, or a lower bound is above the upper.
template <Bounded P>
decltype(auto) checked_bounds(const P& problem, const typename P::Genome& genome) {
    decltype(auto) all = problem.bounds(genome);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!(all[i].lower <= all[i].upper) || (i > 0 && all[i].gene <= all[i - 1].gene))
            throw UsageError("the problem's bounds: number " + std::to_string(i + 1) + " is of gene " +
                             std::to_string(all[i].gene) + ", " + std::to_string(all[i].lower) + " to " +
                             std::to_string(all[i].upper) +
                             "; give genes in ascending order and no lower "
                             "bound above the upper");
    return all;
}

/// Optional: a new genome drawn at random. An overload of `sample` may take a Work as a second argument.
template <class P>
concept Sampled = requires(const P& problem, Stream& stream) {
    { problem.sample(stream) } -> std::same_as<typename P::Genome>;
};

/// The problem's new genome, drawn at random.
template <Sampled P>
typename P::Genome sampled(const P& problem, Stream& stream, Work& work) {
    if constexpr (requires { problem.sample(stream, work); })
        return problem.sample(stream, work);
    else
        return problem.sample(stream);
}

/// Optional: the problem's mutation. It mutates each gene with probability `rate`, and returns whether a gene
/// has changed.
template <class P>
concept MutatesItself = requires(const P& problem, typename P::Genome& genome, double rate, Stream& stream) {
    { problem.mutate(genome, rate, stream) } -> std::same_as<bool>;
};

/// Optional: the problem's uniform cross-over.
template <class P>
concept CrossesUniformly = requires(const P& problem, typename P::Genome& genome, Stream& stream) {
    problem.cross_uniform(genome, genome, stream);
};

/// Optional: the problem's cross-over at n points, for genomes that are not only sequences of genes.
template <class P>
concept CrossesAtPoints = requires(const P& problem, typename P::Genome& genome, std::size_t n, Stream& stream) {
    problem.cross_points(genome, genome, n, stream);
};

/// Optional: the distance of two genomes, symmetric and 0 for equal ones.
template <class P>
concept Measured = requires(const P& problem, const typename P::Genome& genome) {
    { problem.distance(genome, genome) } -> std::convertible_to<double>;
};

/// A feature of a genome, in which solutions of equal fitness may differ. It must be much cheaper than an
/// evaluation, and pure, because several threads call it.
template <class G>
struct Descriptor {
    std::string name;                   ///< name of the feature in pipelines
    std::function<double(const G&)> of; ///< function that returns the value for a genome
    double lower;                       ///< lower end of the range that is divided into cells
    double upper;                       ///< upper end of that range, above `lower`
    /// Derivatives of the value with respect to all genes; if empty, finite differences are used.
    std::function<std::vector<double>(const G&)> gradient = {};
};

/// Optional: features by which genomes differ, for `map-elites` and `emit`.
template <class P>
concept Describing = requires(const P& problem) {
    { problem.descriptors() } -> std::same_as<const std::vector<Descriptor<typename P::Genome>>&>;
};

/// Whether a member pointer's or a static member's type is that of a function.
template <class Member>
constexpr bool is_function_member =
    std::is_member_function_pointer_v<Member> || std::is_function_v<std::remove_pointer_t<Member>>;

/// Gives a compile-time error with the name of a member that does not fit its concept, or whose name is a likely
/// misspelling. Without this check such a member would be ignored. Overloaded and templated members are not checked.
template <class P>
constexpr bool members_fit() {
#define GA_MEMBER_FITS(member, Concept)                                                                                \
    if constexpr (requires { &P::member; })                                                                            \
        if constexpr (is_function_member<decltype(&P::member)>)                                                        \
            static_assert(Concept<P>, "the problem's member '" #member "' has another signature than " #Concept        \
                                      " (ga/problem/problem.hpp) asks for");
    GA_MEMBER_FITS(key, Keyed)
    GA_MEMBER_FITS(final_genome, HasFinalGenome)
    GA_MEMBER_FITS(repair, Repairs)
    GA_MEMBER_FITS(valid, ValidatesGenomes)
    GA_MEMBER_FITS(valid_outcome, ValidatesOutcomes)
    GA_MEMBER_FITS(genes, ConvertsGenes)
    GA_MEMBER_FITS(with_genes, ConvertsGenes)
    GA_MEMBER_FITS(sensitivity, Sensitive)
    GA_MEMBER_FITS(gradient, Differentiable)
    GA_MEMBER_FITS(bounds, Bounded)
    GA_MEMBER_FITS(sample, Sampled)
    GA_MEMBER_FITS(violation, Constrained)
    GA_MEMBER_FITS(levels, Levelled)
    GA_MEMBER_FITS(bytes, Weighed)
    GA_MEMBER_FITS(mutate, MutatesItself)
    GA_MEMBER_FITS(cross_uniform, CrossesUniformly)
    GA_MEMBER_FITS(cross_points, CrossesAtPoints)
    GA_MEMBER_FITS(distance, Measured)
    GA_MEMBER_FITS(descriptors, Describing)
#undef GA_MEMBER_FITS
#define GA_MEMBER_CALLED(member, misspelt)                                                                             \
    if constexpr (requires { &P::misspelt; })                                                                          \
        static_assert(!is_function_member<decltype(&P::misspelt)>,                                                     \
                      "the problem's member '" #misspelt "' is not used; is it '" #member "'?");
    GA_MEMBER_CALLED(violation, violations)
    GA_MEMBER_CALLED(violation, constraint)
    GA_MEMBER_CALLED(violation, constraints)
    GA_MEMBER_CALLED(gradient, gradients)
    GA_MEMBER_CALLED(sensitivity, sensitivities)
#undef GA_MEMBER_CALLED
    return true;
}

/// Whether a genome from outside the run is usable. A permutation must have each number once. If the problem
/// has the member `valid`, this member decides. Otherwise, in a vector of double, every gene that has bounds
/// must exist and be finite.
template <Problem P>
bool is_valid(const P& problem, const typename P::Genome& genome) {
    if constexpr (std::same_as<typename P::Genome, Permutation>)
        if (!genome.is_valid()) return false;
    if constexpr (ValidatesGenomes<P>)
        return problem.valid(genome);
    else if constexpr (Bounded<P> && std::same_as<typename P::Genome, std::vector<double>>)
        return std::ranges::all_of(checked_bounds(problem, genome), [&](const Variable& variable) {
            return variable.gene < genome.size() && std::isfinite(genome[variable.gene]);
        });
    else
        return true;
}

/// The fingerprint under which a genome's outcome is stored.
template <Problem P>
Fingerprint identify(const P& problem, const typename P::Genome& genome) {
    if constexpr (Keyed<P>)
        return fingerprint(std::string_view(problem.key(genome)));
    else
        return fingerprint(genome);
}

} // namespace ga
