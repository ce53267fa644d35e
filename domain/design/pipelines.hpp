#pragma once

#include "domain/design/starts.hpp"
#include "domain/paper/vocabulary.hpp"
#include "domain/problem/pipeline.hpp"

namespace rough {

/// Puts n genomes made for the target (shaped_start) in the place of the population.
struct Shape : ga::Operator {
    std::size_t n; ///< how many

    /// `shape n`.
    explicit Shape(std::size_t count) : n(count) {}
    ///@{
    /// What every operator has (Operator).
    std::string text() const { return "shape " + std::to_string(n); }
    void check(ga::Known& known) const { known.scored.reset(); }

    ga::Population<Genome> operator()(ga::Population<Genome> population,
                                      ga::Context<DesignProblem>& context) const;
    ///@}
};

/// What text pipelines for a design are made of: the engine's words, roughness's, and `shape`, `fit`, and
/// `reduce goal1` and on, one a target.
ga::Registry<DesignProblem> design_registry(const DesignSetup& setup);

} // namespace rough
