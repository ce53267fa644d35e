#pragma once

#include "domain/problem/memory.hpp"
#include "domain/problem/response.hpp"

namespace rough {

/// The set-up with `times` the load steps. Targets that are a measured profile's response
/// (DesignSetup::measured) are computed again in the finer steps; other targets do not change.
DesignSetup in_finer_steps(DesignSetup setup, int times = verified_refinement);

/// The four similarities of a genome: under the set-up, and on a finer grid and in finer load steps. Eq. 11
/// is applied each time. NaN: not verified, because the verifier was stopped before.
struct Verification {
    double similarity = 0; ///< similarity on the set-up's grid, in its load steps
    double refined = 0;    ///< similarity on a grid of 4(N - 1) + 1 nodes (periodic: 4 N) along each axis
    double more_steps = 0; ///< similarity in four times the load steps (in_finer_steps)
    double both = 0;       ///< similarity on the finer grid in four times the load steps
    double interpolation_error = 0; ///< error of interpolated load steps, already subtracted from `both`
    std::vector<Response> on_grid;  ///< responses on the set-up's grid in its load steps
    std::vector<Response> on_finer; ///< responses on the finer grid in the set-up's load steps
    double seconds = 0;             ///< wall time of the verification
    /// Misfits of each target, in the order of the four similarities.
    std::array<std::vector<Eigen::VectorXd>, 4> misfits;

    /// The lowest of the four similarities; NaN unless all are known.
    double worst() const;
};

/// Verifies the genomes of one set-up.
class Verifier {
  public:
    /// The verifier of a set-up. It solves the load steps of a fine map on up to `threads` threads.
    explicit Verifier(DesignSetup setup, int threads = 1) : setup_(std::move(setup)), threads_(threads) {}

    /// Verifies one genome. One solution on each grid in finer load steps gives all four similarities,
    /// because every fourth step is a load step of the set-up. On a fine map, steps between are interpolated
    /// unless the same interpolation on the set-up's grid has an error above 2e-3 times a secant.
    ///
    /// If ContactOptions::stop ends the verification, the remaining similarities are NaN, and their misfits
    /// and responses are empty. Otherwise throws what respond() throws.
    Verification of(const Genome& genome) const;
    /// A genome's verification among the last 32 complete ones, or nothing.
    std::optional<Verification> known(const Genome& genome) const {
        return known_.find(key_of(setup_, genome));
    }
    const DesignSetup& setup() const { return setup_; } ///< the set-up that was given
    /// The set-up in four times the load steps. The finer response of a measured surface is solved on the
    /// first call, because most problems never verify.
    const DesignSetup& finer() const;

  private:
    void verify(const Genome& genome, Verification& result) const;
    std::vector<Response> on_fine_map(const Genome& genome,
                                      const std::vector<std::vector<char>>& to_solve) const;

    DesignSetup setup_;
    int threads_;
    mutable std::once_flag is_finer_known_;
    mutable DesignSetup finer_;
    mutable KeyedMemory<Verification> known_{32}; ///< under key_of()
};

} // namespace rough
