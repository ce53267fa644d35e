#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/numerics/grid.hpp"
#include "ga/problem/problem.hpp"

namespace rough {

/// What surfaces of one response may differ in, with exact derivatives at a fixed scale, of the profile on
/// this grid: `height`, log10 of the root mean square height over the length; `slope`, log10 of the root mean
/// square difference quotient of neighbours, on an area along both axes; `wavelength`, log10 of 2 pi rms
/// height / rms slope over the length; `skewness` of the heights.
std::vector<ga::Descriptor<Genome>> surface_descriptors(const Grid& grid);

} // namespace rough
