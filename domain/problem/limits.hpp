#pragma once

#include "domain/mwm/sampling.hpp"

#include <string>
#include <vector>

namespace rough {

/// Between which bounds a design may move its genes. Lengths in mm.
struct GeneBounds {
    double H_from = 0.05;     ///< least Hurst exponent
    double H_to = 2.5;        ///< greatest Hurst exponent
    double gamma_from = 1.05; ///< least ratio of neighbouring wave numbers, > 1
    double gamma_to = 4;      ///< greatest ratio of neighbouring wave numbers
    double lambda_from = 0;   ///< least length of a series' longest wave, mm; 0: L/4
    double lambda_to = 0;     ///< greatest length of a series' longest wave, mm; 0: 4 L
};

/// What can be made. 0: no limit.
struct MakingLimits {
    double shortest_wave = 0; ///< mm
    double max_slope = 0;     ///< of the profile's own |dZ/dx|, an area's gradient
    double max_height = 0;    ///< max Z - min Z, mm
    /// of curvature, 1/|d2Z/dx2|, in whatever direction of an area, mm: no larger than the circle's own
    double min_radius = 0;

    /// Whether the sampled shape is limited, not the waves alone.
    bool any_shape() const { return max_slope > 0 || max_height > 0 || min_radius > 0; }
};

/// One limit beside what a genome has.
struct Margin {
    std::string name; ///< "shortest_wave_mm", "slope", "height_mm", "radius_mm"
    double limit;     ///< 0: none was set
    double value;     ///< the genome's, on the safe side
    bool is_least;    ///< the limit is a lower one
    /// Whether the value keeps the limit.
    bool holds() const { return limit == 0 || (is_least ? value >= limit : value <= limit); }
    /// How far inside the limit, over it: negative outside; 1 where there is none.
    double margin() const { return limit == 0 ? 1 : (is_least ? 1 - limit / value : 1 - value / limit); }
};

/// A genome's shortest wave, largest slope, height and smallest radius of curvature over [0, length], by the
/// derivatives of its cosines on a grid eight times finer than `grid`, an area's four times, with a bound for
/// what lies between its nodes added (h^2/8 times the sum of G R k^(order + 2)): no finer grid shows a larger
/// value.
std::vector<Margin> margins(const Genome& genome, const Grid& grid, const MakingLimits& limits);

/// How far slope, height and curvature exceed the limits in all, relative to each limit; 0 within them.
/// Aims `guard` inside.
double excess(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard = 0);

/// One row a limit on shape: max(0, value/limit - (1 - guard)), and its derivatives in every gene (central
/// differences of the profile at the place of the extreme). Where the genome's scale moves with its genes,
/// `d_scale` has its derivatives; empty where it does not.
struct LimitRows {
    Eigen::VectorXd residuals; ///< one a limit on shape; 0 where it is kept
    Eigen::MatrixXd jacobian;  ///< rows x genes
};
/// The rows of a genome on a grid, each limit tightened by `guard` (a part of it).
LimitRows limit_rows(const Genome& genome, const Grid& grid, const MakingLimits& limits, double guard,
                     const Eigen::RowVectorXd& d_scale = {});

} // namespace rough
