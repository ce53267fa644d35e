#include "apps/prompt/model_settings.hpp"

#include "apps/report/units.hpp"
#include "domain/errors.hpp"

#include <limits>

namespace app {

namespace {

rough::Model model_on(rough::Grid grid, const Settings& settings, const std::string& prefix) {
    rough::Model model;
    model.body.kernel = static_cast<rough::Kernel>(settings.one_of(prefix + "kernel", rough::kernel_names()));
    const bool periodic = model.body.kernel == rough::Kernel::periodic;
    grid.wraps = periodic;
    model.grid = grid;

    const double poisson = settings.number(prefix + "poisson", -0.999999, 0.5);
    model.body.effective_modulus = settings.positive(prefix + "modulus") / (1 - poisson * poisson);
    model.body.datum = settings.has(prefix + "datum") ? settings.positive(prefix + "datum") : grid.length;
    model.body.strip_width =
        settings.has(prefix + "strip-width") ? settings.positive(prefix + "strip-width") : grid.length / 511;
    model.loading.steps = static_cast<int>(settings.whole(prefix + "steps", 2, 1000000));
    model.loading.reach = settings.has(prefix + "reach")
                              ? settings.number(prefix + "reach", std::numeric_limits<double>::min(), 1)
                              : (periodic ? 0.95 : 1);
    if (periodic && model.loading.reach >= 1)
        throw rough::InputError(
            settings.place(prefix + "reach") +
            ": 1 given, expected less than 1 (the periodic kernel has no solution beyond full "
            "contact)");
    model.contact.solver = static_cast<rough::Solver>(settings.one_of(prefix + "solver", solver_names()));
    model.contact.tolerance = settings.number(prefix + "tolerance", 1e-15, 0.1);
    return model;
}

rough::Model model_from(const Settings& settings, double length, const std::string& prefix) {
    rough::Grid grid;
    grid.length = length;
    grid.nodes = nodes_from(settings, grid.nodes, prefix);
    if (settings.has(prefix + "length"))
        grid.length = settings.positive(prefix + "length");
    return model_on(grid, settings, prefix);
}

} // namespace

const std::vector<std::string>& solver_names() {
    static const std::vector<std::string> names{"auto", "nested", "nnls", "polonsky-keer", "active-set"};
    return names;
}

const std::string& name_of(rough::Solver solver) { return solver_names()[static_cast<std::size_t>(solver)]; }

std::vector<Setting> model_settings(const std::string& prefix) {
    std::vector<Setting> settings{
        {prefix + "nodes", "", "nodes of the grid, 2 to 1e7 [512; a scan: its points]"},
        {prefix + "length", "",
         "length L of the profile, mm [0.84942; a scan, or a genome made for one: its own]"},
        {prefix + "kernel", "free", "elastic body: free, periodic or strip"},
        {prefix + "datum", "", "distance d at which the free half-plane's displacement is zero, mm [L]"},
        {prefix + "strip-width", "", "width W of the strip, mm [L/511]"},
        {prefix + "modulus", "1", "Young's modulus E, MPa"},
        {prefix + "poisson", "0", "Poisson's ratio nu; E* = E/(1 - nu^2)"},
        {prefix + "steps", "20", "load steps n_t, at least 2"},
        {prefix + "reach", "", "largest displacement over the profile's range [1; periodic: 0.95]"},
        {prefix + "solver", "auto", "contact solver: auto, nested, nnls, polonsky-keer or active-set"},
        {prefix + "tolerance", "1e-6", "relative tolerance of the iterative solvers"},
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

double shortest_wave_from(const Settings& settings, const std::string& name, const rough::Grid& grid) {
    if (!settings.has(name))
        return 8 * grid.spacing();
    const double wave = settings.positive(name);
    if (wave < grid.spacing())
        throw rough::InputError(settings.place(name) + ": " + settings.text(name) +
                                " mm given, expected at least the distance of two nodes, " +
                                readable(grid.spacing(), 6) + " mm: the grid sees no shorter wave");
    return wave;
}

rough::Model model_from(const Settings& settings, const std::string& prefix) {
    return model_from(settings, rough::Grid().length, prefix);
}

rough::Model model_from(const Settings& settings, double length) { return model_from(settings, length, ""); }

rough::Model model_from(const Settings& settings, const rough::Profile& scan, const std::string& prefix) {
    rough::Grid grid;
    grid.nodes = nodes_from(settings, scan.nodes(), prefix);
    const bool wraps = settings.text(prefix + "kernel") == name_of(rough::Kernel::periodic);
    const double own = scan.spacing * static_cast<double>(wraps ? scan.nodes() : scan.nodes() - 1);
    grid.length = settings.has(prefix + "length") ? settings.positive(prefix + "length") : own;
    return model_on(grid, settings, prefix);
}

} // namespace app
