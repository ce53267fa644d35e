#pragma once

#include "domain/mwm/genome.hpp"
#include "domain/profile/profile.hpp"

#include <string>

namespace app {

/// In words: that a genome jumps at the ends of a length (mm) if it is continued with that period, and by
/// which share of its height range (mm); "" where it does not.
std::string jump_note(const rough::Genome& genome, double length, double range);

/// The same of measured heights: that their opposite ends differ, rms, by over three times the rms step from
/// node to node along that direction.
std::string jump_note(const rough::Profile& surface);

/// In words: that a genome has waves under 8 node distances; "" where it has none.
std::string wave_note(const rough::Genome& genome, const rough::Grid& grid);

} // namespace app
