#include "apps/prompt/model_settings.hpp"

#include "apps/report/units.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/materials.hpp"
#include "domain/contact/names.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/plain_stream.hpp"
#include "domain/profile/filter.hpp"
#include "domain/scan/source.hpp"
#include "domain/scan/unit.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace app {

namespace {

/// A number as it would be given: 1e-6.
std::string plain(double value) {
    rough::PlainStream text;
    text << std::setprecision(15) << value;
    std::string digits = text.str();
    if (const auto at = digits.find("e-0"); at != std::string::npos)
        digits.erase(at + 2, 1);
    return digits;
}

/// The material that is named; null if none is.
const rough::Material* material_from(const Settings& settings, const std::string& prefix = "") {
    return settings.has(prefix + "material")
               ? &rough::materials()[settings.one_of(prefix + "material", rough::material_names())]
               : nullptr;
}

} // namespace

bool states_modulus(const Settings& settings) {
    return settings.given("modulus") || settings.has("material");
}

std::string material_note(const Settings& settings) {
    const rough::Material* material = material_from(settings);
    if (!material)
        return "";
    return material->name + " (" + material->of + "): E " + plain(material->modulus) + " MPa, nu " +
           plain(material->poissons) + " (" + material->elastic + "), hardness " + plain(material->hardness) +
           " MPa (" + material->indented + ")";
}

double elastic_limit(const Settings& settings, const rough::Body& body) {
    if (body.yields() || !states_modulus(settings))
        return std::numeric_limits<double>::infinity();
    const rough::Material* material = material_from(settings);
    return material ? material->hardness : rough::largest_elastic_pressure * body.effective_modulus;
}

std::vector<Setting> model_settings(const std::string& prefix) {
    const rough::Model usual;
    std::string known;
    for (const std::string& name : rough::material_names())
        known += (known.empty() ? "" : ", ") + name;
    std::vector<Setting> settings{
        {prefix + "nodes", "",
         "nodes of the grid, 2 to 1e7 [" + std::to_string(usual.grid.nodes) + "; a scan: its points]"},
        {prefix + "length", "",
         "length L of the profile, mm [" + plain(usual.grid.length) +
             "; a scan, or a genome made for one: its own]"},
        {prefix + "kernel", name_of(usual.body.kernel), "elastic body: free, periodic or strip"},
        {prefix + "datum", "", "distance d at which the free half-plane's displacement is zero, mm [L]"},
        {prefix + "strip-width", "", "width W of the strip, mm [L/511]"},
        {prefix + "material", "",
         "gives E, nu and the hardness beyond which contact warns; modulus and poisson replace its values: " +
             known},
        {prefix + "modulus", plain(usual.body.effective_modulus), "Young's modulus E, MPa"},
        {prefix + "poisson", "0", "Poisson's ratio nu; E* = E/(1 - nu^2)"},
        {prefix + "steps", std::to_string(usual.loading.steps), "load steps n_t, at least 2"},
        {prefix + "reach", "", "largest displacement over the profile's range [1; periodic: 0.95]"},
        {prefix + "solver", name_of(usual.contact.solver),
         "contact solver: auto, nested, nnls, polonsky-keer or active-set"},
        {prefix + "tolerance", plain(usual.contact.tolerance), "relative tolerance of the iterative solvers"},
    };
    for (Setting& setting : settings)
        setting.group = "The model: grid, elastic body, load steps, solver";
    return settings;
}

Setting accuracy_setting(const std::string& prefix, const std::string& against) {
    return {prefix + "accuracy", "",
            "largest relative error allowed of a response, above 0 to 1, against " + against +
                " [none: every response is solved throughout]"};
}

double accuracy_from(const Settings& settings, const std::string& prefix) {
    return settings.has(prefix + "accuracy")
               ? settings.number(prefix + "accuracy", std::numeric_limits<double>::min(), 1)
               : 0;
}

rough::Index nodes_from(const Settings& settings, rough::Index otherwise, const std::string& prefix,
                        rough::Index least) {
    const std::string name = prefix + "nodes";
    return settings.has(name) ? settings.whole(name, least, 10000000) : otherwise;
}

rough::Kernel kernel_from(const Settings& settings, const std::string& prefix) {
    return static_cast<rough::Kernel>(settings.one_of(prefix + "kernel", rough::kernel_names()));
}

rough::Model model_on(rough::Grid grid, const Settings& settings, const std::string& prefix) {
    grid.nodes = nodes_from(settings, grid.nodes, prefix);
    if (settings.has(prefix + "length"))
        grid.length = settings.positive(prefix + "length");
    rough::Model model;
    model.grid = grid;
    model.body.kernel = kernel_from(settings, prefix);
    const rough::Material* material = material_from(settings, prefix);
    const auto is_given = [&](const char* name) { return !material || settings.given(prefix + name); };
    model.body.effective_modulus = rough::effective_modulus(
        is_given("modulus") ? settings.positive(prefix + "modulus") : material->modulus,
        is_given("poisson") ? settings.number(prefix + "poisson", -0.999999, 0.5) : material->poissons);
    if (settings.has(prefix + "datum"))
        model.body.datum = settings.positive(prefix + "datum");
    if (settings.has(prefix + "strip-width"))
        model.body.strip_width = settings.positive(prefix + "strip-width");
    model.loading.steps = static_cast<int>(settings.whole(prefix + "steps", 2, 1000000));
    if (settings.has(prefix + "reach"))
        model.loading.reach = settings.number(prefix + "reach", std::numeric_limits<double>::min(), 1);
    model.contact.solver =
        static_cast<rough::Solver>(settings.one_of(prefix + "solver", rough::solver_names()));
    model.contact.tolerance = settings.number(prefix + "tolerance", 1e-15, 0.1);
    return placing(settings, prefix, [&] {
        const rough::Model whole = completed(model);
        validate(whole);
        return whole;
    });
}

rough::Model model_from(const Settings& settings, const std::string& prefix) {
    return model_on({}, settings, prefix);
}

rough::Model model_from(const Settings& settings, const rough::Source& source, const std::string& prefix) {
    return model_on(source.grid(kernel_from(settings, prefix) == rough::Kernel::periodic), settings, prefix);
}

std::vector<Setting> loading_settings() {
    return {{"to-pressure", "", "mean pressure of the last load step, MPa, in place of --reach"},
            {"pressures", "",
             "mean pressures of the load steps, MPa, as P1,P2,…, in place of --reach and --steps"},
            {"hardness", "", "largest pressure that a node bears, MPa; nodes at it sink in [none]"}};
}

rough::Model loaded(rough::Model model, const Settings& settings) {
    if (settings.given("to-pressure") + settings.given("pressures") + settings.given("reach") > 1)
        throw rough::InputError(settings.place(settings.given("pressures") ? "pressures" : "to-pressure") +
                                ": given with another end of the load; give one of reach, to-pressure and "
                                "pressures");
    if (settings.given("pressures") && settings.given("steps"))
        throw rough::InputError(settings.place("steps") + ": given with pressures, expected one of them");
    if (settings.has("to-pressure"))
        model.loading.to_pressure = settings.pressure("to-pressure");
    if (settings.has("pressures")) {
        model.loading.pressures = settings.numbers("pressures", std::numeric_limits<double>::min(), 1e100);
        const auto& all = model.loading.pressures;
        if (std::adjacent_find(all.begin(), all.end(), std::greater_equal<>()) != all.end())
            throw rough::InputError(settings.place("pressures") + ": " + settings.text("pressures") +
                                    " given, expected positive increasing numbers with commas between, MPa");
        model.loading.steps = static_cast<int>(model.loading.pressures.size());
    }
    if (settings.has("hardness"))
        model.body.hardness = settings.pressure("hardness");
    return model;
}

std::vector<Setting> scan_settings(const std::string& prefix) {
    std::vector<Setting> settings{
        {prefix + "unit", "",
         "unit of a scan's columns whose header names none, e.g. um, or mm,um for x and heights [mm]"},
        {prefix + "spacing", "", "distance of the points of a scan with one column, in that unit"},
        {prefix + "row", "", "row of an areal map to take, 1 the first (of a text matrix with --spacing)"},
        {prefix + "detrend", "line",
         "form taken off a scan's heights: none, mean, line, parabola, cubic, quartic or arc"},
        {prefix + "outliers", "keep", "what is done to a scan's outliers: keep, or remove and interpolate"},
        {prefix + "lambda-s", "",
         "cut-off of the filter that takes off shorter waves (ISO 16610-21), mm [none]"},
        {prefix + "lambda-c", "",
         "cut-off of the filter that takes off longer waves (ISO 16610-21), mm [none]"},
        {prefix + "fill", "", "replace a scan's missing heights by linear interpolation", true},
    };
    for (Setting& setting : settings)
        setting.group = "How a scan is read";
    return settings;
}

Setting resolution_setting() {
    return {
        "resolution", "auto",
        "band of K and A over the heights as measured and interpolated 4 times: auto (up to 2e6 interpolated "
        "nodes of a map, 1e7 of a line), on or off",
        false, "How a scan is read"};
}

rough::Resolution resolution_from(const Settings& settings) {
    return static_cast<rough::Resolution>(settings.one_of("resolution", rough::resolution_names()));
}

rough::Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                        const std::string& prefix) {
    rough::ScanOptions options;
    options.unit = settings.text(prefix + "unit");
    std::istringstream units(options.unit);
    for (std::string unit; std::getline(units, unit, ',');)
        rough::length_unit_named(unit, settings.place(prefix + "unit"));
    if (settings.has(prefix + "spacing"))
        options.spacing = settings.positive(prefix + "spacing");
    if (settings.has(prefix + "row"))
        options.row = settings.whole(prefix + "row", 1, 10000000);
    options.detrend =
        rough::detrend_named(settings.text(prefix + "detrend"), settings.place(prefix + "detrend"));
    options.remove_outliers = settings.one_of(prefix + "outliers", {"keep", "remove"}) == 1;
    if (settings.has(prefix + "lambda-s"))
        options.lambda_s = settings.positive(prefix + "lambda-s");
    if (settings.has(prefix + "lambda-c"))
        options.lambda_c = settings.positive(prefix + "lambda-c");
    options.fill = settings.is_on(prefix + "fill");
    options.nodes = nodes;
    return placing(settings, prefix, [&] { return rough::open_scan(file, options); });
}

rough::Source source_from(const Settings& settings, rough::Index nodes, const std::string& scan) {
    if (!settings.has("genome"))
        return scan_from(settings.text(scan), settings, nodes);
    expect_none(settings, scan_settings(), "given with a genome, expected with --" + scan + " only");
    return rough::open_genome(settings.text("genome"));
}

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
