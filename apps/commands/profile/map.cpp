#include "apps/commands/profile/map.hpp"

#include "apps/commands/profile/parameters.hpp"
#include "apps/prompt/area_settings.hpp"
#include "apps/prompt/verbosity.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/drawn.hpp"
#include "apps/report/output.hpp"
#include "apps/report/solids.hpp"
#include "apps/report/units.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/profile/spectrum.hpp"
#include "domain/scan/map.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

constexpr rough::Index fewest_nodes = 10; ///< a side, that areal parameters can be told of

/// A text matrix as --surface reads it.
std::string matrix(const rough::Profile& map) {
    std::vector<Eigen::VectorXd> columns;
    const auto [nodes, rows] = map.shape();
    for (rough::Index i = 0; i < nodes; ++i)
        columns.emplace_back(map.heights(Eigen::seqN(i, rows, nodes)));
    const std::string table = csv(std::vector<std::string>(columns.size()), columns);
    return table.substr(table.find('\n') + 1);
}

/// The material ratio curve at one place.
struct OnCurve {
    double ratio, height; ///< mm from the mean plane
};

/// What --smr and --smc ask for, of the mean plane.
struct MaterialRatios {
    std::vector<OnCurve> of_heights, of_ratios;
};

MaterialRatios ratios_of(rough::Profile map, const Settings& settings) {
    map.heights.array() -= map.heights.mean();
    MaterialRatios found;
    for (const double height : settings.numbers("smr", -1e300, 1e300))
        found.of_heights.push_back({material_ratio(map, height), height});
    for (const double ratio : settings.numbers("smc", 0, 1))
        found.of_ratios.push_back({ratio, rough::material_height(map.heights, ratio)});
    return found;
}

/// The ratios that were requested, as rows beside the set that surface.json holds.
std::vector<rough::SurfaceParameter> told(const MaterialRatios& ratios) {
    std::vector<rough::SurfaceParameter> all;
    for (const OnCurve& one : ratios.of_heights) {
        const Unit unit = length_unit(std::abs(one.height));
        all.push_back({"Smr(" + brief(unit.factor * one.height, 4) + " " + unit.name + ")", "",
                       "material ratio at this height over the mean plane", one.ratio});
    }
    for (const OnCurve& one : ratios.of_ratios)
        all.push_back({"Smc(" + brief(100 * one.ratio, 4) + " %)", "mm",
                       "height that this share of the area exceeds", one.height});
    return all;
}

nlohmann::json curve_json(const std::vector<OnCurve>& points) {
    nlohmann::json all = nlohmann::json::array();
    for (const OnCurve& one : points)
        all.push_back({{"material_ratio", one.ratio}, {"height_mm", one.height}});
    return all;
}

nlohmann::json numbers_of(const rough::Profile& map, const rough::ArealParameters& areal,
                          const MaterialRatios& ratios, const Settings& settings, const std::string& name,
                          const std::string& account, const std::vector<std::string>& files) {
    const auto [columns, rows] = map.shape();
    const auto cut_off = [&](const char* name) {
        return settings.has(name) ? nlohmann::json(settings.positive(name)) : nullptr;
    };
    nlohmann::json numbers{
        {"kind", "surface"},
        {"name", name},
        {"account", account},
        {"files", files},
        {"length_mm",
         {map.spacing * static_cast<double>(columns - 1), map.row_spacing * static_cast<double>(rows - 1)}},
        {"nodes", {columns, rows}},
        {"spacing_mm", {map.spacing, map.row_spacing}},
        {"lambda_s_mm", cut_off("lambda-s")},
        {"lambda_c_mm", cut_off("lambda-c")},
        {"Str_is_bound", areal.Str_is_bound},
        {"version", RUGOSA_VERSION}};
    add_parameters(numbers, areal.rows, told(ratios));
    if (settings.has("smr"))
        numbers["Smr_of_heights"] = curve_json(ratios.of_heights);
    if (settings.has("smc"))
        numbers["Smc_of_ratios"] = curve_json(ratios.of_ratios);
    return numbers;
}

} // namespace

int profile_map(const Settings& settings, const rough::Extrusion& extrusion) {
    const bool wraps = settings.is_on("periodic"), measured = settings.has("surface");
    const rough::Map read = measured ? surface_from(settings) : sampled_from(settings, wraps, fewest_nodes);
    const rough::Profile& map = read.heights;
    const rough::ArealParameters areal = areal_parameters(map, wraps);
    const MaterialRatios ratios = ratios_of(map, settings);
    const rough::Spectrum spectrum = continuous_spectrum(map, wraps);
    const Solids solids = solids_of(map, extrusion);

    const std::filesystem::path source = settings.text(measured ? "surface" : "genome");
    const OutputFolder out(settings.text("out"), source.stem().string(),
                           {{"surface.json", "heights.txt", "surface.x3p", "surface.vtk", "surface.stl",
                             "surface.3mf", "heights.svg", "map.csv", "bearing.csv", "spectrum.csv",
                             "spectrum-drawn.csv", "spectrum.svg", "report.html"},
                            settings.files(),
                            settings.is_on("force")});
    const auto write = [&](const char* name, const std::string& content) {
        rough::write_atomically(out.path() / name, content);
    };
    write("heights.txt", matrix(map));
    write("surface.x3p", x3p(map));
    write("surface.vtk", vtk(map));
    const std::vector<std::string> solid_files = write_solids(solids, out.path(), "surface");
    write("bearing.csv", bearing_csv(map.heights));
    write("map.csv", map_csv(map, {"height_mm"}, {below_highest(map)}));
    write("spectrum.csv", csv({"wave_number_rad_per_mm", "density_mm4", "power_mm2"},
                              {spectrum.wave_number, spectrum.density, spectrum.power}));
    write("spectrum-drawn.csv",
          drawn_csv({"wave_number_rad_per_mm", "density"}, {spectrum.wave_number, spectrum.density}, true));
    std::vector<std::string> files{"surface.json", "heights.txt", "surface.x3p",
                                   "surface.vtk",  "bearing.csv", "spectrum.csv"};
    files.insert(files.end(), solid_files.begin(), solid_files.end());
    write_json(out.path() / "surface.json",
               numbers_of(map, areal, ratios, settings, source.filename().string(), read.account, files));
    if (settings.is_on("pictures"))
        write_pages(out.path(), {{"heights.svg", "map:height"}, {"spectrum.svg", "spectrum:mm⁴"}});
    say(measured ? source.string() + ": " + read.account : read.account);
    std::vector<rough::SurfaceParameter> all = areal.rows;
    for (const rough::SurfaceParameter& one : told(ratios))
        all.push_back(one);
    print_parameters(all, areal["Sz"]);
    say("written to " + out.path().string());
    return 0;
}

} // namespace app
