#pragma once

#include "domain/problem/making_errors.hpp"
#include "domain/problem/verification.hpp"

namespace rough {

/// Responses of responses_of() under DesignProblem::key(). Problems that share them have one model and differ
/// only in the threshold or, under Eq. 11, in the targets.
struct ResponseMemory : KeyedMemory<std::vector<Response>> {};

/// Features in which surfaces with the same response may differ. Their derivatives are exact as long as
/// Genome::scale is constant. L is the length. `height` is log10(h/L) with the root mean square height h.
/// `slope` is log10 of s, the root mean square difference quotient of neighbouring nodes; on a map it
/// includes both axes. `wavelength` is log10(2 pi h/(s L)). `skewness` is the skewness of the heights.
std::vector<ga::Descriptor<Genome>> surface_descriptors(const Grid& grid);

/// Levels at which a design is evaluated. Each is a key of the engine's memory and has a price.
namespace level {
constexpr ga::Level search{0};   ///< one curve per loading, on the problem's grid in its load steps
constexpr ga::Level verified{1}; ///< Verification of the whole search's set-up, on both grids
constexpr ga::Level made{2};     ///< as `search`, and under each of the common errors (CommonErrors)
} // namespace level

/// The misfits of a genome to all targets at one level.
struct DesignOutcome {
    double scale = 1; ///< the factor of Eq. 11; 1 without Eq. 11
    /// Weighted misfits, one vector per target. At the level `verified` they are those of the finer grid in
    /// finer load steps.
    std::vector<Eigen::VectorXd> misfits;
    double excess = 0;     ///< the sum by which limits on shape are exceeded (excess())
    double similarity = 0; ///< the lowest similarity to all targets; at `verified` Verification::worst
};

/// The problem of finding the genome that matches all targets within limits. Its objectives are similarities:
/// - `similarity`: the lowest similarity over all targets.
/// - `verified`: Verification::worst, the similarity on the finer grid in finer load steps, less its error.
/// - `made`: the lower of `similarity` and the similarity under the set-up's errors (CommonErrors).
/// - `low`: the similarity on the first target's points with x up to DesignSetup::threshold.
/// - `high`: the similarity on the first target's points with x from this threshold on.
/// - `goal1`, `goal2`, ...: the similarity to one target.
/// The objectives `verified` and `made` read outcomes of the level of that name, all others those of
/// `search`. A genome that exceeds a limit is ranked below every genome within the limits.
class DesignProblem {
  public:
    using Genome = rough::Genome;  ///< the designed surface
    using Outcome = DesignOutcome; ///< the result of an evaluation

    /// The problem of a set-up. Throws InputError as validate() does, and on invalid limits. Problems may
    /// share a memory if their set-ups differ only in the threshold. Under Eq. 11 targets may differ, too.
    /// Answers are verified on `threads` threads. Prices are in curves of the set-up's model.
    explicit DesignProblem(DesignSetup setup, std::shared_ptr<ResponseMemory> memory = nullptr, int threads = 1);
    /// The problem of a changed set-up, e.g. on a coarser grid, with this one's prices and level `verified`.
    DesignProblem with(DesignSetup setup) const;

    /// The genome's misfits to all targets at a level. Throws InputError or NotConverged if the genome has no
    /// response, and ga::Stopped if ContactOptions::stop ends the solution.
    Outcome evaluate(const Genome& genome, ga::Level level = level::search) const;
    /// Names and prices of the levels, in curves of the unit's model.
    const std::vector<ga::LevelPrice>& levels() const { return levels_; }
    /// The objectives above.
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }

    bool valid(const Genome& genome) const; ///< whether validate() accepts the genome
    /// Whether the outcome has a misfit for each point of each target.
    bool valid_outcome(const Outcome& outcome) const;

    std::string key(const Genome& genome) const; ///< bits of the genome that its outcome depends on (key_of)
    /// The genome in its final form. Under Eq. 11 it gets the scale of its outcome.
    Genome final_genome(Genome genome, const Outcome& outcome) const;

    /// The values of the genome's genes in the order of gene_places(): mm, rad or dimensionless.
    std::vector<double> genes(const Genome& genome) const { return rough::genes(genome); }
    /// The genome with new values of its genes.
    Genome with_genes(const Genome& genome, const std::vector<double>& values) const {
        return rough::with_genes(genome, values);
    }
    /// A random genome (drawn_start). Without Eq. 11 its amplitude is fitted to the first target.
    Genome sample(ga::Stream& random, ga::Work& work) const;
    /// A random genome, without its price.
    Genome sample(ga::Stream& random) const {
        ga::Work work;
        return sample(random, work);
    }
    /// Cuts both genomes' chromosomes, ordered by wavelength, at `cuts` places. Exchanges every second piece.
    void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) const {
        rough::cross_points(a, b, cuts, stream);
    }
    /// Exchanges each chromosome with probability 1/2.
    void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) const { rough::cross_uniform(a, b, stream); }

    /// Bounds of every gene that may move. If the set-up gives `phases`, only phases move. Otherwise phases move by up
    /// to half a turn and A by a factor of up to 10. H, gamma and lambda move within the set-up's bounds. Gamma and
    /// lambda are bounded so that wavelengths stay within the limit. On a periodic grid gamma and lambda are fixed.
    std::vector<ga::Variable> bounds(const Genome& genome) const;
    /// Misfits at the objective's points with exact derivatives, then one row per limit on shape. Contact
    /// fractions are smooth here (contact/interface.hpp), because a count of nodes has no derivative. For
    /// `made` each misfit m, also of each draw and tilt, is m |m/0.05|^1.5, so that the largest ones decide.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    /// The features of surface_descriptors().
    const std::vector<ga::Descriptor<Genome>>& descriptors() const { return descriptors_; }
    double distance(const Genome& a, const Genome& b) const; ///< difference() of the two surfaces, 0 to 2

    const DesignSetup& setup() const { return *setup_; }      ///< targets, model and limits
    const Verifier& verifier() const { return *verifier_; }   ///< verifies under as_reported(setup())
    bool shares_memory() const { return memory_ != nullptr; } ///< whether it has a memory of responses

  private:
    DesignProblem(DesignSetup setup, std::shared_ptr<const Verifier> verifier, std::shared_ptr<ResponseMemory> memory);
    std::vector<Response> search_responses(const Genome& genome) const;

    std::shared_ptr<const DesignSetup> setup_;
    std::shared_ptr<const Verifier> verifier_;
    std::shared_ptr<const CommonErrors> errors_;
    std::shared_ptr<ResponseMemory> memory_;
    std::vector<ga::LevelPrice> levels_;
    std::vector<ga::Objective<Outcome>> objectives_;
    std::vector<ga::Descriptor<Genome>> descriptors_;
};

} // namespace rough
