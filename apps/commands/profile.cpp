#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/render.hpp"
#include "apps/report/surface.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/atomic_file.hpp"

#include <cstdio>

namespace app {
namespace {

Bindings bindings_of(rough::Extrusion& extrusion) {
    return {
        {positive("width", "", "width of a profile's solid along its ridges, mm [L/4]"), extrusion.width},
        {positive("base", "", "thickness of the solid below its lowest node, mm [the larger of height range and L/10]"),
         extrusion.base},
        {positive("magnify", "1", "factor on all lengths of the solid, for printing"), extrusion.magnify},
        {positive("layer-height", "0.05", "height of the printer's layers, mm"), extrusion.layer},
    };
}

std::vector<Setting> profile_settings() {
    rough::Extrusion usual;
    const std::vector<Setting> settings{
        {"out", "", "folder for the results [out/NAME, or out/NAME-2 and on]"},
        force_setting(),
        whole("nodes", "", 10, 1e7, "nodes of the grid, 10 to 1e7, or NXxNY of a map [512, or the points of a scan]")
            .several('x'),
        positive("length", "",
                 "length L of the profile, mm, or LXxLY of a map [0.84942, or the length of a scan or of the scan "
                 "that a genome was made for]")
            .several('x'),
        Setting("periodic", "", "the map is periodic: no window is applied, and lags cross its edges", true),
        Setting(ga::number("smr", "", -1e300, 1e300,
                           "heights over a map's mean plane, mm, with commas between, whose material "
                           "ratios are computed"))
            .several(),
        Setting(ga::number("smc", "", 0, 1,
                           "shares of a map, 0 to 1, with commas between. The height that each share exceeds "
                           "is computed"))
            .several(),
        pictures_setting(),
    };
    return joined({surface_settings(), settings, settings_of(bindings_of(usual)), scan_settings()});
}

/// A text matrix as --surface reads it.
std::string matrix(const rough::Profile& map) {
    const auto [nodes, rows] = map.shape();
    rough::PlainStream out;
    out << map.heights.reshaped(nodes, rows).transpose().format({17, Eigen::DontAlignCols, ",", "\n"}) << "\n";
    return out.str();
}

/// A file of a description.
struct Table {
    std::string name;
    std::function<std::string()> content; ///< made when it is written, as those of maps are large
    bool is_listed = true;                ///< on the page
};

/// The description of a profile or a map.
struct SurfaceReport {
    std::string kind;                               ///< profile or surface, as its files are called
    std::shared_ptr<const rough::Profile> surface;  ///< missing points are filled
    std::shared_ptr<const rough::Profile> measured; ///< `surface` with NaN at points that are not filled
    rough::Spectrum spectrum;
    std::string account;
    std::string warning = {};                  ///< warning about a scan or map; "": none
    std::vector<rough::SurfaceParameter> rows; ///< parameters
    std::vector<rough::SurfaceParameter> requested = {};
    double largest_height;  ///< mm
    nlohmann::json numbers; ///< keys of KIND.json besides those that both have
    std::vector<Table> tables;
    std::vector<std::pair<std::string, std::string>> pictures; ///< SVG files and figures
};

/// The surface with NaN at its missing points, unless --fill was given.
std::shared_ptr<const rough::Profile> with_holes(const std::shared_ptr<const rough::Profile>& surface,
                                                 const rough::MissingPoints& missing, const Settings& settings) {
    if (!missing || settings.is_on("fill")) return surface;
    rough::Profile holed = *surface;
    holed.heights(missing.nodes).setConstant(std::nan(""));
    return std::make_shared<const rough::Profile>(std::move(holed));
}

void add_missing(SurfaceReport& all, const rough::MissingPoints& missing) {
    all.numbers["missing"] = {{"points", missing.nodes.size()},
                              {"share", missing.share},
                              {all.surface->is_2d() ? "largest_hole_mm2" : "largest_hole_mm", missing.largest_hole}};
}

SurfaceReport described_profile(const Settings& settings) {
    if (settings.has("profile") && settings.given("length"))
        rough::refuse("--length: given with a scan; omit it, as a scan has a length");
    const Source source = source_from(settings, "profile", true);
    rough::Grid grid = source.grid();
    settings.take("nodes", grid.nodes);
    settings.take("length", grid.length);
    const auto profile = std::make_shared<const rough::Profile>(source.on(grid)),
               measured = with_holes(profile, source.missing, settings);
    std::string account = source.account, jump;
    std::vector<rough::SpectralLine> lines;
    if (source.genome) {
        lines = rough::discrete_spectrum(*source.genome);
        const double shortest = shortest_wave(*source.genome) * (1 + 1e-9) / grid.spacing();
        account = source.name + ": a profile of " + readable(grid.length, 6) + " mm with " +
                  std::to_string(lines.size()) + " waves, of which the shortest is " + readable(shortest) +
                  " nodes long" +
                  (shortest < 8 ? " (under 8, so that slopes, curvatures and light contact depend on the grid)" : "");
        jump = jump_note(*source.genome, grid.length, profile->heights.maxCoeff() - profile->heights.minCoeff());
    }
    const bool is_roughness = settings.has("lambda-c");
    const rough::Roughness r = rough::roughness(*profile, is_roughness ? settings.number("lambda-c") : 0);
    SurfaceReport all{.kind = "profile",
                      .surface = profile,
                      .measured = measured,
                      .spectrum = continuous_spectrum(*profile),
                      .account = account + (jump.empty() ? "" : "\n" + jump),
                      .warning = source.genome ? "" : resolution_warning(*profile, false),
                      .rows = r.rows,
                      .largest_height = r[is_roughness ? "Rt" : "Pt"],
                      .numbers = {{"account", account},
                                  {"nodes", profile->nodes()},
                                  {"length_mm", profile->spacing * static_cast<double>(profile->nodes() - 1)},
                                  {"section_length_mm", r.section_length},
                                  {"sections", r.sections}},
                      .tables = {},
                      .pictures = {{"profile.svg", "profile-heights"}, {"spectrum.svg", "spectrum:mm³"}}};
    all.tables = {{"heights.csv",
                   [=] {
                       return csv({"x_mm", "height_mm"}, {positions(*measured), measured->heights});
                   }},
                  {"heights-drawn.csv", [=] { return heights_csv(*profile); }, false},
                  {"spectrum.csv", [s = all.spectrum] {
                       return csv({"wave_number_rad_per_mm", "density_mm3"}, {s.wave_number, s.density});
                   }}};
    add_missing(all, source.missing);
    if (!lines.empty()) {
        double m0 = 0, m2 = 0, m4 = 0; // exact, over lengths that all waves divide
        Csv table("wave_number_rad_per_mm,power_mm2");
        for (const auto& [k, power] : lines) {
            m0 += power, m2 += power * k * k, m4 += power * k * k * k * k;
            table.row(k, power);
        }
        all.numbers["series"] = {{"m0_mm2", m0}, {"m2", m2}, {"m4_per_mm2", m4}};
        all.tables.push_back({"lines.csv", [text = table.text()] { return text; }, false});
    }
    return all;
}

/// Adds points of the material ratio curve, heights over the mean plane (mm), for --smr and --smc.
void add_requested(SurfaceReport& all, rough::Profile map, const Settings& settings) {
    map.heights.array() -= map.heights.mean();
    const auto add = [&](const char* key, double ratio, double height, rough::SurfaceParameter row) {
        all.numbers[key].push_back({{"material_ratio", ratio}, {"height_mm", height}});
        all.requested.push_back(std::move(row));
    };
    for (const double height : settings.numbers("smr")) {
        const Unit unit = length_unit(std::abs(height));
        const double ratio = material_ratio(map, height);
        add("Smr_of_heights", ratio, height,
            {"Smr(" + brief(unit.factor * height, 4) + " " + unit.name + ")", "",
             "material ratio at this height over the mean plane", ratio});
    }
    for (const double ratio : settings.numbers("smc")) {
        const double height = rough::material_height(map.heights, ratio);
        add("Smc_of_ratios", ratio, height,
            {"Smc(" + brief(100 * ratio, 4) + " %)", "mm", "height that this share of the map exceeds", height});
    }
}

SurfaceReport described_map(const Settings& settings) {
    const bool periodic = settings.is_on("periodic"), measured = settings.has("surface");
    rough::Scan read = measured ? surface_from(settings, "surface", true) : sampled_from(settings, periodic);
    const auto map = std::make_shared<const rough::Profile>(std::move(read.measured)),
               holed = with_holes(map, read.missing, settings);
    const rough::ArealParameters areal = areal_parameters(*map, periodic);
    const auto [nodes, rows] = map->shape();
    SurfaceReport all{
        .kind = "surface",
        .surface = map,
        .measured = holed,
        .spectrum = continuous_spectrum(*map, periodic),
        .account = (measured ? settings.text("surface") + ": " : "") + read.account,
        .warning = measured ? resolution_warning(*map, periodic) : "",
        .rows = areal.rows,
        .largest_height = areal["Sz"],
        .numbers = {{"account", read.account},
                    {"length_mm",
                     {map->spacing * static_cast<double>(nodes), map->row_spacing * static_cast<double>(rows)}},
                    {"nodes", {nodes, rows}},
                    {"spacing_mm", {map->spacing, map->row_spacing}},
                    {"Str_is_bound", areal.Str_is_bound}},
        .tables = {},
        .pictures = {{"heights.svg", "map:height"}, {"spectrum.svg", "spectrum:mm⁴"}}};
    all.tables = {
        {"heights.txt", [=] { return matrix(*holed); }},
        {"map.csv", [=] { return map_csv(*holed, {"height_mm"}, {holed->heights.array() - map->heights.maxCoeff()}); },
         false},
        {"spectrum.csv", [s = all.spectrum] {
             return csv({"wave_number_rad_per_mm", "density_mm4", "power_mm2"}, {s.wave_number, s.density, s.power});
         }}};
    add_missing(all, read.missing);
    add_requested(all, *map, settings);
    return all;
}

/// KIND.json: each parameter under its key (`Pa_mm`), and under `parameters` all rows that the page shows.
nlohmann::json numbers_of(const SurfaceReport& of, const Settings& settings, const std::string& name,
                          const std::vector<std::string>& files, const rough::Extrusion& extrusion) {
    const auto cut_off = [&](const char* flag) {
        return settings.has(flag) ? nlohmann::json(settings.number(flag)) : nullptr;
    };
    nlohmann::json numbers = of.numbers;
    numbers.update({{"kind", of.kind},
                    {"name", name},
                    {"files", files},
                    {"lambda_s_mm", cut_off("lambda-s")},
                    {"lambda_c_mm", cut_off("lambda-c")},
                    {"version", RUGOSA_VERSION}});
    numbers["warning"] = of.warning;
    numbers["print"] = print_note(*of.surface, extrusion);
    for (const rough::SurfaceParameter& one : of.rows) numbers[one.key()] = one.value;
    for (const auto* const all : {&of.rows, &of.requested})
        for (const rough::SurfaceParameter& one : *all)
            numbers["parameters"].push_back(
                {{"name", one.name}, {"value", one.value}, {"unit", one.unit}, {"meaning", one.meaning}});
    return numbers;
}

/// Prints parameters as lines of the terminal, heights in the unit that suits the largest (mm).
void print_parameters(const std::vector<rough::SurfaceParameter>& all, double largest) {
    const Unit height = length_unit(largest);
    for (const rough::SurfaceParameter& one : all) {
        const Unit unit = one.unit == "mm" ? height : Unit{one.unit, 1};
        char value[32] = "none", line[160];
        if (std::isfinite(one.value)) std::snprintf(value, sizeof value, "%.6g", one.value * unit.factor);
        std::snprintf(line, sizeof line, "  %-14s %12s %-5s %s", one.name.c_str(), value, unit.name.c_str(),
                      one.meaning.c_str());
        say(line);
    }
}

/// Writes all files of a description; a picture that cannot be drawn is left out.
void write_description(const SurfaceReport& of, const std::filesystem::path& source, const Settings& settings,
                       const rough::Extrusion& extrusion) {
    std::vector<std::string> names{of.kind + ".json", of.kind + ".x3p",     of.kind + ".stl",
                                   of.kind + ".3mf",  of.kind + ".png",     of.kind + "-scale.json",
                                   of.kind + ".sur",  "bearing.csv",        "spectrum-drawn.csv",
                                   "report.html",     of.pictures[0].first, of.pictures[1].first};
    for (const Table& table : of.tables) names.push_back(table.name);
    const OutputFolder out(settings.text("out"), source.stem().string(),
                           {names, settings.files(), settings.is_on("force")});
    const auto write = [&](const std::string& name, const std::string& content) {
        rough::write_atomically(out.path() / name, content);
    };
    const auto solids = write_solids(*of.surface, extrusion, out.path(), of.kind); // may refuse the extrusion
    std::vector<std::string> files{of.kind + ".json", "bearing.csv", of.kind + ".x3p"};
    const auto write_possible = [&](const std::string& name, const auto& content) {
        try {
            write(name, content());
            return true;
        } catch (const rough::InputError& error) {
            say("note: " + name + " is left out: " + error.what());
            return false;
        }
    };
    if (write_possible(of.kind + ".sur", [&] { return sur(*of.measured); })) files.push_back(of.kind + ".sur");
    for (const auto& [name, content, is_listed] : of.tables) {
        write(name, content());
        if (is_listed) files.push_back(name);
    }
    write(of.kind + ".x3p", x3p(*of.measured));
    write("bearing.csv", bearing_csv(of.surface->heights));
    write("spectrum-drawn.csv",
          drawn_csv({"wave_number_rad_per_mm", "density"}, {of.spectrum.wave_number, of.spectrum.density}, true));
    for (const auto& written : {solids, write_height_image(*of.surface, extrusion, out.path(), of.kind)})
        files.insert(files.end(), written.begin(), written.end());
    write_json(out.path() / (of.kind + ".json"),
               numbers_of(of, settings, source.filename().string(), files, extrusion));
    if (settings.choice("pictures") == 0) {
        const PageSource page = page_source(out.path());
        for (const auto& [file, figure] : of.pictures)
            write_possible(file, [&, name = figure] { return figure_file(name, page); });
        rough::write_atomically(page_of(page), render(page));
    }
    if (!of.warning.empty()) say("warning: " + of.warning);
    say(of.account);
    print_parameters(of.rows, of.largest_height);
    print_parameters(of.requested, of.largest_height);
    say(print_note(*of.surface, extrusion));
    const bool has_page = settings.choice("pictures") == 0;
    say("written to " + out.path().string() + (has_page ? "; page " + page_of(page_source(out.path())).string() : ""));
}

int profile(const Settings& settings, const std::string&) {
    const std::string given = the_given(settings, surface_names, "profile");
    rough::Extrusion extrusion;
    take(settings, bindings_of(extrusion));
    const bool is_map = given == "surface" || (given == "genome" && asks_for_map(settings));
    if (!is_map)
        expect_none(settings, {"periodic", "smr", "smc"}, "given without a map; give --surface or --nodes NXxNY too");
    write_description(is_map ? described_map(settings) : described_profile(settings), settings.text(given), settings,
                      extrusion);
    return 0;
}

} // namespace

Command profile_command() { return {"profile", profile_settings(), profile, {"genome"}}; }

} // namespace app
