#pragma once

#include "domain/problem/setup.hpp"

namespace rough {

/// Appends all chromosomes down to the wavelength `shortest` (mm), with `ridges` random phases in [0, 2 pi).
void add_chromosomes(Series& series, double shortest, int ridges, ga::Stream& random);

/// Series of amplitude 1 without chromosomes, with the same H and gamma = 2. L is `length`, mm. There is one
/// series with lambda = L/k for each odd k up to 32, unless L/k is below `shortest` (mm). With their
/// wavelengths L/(k 2^(n-1)), n = 1, 2, ..., the series have each harmonic of L once.
std::vector<Series> harmonic_series(double length, double shortest, double H);

/// The genome with every wavelength moved to the nearest harmonic L/k, k >= 1, of the length L (mm). Its
/// profile then repeats without a jump. Amplitudes, phases and series of harmonics do not change.
Genome in_harmonics(const Genome& genome, double length);

/// A series of amplitude 1 without chromosomes, its genes moved into the set-up's bounds; lambda in mm.
Series drawn_series(const DesignSetup& setup, double H, double gamma, double lambda);

/// A random genome of two series: H in 0.5-1.5, gamma in 1.4-2, lambda near L, all within the set-up's bounds. Phases
/// and the ratio of the amplitudes are random. The set-up gives the number of ridges. On a periodic line the genome has
/// the harmonics of its length with one H. (A periodic map moves wave vectors instead, see plane_waves.)
Genome drawn_start(const DesignSetup& setup, ga::Stream random);

/// The genome with the amplitude at which its curve is the most similar to the first target. It is at most
/// 2^16 times the one at which full approach just reaches the target's last load. No change under Eq. 11.
Genome with_fitting_amplitude(const DesignSetup& setup, const Genome& genome);
/// The price of with_fitting_amplitude() in curves of the set-up's model; 0 under Eq. 11.
double fitting_price(const DesignSetup& setup);

} // namespace rough
