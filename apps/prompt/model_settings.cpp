#include "apps/prompt/model_settings.hpp"

#include "domain/contact/names.hpp"
#include "domain/plain_stream.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>

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

} // namespace

std::vector<Setting> model_settings(const std::string& prefix) {
    const rough::Model usual;
    std::vector<Setting> settings{
        {prefix + "nodes", "",
         "nodes of the grid, 2 to 1e7 [" + std::to_string(usual.grid.nodes) + "; a scan: its points]"},
        {prefix + "length", "",
         "length L of the profile, mm [" + plain(usual.grid.length) +
             "; a scan, or a genome made for one: its own]"},
        {prefix + "kernel", name_of(usual.body.kernel), "elastic body: free, periodic or strip"},
        {prefix + "datum", "", "distance d at which the free half-plane's displacement is zero, mm [L]"},
        {prefix + "strip-width", "", "width W of the strip, mm [L/511]"},
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
    model.body.effective_modulus = rough::effective_modulus(
        settings.positive(prefix + "modulus"), settings.number(prefix + "poisson", -0.999999, 0.5));
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

} // namespace app
