#pragma once

#include "ga/fingerprint.hpp"

#include <Eigen/Core>

#include <concepts>
#include <functional>
#include <string>
#include <vector>

namespace ga {

/// One reading of an evaluation's outcome, greater is better. A pure function; NaN, infinity or an exception
/// marks the individual as failed.
template <class Outcome>
struct Objective {
    std::string name;
    std::function<double(const Outcome&)> fitness;
};

/// All that ga knows of a domain: a genome, the one paid call `evaluate` (pure: called from several threads
/// at once, its outcome is remembered; it may throw), and the objectives that read its outcome.
/// objectives().front() is the one `score()` takes; there is at least one.
template <class P>
concept Problem = requires(const P& problem, const typename P::Genome& genome) {
    requires std::copyable<typename P::Genome>;
    requires std::copyable<typename P::Outcome>;
    { problem.evaluate(genome) } -> std::same_as<typename P::Outcome>;
    { problem.objectives() } -> std::same_as<const std::vector<Objective<typename P::Outcome>>&>;
};

/// Optional: the bytes that identify a genome, where ga cannot read its bits or where several genomes have
/// one outcome.
template <class P>
concept Keyed = requires(const P& problem, const typename P::Genome& genome) {
    { problem.key(genome) } -> std::convertible_to<std::string>;
};

/// Optional: the final form of a genome once it is evaluated; `score` puts it in the genome's place. It must
/// have the genome's own key, so that forgetting an outcome never changes a result.
template <class P>
concept Settling = requires(const P& problem, const typename P::Genome& genome,
                            const typename P::Outcome& outcome) {
    { problem.settled(genome, outcome) } -> std::same_as<typename P::Genome>;
};

/// Optional: a genome as a vector of real genes, and back.
template <class P>
concept HasGenes = requires(const P& problem, const typename P::Genome& genome,
                            const std::vector<double>& genes) {
    { problem.genes(genome) } -> std::same_as<std::vector<double>>;
    { problem.with_genes(genome, genes) } -> std::same_as<typename P::Genome>;
};

/// Residuals r_k of an objective (a perfect genome has none) and their derivatives: rows k, columns genes.
struct Sensitivity {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;
};

/// Optional: the one derivative from which `refine` builds every form (squares, minimax, the paper's s|s|).
template <class P>
concept Sensitive = HasGenes<P> &&
    requires(const P& problem, const typename P::Genome& genome, const std::string& objective) {
    { problem.sensitivity(genome, objective) } -> std::same_as<Sensitivity>;
};

/// A gene that may move, between its bounds.
struct Variable {
    std::size_t gene;
    double lower, upper;
};

/// Which genes of a genome may move, and how far: a named choice that refinement takes.
template <class G>
struct Variables {
    std::string name;
    std::function<std::vector<Variable>(const G&)> of;
};

/// Optional: every gene with its bounds, the choice called `all`.
template <class P>
concept Bounded = HasGenes<P> && requires(const P& problem, const typename P::Genome& genome) {
    { problem.bounds(genome) } -> std::same_as<std::vector<Variable>>;
};

/// The identity under which the genome's outcome is remembered.
template <Problem P>
Fingerprint identify(const P& problem, const typename P::Genome& genome) {
    if constexpr (Keyed<P>)
        return fingerprint(std::string_view(problem.key(genome)));
    else
        return fingerprint(genome);
}

} // namespace ga
