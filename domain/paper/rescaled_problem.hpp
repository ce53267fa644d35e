#pragma once

#include "domain/mwm/cross.hpp"
#include "domain/paper/phases.hpp"
#include "domain/paper/response_memory.hpp"
#include "domain/target/similarity.hpp"
#include "ga/problem.hpp"

#include <memory>

namespace rough {

/// What a contact solution tells the paper's problem of a genome.
struct RescaledResponse {
    double scale;      ///< by Eq. 11: brings the genome's last pressure to p_max
    Curve stiffness;   ///< K(p) with pressures so rescaled
    Response response; ///< of the genome at scale 1
};

/// By what a genome's evaluation under way is judged (`appraise`).
enum class Outlook {
    proven,   ///< what its first load steps leave possible: an exact bound
    foretold, ///< also a coarse grid's curve, within margins that are an estimate
};

/// The paper's problem: find the genome whose K(p), rescaled by Eq. 11 so that its last load step lies at
/// p_max, is similar to the target. Amplitude is no gene here: `settled` sets it.
class RescaledProblem {
  public:
    using Genome = rough::Genome;     ///< what is evolved
    using Outcome = RescaledResponse; ///< what an evaluation yields

    /// `threshold` is p_bar (MPa), which parts the objectives `low` on [0, p_bar] and `high` on [p_bar,
    /// p_max]. Throws InputError if the target reaches beyond max_pressure or one of its two parts has no
    /// point.
    RescaledProblem(Model model, Target target, double max_pressure, double threshold,
                    std::shared_ptr<ResponseMemory> memory = nullptr, PhaseReach reach = {},
                    Outlook outlook = Outlook::proven);

    /// The genome's response at scale 1, within the model's accuracy, and the scale that Eq. 11 gives it.
    /// Throws NotConverged.
    Outcome evaluate(const Genome& genome) const;
    /// The outcome of a genome whose response at scale 1 this is.
    Outcome of_response(const Genome& genome, Response response) const;
    /// An evaluation that goes from one load step to the next and tells after each how similar the curve can
    /// still be. Null where the response is known, where it need not be exact, or where another solver than
    /// the nested factor is asked for.
    std::unique_ptr<ga::Appraisal<Outcome>> appraise(const Genome& genome) const;
    /// similarity (Eq. 12 over all points), low, high
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }

    std::string key(const Genome& genome) const { return shape_key(genome); } ///< all bits but the scale's
    /// The genome at the scale of Eq. 11.
    Genome settled(Genome genome, const Outcome& outcome) const;

    /// In the order of gene_places(); refinement moves phases alone (rad).
    std::vector<double> genes(const Genome& genome) const { return rough::genes(genome); }
    /// The genome with those genes replaced.
    Genome with_genes(const Genome& genome, const std::vector<double>& values) const {
        return rough::with_genes(genome, values);
    }
    /// The choice `all`: every phase within the reach.
    std::vector<ga::Variable> bounds(const Genome& genome) const { return phase_variables(genome, reach_); }
    /// Exchanges chromosomes at `cuts` places along their wave lengths.
    void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) const {
        rough::cross_points(a, b, cuts, stream);
    }
    /// Exchanges each chromosome with probability 1/2.
    void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) const { rough::cross_uniform(a, b, stream); }

    /// Relative misfits at the objective's points and their derivatives by the adjoint.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    Outlook outlook() const { return outlook_; }          ///< of evaluations under way
    const Model& model() const { return model_; }         ///< grid, body, load steps
    const Target& target() const { return target_; }      ///< what similarity is to
    double max_pressure() const { return max_pressure_; } ///< p_max, MPa

  private:
    const std::vector<Index>& points_of(const std::string& objective) const;

    Model model_;
    Target target_;
    double max_pressure_;
    std::shared_ptr<ResponseMemory> memory_;
    PhaseReach reach_;
    Outlook outlook_;
    double stiffest_; ///< no tangent is above it, MPa/mm
    std::vector<std::pair<std::string, std::vector<Index>>> points_;
    std::vector<ga::Objective<Outcome>> objectives_;
};

/// The similarity of a genome under a problem's set-up, on a grid `refine` times finer; Eq. 11 anew. Solved
/// throughout, whatever accuracy the search was allowed.
double similarity(const RescaledProblem& problem, const Genome& genome, Index refine = 1);
/// The genome with the scale that Eq. 11 gives it on the problem's own grid, solved throughout.
Genome in_final_form(const RescaledProblem& problem, Genome genome);

} // namespace rough
