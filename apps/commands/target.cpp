#include "domain/target/target.hpp"

#include "apps/commands/commands.hpp"
#include "apps/prompt/goals.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/output.hpp"
#include "apps/report/units.hpp"
#include "domain/errors.hpp"
#include "domain/target/like.hpp"
#include "domain/target/out_of_reach.hpp"
#include "domain/target/recorded.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {

namespace {

std::vector<Setting> target_settings() {
    const std::vector<Setting> settings{
        {"formula", "",
         "the target as a formula of p (MPa), or of d (mm), e.g. \"0.3 + 2 * sqrt(p / 1e-4)\""},
        {"genome", "", "genome file (JSON) whose own response is the target"},
        {"like", "", "measured profile whose own response is the target"},
        {"check", "", "target file to check in place of making one"},
        Setting("quantity", "stiffness",
                "of what, against pressure or (area-displacement, load) displacement")
            .of(rough::quantity_names()),
        positive("to", "",
                 "last pressure (MPa) or displacement (mm) [the response's own; needed with --formula]"),
        ga::whole("points", "20", 1, "points of the target, evenly spaced").up_to(1e6),
        ga::number("band", "", 0, 1,
                   "tolerance band, a fraction of each value on both sides [none; a scan: its resolution's]"),
        resistivity_setting(),
        {"out", "", "target file to write (CSV)"},
        force_setting(),
    };
    return joined({settings, scan_settings(), {resolution_setting()}, model_settings()});
}

struct Made {
    rough::Target goal;
    rough::Model model;
};

Made made_target(const Settings& settings) {
    const auto quantity = static_cast<rough::Quantity>(settings.choice("quantity"));
    const rough::Index points = static_cast<rough::Index>(settings.number("points"));
    if (settings.has("formula")) {
        if (!settings.has("to"))
            throw rough::InputError(
                "--to: missing, expected the last pressure (MPa) or displacement (mm) of the formula");
        const auto y = formula(settings.text("formula"), against_pressure(quantity) ? "p" : "d", "--formula");
        const rough::Model model = model_from(settings);
        rough::Target goal = rough::even_target(quantity, "--formula", points, settings.number("to"), y);
        goal.recorded = recorded_model(model);
        return {std::move(goal), model};
    }
    const rough::Source source = source_from(settings, nodes_from(settings, 0), "like");
    if (!source.account.empty())
        say(source.account);
    const rough::Model model = model_from(settings, source);
    rough::Model loaded = model;
    double last = 0;
    settings.take("to", last);
    (against_pressure(quantity) ? loaded.loading.to_pressure : loaded.loading.to_displacement) = last;
    return {placing(settings, "",
                    [&] {
                        return target_like(source.on(model.grid), loaded, source.name, quantity, points, last,
                                           source.genome || settings.has("band") ? rough::Resolution::off
                                                                                 : resolution_from(settings));
                    }),
            model};
}

/// Says what the target is; gives the exit code, 3 where it is out of reach.
int report(const rough::Target& goal, const rough::Model& model, const Settings& settings) {
    const rough::Columns columns = columns_of(goal.quantity);
    say(goal.name + ": " + std::to_string(goal.points()) + " points of " + columns.y + " from " +
        readable(goal.y.minCoeff(), 4) + " to " + readable(goal.y.maxCoeff(), 4) + " against " + columns.x +
        " up to " + readable(goal.last(), 4) + (goal.has_band() ? ", with a band" : ""));
    if (!states_modulus(settings))
        say(modulus_note);
    const auto reasons = rough::out_of_reach({goal}, model);
    for (const auto& reason : reasons)
        say(reason.verdict() + "; no similarity is above " + readable(reason.bound, 4));
    return reasons.empty() ? 0 : 3;
}

int target(const Settings& settings, const std::string&) {
    int given = 0;
    for (const char* source : {"formula", "genome", "like", "check"})
        given += settings.has(source);
    if (given != 1)
        throw rough::InputError("target: expected one of --formula, --genome, --like and --check");
    if (settings.has("check")) {
        const rough::Model model = model_from(settings);
        const rough::Target goal = goal_from(settings, settings.text("check"), model);
        for (const auto& note : without_effect(settings, {settings.text("check")}))
            say(note);
        for (const auto& note : carried_notes({goal}, model))
            say(note);
        return report(goal, model, settings);
    }
    if (!settings.has("out"))
        throw rough::InputError("target: --out is missing, expected the target file to write");
    const std::filesystem::path out = expect_writable(settings.text("out"), settings);
    Made made = made_target(settings);
    if (settings.has("band")) {
        const double part = settings.number("band");
        made.goal.lower = (1 - part) * made.goal.y;
        made.goal.upper = (1 + part) * made.goal.y;
    }
    validate(made.goal);
    rough::write_atomically(out, to_csv(made.goal));
    for (const auto& note : without_effect(settings))
        say(note);
    return report(made.goal, made.model, settings);
}

} // namespace

Command target_command() {
    return {"target",
            "make target files for a design, or check one",
            "(--formula F --to X | --genome G.json | --like SCAN.txt | --check T.csv) [--out T.csv] "
            "[flags]",
            "Makes target files for rugosa design, or checks one: reads it, and tests exactly whether any "
            "profile could answer so. A file made here records the body, length and datum it is meant for. "
            "Exit code 3 says that the target is out of reach.",
            target_settings(),
            {"target --formula \"0.3 + 0.8 * sqrt(p / 1.6e-4)\" --to 1.6e-4 --out target.csv",
             "target --genome surface.json --quantity area --out area.csv",
             "target --like scan.txt --unit um --band 0.02 --out target.csv", "target --check target.csv"},
            target};
}

} // namespace app
