#pragma once

#include "domain/accuracy/respond.hpp"
#include "domain/paper/dominance.hpp"
#include "domain/profile/fractal.hpp"

#include <cstdint>
#include <vector>

namespace app {

/// Figure 3: a profile that is no MWM series, in octave bands in place of chromosomes. Algorithm 1 verifies
/// each band by the correlation of its K with the whole profile's at equal pressures; the dominant ones make
/// the reduced profile.
struct FractalStudy {
    rough::Profile whole, reduced;
    std::vector<rough::Band> bands;
    std::vector<double> correlation; ///< of each band's K with the whole's; NaN for a flat one
    std::vector<bool> dominant;      ///< correlation > 0.95, or the best one where none passes
    rough::Response whole_response, reduced_response;
};

/// Twenty such profiles, on the model's grid and body.
std::vector<FractalStudy>
fractal_studies(const rough::Model& model, std::uint64_t seed, int threads,
                rough::DominanceReading reading = rough::DominanceReading::same_pressure,
                double threshold = rough::dominance_threshold);

} // namespace app
