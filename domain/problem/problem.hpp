#pragma once

#include "domain/problem/made.hpp"
#include "domain/problem/response_memory.hpp"
#include "domain/problem/verification.hpp"
#include "ga/base/random.hpp"
#include "ga/problem/problem.hpp"
#include "ga/refinement/sensitivity.hpp"

#include <memory>

namespace rough {

/// A genome's answer to all targets.
struct DesignOutcome {
    double scale = 1;                     ///< by Eq. 11; 1 where it does not apply
    std::vector<Eigen::VectorXd> misfits; ///< of each target at its points, weighted
    double excess = 0;                    ///< over the limits on shape
    Genome genome;                        ///< as it was evaluated

    double similarity() const; ///< 1 - the largest |misfit| of all targets
};

/// Find the genome that answers as asked, within limits. Objectives: `similarity`; `verified`, the least of
/// it and the same on a finer grid and in finer load steps (Verification::worst); `more_steps`, of it and the
/// same in finer load steps; `made`, the least of it and what survives the set-up's errors (CommonErrors);
/// `low` and `high`, on the first target's points up to and from the threshold; `goal1`, `goal2` and on, on
/// each target alone. A genome over the limits is ranked below every one within them.
class DesignProblem {
  public:
    using Genome = rough::Genome;  ///< what is designed
    using Outcome = DesignOutcome; ///< what an evaluation yields

    /// Throws InputError as validate() does, and on limits without sense. Problems whose set-ups differ in
    /// targets under Eq. 11 or in the threshold alone may share a memory. An answer is verified on so many
    /// threads.
    explicit DesignProblem(DesignSetup setup, std::shared_ptr<ResponseMemory> memory = nullptr,
                           int threads = 1);

    /// The genome's misfit to every target. Throws InputError or NotConverged where it has no answer,
    /// ga::Stopped where the set-up's ContactOptions::stop ends it, as `verified` and `more_steps` do.
    Outcome evaluate(const Genome& genome) const;
    /// The outcome of a genome whose responses to each way of loading, as pressed() has them, these are.
    Outcome of_responses(const Genome& genome, std::vector<Response> responses) const;
    /// Those named above.
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }

    /// The genome's bits as far as they decide its outcome: all, or under Eq. 11 all but the scale.
    std::string key(const Genome& genome) const;
    /// Under Eq. 11 the genome with its scale set.
    Genome settled(Genome genome, const Outcome& outcome) const;

    /// Its genes in the order of gene_places(): mm, rad, dimensionless.
    std::vector<double> genes(const Genome& genome) const { return rough::genes(genome); }
    /// The genome with those genes replaced.
    Genome with_genes(const Genome& genome, const std::vector<double>& values) const {
        return rough::with_genes(genome, values);
    }
    /// A genome drawn blindly (drawn_start), its amplitude fitted where it is free.
    Genome sample(ga::Stream& random) const;
    /// Exchanges chromosomes at `cuts` places along their wave lengths.
    void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) const;
    /// Exchanges each chromosome with probability 1/2.
    void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) const;

    /// Every gene that may move: phases alone where the set-up says so, else phases by half a turn; A by a
    /// factor of 10; H, gamma and lambda within the set-up's bounds, the latter two so that no wave becomes
    /// shorter than allowed, both sharing the slack; these two stay where the grid is periodic.
    std::vector<ga::Variable> bounds(const Genome& genome) const;
    /// Misfits at the objective's points, then one row a limit on shape, with exact derivatives. Contact
    /// fractions are the smooth ones (contact/smooth_area.hpp) here, as a count of nodes has no derivative.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    /// What surfaces may differ in (surface_descriptors).
    const std::vector<ga::Descriptor<Genome>>& descriptors() const { return descriptors_; }
    /// How much the profiles of two genomes differ (difference); 0 to 2.
    double distance(const Genome& a, const Genome& b) const;

    const DesignSetup& setup() const { return *setup_; }      ///< what is asked for
    const Verifier& verifier() const { return *verifier_; }   ///< of the set-up as answers are reported
    bool shares_memory() const { return memory_ != nullptr; } ///< with other problems
    double stiffest() const { return stiffest_; }             ///< no tangent is above it, MPa/mm
    /// Which points of a target an objective is over.
    std::vector<Index> points_of(const std::string& objective, std::size_t target) const;

  private:
    std::shared_ptr<const DesignSetup> setup_;
    std::shared_ptr<const Verifier> verifier_;
    std::shared_ptr<const CommonErrors> errors_;
    std::shared_ptr<ResponseMemory> memory_;
    double stiffest_;
    std::vector<ga::Objective<Outcome>> objectives_;
    std::vector<ga::Descriptor<Genome>> descriptors_;
};

} // namespace rough
