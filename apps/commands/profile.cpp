#include "apps/commands/commands.hpp"
#include "apps/commands/profile/map.hpp"
#include "apps/commands/profile/parameters.hpp"
#include "apps/prompt/area_settings.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/scan_settings.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/drawn.hpp"
#include "apps/report/output.hpp"
#include "apps/report/shape_notes.hpp"
#include "apps/report/solids.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace app {

namespace {

constexpr const char* numbers_file = "profile.json";
constexpr rough::Index fewest_nodes = 10; ///< that roughness can be told of

std::vector<Setting> profile_settings() {
    const std::vector<Setting> settings{
        {"genome", "", "genome file (JSON) of the profile (may be given without the flag)"},
        {"profile", "", "measured profile in place of a genome: text, SDF, SUR, GSF or X3P"},
        {"out", "", "folder for the results [out/NAME, or out/NAME-2 and on]"},
        {"force", "", "write over existing results", true},
        {"nodes", "", "nodes of the grid, 10 to 1e7 [512; a scan: its points]; a genome's area: NXxNY"},
        {"length", "",
         "length L of the profile, mm [0.84942; a scan, or a genome made for one: its own]; an area: LX or "
         "LXxLY"},
        {"periodic", "", "the area repeats: nothing is windowed, lags go around its edges", true},
        {"smr", "", "heights over an area's mean plane, mm, with commas between: what share is higher"},
        {"smc", "", "shares of an area, 0 to 1, with commas between: the height that each exceeds"},
        {"width", "", "width of a profile's solid along its ridges, mm [L/4]"},
        {"base", "",
         "thickness of the solid below its lowest node, mm [the larger of height range and L/10]"},
        {"magnify", "1", "factor on all lengths of the solid, for printing"},
        {"pictures", "on", "off leaves out the page and the pictures"},
    };
    return joined({area_settings(), settings, scan_settings()});
}

/// A profile and what it was made of: cosines, or a scan.
struct Shape {
    rough::Profile profile;
    std::vector<rough::SpectralLine> lines; ///< of a genome
    std::string account;
    std::string jump; ///< in words; "" where its ends meet
};

Shape shape_from(const Settings& settings) {
    if (settings.has("profile") && settings.given("length"))
        throw rough::InputError("--length: given with a scan, which has its own");
    const rough::Index nodes = nodes_from(settings, 0, "", fewest_nodes);
    const rough::Source source = source_from(settings, nodes);
    rough::Grid grid = source.grid();
    if (nodes > 0)
        grid.nodes = nodes;
    if (settings.has("length"))
        grid.length = settings.positive("length");
    Shape shape{source.on(grid), {}, source.account, ""};
    if (!source.genome)
        return shape;
    shape.lines = rough::discrete_spectrum(*source.genome);
    const double shortest = 2 * std::numbers::pi / shape.lines.back().wave_number / grid.spacing();
    shape.account = source.name + ": " + readable(grid.length, 6) + " mm, " +
                    std::to_string(shape.lines.size()) + " waves, the shortest " + readable(shortest) +
                    " nodes long";
    if (shortest < 8)
        shape.account += " (waves under 8 nodes: slopes, curvatures and light contact depend on the grid)";
    shape.jump = jump_note(*source.genome, grid.length,
                           shape.profile.heights.maxCoeff() - shape.profile.heights.minCoeff());
    return shape;
}

rough::Extrusion extrusion_from(const Settings& settings) {
    rough::Extrusion extrusion;
    if (settings.has("width"))
        extrusion.width = settings.positive("width");
    if (settings.has("base"))
        extrusion.base = settings.positive("base");
    extrusion.magnify = settings.positive("magnify");
    return extrusion;
}

nlohmann::json numbers_of(const Shape& shape, const rough::Roughness& r, const Settings& settings,
                          const std::string& name, const std::vector<std::string>& files) {
    nlohmann::json numbers{
        {"kind", "profile"},
        {"name", name},
        {"account", shape.account},
        {"files", files},
        {"nodes", shape.profile.nodes()},
        {"length_mm", shape.profile.spacing * static_cast<double>(shape.profile.nodes() - 1)},
        {"lambda_s_mm", settings.has("lambda-s") ? nlohmann::json(settings.positive("lambda-s")) : nullptr},
        {"lambda_c_mm", settings.has("lambda-c") ? nlohmann::json(settings.positive("lambda-c")) : nullptr},
        {"section_length_mm", r.section_length},
        {"sections", r.sections},
        {"version", RUGOSA_VERSION}};
    add_parameters(numbers, r.rows);
    if (!shape.lines.empty()) { // exact, over lengths that all waves divide
        double m0 = 0, m2 = 0, m4 = 0;
        for (const auto& [k, power] : shape.lines)
            m0 += power, m2 += power * k * k, m4 += power * k * k * k * k;
        numbers["series"] = {{"m0_mm2", m0}, {"m2", m2}, {"m4_per_mm2", m4}};
    }
    return numbers;
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> columns(const std::vector<rough::SpectralLine>& lines) {
    Eigen::VectorXd k(static_cast<Eigen::Index>(lines.size())), power(k.size());
    for (Eigen::Index i = 0; i < k.size(); ++i) {
        k[i] = lines[static_cast<std::size_t>(i)].wave_number;
        power[i] = lines[static_cast<std::size_t>(i)].power;
    }
    return {k, power};
}

} // namespace

int profile(const Words& words) {
    if (shows_help(
            words,
            "profile (GENOME.json | --profile SCAN.txt | --surface MAP.txt --spacing DX[xDY]) [--out DIR] "
            "[flags]",
            "Writes what a rough profile is: a page to look at (report.html), its heights (heights.csv, "
            "profile.x3p), a solid to print or mesh (profile.3mf in mm, profile.stl), a picture "
            "(profile.svg), its parameters (profile.json: Pa, Pq and so on, or Ra, Rq and so on with "
            "--lambda-c), its material ratio curve (bearing.csv) and its power spectrum "
            "(spectrum.csv, spectrum.svg; lines.csv holds a genome's waves). Of a map, and of a genome on "
            "--nodes NXxNY: ISO 25178 parameters "
            "(surface.json), heights.txt, surface.x3p, surface.vtk, a tile to print (surface.3mf, "
            "surface.stl), a picture (heights.svg), bearing.csv and the areal spectrum.",
            profile_settings(),
            {"profile surface.json", "profile surface.json --nodes 2048 --magnify 100 --out surface",
             "profile --profile scan.txt --unit um --lambda-s 0.0025 --lambda-c 0.8",
             "profile --profile map.sur --row 12 --detrend arc --outliers remove",
             "profile surface.json --nodes 128x128",
             "profile --surface map.x3p --detrend parabola --lambda-c 0.8 --smc 0.1,0.8 --out out/map"}))
        return 0;
    const Settings settings = read_command_line(words, profile_settings(), {"genome"});
    if (settings.has("genome") + settings.has("profile") + settings.has("surface") != 1)
        throw rough::InputError("profile: expected one of a genome file, --profile and --surface");
    const rough::Extrusion extrusion = extrusion_from(settings);
    if (settings.has("surface") || (settings.has("genome") && asks_for_area(settings)))
        return profile_map(settings, extrusion);
    for (const std::string name : {"periodic", "smr", "smc"})
        if (settings.given(name))
            throw rough::InputError("--" + name +
                                    ": given without an area, expected with --surface or --nodes NXxNY");
    const bool pictures = settings.is_on("pictures");

    const Shape shape = shape_from(settings);
    const bool is_roughness = settings.has("lambda-c");
    const rough::Roughness roughness =
        rough::roughness(shape.profile, is_roughness ? settings.positive("lambda-c") : 0);
    const rough::Spectrum spectrum = continuous_spectrum(shape.profile);
    const Solids solids = solids_of(shape.profile, extrusion);

    const std::filesystem::path source = settings.text(settings.has("genome") ? "genome" : "profile");
    const OutputFolder out(settings.text("out"), source.stem().string(),
                           {{numbers_file, "heights.csv", "heights-drawn.csv", "profile.x3p", "profile.stl",
                             "profile.3mf", "spectrum.csv", "spectrum-drawn.csv", "lines.csv", "bearing.csv",
                             "profile.svg", "spectrum.svg", "report.html"},
                            settings.files(),
                            settings.is_on("force")});
    const auto write = [&](const char* name, const std::string& content) {
        rough::write_atomically(out.path() / name, content);
    };
    write("heights.csv", csv({"x_mm", "height_mm"}, {positions(shape.profile), shape.profile.heights}));
    write("profile.x3p", x3p(shape.profile));
    const std::vector<std::string> solid_files = write_solids(solids, out.path(), "profile");
    write("bearing.csv", bearing_csv(shape.profile.heights));
    write("spectrum.csv",
          csv({"wave_number_rad_per_mm", "density_mm3"}, {spectrum.wave_number, spectrum.density}));
    write("heights-drawn.csv", heights_csv(shape.profile));
    write("spectrum-drawn.csv",
          drawn_csv({"wave_number_rad_per_mm", "density"}, {spectrum.wave_number, spectrum.density}, true));
    if (!shape.lines.empty()) {
        const auto [k, power] = columns(shape.lines);
        write("lines.csv", csv({"wave_number_rad_per_mm", "power_mm2"}, {k, power}));
    }
    std::vector<std::string> files{numbers_file, "heights.csv", "bearing.csv", "spectrum.csv", "profile.x3p"};
    files.insert(files.end(), solid_files.begin(), solid_files.end());
    write_json(out.path() / numbers_file,
               numbers_of(shape, roughness, settings, source.filename().string(), files));
    if (pictures)
        write_pages(out.path(), {{"profile.svg", "profile-heights"}, {"spectrum.svg", "spectrum:mm³"}});
    say(shape.account);
    if (!shape.jump.empty())
        say(shape.jump);
    print_parameters(roughness.rows, roughness[is_roughness ? "Rt" : "Pt"]);
    say("written to " + out.path().string());
    return 0;
}

} // namespace app
