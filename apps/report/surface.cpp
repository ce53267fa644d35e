#include "apps/report/surface.hpp"

#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/text/atomic_file.hpp"

#include <cmath>
#include <numbers>

namespace app {

namespace {

constexpr rough::Index max_stl_nodes = 1'000'000, max_3mf_nodes = 100'000;
constexpr double rounding = 1e-9;
constexpr double min_nodes = 8; ///< nodes per wavelength
constexpr double max_step = 3;  ///< step at the ends of a periodic surface, over that from node to node

std::string step_note(const std::string& ends, double jump, double range) {
    return "note: " + ends + " differ by " + readable(jump) + " mm, " + percent(jump / range) +
           " of its height range; a periodic body has a step there";
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
    if (along_x > max_step * rms(z.bottomRows(columns - 1) - z.topRows(columns - 1)))
        return step_note(rows > 1 ? "the map's ends along x" : "the profile's ends", along_x, range);
    if (rows > 1)
        if (const double along_y = rms(z.col(rows - 1) - z.col(0));
            along_y > max_step * rms(z.rightCols(rows - 1) - z.leftCols(rows - 1)))
            return step_note("the map's ends along y", along_y, range);
    return "";
}

std::string wave_note(const rough::Genome& genome, const rough::Grid& grid) {
    const auto lines = discrete_spectrum(genome);
    if (lines.empty())
        return "";
    const double nodes = 2 * std::numbers::pi / lines.back().wave_number / grid.spacing();
    if (!(nodes < min_nodes * (1 - rounding)))
        return "";
    return "note: the shortest wavelength is " + readable(nodes) +
           " nodes long, under 8: light contact depends on the grid";
}

Solids solids_of(const rough::Profile& surface, const rough::Extrusion& extrusion) {
    const rough::Index nodes = surface.nodes();
    return {nodes <= max_stl_nodes ? binary_stl(surface, extrusion) : "",
            nodes <= max_3mf_nodes ? three_mf(surface, extrusion) : ""};
}

std::string print_note(const rough::Profile& surface, const rough::Extrusion& extrusion) {
    if (surface.nodes() > max_stl_nodes)
        return "print: no solid is written";
    constexpr double few_steps = 20; ///< with fewer, the steps are as large as the roughness
    Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
    for (const Eigen::Vector3f& vertex : solid(surface, extrusion).vertices) {
        low = low.min(vertex.cast<double>().array());
        high = high.max(vertex.cast<double>().array());
    }
    const Eigen::Array3d size = high - low;
    const double relief = extrusion.magnify * (surface.heights.maxCoeff() - surface.heights.minCoeff()),
                 steps = relief / extrusion.layer;
    std::string all = "print: " + readable(size[0]) + " x " + readable(size[1]) + " x " + readable(size[2]) +
                      " mm, relief " + readable(relief) + " mm, " + readable(steps) + " layer steps of " +
                      brief(extrusion.layer) + " mm";
    if (steps < few_steps)
        all += " (under 20: give a larger --magnify)";
    if (extrusion.magnify != 1)
        all += "; at the same pressure and modulus its K, in MPa/mm, is that of the surface over " +
               brief(extrusion.magnify, 6) + ", with a datum as many times farther";
    return all;
}

std::vector<std::string> write_solids(const Solids& solids, const std::filesystem::path& folder,
                                      const std::string& name) {
    std::vector<std::string> files;
    const auto write = [&](const std::string& file, const std::string& content, const char* why) {
        if (content.empty())
            return say("note: " + file + " is left out, because " + why);
        rough::write_atomically(folder / file, content);
        files.push_back(file);
    };
    write(name + ".stl", solids.stl, "no printer can use a solid of more than 1e6 nodes");
    write(name + ".3mf", solids.three_mf, "it takes 500 bytes per node and there are over 1e5 nodes");
    return files;
}

} // namespace app
