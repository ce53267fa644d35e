#include "apps/commands/profile/map.hpp"

#include "apps/commands/profile/solids.hpp"
#include "apps/prompt/area_settings.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/map_page.hpp"
#include "apps/report/map_plot.hpp"
#include "apps/report/output.hpp"
#include "apps/report/units.hpp"
#include "domain/profile/areal.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/x3p.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

/// A text matrix as --surface reads it.
std::string matrix(const rough::Profile& map) {
    std::vector<Eigen::VectorXd> columns;
    const auto [nodes, rows] = map.shape();
    for (rough::Index i = 0; i < nodes; ++i)
        columns.emplace_back(map.heights(Eigen::seqN(i, rows, nodes)));
    const std::string table = csv(std::vector<std::string>(columns.size()), columns);
    return table.substr(table.find('\n') + 1);
}

nlohmann::json numbers_of(const rough::Profile& map, const rough::ArealParameters& areal,
                          const Settings& settings) {
    const auto [columns, rows] = map.shape();
    const auto cut_off = [&](const char* name) {
        return settings.has(name) ? nlohmann::json(settings.positive(name)) : nullptr;
    };
    nlohmann::json numbers{{"nodes", {columns, rows}},
                           {"spacing_mm", {map.spacing, map.row_spacing}},
                           {"lambda_s_mm", cut_off("lambda-s")},
                           {"lambda_c_mm", cut_off("lambda-c")},
                           {"Str_is_bound", areal.texture.Str_is_bound},
                           {"version", RUGOSA_VERSION}};
    for (const Parameter& one : parameters(areal))
        numbers[one.key] = one.value;
    return numbers;
}

} // namespace

int profile_map(const Settings& settings, const rough::Extrusion& extrusion) {
    const rough::Map read = surface_from(settings, rough::Detrend::line);
    const rough::Profile& map = read.heights;
    const bool wraps = settings.is_on("periodic");
    const rough::ArealParameters areal = areal_parameters(map, wraps);
    const rough::Spectrum spectrum = continuous_spectrum(map, wraps);
    const Solids solids = solids_of(map, extrusion);

    const std::filesystem::path source = settings.text("surface");
    const OutputFolder out(
        settings.text("out"), source.stem().string(),
        {{"surface.json", "heights.txt", "surface.x3p", "surface.vtk", "surface.stl", "surface.3mf",
          "heights.svg", "bearing.csv", "spectrum.csv", "spectrum.svg", "report.html"},
         settings.files(),
         settings.is_on("force")});
    const auto write = [&](const char* name, const std::string& content) {
        rough::write_atomically(out.path() / name, content);
    };
    write("heights.txt", matrix(map));
    write("surface.x3p", x3p(map));
    write("surface.vtk", vtk(map));
    const std::vector<std::string> solid_files = write_solids(solids, out.path(), "surface");
    const auto [ratio, level] = bearing_curve(map.heights);
    write("bearing.csv", csv({"material_ratio", "height_mm"}, {ratio, level}));
    write("spectrum.csv", csv({"wave_number_rad_per_mm", "density_mm4", "power_mm2"},
                              {spectrum.wave_number, spectrum.density, spectrum.power}));
    if (settings.is_on("pictures")) {
        const Plot heights = heights_plot(map);
        write_picture(out.path() / "heights.svg", heights);
        write_picture(out.path() / "spectrum.svg", spectrum_plot(spectrum));
        std::vector<std::string> files{"surface.json", "heights.txt", "heights.svg", "surface.x3p",
                                       "surface.vtk",  "bearing.csv", "spectrum.csv"};
        files.insert(files.end(), solid_files.begin(), solid_files.end());
        write("report.html",
              map_page({source.filename().string(), read.account, map, areal, spectrum, heights, files}));
    }
    write_json(out.path() / "surface.json", numbers_of(map, areal, settings));
    say(source.string() + ": " + read.account);
    tell_parameters(parameters(areal), areal.Sz);
    say("written to " + out.path().string());
    return 0;
}

} // namespace app
