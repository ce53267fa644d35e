#include "apps/prompt/area_settings.hpp"

#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/scan_settings.hpp"
#include "apps/report/units.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/profile/filter.hpp"
#include "domain/scan/source.hpp"
#include "domain/scan/unit.hpp"

namespace app {

namespace {

/// Of "AxB", x first, both; of "A", it twice.
std::pair<std::string, std::string> pair_of(const std::string& text) {
    const std::size_t by = text.find('x');
    return by == std::string::npos ? std::pair(text, text)
                                   : std::pair(text.substr(0, by), text.substr(by + 1));
}

/// The settings along x, or along y.
Settings along(const Settings& settings, const std::string& prefix, bool x) {
    std::map<std::string, std::string> values;
    for (const char* key : {"nodes", "length", "spacing"})
        if (const std::string name = prefix + key; settings.knows(name) && settings.has(name)) {
            const auto [first, second] = pair_of(settings.text(name));
            values[name] = x ? first : second;
            if (values[name].empty())
                throw rough::InputError(settings.place(name) + ": '" + settings.text(name) +
                                        "' given, expected two numbers with an x between, as in 64x48");
        }
    return settings.with(values);
}

/// Throws if one of these keys, which only a profile has, or its kernel is given.
void expect_of_areas(const Settings& settings, const std::string& prefix,
                     const std::vector<const char*>& keys) {
    for (const char* key : keys)
        if (const std::string name = prefix + key; settings.knows(name) && settings.has(name))
            throw rough::InputError(settings.place(name) +
                                    ": given with an area, expected none: it is for profiles alone");
    if (settings.text(prefix + "kernel") == "strip")
        throw rough::InputError(settings.place(prefix + "kernel") +
                                ": strip given with an area, expected free or periodic");
}

/// The model along x with the rows and the width of that along y.
rough::Model crossed(rough::Model model, const rough::Grid& across, const Settings& settings,
                     const std::string& prefix) {
    model.grid.rows = across.nodes;
    model.grid.width = across.length;
    if (static_cast<double>(model.grid.nodes) * static_cast<double>(model.grid.rows) > 1e7)
        throw rough::InputError(settings.place(prefix + "nodes") + ": '" + settings.text(prefix + "nodes") +
                                "' given, expected at most 1e7 in all");
    return model;
}

} // namespace

std::vector<Setting> area_settings() {
    return {
        {"surface", "",
         "measured area in place of a genome: X3P, SDF, SUR, GSF; a text matrix, a line a row along x, with "
         "--spacing DX or DXxDY; or columns x, y, height"}};
}

rough::Map surface_from(const Settings& settings, const std::string& flag) {
    for (const char* name : {"nodes", "length", "row", "fill", "outliers"})
        if (settings.given(name))
            throw rough::InputError(settings.place(name) + ": given with --" + flag +
                                    " of a map, expected none: it is for profiles");
    rough::MapLayout layout{settings.text("unit")};
    if (settings.has("spacing")) {
        layout.spacing = along(settings, "", true).positive("spacing");
        layout.row_spacing = along(settings, "", false).positive("spacing");
    }
    if (!layout.unit.empty())
        rough::length_unit_named(layout.unit, settings.place("unit"));
    const rough::Detrend form = rough::detrend_named(settings.text("detrend"), settings.place("detrend"));
    rough::Map map = placing(settings, "", [&] { return rough::read_map(settings.text(flag), layout); });
    rough::Profile& surface = map.heights;
    surface.heights = placing(settings, "", [&] { return detrended(surface, form); });
    const auto [columns, rows] = surface.shape();
    map.account = "a map of " + std::to_string(columns) + " x " + std::to_string(rows) + " heights (" +
                  map.account + "), " +
                  (form == rough::Detrend::none   ? "taken as it is"
                   : form == rough::Detrend::line ? "its plane taken off"
                                                  : "its form taken off: " + name_of(form));
    for (const bool is_long : {false, true})
        if (const char* name = is_long ? "lambda-c" : "lambda-s"; settings.has(name)) {
            const Eigen::VectorXd passed = low_passed(surface, settings.positive(name));
            surface.heights = is_long ? (surface.heights - passed).eval() : passed;
            map.account += std::string(", waves ") + (is_long ? "over " : "under ") +
                           readable(settings.positive(name)) + " mm taken off";
        }
    return map;
}

bool asks_for_area(const Settings& settings, const std::string& prefix) {
    const auto is_pair = [&](const char* name) {
        return settings.text(prefix + name).find('x') != std::string::npos;
    };
    return (settings.knows("surface") && settings.has("surface")) || is_pair("nodes") || is_pair("length") ||
           (settings.knows(prefix + "spacing") && is_pair("spacing"));
}

rough::Model model_of(const rough::Profile& surface, const Settings& settings) {
    const bool wraps = kernel_from(settings) == rough::Kernel::periodic;
    const auto length = [&](double spacing, rough::Index n) {
        return spacing * static_cast<double>(wraps ? n : n - 1);
    };
    const auto [columns, rows] = surface.shape();
    rough::Grid grid{columns, length(surface.spacing, columns)};
    if (surface.is_2d()) {
        expect_of_areas(settings, "", {"datum", "strip-width"});
        grid.rows = rows;
        grid.width = length(surface.row_spacing, rows);
    }
    return model_on(grid, settings);
}

rough::Model surface_model_from(const Settings& settings, const std::string& prefix) {
    if (!asks_for_area(settings, prefix))
        return model_from(settings, prefix);
    expect_of_areas(settings, prefix, {"datum", "strip-width", "accuracy"});
    return crossed(model_from(along(settings, prefix, true), prefix),
                   model_from(along(settings, prefix, false), prefix).grid, settings, prefix);
}

std::string fit_note(const rough::Genome& genome, const rough::Grid& grid) {
    double farthest = 0;
    if (grid.is_2d() && grid.wraps)
        for (const rough::PlaneWave& wave : plane_waves(genome, grid))
            farthest = std::max(farthest, wave.moved);
    return farthest > 1e-12
               ? "note: wave vectors were moved to the nearest that fit the periodic area, by up to " +
                     readable(100 * farthest) + " % of their length"
               : "";
}

rough::Map sampled_from(const Settings& settings, bool wraps, rough::Index least) {
    expect_none(settings, scan_settings(), "given with a genome, expected with --surface only");
    const rough::Source source = rough::open_genome(settings.text("genome"));
    const auto side = [&](bool x) {
        const Settings own = along(settings, "", x);
        rough::Model model;
        model.grid = source.grid(wraps);
        model.grid.nodes = nodes_from(own, model.grid.nodes, "", least);
        if (own.has("length"))
            model.grid.length = own.positive("length");
        return model;
    };
    const rough::Grid grid = crossed(side(true), side(false).grid, settings, "").grid;
    const std::string note = fit_note(*source.genome, grid);
    return {sample(*source.genome, grid), source.name + ": " + std::to_string(grid.nodes) + " x " +
                                              std::to_string(grid.rows) + " nodes on " +
                                              readable(grid.length, 6) + " x " + readable(grid.width, 6) +
                                              " mm" + (note.empty() ? "" : "; " + note)};
}

AreaScene area_from(const Settings& settings, const std::string& map) {
    expect_of_areas(settings, "", {"profile", "friction", "datum", "strip-width"});
    const Settings x = along(settings, "", true), y = along(settings, "", false);
    AreaScene scene;
    if (settings.knows(map) && settings.has(map)) {
        rough::Map read = surface_from(settings, map);
        scene.map = std::move(read.heights);
        scene.model = model_of(scene.map, settings);
        const rough::Grid& grid = scene.model.grid;
        scene.notes.push_back(read.account + "; " + readable(grid.length) + " x " + readable(grid.width) +
                              " mm");
    } else {
        expect_none(settings, scan_settings(), "given with a genome, expected with --surface only");
        const rough::Source source = rough::open_genome(settings.text("genome"));
        scene.model = crossed(model_from(x, source), model_from(y, source).grid, settings, "");
        scene.map = sample(*source.genome, scene.model.grid);
        if (const std::string note = fit_note(*source.genome, scene.model.grid); !note.empty())
            scene.notes.push_back(note);
    }
    if (scene.model.body.kernel == rough::Kernel::free)
        scene.notes.emplace_back(no_datum_note);
    return scene;
}

} // namespace app
