#include "apps/report/surface.hpp"

#include "apps/prompt/terminal.hpp"
#include "apps/report/units.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/text/atomic_file.hpp"

#include <cmath>
#include <numbers>

namespace app {

namespace {

constexpr rough::Index most_nodes = 1'000'000, most_3mf_nodes = 100'000; ///< of solids
constexpr double rounding = 1e-9;
constexpr double fewest_nodes = 8; ///< of a wave
constexpr double usual_steps = 3;  ///< of steps from node to node that a periodic surface makes at its ends

std::string step_note(const std::string& ends, double jump, double range) {
    return "note: " + ends + " differ by " + readable(jump) + " mm, " + percent(jump / range) +
           " of its height range: a step where a periodic body repeats it";
}

} // namespace

std::string jump_note(const rough::Genome& genome, double length, double range) {
    const double jump = std::abs(jump_at_ends(genome, length));
    if (!(jump > rounding * range))
        return "";
    return step_note("the profile's ends", jump, range);
}

std::string jump_note(const rough::Profile& surface) {
    const auto [columns, rows] = surface.shape();
    const Eigen::Map<const Eigen::ArrayXXd> z(surface.heights.data(), columns, rows);
    const double range = z.maxCoeff() - z.minCoeff();
    const auto rms = [](const auto& steps) { return std::sqrt(steps.square().mean()); };
    const double along_x = rms(z.row(columns - 1) - z.row(0));
    if (along_x > usual_steps * rms(z.bottomRows(columns - 1) - z.topRows(columns - 1)))
        return step_note(rows > 1 ? "the map's ends along x" : "the profile's ends", along_x, range);
    if (rows > 1)
        if (const double along_y = rms(z.col(rows - 1) - z.col(0));
            along_y > usual_steps * rms(z.rightCols(rows - 1) - z.leftCols(rows - 1)))
            return step_note("the map's ends along y", along_y, range);
    return "";
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

Solids solids_of(const rough::Profile& surface, const rough::Extrusion& extrusion) {
    const rough::Index nodes = surface.nodes();
    return {nodes <= most_nodes ? binary_stl(surface, extrusion) : "",
            nodes <= most_3mf_nodes ? three_mf(surface, extrusion) : "", nodes};
}

std::vector<std::string> write_solids(const Solids& solids, const std::filesystem::path& folder,
                                      const std::string& name) {
    std::vector<std::string> files;
    const auto write = [&](const std::string& file, const std::string& content, const char* why) {
        if (content.empty())
            return say("note: " + file + " is left out, as " + why);
        rough::write_atomically(folder / file, content);
        files.push_back(file);
    };
    write(name + ".stl", solids.stl, "a solid of more than 1e6 nodes is of no use to any printer");
    write(name + ".3mf", solids.three_mf, "its text would have 500 bytes for each of more than 1e5 nodes");
    return files;
}

} // namespace app
