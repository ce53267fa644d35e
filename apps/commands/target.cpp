#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/targets.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/output.hpp"
#include "apps/report/render.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/target/out_of_reach.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"

#include <boost/algorithm/string/replace.hpp>

namespace app {
namespace {

std::vector<std::string> quantities() {
    std::vector<std::string> names = rough::quantity_names();
    names.push_back("conductance");
    return names;
}

std::vector<Setting> target_settings() {
    const std::vector<Setting> settings{
        {"formula", "", "formula of p (pressure, MPa) or of d (displacement, mm), e.g. \"0.3 + 2 * sqrt(p / 1e-4)\""},
        {"genome", "", "genome file (JSON); its response becomes the target"},
        {"like", "", "measured profile, or map (a text matrix with --spacing); its response becomes the target"},
        {"check", "", "target file to check; none is written"},
        {"draw", "", "page to write (HTML), on which a person draws a target and saves it"},
        Setting("quantity", "stiffness",
                "quantity of the target, against displacement for area-displacement and load, else against "
                "pressure; conductance takes --conductivity or --resistivity")
            .of(quantities()),
        positive("to", "", "last pressure (MPa) or displacement (mm) [last of the response; --formula needs it]"),
        positive("from", "", "first pressure (MPa) or displacement (mm) [the last over the number of points]"),
        whole("points", "20", 1, 1e6, "points of the target"),
        Setting("spaced", "even", "spacing of the points: even, or log for a constant factor").of({"even", "log"}),
        ga::number("band", "", 0, 1,
                   "tolerance band on both sides, as a fraction of each value [none; a scan: that of its "
                   "resolution]"),
        {"out", "", "target file to write (CSV)"},
        force_setting(),
    };
    return joined({settings, scale_settings(), scan_settings(), {resolution_setting()}, model_settings()});
}

/// The requested quantity, and its columns if it is a conductance: an interface stiffness in other columns.
std::pair<rough::Quantity, std::optional<rough::WrittenColumns>> quantity_from(const Settings& settings,
                                                                               const rough::Model& model) {
    const std::size_t choice = settings.choice("quantity");
    if (choice < rough::quantity_names().size()) return {static_cast<rough::Quantity>(choice), std::nullopt};
    return {rough::Quantity::interface_stiffness,
            placing(settings, "", [&] { return conductance_columns(scales_from(settings, model)); })};
}

/// Makes the target that --formula, --genome or --like describes, and the model that it is meant for.
std::pair<rough::Target, rough::Model> made_target(const Settings& settings) {
    rough::PointPlacement points{settings.whole<rough::Index>("points")};
    settings.take("to", points.last);
    settings.take("from", points.first);
    points.logarithmic = settings.choice("spaced") == 1;
    if (settings.has("formula")) {
        if (!points.last)
            rough::refuse("--to: missing; give the last pressure (MPa) or displacement (mm) of the formula");
        const rough::Model model = surface_model_from(settings);
        const auto [quantity, written] = quantity_from(settings, model);
        const auto y = formula(settings.text("formula"), against_pressure(quantity) ? "p" : "d", "--formula");
        const double unit = written ? written->y_unit : 1;
        const Eigen::VectorXd x = placing(settings, "", [&] { return points.up_to(*points.last); });
        rough::Target target = rough::target_at(quantity, "--formula", x, [&](double at) { return unit * y(at); });
        target.written = written;
        return {std::move(target), model}; // it records no body, because a formula belongs to none
    }
    const Scene scene = scene_from(settings, "like", asks_for_map(settings));
    std::ranges::for_each(scene.notes, say);
    const auto [quantity, written] = quantity_from(settings, scene.model);
    rough::Model loaded = scene.model;
    (against_pressure(quantity) ? loaded.loading.to_pressure : loaded.loading.to_displacement) = points.last;
    const bool has_band = !settings.has("genome") && !settings.has("band") &&
                          (!scene.surface.is_2d() || settings.given("resolution")); // that of a map takes long
    const std::string& name = settings.text(settings.has("genome") ? "genome" : "like");
    rough::Target target = placing(settings, "", [&, quantity = quantity] {
        return target_like(scene.surface, loaded, name, quantity, points,
                           has_band ? resolution_from(settings) : rough::Resolution::off);
    });
    target.written = written;
    return {std::move(target), scene.model};
}

/// Describes the target and returns the exit code: 3 if no surface can reach it.
int report(const rough::Target& target, const rough::Model& model, const Settings& settings) {
    const rough::WrittenColumns columns = columns_of(target);
    say(target.name + ": " + std::to_string(target.points()) + " points of " + columns.y + " from " +
        readable(target.y.minCoeff() / columns.y_unit, 4) + " to " + readable(target.y.maxCoeff() / columns.y_unit, 4) +
        " against " + columns.x + " up to " + readable(target.last() / columns.x_unit, 4) +
        (target.has_band() ? ", with a band" : ""));
    if (!states_modulus(settings)) say(modulus_note);
    const auto reasons = rough::out_of_reach({target}, model);
    for (const auto& reason : reasons) say(reason.verdict() + "; no similarity is above " + readable(reason.bound, 4));
    return reasons.empty() ? 0 : 3;
}

/// Writes the page on which a person draws a target for the model of the flags, and saves it as NAME.csv.
void write_drawing_page(const std::filesystem::path& page, const Settings& settings) {
    const rough::Model model = surface_model_from(settings);
    const bool nests = contact_sets_nest(model.body, model.grid);
    nlohmann::json data{{"file", page.stem().string() + ".csv"},
                        {"quantity", quantities()[settings.choice("quantity")]},
                        {"to", settings.has("to") ? nlohmann::json(settings.number("to")) : nullptr},
                        {"points", settings.whole<rough::Index>("points")},
                        {"band", settings.has("band") ? 100 * settings.number("band") : 0},
                        {"recorded", recorded_model(model)},
                        {"nests", nests},
                        {"full_contact", nests ? nlohmann::json(stiffness_limits(model).max) : nullptr},
                        {"modulus", model.body.effective_modulus},
                        {"length_mm", model.grid.length},
                        {"area", model.grid.is_2d() ? nlohmann::json(model.grid.nominal_area()) : nullptr}};
    for (const std::string& name : rough::quantity_names()) {
        const rough::Columns columns = columns_of(rough::quantity_named(name));
        data["quantities"].push_back({{"name", name}, {"x", columns.x}, {"y", columns.y}});
    }
    if (const auto [quantity, written] = quantity_from(settings, model); written)
        data["quantities"].push_back({{"name", "conductance"}, {"x", written->x}, {"y", written->y}});
    std::string text = rough::json_text(data, true);
    boost::replace_all(text, "<", "\\u003c"); // no tag within the page's script
    rough::write_atomically(page, render({.values = {{"kind", "draw"}, {"data", text}}, .folder = {}}));
    say("open " + page.string() + " in a browser; it saves " + data["file"].get<std::string>());
}

int target(const Settings& settings, const std::string&) {
    const std::string source = the_given(settings, {"formula", "genome", "like", "check", "draw"}, "target");
    if (source == "draw") {
        if (settings.has("out")) rough::refuse("--out: given with --draw; omit it, as the page saves the target");
        write_drawing_page(expect_writable(settings.text("draw"), settings, "--draw"), settings);
        return 0;
    }
    if (source == "check") {
        const rough::Model model = surface_model_from(settings);
        const rough::Target target = target_from(settings, settings.text("check"), model);
        std::ranges::for_each(notes_on(settings, model, {target}), say);
        return report(target, model, settings);
    }
    if (!settings.has("out")) rough::refuse("--out: missing; name the target file to write");
    const std::filesystem::path out = expect_writable(settings.text("out"), settings);
    auto [target, model] = made_target(settings);
    if (settings.has("band")) {
        target.lower = (1 - settings.number("band")) * target.y;
        target.upper = (1 + settings.number("band")) * target.y;
    }
    validate(target);
    rough::write_atomically(out, to_csv(target));
    std::ranges::for_each(notes_on(settings, model, {target}), say);
    return report(target, model, settings);
}

} // namespace

Command target_command() { return {"target", target_settings(), target}; }

} // namespace app
