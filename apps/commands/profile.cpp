#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/scan_settings.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/plot.hpp"
#include "apps/report/shape_notes.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/discrete_spectrum.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/solid.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/text/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <numbers>

namespace app {

namespace {

constexpr const char* numbers_file = "profile.json";
constexpr rough::Index fewest_nodes = 10; ///< that roughness can be told of
constexpr rough::Index most_solid_nodes = 1'000'000;

std::vector<Setting> profile_settings() {
    const std::vector<Setting> settings{
        {"genome", "", "genome file (JSON) of the profile (may be given without the flag)"},
        {"profile", "", "measured profile in place of a genome: a text file of one or two columns"},
        {"out", "", "folder for the results [out/NAME, or out/NAME-2 and on]"},
        {"force", "", "write over existing results", true},
        {"nodes", "", "nodes of the grid, 10 to 1e7 [512; a scan: its points]"},
        {"length", "", "length L of the profile, mm [0.84942; a scan, or a genome made for one: its own]"},
        {"width", "", "width of the solid along its ridges, mm [L/4]"},
        {"base", "",
         "thickness of the solid below its lowest node, mm [the larger of height range and L/10]"},
        {"magnify", "1", "factor on all lengths of the solid, for printing"},
        {"pictures", "on", "off leaves out the pictures"},
    };
    return joined({settings, scan_settings()});
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

nlohmann::json numbers_of(const Shape& shape, const rough::Roughness& r) {
    nlohmann::json numbers{
        {"nodes", shape.profile.nodes()},
        {"length_mm", shape.profile.spacing * static_cast<double>(shape.profile.nodes() - 1)},
        {"Ra_mm", r.Ra},
        {"Rq_mm", r.Rq},
        {"Rsk", r.Rsk},
        {"Rku", r.Rku},
        {"Rz_mm", r.Rz},
        {"Rt_mm", r.Rt},
        {"rms_slope", r.Rdq},
        {"rms_curvature_per_mm", r.rms_curvature},
        {"m0_mm2", r.m0},
        {"m2", r.m2},
        {"m4_per_mm2", r.m4},
        {"bandwidth", r.bandwidth},
        {"version", RUGOSA_VERSION}};
    if (!shape.lines.empty()) { // exact, over lengths that all waves divide
        double m0 = 0, m2 = 0, m4 = 0;
        for (const auto& [k, power] : shape.lines)
            m0 += power, m2 += power * k * k, m4 += power * k * k * k * k;
        numbers["series"] = {{"m0_mm2", m0}, {"m2", m2}, {"m4_per_mm2", m4}};
    }
    return numbers;
}

Eigen::VectorXd positions(const rough::Profile& profile) {
    return profile.spacing *
           Eigen::VectorXd::LinSpaced(profile.nodes(), 0, static_cast<double>(profile.nodes() - 1));
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> columns(const std::vector<rough::SpectralLine>& lines) {
    Eigen::VectorXd k(static_cast<Eigen::Index>(lines.size())), power(k.size());
    for (Eigen::Index i = 0; i < k.size(); ++i) {
        k[i] = lines[static_cast<std::size_t>(i)].wave_number;
        power[i] = lines[static_cast<std::size_t>(i)].power;
    }
    return {k, power};
}

Plot profile_plot(const rough::Profile& profile) {
    const Eigen::VectorXd heights = profile.heights.array() - profile.heights.mean();
    const Unit across = length_unit(profile.spacing * static_cast<double>(profile.nodes() - 1));
    const Unit up = length_unit(heights.cwiseAbs().maxCoeff());
    Plot plot;
    plot.alt = "Height of the profile along its length";
    plot.x = {"Position x (" + across.name + ")"};
    plot.y = {"Height z (" + up.name + ")"};
    plot.series.push_back({"", across.factor * positions(profile), up.factor * heights});
    plot.series.back().width = 1.2;
    plot.height = 220;
    return plot;
}

Plot spectrum_plot(const rough::Spectrum& spectrum) {
    Plot plot;
    plot.alt = "Power spectral density of the profile against wave number";
    plot.x = {"Wave number q (rad/mm)", true};
    plot.y = {"Power spectral density C (mm³)", true};
    plot.series.push_back({"", spectrum.wave_number, spectrum.density});
    plot.series.back().width = 1.2;
    return plot;
}

void tell_roughness(const rough::Roughness& r) {
    const Unit height = length_unit(r.Rt);
    const auto row = [](const char* name, double value, const std::string& unit, const char* meaning) {
        char line[120];
        std::snprintf(line, sizeof line, "  %-14s %12.6g %-5s %s", name, value, unit.c_str(), meaning);
        say(line);
    };
    row("Ra", r.Ra * height.factor, height.name, "arithmetic mean height");
    row("Rq", r.Rq * height.factor, height.name, "root mean square height");
    row("Rsk", r.Rsk, "", "skewness");
    row("Rku", r.Rku, "", "kurtosis");
    row("Rz", r.Rz * height.factor, height.name, "maximum height, mean of five sections");
    row("Rt", r.Rt * height.factor, height.name, "total height");
    row("rms slope", r.Rdq, "", "");
    row("rms curvature", r.rms_curvature, "1/mm", "");
    row("m0", r.m0, "mm²", "spectral moments, from the nodes");
    row("m2", r.m2, "", "");
    row("m4", r.m4, "1/mm²", "");
    row("bandwidth", r.bandwidth, "", "m0 m4/m2²");
}

} // namespace

int profile(const Words& words) {
    if (shows_help(words, "profile (GENOME.json | --profile SCAN.txt) [--out DIR] [flags]",
                   "Writes what a rough profile is: its heights (heights.csv), a solid to print or mesh "
                   "(profile.stl), a picture (profile.svg), its roughness (profile.json) and its power "
                   "spectrum (spectrum.csv, spectrum.svg; lines.csv holds a genome's waves).",
                   profile_settings(),
                   {"profile surface.json", "profile surface.json --nodes 2048 --magnify 100 --out surface",
                    "profile --profile scan.txt --unit um --detrend parabola"}))
        return 0;
    const Settings settings = read_command_line(words, profile_settings(), {"genome"});
    if (settings.has("genome") == settings.has("profile"))
        throw rough::InputError("profile: expected either a genome file or --profile");
    const rough::Extrusion extrusion = extrusion_from(settings);
    const bool pictures = settings.is_on("pictures");

    const Shape shape = shape_from(settings);
    const rough::Roughness roughness = rough::roughness(shape.profile);
    const rough::Spectrum spectrum = continuous_spectrum(shape.profile);
    const bool has_solid = shape.profile.nodes() <= most_solid_nodes;
    const std::string solid = has_solid ? binary_stl(shape.profile, extrusion) : "";

    const std::filesystem::path source = settings.text(settings.has("genome") ? "genome" : "profile");
    const OutputFolder out(settings.text("out"), source.stem().string(),
                           {{numbers_file, "heights.csv", "profile.stl", "spectrum.csv", "lines.csv",
                             "profile.svg", "spectrum.svg"},
                            settings.files(),
                            settings.is_on("force")});
    const auto write = [&](const char* name, const std::string& content) {
        rough::write_atomically(out.path() / name, content);
    };
    write("heights.csv", csv({"x_mm", "height_mm"}, {positions(shape.profile), shape.profile.heights}));
    if (has_solid)
        write("profile.stl", solid);
    else
        say("note: profile.stl is left out, as a solid of more than 1e6 nodes is of no use to any printer");
    write("spectrum.csv",
          csv({"wave_number_rad_per_mm", "density_mm3"}, {spectrum.wave_number, spectrum.density}));
    if (!shape.lines.empty()) {
        const auto [k, power] = columns(shape.lines);
        write("lines.csv", csv({"wave_number_rad_per_mm", "power_mm2"}, {k, power}));
    }
    if (pictures) {
        write_picture(out.path() / "profile.svg", profile_plot(shape.profile));
        write_picture(out.path() / "spectrum.svg", spectrum_plot(spectrum));
    }
    write_json(out.path() / numbers_file, numbers_of(shape, roughness));
    say(shape.account);
    if (!shape.jump.empty())
        say(shape.jump);
    tell_roughness(roughness);
    say("written to " + out.path().string());
    return 0;
}

} // namespace app
