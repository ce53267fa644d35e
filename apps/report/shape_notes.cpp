#include "apps/report/shape_notes.hpp"

#include "apps/report/units.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/mwm/sampling.hpp"

#include <cmath>
#include <numbers>

namespace app {

namespace {

constexpr double rounding = 1e-9;
constexpr double fewest_nodes = 8; ///< of a wave

} // namespace

std::string jump_note(const rough::Genome& genome, double length, double range) {
    const double jump = std::abs(jump_at_ends(genome, length));
    if (!(jump > rounding * range))
        return "";
    return "note: the profile's ends differ by " + readable(jump) + " mm, " + percent(jump / range) +
           " of its height range: a step where a periodic body repeats it";
}

std::string wave_note(const rough::Genome& genome, const rough::Grid& grid) {
    const auto lines = discrete_spectrum(genome);
    if (lines.empty())
        return "";
    const double nodes = 2 * std::numbers::pi / lines.back().wave_number / grid.spacing();
    if (!(nodes < fewest_nodes * (1 - rounding)))
        return "";
    return "note: the shortest wave is " + readable(nodes) +
           " nodes long, under 8: light contact depends on the grid";
}

} // namespace app
