#pragma once

#include "domain/design/starts.hpp"
#include "domain/paper/vocabulary.hpp"
#include "domain/problem/pipeline.hpp"

namespace rough {

/// Puts n genomes made for the target (shaped_start) in the place of the population.
struct Shape : ga::Operator {
    std::size_t n = 1; ///< how many

    ///@{
    /// What every operator has (ga::Operator).
    static constexpr bool begins = true;
    static ga::Words words() {
        return {"shape", "roughness",
                "n genomes made for the target, contact solved backwards, in the population's place"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, ga::whole("n", std::nullopt, 1, "how many"));
    }
    void check(ga::Known& known) const { known.scored.reset(); }

    ga::Population<Genome> operator()(ga::Population<Genome> population,
                                      ga::Context<DesignProblem>& context) const;
    ///@}
};

/// Puts n sums of the measured profile's own waves (own_waves) in the place of the population: of all waves
/// that can be made, of half as many, and on.
struct Own : ga::Operator {
    std::size_t n = 1; ///< how many

    ///@{
    /// What every operator has (ga::Operator).
    static constexpr bool begins = true;
    static ga::Words words() {
        return {
            "own", "roughness",
            "n sums of the measured profile's own waves, each with half as many as the one before, in the "
            "population's place"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, ga::whole("n", std::nullopt, 1, "how many"));
    }
    void check(ga::Known& known) const { known.scored.reset(); }

    ga::Population<Genome> operator()(ga::Population<Genome> population,
                                      ga::Context<DesignProblem>& context) const;
    ///@}
};

/// What text pipelines for a design are made of: the engine's words, roughness's, and `shape`, `own`, `fit`,
/// and `reduce goal1` and on, one a target.
ga::Registry<DesignProblem> design_registry(const DesignSetup& setup);

/// The pipeline of a text made of design_registry's words, in which design_variants may stand as stages.
/// Throws ga::UsageError on one that cannot be made.
Pipeline design_pipeline(const DesignSetup& setup, const std::string& text);
/// The pipeline of one of design_variants, by its name.
Pipeline design_variant(const DesignSetup& setup, const std::string& name);
/// The text of a variant that ends in refining what an answer is judged by, without that end.
std::string without_polish(const std::string& variant);

} // namespace rough
