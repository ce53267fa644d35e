#pragma once

#include "domain/problem/response.hpp"

#include <array>
#include <deque>
#include <mutex>

namespace rough {

/// How many times the nodes and the load steps an answer has to survive.
constexpr int verified_refinement = 4;

/// The set-up with `times` the load steps on both sides: a target that is a measured profile's own response
/// (DesignSetup::like) is taken from its finer steps, others stand as they were given.
DesignSetup in_finer_steps(DesignSetup setup, int times = verified_refinement);

/// A genome's similarity as it is asked for, and under finer grids and load steps; Eq. 11 anew each time
/// where it applies. NaN: not verified, as the verifier was stopped before.
struct Verification {
    double similarity = 0; ///< on the set-up's grid, in its load steps
    double refined = 0;    ///< on a grid of 4(N - 1) + 1 nodes (periodic: 4 N), along both axes of an area
    double stepped = 0;    ///< in four times the load steps, on both sides
    double both = 0;       ///< on that grid in those steps
    /// Of an area `both` is less than what it was read as by so much (Verifier::of).
    double reading_error = 0;
    std::vector<Response> on_own;   ///< as pressed() has them, on the set-up's grid in its load steps
    std::vector<Response> on_finer; ///< the same on the finer grid
    double seconds = 0;             ///< of wall time that verifying took
    /// Each target's, of the four in the order above.
    std::array<std::vector<Eigen::VectorXd>, 4> misfits;

    /// The least of the four, NaN where not all are known.
    double worst() const;
};

/// Verifies the genomes of one set-up.
class Verifier {
  public:
    /// A fine area's load steps are solved by up to so many threads.
    explicit Verifier(DesignSetup setup, int threads = 1) : setup_(std::move(setup)), threads_(threads) {}

    /// Of two curves in finer steps every fourth load step is one of the set-up's own: two solutions give all
    /// four. On a fine area every fourth of the finer steps is solved, and those between where on the
    /// set-up's own grid, which solves all, a cubic through the pressures and tangents beside them is off by
    /// more than 2e-3 of a secant; the others are read off such cubics. What this changes on the own grid is
    /// taken off `both`. Where the set-up's ContactOptions::stop ends it, what was not verified by then is
    /// left at NaN, its misfits and responses empty. Otherwise throws what respond() throws.
    Verification of(const Genome& genome) const;
    /// The same, remembered: the last 32 that were complete are kept.
    Verification remembered(const Genome& genome) const;
    /// What is remembered of a genome.
    std::optional<Verification> known(const Genome& genome) const;
    const DesignSetup& setup() const { return setup_; } ///< as it was given
    /// The set-up in four times the load steps. Where the targets are a measured surface's, its finer
    /// response is solved when it is first asked for: most problems never verifier.
    const DesignSetup& finer() const;

  private:
    void verifier(const Genome& genome, Verification& result) const;
    std::vector<Response> on_fine_area(const Genome& genome,
                                       const std::vector<std::vector<char>>& to_solve) const;

    DesignSetup setup_;
    int threads_;
    mutable std::once_flag asked_;
    mutable DesignSetup finer_;
    mutable std::mutex guard_;
    mutable std::deque<std::pair<std::string, Verification>> known_; ///< by what decides their curves
};

} // namespace rough
