#pragma once

#include "domain/problem/response.hpp"

namespace rough {

/// How many times the nodes and the load steps an answer has to survive.
constexpr int judged_refinement = 4;

/// The set-up with `times` the load steps on both sides: a target that is a measured profile's own response
/// (DesignSetup::like) is taken from its finer steps, others stand as they were given.
DesignSetup in_finer_steps(DesignSetup setup, int times = judged_refinement);

/// A genome's similarity as it is asked for, and under finer grids and load steps; Eq. 11 anew each time
/// where it applies.
struct Judgement {
    double similarity = 0; ///< on the set-up's grid, in its load steps
    double refined = 0;    ///< on a grid of 4(N - 1) + 1 nodes (periodic: 4 N)
    double stepped = 0;    ///< in four times the load steps, on both sides
    double both = 0;       ///< on that grid in those steps

    double worst() const; ///< the least of the four
};

/// Judges the genomes of one set-up.
class Judge {
  public:
    /// Solves a measured profile's finer response, where the targets are one's.
    explicit Judge(const DesignSetup& setup) : setup_(setup), finer_(in_finer_steps(setup)) {}

    /// Of two curves in finer steps every fourth load step is one of the set-up's own: two solutions give all
    /// four. Throws what respond() throws.
    Judgement of(const Genome& genome) const;
    const DesignSetup& finer() const { return finer_; } ///< the set-up in four times the load steps

  private:
    DesignSetup setup_, finer_;
};

} // namespace rough
