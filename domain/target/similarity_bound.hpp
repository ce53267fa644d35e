#pragma once

#include "domain/contact/solve.hpp"
#include "domain/target/target.hpp"

#include <vector>

namespace rough {

/// The largest similarity (Eq. 12, after Eq. 11) that a curve can still have when only its first load steps
/// are solved. P is convex in Delta (domain/accuracy/README.md, "Load steps not taken"), so the secants never
/// decrease; those to come lie between the last tangent and full contact's stiffness, and they fix P_nt,
/// which Eq. 11 stretches the curve by.
class SimilarityBound {
  public:
    /// `max_pressure` is Eq. 11's (MPa), `stiffest` bounds every tangent (MPa/mm), infinite where nothing
    /// does.
    SimilarityBound(double max_pressure, double stiffest)
        : max_pressure_(max_pressure), stiffest_(stiffest) {}
    /// Counts these points of a target of stiffness, too.
    void add(const Target& target, const std::vector<Index>& points);

    /// `first` are at least 2 of the `count` load steps, which are even. Exact but for rounding, for which it
    /// leaves room; an estimate where the secants of all steps are `foretold` (MPa/mm): those to come are
    /// then taken to be near them.
    double operator()(const std::vector<LoadStep>& first, std::size_t count,
                      const std::vector<double>& foretold = {}) const;

  private:
    /// Pressure over max_pressure; what a curve may be there, over y_k; y_k.
    struct Point {
        double at, lower, upper, wanted, weight;
    };
    double max_pressure_, stiffest_;
    std::vector<Point> points_;
};

} // namespace rough
