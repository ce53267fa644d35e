#pragma once

#include "domain/mwm/sampling.hpp"

#include <functional>

/// Surfaces to try methods on: for tests, benchmarks and the experiments that compare solvers.
namespace rough {

/// A draw from [from, to), e.g. ga::Stream's.
using Uniform = std::function<double(double from, double to)>;

/// Between which bounds a random series' genes are drawn; a gene whose bounds are equal is not drawn.
struct SeriesLaw {
    double A_from = 0.5;     ///< least amplitude
    double A_to = 2;         ///< greatest amplitude
    double H_from = 0.5;     ///< least Hurst exponent
    double H_to = 1.5;       ///< greatest Hurst exponent
    double gamma_from = 1.4; ///< least ratio of neighbouring wave numbers
    double gamma_to = 2;     ///< greatest ratio of neighbouring wave numbers
};

/// A genome of so many series, each with every wave from `length` down to `shortest` (mm), of so many ridges
/// with phases from the whole turn.
Genome random_genome(const Uniform& uniform, int series, std::size_t ridges, double length, double shortest,
                     const SeriesLaw& law = {});

/// Waves of a self-affine profile: of amplitude `amplitude` ratio^(-n hurst) (mm) and ratio^n to the length
/// (mm), n = 0 to count-1; phases by the golden angle. A periodic one has whole numbers of them, so that it
/// repeats.
std::vector<Wave> self_affine_waves(double length, double amplitude, double hurst, double ratio, int count,
                                    bool periodic = false);

/// Waves of a fractional-Brownian profile: 1 to `count` to the length (mm), the n-th of amplitude `amplitude`
/// n^-(hurst + 1/2) (mm), so that the power spectral density is ~ k^-(1 + 2 hurst); phases by the golden
/// angle times squares, as those of evenly spaced waves must not grow evenly: their crests would meet.
std::vector<Wave> brownian_waves(double length, double amplitude, double hurst, int count);

/// A sum of waves at x, both in mm, without their offsets.
double height_at(const std::vector<Wave>& waves, double x);

/// The heights (mm) that a formula gives at the grid's nodes, x in mm from the first.
Profile sampled(const Grid& grid, const std::function<double(double)>& height);

} // namespace rough
