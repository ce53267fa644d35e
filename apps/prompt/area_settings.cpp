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
         "measured area in place of a genome: X3P, SDF, SUR, GSF; a text matrix, a line a row along x, with "
         "--spacing DX or DXxDY; or columns x, y, height"}};
}

rough::Map surface_from(const Settings& settings, const std::vector<Setting>& known, rough::Detrend form) {
    for (const char* name : {"nodes", "length", "row", "fill", "outliers"})
        if (settings.given(name))
            throw rough::InputError(settings.place(name) +
                                    ": given with --surface, expected none: it is for profiles");
    rough::MapLayout layout{settings.text("unit")};
    if (settings.has("spacing")) {
        layout.spacing = along(settings, known, true).positive("spacing");
        layout.row_spacing = along(settings, known, false).positive("spacing");
    }
    if (!layout.unit.empty())
        rough::length_unit_named(layout.unit, settings.place("unit"));
    if (settings.given("detrend"))
        form = rough::detrend_named(settings.text("detrend"), settings.place("detrend"));
    rough::Map map = placing(settings, "", [&] { return rough::read_map(settings.text("surface"), layout); });
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

bool asks_for_area(const Settings& settings) {
    const auto is_pair = [&](const char* name) { return settings.text(name).find('x') != std::string::npos; };
    return settings.has("surface") || is_pair("nodes") || is_pair("length");
}

AreaScene area_from(const Settings& settings, const std::vector<Setting>& known) {
    for (const char* name : {"profile", "friction", "datum", "strip-width"})
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
        rough::Map read = surface_from(settings, known, rough::Detrend::none);
        scene.map = std::move(read.heights);
        scene.model = model_from(changed(x, known, {{"spacing", ""}}));
        rough::Grid& grid = scene.model.grid;
        const auto [columns, rows] = scene.map.shape();
        grid.nodes = columns;
        grid.rows = rows;
        grid.length = profile_length(scene.map, scene.model.body.kernel);
        grid.width = scene.map.row_spacing * static_cast<double>(grid.wraps ? rows : rows - 1);
        scene.notes.push_back(read.account + "; " + readable(grid.length) + " x " + readable(grid.width) +
                              " mm");
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
