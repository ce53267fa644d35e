#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/design/limits.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/target/goal.hpp"
#include "ga/problem.hpp"
#include "ga/random.hpp"

#include <memory>
#include <optional>

namespace rough {

/// What a design is asked for. What is left at 0 is filled in where a search begins (design/defaults.hpp):
/// K at a target is found by search({.goals = {read_goal("target.csv")}}).
struct DesignSetup {
    Model model = {};             ///< grid, body, load steps, contact options
    std::vector<Goal> goals = {}; ///< at least one; the first shapes the starts
    /// MPa: every genome is rescaled to it at its last load step (Eq. 11). Without it amplitude is a gene
    /// like another, and load steps end where the goals do.
    std::optional<double> max_pressure = {};
    GeneBounds bounds = {};   ///< of the genes
    MakingLimits limits = {}; ///< of what can be made; shortest_wave 0: 8 node distances
};

/// A genome's answer to all goals.
struct DesignOutcome {
    double scale = 1;                     ///< by Eq. 11; 1 where it does not apply
    std::vector<Eigen::VectorXd> misfits; ///< of each goal at its points, weighted
    double excess = 0;                    ///< over the limits on shape
    Genome genome;                        ///< as it was evaluated

    double similarity() const; ///< 1 - the largest |misfit| of all goals
};

/// Find the genome that answers as asked, within limits. Objectives: `similarity`; `judged`, the smaller of
/// it and the same on a grid four times finer; `low` and `high`, on the first goal's points up to and from
/// the middle of its range; `goal1`, `goal2` and on, on each goal alone. A genome over the limits is ranked
/// below every one within them.
class DesignProblem {
  public:
    using Genome = rough::Genome;  ///< what is designed
    using Outcome = DesignOutcome; ///< what an evaluation yields

    /// Throws InputError on no goals, a goal beyond max_pressure, goals that the set-up cannot load together,
    /// or limits without sense.
    explicit DesignProblem(DesignSetup setup);

    /// The genome's misfit to every goal. Throws InputError or NotConverged where it has no answer.
    Outcome evaluate(const Genome& genome) const;
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

    /// Every gene that may move: phases by half a turn; A by a factor of 10; H, gamma and lambda within the
    /// set-up's bounds, the latter two so that no wave becomes shorter than allowed, both sharing the slack.
    std::vector<ga::Variable> bounds(const Genome& genome) const;
    /// Misfits at the objective's points, then one row a limit on shape, with exact derivatives. Contact
    /// fractions are the smooth ones (response/smooth_area.hpp) here, as a count of nodes has no derivative.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    const DesignSetup& setup() const { return *setup_; } ///< what is asked for

  private:
    explicit DesignProblem(std::shared_ptr<DesignSetup> setup);

    std::shared_ptr<const DesignSetup> setup_;
    std::vector<ga::Objective<Outcome>> objectives_;
};

/// A genome's responses under a set-up, in final amplitude, one for each way the goals are loaded, and which
/// of them serves each goal.
struct DesignResponse {
    double scale = 1;                 ///< that Eq. 11 found
    std::vector<Response> responses;  ///< one a way of loading
    std::vector<std::size_t> of_goal; ///< index into `responses` for each goal
};
/// `model` may differ from the set-up's own: a finer grid, more load steps, another kernel; within its
/// accuracy.
DesignResponse respond(const DesignSetup& setup, const Genome& genome, const Model& model);
/// The same for a profile, e.g. a measured one; Eq. 11 as for a genome.
DesignResponse respond(const DesignSetup& setup, const Profile& profile, const Model& model);

/// The set-up's model for each way the goals are loaded.
std::vector<Model> loaded_models(const DesignSetup& setup);

/// The same set-up solved throughout, whatever accuracy its model allows.
DesignSetup exactly(DesignSetup setup);

/// Each goal's similarity.
std::vector<double> similarities(const DesignSetup& setup, const DesignResponse& response);
/// The smallest similarity of all goals.
double similarity(const DesignSetup& setup, const DesignResponse& response);
/// The same of a genome on a grid `refine` times finer, within the set-up's accuracy; Eq. 11 anew where it
/// applies.
double similarity(const DesignSetup& setup, const Genome& genome, Index refine = 1);

} // namespace rough
