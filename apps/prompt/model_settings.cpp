#include "apps/prompt/model_settings.hpp"

#include "apps/prompt/units.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/contact/materials.hpp"

namespace app {
namespace {

/// The --material; null if none is given.
const rough::Material* material_from(const Settings& settings, const std::string& prefix = "") {
    return settings.has(prefix + "material") ? &rough::materials()[settings.choice(prefix + "material")] : nullptr;
}

/// The values that the flags of a model set. E* follows from E and nu.
struct ModelParameters {
    rough::Model model = {};
    double modulus = rough::Model().body.effective_modulus, poisson = 0;
    std::string material = {}, layers = {};
};

/// Maximum number of layers. The time to compute a body's compliance grows with their cube.
constexpr std::size_t max_layers = 32;

/// The layers that --layer describes, T or T:E:NU each, one after another. E and nu are given if T is alone.
std::vector<rough::Layer> layers_from(const std::string& text, const std::string& place, double modulus,
                                      double poissons_ratio) {
    std::vector<rough::Layer> layers;
    std::string all = text;
    std::ranges::replace(all, '\n', ',');
    for (const std::string& word : rough::listed(all)) {
        std::vector<double> numbers;
        std::istringstream parts(word);
        for (std::string part; std::getline(parts, part, ':');) numbers.push_back(rough::number_from(part, place));
        const bool has_elasticity = numbers.size() == 3;
        if (numbers.size() != 1 && !has_elasticity)
            rough::refuse(place, ": \"", word, "\" given; give a thickness T (mm), or T:E:NU");
        if (has_elasticity && !(numbers[1] > 0))
            rough::refuse(place, ": \"", word, "\" has no modulus above 0; give T:E:NU");
        numbers.insert(numbers.end(), {modulus, poissons_ratio});
        layers.push_back({numbers[0], numbers[1], numbers[2]});
        if (layers.size() > max_layers) rough::refuse(place, ": more than ", max_layers, " layers given; give fewer");
    }
    return layers;
}

Bindings bindings_of(ModelParameters& of) {
    auto& [grid, body, loading, contact, accuracy] = of.model;
    const rough::Model usual;
    return {
        {whole("nodes", "", 2, 1e7,
               "nodes of the grid, 2 to 1e7 [" + std::to_string(usual.grid.nodes) + "; for a scan or map: its points]")
             .several('x'),
         grid.nodes},
        {positive("length", "",
                  "length L of the profile, mm [" + ga::number(usual.grid.length) +
                      "; for a scan, or a genome made for one: its length]")
             .several('x'),
         grid.length},
        {Setting("kernel", name_of(usual.body.kernel), "elastic body").of(rough::kernel_names()), body.kernel},
        {positive("datum", "", "distance d at which the free half-plane's displacement is zero, mm [L]"), body.datum},
        {positive("strip-width", "", "width W of the strip, mm [L/511]"), body.strip_width},
        {Setting("material", "",
                 "sets E, nu and the hardness above which a curve has a warning; modulus and poisson replace "
                 "its values")
             .of(names_of(rough::materials())),
         of.material},
        {positive("modulus", ga::number(usual.body.effective_modulus), "Young's modulus E, MPa"), of.modulus},
        {ga::number("poisson", "0", -0.999999, 0.5, "Poisson's ratio nu; E* = E/(1 - nu^2)"), of.poisson},
        {Setting("layer", "",
                 "a layer of the periodic body, T (mm) or T:E:NU, bonded to the next; may be repeated, the top "
                 "one first [none]")
             .several('\n'),
         of.layers},
        {Setting("base", "elastic", "body under the layers; elastic: the half-space of modulus and poisson")
             .of({"elastic", "rigid"}),
         body.layering.rigid_base},
        {whole("steps", std::to_string(usual.loading.steps), 2, 1e6, "load steps n_t, at least 2"), loading.steps},
        {ga::number("reach", "", ga::above_zero, 1, "largest displacement over the height range [1; periodic: 0.95]"),
         loading.reach},
        {Setting("solver", name_of(usual.contact.solver), "contact solver").of(rough::solver_names()), contact.solver},
        {ga::number("tolerance", ga::number(usual.contact.tolerance), 1e-15, 0.1,
                    "relative tolerance of the iterative solvers"),
         contact.tolerance},
    };
}

Bindings bindings_of(rough::ScanOptions& options) {
    return {
        {{"unit", "",
          "unit of columns without one in their header, or mm,um for x (and y) and heights; one of " +
              std::string(rough::known_lengths) + " [mm]"},
         options.unit},
        {positive("spacing", "", "distance of the points of heights without x, in the given unit").several('x'),
         options.spacing},
        {whole("row", "", 1, 1e7, "row of an areal map to take as the profile, from 1 (a text matrix needs --spacing)"),
         options.row},
        {Setting("detrend", "line", "form that is removed from a scan's heights").of(rough::detrend_names()),
         options.detrend},
        {Setting("outliers", "keep",
                 "whether outliers of a scan or map are kept, or replaced as missing points are filled")
             .of({"keep", "remove"}),
         options.remove_outliers},
        {positive("lambda-s", "", "cut-off of the filter that removes shorter wavelengths (ISO 16610-21), mm [none]"),
         options.lambda_s},
        {positive("lambda-c", "", "cut-off of the filter that removes longer wavelengths (ISO 16610-21), mm [none]"),
         options.lambda_c},
        {Setting("fill", "", "fill missing points: along a line by interpolation, on a map by Laplace's equation",
                 true),
         options.fill},
        {ga::number("max-filled", ga::number(options.max_filled), 0, 1,
                    "largest share of the points that may be filled"),
         options.max_filled},
    };
}

/// The scan options that the settings describe.
rough::ScanOptions scan_options(const Settings& settings, const std::string& prefix, bool keep_missing) {
    rough::ScanOptions options;
    take(settings.with({{prefix + "spacing", ""}}), bindings_of(options), prefix);
    if (settings.has(prefix + "spacing")) {
        options.spacing = settings.numbers(prefix + "spacing").front();
        options.row_spacing = settings.numbers(prefix + "spacing").back();
    }
    for (const std::string& unit : rough::listed(options.unit))
        rough::length_unit_named(unit, settings.place(prefix + "unit"));
    options.keep_missing = keep_missing && !options.fill;
    return options;
}

Bindings loading_bindings(rough::Model& model) {
    return {
        {pressure("to-pressure", "", "mean pressure of the last load step, MPa; replaces --reach"),
         model.loading.to_pressure},
        {pressure("pressures", "", "mean pressures of the load steps, MPa, as P1,P2,…; replaces --reach and --steps")
             .several(),
         model.loading.pressures},
        {pressure("hardness", "", "largest pressure that a node carries, MPa; nodes that reach it sink in [none]"),
         model.body.hardness}};
}

bool is_periodic(const Settings& settings, const std::string& prefix = "") {
    return settings.text(prefix + "kernel") == rough::name_of(rough::Kernel::periodic);
}

/// Throws if one of these keys, which only a profile has, or the kernel of a profile is given.
void expect_for_map(const Settings& settings, const std::string& prefix, const std::vector<std::string>& keys) {
    for (const std::string& key : keys)
        if (settings.knows(prefix + key) && settings.has(prefix + key))
            settings.refuse(prefix + key, "given with a map; omit it, as it is for profiles only");
    if (settings.text(prefix + "kernel") == "strip")
        settings.refuse(prefix + "kernel", "strip given with a map; give free or periodic");
}

/// A 2-D grid from --nodes and --length. By default it is a square with the nodes and the length of `usual`.
rough::Grid map_grid(const rough::Grid& usual, const Settings& settings, const std::string& prefix = "") {
    rough::Grid grid = usual;
    std::vector<double> length(2, usual.length);
    settings.take(prefix + "length", length);
    const rough::Extent cells = cells_from(settings, prefix).value_or(rough::Extent{usual.nodes, usual.nodes});
    grid.nodes = cells.columns;
    grid.rows = cells.rows;
    grid.length = length.front();
    grid.width = length.back();
    return grid;
}

/// The note by how much a genome's wave vectors were moved to fit a periodic map; "" if they were not.
std::string fit_note(const rough::Genome& genome, const rough::Grid& grid) {
    double farthest = 0;
    if (grid.periodic)
        for (const rough::PlaneWave& wave : plane_waves(genome, grid)) farthest = std::max(farthest, wave.moved);
    return farthest > 1e-12 ? "note: wave vectors were moved to the nearest that fit the periodic map, by up to " +
                                  readable(100 * farthest) + " % of their length"
                            : "";
}

/// The model of a map on a grid that --nodes and --length may change.
rough::Model map_model_on(const rough::Grid& usual, const Settings& settings, const std::string& prefix = "") {
    return model_from(settings.with({{prefix + "nodes", ""}, {prefix + "length", ""}}), prefix,
                      map_grid(usual, settings, prefix));
}

} // namespace

std::optional<rough::Extent> cells_from(const Settings& settings, const std::string& prefix) {
    if (!settings.knows(prefix + "nodes") || !settings.has(prefix + "nodes")) return {};
    const std::vector<double> nodes = settings.numbers(prefix + "nodes");
    if (nodes.front() * nodes.back() > 2e7)
        settings.refuse(prefix + "nodes", "'", settings.text(prefix + "nodes"),
                        "' has more than 2e7 nodes; give fewer");
    return rough::Extent{static_cast<rough::Index>(nodes.front()), static_cast<rough::Index>(nodes.back())};
}

Source open_genome(const std::filesystem::path& file) {
    rough::GenomeFile read = rough::read_genome_file(file);
    return {{.name = file.string()}, std::move(read.genome), read.length};
}

rough::Grid Source::grid(bool periodic) const {
    return genome ? rough::Grid{.length = length, .periodic = periodic} : grid_of(measured, periodic);
}

rough::Profile Source::on(const rough::Grid& grid) const { return genome ? sample(*genome, grid) : Scan::on(grid); }

bool states_modulus(const Settings& settings) { return settings.given("modulus") || settings.has("material"); }

std::string material_note(const Settings& settings) {
    const rough::Material* material = material_from(settings);
    if (!material) return "";
    return material->name + " (" + material->of + "): E " + ga::number(material->modulus) + " MPa, nu " +
           ga::number(material->poissons) + " (" + material->elastic + "), hardness " + ga::number(material->hardness) +
           " MPa (" + material->indented + ")";
}

double elastic_limit(const Settings& settings, const rough::Body& body) {
    if (body.yields() || !states_modulus(settings)) return std::numeric_limits<double>::infinity();
    const rough::Material* material = material_from(settings);
    return material ? material->hardness : rough::largest_elastic_pressure * body.effective_modulus;
}

std::vector<Setting> model_settings(const std::string& prefix) {
    ModelParameters usual;
    return settings_of(bindings_of(usual), prefix, "The model: grid, elastic body, load steps, solver");
}

std::vector<Setting> cap_settings(const std::string& prefix) {
    return {
        whole(prefix + "asperities", "", 1, 4096, "spherical caps in an array, NXxNY, instead of a sum of cosines")
            .several('x'),
        positive(prefix + "pitch", "", "distance of neighbouring caps, mm [1.5]"),
        positive(prefix + "radius", "", "radius of all caps, mm [0.526]"),
        Setting(prefix + "radii", "", "radii of caps as genes, FROM:TO or FROM:TO:STEP, mm").several(':'),
        Setting(prefix + "heights", "", "heights of the summits, FROM:TO or FROM:TO:STEP, mm [0:0.12:0.001]")
            .several(':'),
    };
}

Setting accuracy_setting(const std::string& against) {
    return ga::number("accuracy", "", 1e-9, 1,
                      "largest relative error allowed for a response, 1e-9 to 1, against " + against +
                          " [none: no response is approximated]");
}

rough::Model model_from(const Settings& settings, const std::string& prefix, const rough::Grid& grid) {
    ModelParameters given;
    given.model.grid = grid;
    take(settings, bindings_of(given), prefix);
    const rough::Material* material = material_from(settings, prefix);
    if (material && !settings.given(prefix + "modulus")) given.modulus = material->modulus;
    if (material && !settings.given(prefix + "poisson")) given.poisson = material->poissons;
    given.model.body.effective_modulus = rough::effective_modulus(given.modulus, given.poisson);
    rough::Layering& layering = given.model.body.layering;
    const double nu = given.poisson, modulus = given.model.body.effective_modulus * (1 - nu * nu);
    layering.layers = layers_from(given.layers, settings.place(prefix + "layer"), modulus, nu);
    layering.poissons_ratio = nu;
    rough::Model model = completed(std::move(given.model));
    placing(settings, prefix, [&] { validate(model); });
    return model;
}

rough::Model model_from(const Settings& settings, const Source& source, const std::string& prefix) {
    return model_from(settings, prefix, source.grid(is_periodic(settings, prefix)));
}

std::vector<Setting> loading_settings() {
    rough::Model usual;
    return settings_of(loading_bindings(usual));
}

rough::Model loaded(rough::Model model, const Settings& settings) {
    if (settings.given("to-pressure") + settings.given("pressures") + settings.given("reach") > 1)
        settings.refuse(settings.given("pressures") ? "pressures" : "to-pressure",
                        "given with another end of the load; give one of reach, to-pressure and pressures");
    if (settings.given("pressures") && settings.given("steps"))
        settings.refuse("steps", "given with pressures; give one of them");
    take(settings, loading_bindings(model));
    const auto& all = model.loading.pressures;
    if (std::ranges::adjacent_find(all, std::greater_equal<>()) != all.end())
        settings.refuse("pressures", settings.text("pressures"),
                        " given; give positive increasing numbers (MPa) with commas between");
    if (!all.empty()) model.loading.steps = static_cast<int>(all.size());
    return model;
}

std::vector<Setting> scan_settings(const std::string& prefix) {
    rough::ScanOptions usual;
    return settings_of(bindings_of(usual), prefix, "How a scan is read");
}

Setting resolution_setting() {
    Setting setting =
        Setting("resolution", "auto",
                "band of stiffness and contact area over the heights as measured and interpolated 4 times; auto: "
                "up to 2e6 interpolated nodes of a map, 1e7 of a line")
            .of(rough::resolution_names());
    setting.group = "How a scan is read";
    return setting;
}

rough::Resolution resolution_from(const Settings& settings) {
    return static_cast<rough::Resolution>(settings.choice("resolution"));
}

Source scan_from(const std::filesystem::path& file, const Settings& settings, rough::Index nodes,
                 const std::string& prefix, bool keep_missing) {
    rough::ScanOptions options = scan_options(settings, prefix, keep_missing);
    options.nodes = {nodes};
    return {placing(settings, prefix, [&] { return rough::open_scan(file, options); })};
}

Source source_from(const Settings& settings, const std::string& scan, bool keep_missing) {
    if (settings.knows("genome") && settings.has("genome")) {
        expect_none(settings, names_of(scan_settings()), "given with a genome; give it with --" + scan + " only");
        return open_genome(settings.text("genome"));
    }
    rough::Index nodes = 0;
    settings.take("nodes", nodes);
    return scan_from(settings.text(scan), settings, nodes, "", keep_missing);
}

std::string fill_note(const rough::Profile& surface, const std::vector<rough::Index>& filled,
                      const rough::Model& model) {
    const double share = static_cast<double>(filled.size()) / static_cast<double>(surface.nodes());
    return (share > rough::doubtful_fill ? "warning: " + percent(share) + " of the points are filled; " : "") +
           describe_fill_effect(surface, filled, model);
}

Setting map_setting() {
    return {"surface", "",
            "measured map instead of a genome: X3P, SDF, SUR, GSF, GWY; a text matrix, one line per row along x, "
            "with --spacing DX or DXxDY; or columns x, y, height"};
}

std::vector<Setting> surface_settings() {
    return {{"genome", "", "genome file (JSON) of the profile"},
            {"profile", "", "measured profile instead of a genome: text, XLSX, SDF, PRO, GSF or X3P"},
            map_setting()};
}

rough::Scan surface_from(const Settings& settings, const std::string& flag, bool keep_missing) {
    expect_none(settings, {"length", "row"}, "given with --" + flag + "; omit it, as it is for profiles only");
    rough::ScanOptions options = scan_options(settings, "", keep_missing);
    options.nodes = cells_from(settings).value_or(rough::Extent{});
    return placing(settings, "", [&] { return rough::read_map(settings.text(flag), options); });
}

bool asks_for_map(const Settings& settings, const std::string& prefix) {
    const auto is_pair = [&](const char* name) { return settings.text(prefix + name).find('x') != std::string::npos; };
    return (settings.knows("surface") && settings.has("surface")) || is_pair("nodes") || is_pair("length") ||
           (settings.knows(prefix + "spacing") && is_pair("spacing")) ||
           (settings.knows("like") && settings.has("like") &&
            rough::holds_map(settings.text("like"), scan_options(settings, "", false)));
}

rough::Model model_of(const rough::Profile& surface, const Settings& settings) {
    if (surface.is_2d()) expect_for_map(settings, "", {"datum", "strip-width"});
    return model_from(surface.is_2d() ? settings.with({{"nodes", ""}}) : settings, "",
                      grid_of(surface, is_periodic(settings)));
}

rough::Model surface_model_from(const Settings& settings, const std::string& prefix) {
    if (!asks_for_map(settings, prefix)) return model_from(settings, prefix);
    expect_for_map(settings, prefix, {"datum", "strip-width", "accuracy"});
    return map_model_on({}, settings, prefix);
}

rough::Scan sampled_from(const Settings& settings, bool periodic) {
    const Source source = source_from(settings, "surface");
    const rough::Grid grid = map_grid(source.grid(periodic), settings);
    const std::string note = fit_note(*source.genome, grid);
    return {source.name, sample(*source.genome, grid),
            source.name + ": " + std::to_string(grid.nodes) + " x " + std::to_string(grid.rows) + " nodes on " +
                readable(grid.length, 6) + " x " + readable(grid.width, 6) + " mm" + (note.empty() ? "" : "; " + note)};
}

Scene map_from(const Settings& settings, const std::string& map) {
    expect_for_map(settings, "", {"profile", "friction", "datum", "strip-width"});
    Scene scene;
    if (settings.knows(map) && settings.has(map)) {
        rough::Scan read = surface_from(settings, map);
        scene.surface = std::move(read.measured);
        scene.model = model_of(scene.surface, settings);
        const rough::Grid& grid = scene.model.grid;
        scene.missing = std::move(read.missing.nodes);
        scene.outliers = std::move(read.outliers);
        scene.notes.push_back(read.account + "; " + readable(grid.length) + " x " + readable(grid.width) + " mm");
    } else {
        const Source source = source_from(settings, "surface");
        scene.model = map_model_on(source.grid(is_periodic(settings)), settings);
        scene.surface = sample(*source.genome, scene.model.grid);
        scene.notes.push_back(fit_note(*source.genome, scene.model.grid));
    }
    if (scene.model.body.kernel == rough::Kernel::free) scene.notes.emplace_back(no_datum_note);
    return scene;
}

Scene scene_from(const Settings& settings, const std::string& flag, bool is_map) {
    Scene scene;
    if (is_map) {
        scene = map_from(settings, flag);
    } else {
        Source source = source_from(settings, flag);
        scene = {{},
                 model_from(settings, source),
                 std::move(source.missing.nodes),
                 std::move(source.outliers),
                 {source.account}};
        scene.surface = source.on(scene.model.grid);
    }
    if (!scene.missing.empty()) scene.notes.push_back(fill_note(scene.surface, scene.missing, scene.model));
    std::erase(scene.notes, "");
    return scene;
}

} // namespace app
