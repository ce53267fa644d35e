#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/response/model.hpp"

#include <string>

namespace app {

/// A number of a surface that might drive its response.
struct SurfaceFeature {
    std::string name;
    std::string meaning; ///< with its unit
    double value = 0;
    bool of_shape = true; ///< else of the loaded surface
};

/// Of a genome in final amplitude: where peaks and valleys stand (a surface and its mirror image are one),
/// heights over the height range, slopes, waves by octave, contact spots. All without dimension, so that
/// neither amplitude nor length decides. Always the same features in the same order.
std::vector<SurfaceFeature> features_of(const rough::Genome& genome, const rough::Model& model);

/// Waves are told apart by octaves of L over their length: 0 from L/1.41 up, 1 about L/2, 2 about L/4 and on.
constexpr std::size_t wave_octaves = 7;
std::size_t wave_octave(double wave_length, double length);
std::string octave_name(std::size_t octave);

} // namespace app
