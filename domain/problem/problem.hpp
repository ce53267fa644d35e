#pragma once

#include "domain/problem/made.hpp"
#include "domain/problem/verification.hpp"

#include <memory>

namespace rough {

/// Responses by pressed(), for problems of one model that differ only in target or threshold and so request
/// the same curves. Threads may share it. Responses are pure functions of the key, so it does not affect
/// results.
class ResponseMemory {
  public:
    /// The responses for a problem's key, or nothing.
    std::optional<std::vector<Response>> find(const std::string& key) const {
        const std::lock_guard lock(guard_);
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }
    /// Keeps the responses, unless the key has some.
    void keep(const std::string& key, const std::vector<Response>& responses) {
        const std::lock_guard lock(guard_);
        known_.emplace(key, responses);
    }

  private:
    mutable std::mutex guard_;
    std::map<std::string, std::vector<Response>> known_;
};

/// Features in which surfaces with the same response may differ, with exact derivatives at a fixed scale, of
/// the profile on this grid. `height`: log10 of the root mean square height over the length. `slope`: log10
/// of the root mean square difference quotient of neighbouring nodes, on a map along both axes. `wavelength`:
/// log10 of 2 pi rms height / rms slope over the length. `skewness` of the heights.
std::vector<ga::Descriptor<Genome>> surface_descriptors(const Grid& grid);

/// The misfits of a genome to all targets.
struct DesignOutcome {
    double scale = 1;                     ///< the factor of Eq. 11; 1 without it
    std::vector<Eigen::VectorXd> misfits; ///< weighted, one vector per target
    double excess = 0;                    ///< the sum by which limits on shape are exceeded
    Genome genome;                        ///< as it was evaluated

    double similarity() const; ///< 1 - the largest |misfit| of all targets
};

/// Finds the genome that matches all targets within limits. Objectives:
/// - `similarity`: the lowest over all targets.
/// - `verified`: the lowest of `similarity` and Verification::worst (finer grid, finer load steps).
/// - `more_steps`: the lower of `similarity` and that in finer load steps.
/// - `made`: the lower of `similarity` and that with the set-up's errors (CommonErrors).
/// - `low`, `high`: on the first target's points up to and from the threshold.
/// - `goal1`, `goal2`, ...: on one target.
/// A genome that exceeds a limit is ranked below every genome within the limits.
class DesignProblem {
  public:
    using Genome = rough::Genome;  ///< the designed surface
    using Outcome = DesignOutcome; ///< the result of an evaluation

    /// Throws InputError as validate() does, and on invalid limits. Problems may share a memory if their
    /// set-ups differ only in the threshold, or under Eq. 11 in the targets. Answers are verified on
    /// `threads` threads.
    explicit DesignProblem(DesignSetup setup, std::shared_ptr<ResponseMemory> memory = nullptr,
                           int threads = 1);

    /// The genome's misfit to every target. Throws InputError or NotConverged if it has no response, and
    /// ga::Stopped if ContactOptions::stop ends it. The objectives `verified` and `more_steps` throw alike.
    Outcome evaluate(const Genome& genome) const;
    /// The outcome of a genome with these responses by pressed().
    Outcome of_responses(const Genome& genome, std::vector<Response> responses) const;
    /// The objectives above.
    const std::vector<ga::Objective<Outcome>>& objectives() const { return objectives_; }

    bool valid(const Genome& genome) const;           ///< validate() accepts it
    bool valid_outcome(const Outcome& outcome) const; ///< misfits to each point of each target

    /// The bits of the genome that its outcome depends on (key_of).
    std::string key(const Genome& genome) const;
    /// The genome, under Eq. 11 with the scale of its outcome.
    Genome settled(Genome genome, const Outcome& outcome) const;

    /// Its genes in the order of gene_places(): mm, rad, dimensionless.
    std::vector<double> genes(const Genome& genome) const { return rough::genes(genome); }
    /// The genome with those genes replaced.
    Genome with_genes(const Genome& genome, const std::vector<double>& values) const {
        return rough::with_genes(genome, values);
    }
    /// A random genome (drawn_start), with its amplitude fitted if that is free.
    Genome sample(ga::Stream& random) const;
    /// Exchanges chromosomes at `cuts` places along their wavelengths.
    void cross_points(Genome& a, Genome& b, std::size_t cuts, ga::Stream& stream) const {
        rough::cross_points(a, b, cuts, stream);
    }
    /// Exchanges each chromosome with probability 1/2.
    void cross_uniform(Genome& a, Genome& b, ga::Stream& stream) const { rough::cross_uniform(a, b, stream); }

    /// Every gene that may move; only phases if the set-up demands it. Otherwise phases move by half a turn,
    /// A by a factor of 10, and H, gamma and lambda within the set-up's bounds. Gamma and lambda are bounded
    /// so that no wave becomes shorter than allowed. On a periodic grid both are fixed.
    std::vector<ga::Variable> bounds(const Genome& genome) const;
    /// Misfits at the objective's points with exact derivatives, then one row per limit on shape. Contact
    /// fractions are the smooth ones here (contact/interface.hpp), because a count of nodes has no
    /// derivative.
    ga::Sensitivity sensitivity(const Genome& genome, const std::string& objective) const;

    /// The features of surface_descriptors().
    const std::vector<ga::Descriptor<Genome>>& descriptors() const { return descriptors_; }
    /// How much the profiles of two genomes differ (difference); 0 to 2.
    double distance(const Genome& a, const Genome& b) const;

    const DesignSetup& setup() const { return *setup_; }      ///< targets, model and limits
    const Verifier& verifier() const { return *verifier_; }   ///< for as_reported() of the set-up
    bool shares_memory() const { return memory_ != nullptr; } ///< whether other problems may share it
    /// The points of a target that an objective uses.
    std::vector<Index> points_of(const std::string& objective, std::size_t target) const;

  private:
    std::shared_ptr<const DesignSetup> setup_;
    std::shared_ptr<const Verifier> verifier_;
    std::shared_ptr<const CommonErrors> errors_;
    std::shared_ptr<ResponseMemory> memory_;
    std::vector<ga::Objective<Outcome>> objectives_;
    std::vector<ga::Descriptor<Genome>> descriptors_;
};

} // namespace rough
