#pragma once

#include "domain/problem/response.hpp"

#include <deque>
#include <mutex>

namespace rough {

/// The set-up with `times` the load steps on both sides. Targets that are a measured profile's response
/// (DesignSetup::like) are taken from its finer steps; other targets do not change.
DesignSetup in_finer_steps(DesignSetup setup, int times = verified_refinement);

/// A genome's similarity under the set-up, and under finer grids and load steps. Eq. 11 is applied each time.
/// NaN: not verified, because the verifier was stopped before.
struct Verification {
    double similarity = 0;    ///< on the set-up's grid, in its load steps
    double refined = 0;       ///< on a grid of 4(N - 1) + 1 nodes (periodic: 4 N), along both axes of a map
    double stepped = 0;       ///< in four times the load steps, on both sides
    double both = 0;          ///< on the finer grid in four times the load steps
    double reading_error = 0; ///< error of interpolated load steps, already subtracted from `both`
    std::vector<Response> on_own;   ///< responses on the set-up's grid in its load steps
    std::vector<Response> on_finer; ///< responses on the finer grid in the set-up's load steps
    double seconds = 0;             ///< wall time of the verification
    /// Misfits of each target, in the order of the four similarities.
    std::array<std::vector<Eigen::VectorXd>, 4> misfits;

    /// The lowest of the four; NaN unless all are known.
    double worst() const;
};

/// Verifies the genomes of one set-up.
class Verifier {
  public:
    /// A fine map's load steps are solved on up to `threads` threads.
    explicit Verifier(DesignSetup setup, int threads = 1) : setup_(std::move(setup)), threads_(threads) {}

    /// Two solutions in finer load steps give all four similarities, because every fourth step is one of the
    /// set-up's. On a fine map, only every fourth step is solved. The steps between are interpolated by
    /// cubics through the neighbouring pressures and tangents. All steps are solved on the set-up's grid.
    /// Steps with an interpolation error above 2e-3 of a secant there are solved on the fine map, too. The
    /// effect of the interpolation on the set-up's grid is subtracted from `both`. If ContactOptions::stop
    /// ends the verification, the remaining similarities are NaN, and their misfits and responses empty.
    /// Otherwise throws what respond() throws.
    Verification of(const Genome& genome) const;
    /// The result of of(). The last 32 complete verifications are stored.
    Verification remembered(const Genome& genome) const;
    /// A genome's stored verification, or nothing.
    std::optional<Verification> known(const Genome& genome) const;
    const DesignSetup& setup() const { return setup_; } ///< as it was given
    /// The set-up in four times the load steps. A measured surface's finer response is solved on the first
    /// call, because most problems never verify.
    const DesignSetup& finer() const;

  private:
    void verify(const Genome& genome, Verification& result) const;
    std::vector<Response> on_fine_area(const Genome& genome,
                                       const std::vector<std::vector<char>>& to_solve) const;

    DesignSetup setup_;
    int threads_;
    mutable std::once_flag finer_made_;
    mutable DesignSetup finer_;
    mutable std::mutex guard_;
    mutable std::deque<std::pair<std::string, Verification>> known_; ///< under key_of()
};

} // namespace rough
