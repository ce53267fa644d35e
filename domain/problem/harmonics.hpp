#pragma once

#include "domain/mwm/genome.hpp"

#include <vector>

namespace rough {

/// Series that between them have each harmonic L/k of a length L (mm) once, down to `shortest` (mm) or k =
/// 32: lambda = L/k for every odd k, gamma = 2. Amplitude 1 and one H: one power law. Without chromosomes.
std::vector<Series> harmonic_series(double length, double shortest, double H);

/// The genome with every wave moved to the nearest harmonic L/k, k >= 1, of the length L (mm), amplitudes and
/// phases kept, so that it repeats without a jump. Series whose waves are harmonics stay as they are.
Genome in_harmonics(const Genome& genome, double length);

} // namespace rough
