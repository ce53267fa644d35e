#include "apps/report/surface.hpp"

#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/output.hpp"
#include "domain/accuracy/resolution.hpp"
#include "domain/contact/interface.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/base/json.hpp"

namespace app {
namespace {

constexpr rough::Index max_stl_nodes = 1'000'000, max_3mf_nodes = 100'000;
constexpr double rounding = 1e-9;
constexpr double max_step = 3; ///< step at the ends of a periodic surface, over that from node to node

std::string nodes_in_words(rough::Index nodes) { return std::to_string(nodes) + (nodes == 1 ? " node" : " nodes"); }

std::string step_note(const std::string& ends, double jump, double range) {
    return "note: " + ends + " differ by " + readable(jump) + " mm, " + percent(jump / range) +
           " of its height range; a periodic body has a step there";
}

} // namespace

std::string jump_note(const rough::Genome& genome, double length, double range) {
    const double jump = std::abs(jump_at_ends(genome, length));
    if (!(jump > rounding * range)) return "";
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

std::string resolution_warning(const rough::Response& response) {
    int known = 0, unresolved = 0;
    double pressure = 0;
    rough::Index widest = 0;
    for (rough::Index j = 0; j < response.steps(); ++j) {
        const auto width = static_cast<rough::Index>(response.spot_width[j]);
        known += width > 0;
        if (width == 0 || width >= rough::resolved_spot_nodes) continue;
        ++unresolved;
        pressure = response.pressure[j];
        widest = std::max(widest, width);
    }
    if (unresolved == 0 || 2 * unresolved < known) // the first touch is never resolved
        return "";
    return "contact spots are not resolved at " + std::to_string(unresolved) + " of " + std::to_string(known) +
           " loads, up to " + readable(pressure) + " MPa: half of the contact area is in spots at most " +
           nodes_in_words(widest) + " wide, so the area depends on the node spacing; measure with a finer node spacing";
}

std::string resolution_warning(const rough::Profile& surface, bool periodic) {
    const double height = rough::material_height(surface.heights, 0.01);
    std::vector<int> highest;
    for (rough::Index i = 0; i < surface.nodes(); ++i)
        if (surface.heights[i] >= height) highest.push_back(static_cast<int>(i));
    const rough::Index width = rough::spot_width(highest, surface.shape(), periodic);
    if (width >= rough::resolved_spot_nodes) return "";
    return "contact spots are not resolved at light load: half of the highest 1 % of nodes are in groups "
           "at most " +
           nodes_in_words(width) +
           " wide, so their contact area depends on the node spacing; measure with a finer node spacing";
}

std::string print_note(const rough::Profile& surface, const rough::Extrusion& extrusion) {
    if (surface.nodes() > max_stl_nodes) return "no solid is written, because the surface has too many nodes";
    constexpr double few_steps = 20; ///< with fewer, the steps are as large as the roughness
    Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
    for (const Eigen::Vector3f& vertex : solid(surface, extrusion).vertices) {
        low = low.min(vertex.cast<double>().array());
        high = high.max(vertex.cast<double>().array());
    }
    const Eigen::Array3d size = high - low;
    const double relief = extrusion.magnify * (surface.heights.maxCoeff() - surface.heights.minCoeff()),
                 steps = relief / extrusion.layer;
    std::string all = "the printed solid is " + readable(size[0]) + " x " + readable(size[1]) + " x " +
                      readable(size[2]) + " mm; its relief of " + readable(relief) + " mm has " + readable(steps) +
                      " layer steps of " + brief(extrusion.layer) + " mm";
    if (steps < few_steps) all += " (under 20: give a larger --magnify)";
    if (extrusion.magnify != 1)
        all += "; at the same pressure and modulus its stiffness K is the surface's K divided by " +
               brief(extrusion.magnify, 6) + ", with a datum " + brief(extrusion.magnify, 6) + " times farther";
    return all;
}

std::vector<std::string> write_solids(const rough::Profile& surface, const rough::Extrusion& extrusion,
                                      const std::filesystem::path& folder, const std::string& name) {
    std::vector<std::string> files;
    const auto write = [&](const std::string& file, auto content, rough::Index max_nodes, const char* why) {
        if (surface.nodes() > max_nodes) return say("note: " + file + " is left out, because " + why);
        rough::write_atomically(folder / file, content(surface, extrusion));
        files.push_back(file);
    };
    write(name + ".stl", rough::binary_stl, max_stl_nodes, "no printer can use a solid of more than 1e6 nodes");
    write(name + ".3mf", rough::three_mf, max_3mf_nodes, "it takes 500 bytes per node and there are over 1e5 nodes");
    return files;
}

std::vector<std::string> write_height_image(const rough::Profile& surface, const rough::Extrusion& extrusion,
                                            const std::filesystem::path& folder, const std::string& name) {
    try {
        const rough::HeightImage image = height_image(surface, extrusion);
        nlohmann::json scale{{"image", name + ".png"}};
        for (const auto& [key, value] : image.scale) scale[key] = value;
        rough::write_atomically(folder / (name + ".png"), image.png);
        write_json(folder / (name + "-scale.json"), scale);
        return {name + ".png", name + "-scale.json"};
    } catch (const rough::InputError& error) {
        say("note: " + name + ".png is left out: " + error.what());
        return {};
    }
}

} // namespace app
