#include "apps/prompt/area_settings.hpp"

#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/scan_settings.hpp"
#include "apps/report/units.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/scan/map.hpp"
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

/// The settings with some values changed; "" takes one away.
Settings changed(const Settings& settings, const std::vector<Setting>& known,
                 const std::map<std::string, std::string>& values) {
    std::map<std::string, std::string> given;
    for (const Setting& setting : known)
        if (settings.given(setting.name))
            given[setting.name] = settings.text(setting.name);
    for (const auto& [name, value] : values)
        if (value.empty())
            given.erase(name);
        else
            given[name] = value;
    return {"", known, given};
}

/// The settings along x, or along y.
Settings along(const Settings& settings, const std::vector<Setting>& known, bool x) {
    std::map<std::string, std::string> values;
    for (const char* name : {"nodes", "length", "spacing"})
        if (settings.has(name)) {
            const auto [first, second] = pair_of(settings.text(name));
            values[name] = x ? first : second;
            if (values[name].empty())
                throw rough::InputError(settings.place(name) + ": '" + settings.text(name) +
                                        "' given, expected two numbers with an x between, as in 64x48");
        }
    return changed(settings, known, values);
}

rough::Profile map_from(const Settings& settings, const Settings& x, const Settings& y) {
    if (!settings.has("spacing"))
        throw rough::InputError("--spacing is missing, expected the distance of a map's nodes, DX or DXxDY");
    for (const char* name : {"nodes", "length", "row", "detrend", "fill"})
        if (settings.given(name))
            throw rough::InputError(settings.place(name) +
                                    ": given with --surface, expected none: a map is taken "
                                    "as it is");
    rough::MapLayout layout{settings.text("unit"), x.positive("spacing"), y.positive("spacing")};
    if (!layout.unit.empty())
        rough::length_unit_named(layout.unit, settings.place("unit"));
    return placing(settings, "", [&] { return rough::read_map(settings.text("surface"), layout); });
}

/// How far wave vectors were moved to fit a periodic area.
std::string fit_note(const rough::Genome& genome, const rough::Grid& grid) {
    double farthest = 0;
    for (const rough::PlaneWave& wave : plane_waves(genome, grid))
        farthest = std::max(farthest, wave.moved);
    return farthest > 1e-12
               ? "note: wave vectors were moved to the nearest that fit the periodic area, by up to " +
                     readable(100 * farthest) + " % of their length"
               : "";
}

} // namespace

std::vector<Setting> area_settings() {
    return {
        {"surface", "",
         "measured area in place of a genome: a text matrix, a line a row along x; --spacing DX or DXxDY"}};
}

bool asks_for_area(const Settings& settings) {
    const auto is_pair = [&](const char* name) { return settings.text(name).find('x') != std::string::npos; };
    return settings.has("surface") || is_pair("nodes") || is_pair("length");
}

AreaScene area_from(const Settings& settings, const std::vector<Setting>& known) {
    for (const char* name : {"profile", "accuracy", "friction", "datum", "strip-width"})
        if (settings.has(name))
            throw rough::InputError(settings.place(name) +
                                    ": given with an area, expected none: it is for profiles"
                                    " alone");
    if (settings.text("kernel") == "strip")
        throw rough::InputError(settings.place("kernel") +
                                ": strip given with an area, expected free or periodic");
    const Settings x = along(settings, known, true), y = along(settings, known, false);
    AreaScene scene;
    if (settings.has("surface")) {
        scene.map = map_from(settings, x, y);
        scene.model = model_from(changed(x, known, {{"spacing", ""}}));
        rough::Grid& grid = scene.model.grid;
        const auto [columns, rows] = scene.map.shape();
        grid.nodes = columns;
        grid.rows = rows;
        grid.length = profile_length(scene.map, scene.model.body.kernel);
        grid.width = scene.map.row_spacing * static_cast<double>(grid.wraps ? rows : rows - 1);
        scene.notes.push_back("a map of " + std::to_string(columns) + " x " + std::to_string(rows) +
                              " heights, " + readable(grid.length) + " x " + readable(grid.width) +
                              " mm, taken as it is");
    } else {
        expect_none(settings, scan_settings(), "given with a genome, expected with --surface only");
        const rough::Source source = rough::open_genome(settings.text("genome"));
        scene.model = model_from(x, source);
        rough::Grid& grid = scene.model.grid;
        const rough::Grid across = model_from(y, source).grid;
        grid.rows = across.nodes;
        grid.width = across.length;
        if (static_cast<double>(grid.nodes) * static_cast<double>(grid.rows) > 1e7)
            throw rough::InputError("--nodes: '" + settings.text("nodes") +
                                    "' given, expected at most 1e7 in all");
        scene.map = sample(*source.genome, grid);
        if (grid.wraps)
            if (const std::string note = fit_note(*source.genome, grid); !note.empty())
                scene.notes.push_back(note);
    }
    if (scene.model.body.kernel == rough::Kernel::free)
        scene.notes.push_back(
            "an area on a half-space needs no datum: displacements are measured to infinity");
    return scene;
}

} // namespace app
