#include "apps/experiments/chart/models.hpp"
#include "apps/experiments/chart/words.hpp"
#include "apps/report/units.hpp"

#include <cmath>

namespace app {

namespace {

using Eigen::VectorXd;
using rough::Index;

constexpr double fair = 0.2; ///< an error up to which a model is said to hold

const ModelRun* run_of(const ModelChart& chart, const std::string& scene, const std::string& model) {
    for (const ModelRun& run : chart.runs)
        if (chart.scenes[run.scene].name == scene && run.model == model)
            return &run;
    return nullptr;
}

/// Between which contact fractions an error stays fair, around the load where it is least; "nowhere".
std::string fair_range(const VectorXd& errors, const VectorXd& fractions) {
    Index best = -1;
    for (Index j = 0; j < errors.size(); ++j)
        if (std::isfinite(errors[j]) && (best < 0 || std::abs(errors[j]) < std::abs(errors[best])))
            best = j;
    if (best < 0 || !(std::abs(errors[best]) <= fair))
        return "nowhere";
    Index from = best, to = best;
    while (from > 0 && std::abs(errors[from - 1]) <= fair)
        --from;
    while (to + 1 < errors.size() && std::abs(errors[to + 1]) <= fair)
        ++to;
    return "from " + share_words(fractions[from]) + " to " + share_words(fractions[to]) + " in contact";
}

/// "persson: area from … to …, stiffness …; …"
std::string theories_words(const ModelChart& chart, std::size_t scene) {
    std::vector<std::string> words;
    for (const ModelRun& run : chart.runs)
        if (run.scene == scene && run.family == ModelRun::Family::theory) {
            const ModelScene& of = chart.scenes[scene];
            words.push_back(run.model + " holds for the area " +
                            fair_range(run.area_errors(of), of.contact_fraction) + " and for the stiffness " +
                            fair_range(run.stiffness_errors(of), of.contact_fraction) + " (" +
                            time_words(run.seconds) + ")");
        }
    return enumerated(words);
}

std::string error_words(const ModelRun& run, const ModelScene& scene) {
    const auto [area, stiffness] = errors_of(run, scene);
    return share_words(area) + " in the area and " + share_words(stiffness) + " in the stiffness in " +
           time_words(run.seconds);
}

/// The coarsest grid of a scene whose errors are both under 0.03, or the finest.
const ModelRun* grid_that_is_enough(const ModelChart& chart, std::size_t scene) {
    const ModelRun* found = nullptr;
    for (const ModelRun& run : chart.runs)
        if (run.scene == scene && run.family == ModelRun::Family::grid) {
            const auto [area, stiffness] = errors_of(run, chart.scenes[scene]);
            found = &run;
            if (std::max(area, stiffness) < 0.03)
                break;
        }
    return found;
}

std::string described(const ModelRun& run) {
    return run.nodes > 0 ? run.model + ", " + std::to_string(run.nodes) + " nodes" : run.model;
}

struct FamilyLook {
    ModelRun::Family family;
    const char* label;
    Colour colour;
};
constexpr std::array<FamilyLook, 3> family_looks{{{ModelRun::Family::theory, "theories", Colour::orange},
                                                  {ModelRun::Family::line, "one line", Colour::green},
                                                  {ModelRun::Family::grid, "solved", Colour::blue}}};

/// Time against an error over all loads.
Plot time_plot(const ModelChart& chart, std::size_t scene, bool of_area) {
    Plot plot;
    plot.title = chart.scenes[scene].name;
    plot.alt = std::string("Error of the ") + (of_area ? "contact fraction" : "stiffness") +
               " against time per curve on the scene " + plot.title + ": theories, one line, solved grids";
    plot.x = {"Seconds per curve", true};
    plot.y = {std::string("Error of the ") + (of_area ? "contact fraction" : "stiffness"), true};
    for (const FamilyLook& look : family_looks) {
        std::vector<double> x, y;
        for (const ModelRun& run : chart.runs)
            if (run.scene == scene && run.family == look.family) {
                const auto [area, stiffness] = errors_of(run, chart.scenes[scene]);
                x.push_back(run.seconds);
                y.push_back(of_area ? area : stiffness);
            }
        const auto size = static_cast<Index>(x.size());
        if (size > 0)
            plot.series.push_back(
                {look.label, VectorXd::Map(x.data(), size), VectorXd::Map(y.data(), size), look.colour,
                 look.family == ModelRun::Family::grid ? Style::line_points : Style::points, 2});
    }
    return plot;
}

/// A quantity over the load that Persson takes, P over E* h', of all models and the exact one.
Plot load_plot(const ModelChart& chart, std::size_t scene, bool of_area) {
    const ModelScene& of = chart.scenes[scene];
    Plot plot;
    plot.title = of.name;
    plot.alt = std::string(of_area ? "E* h' A/p" : "Length p/K over the rms height") +
               " against the contact fraction on the scene " + of.name + ", one line a model";
    plot.x = {"Contact fraction A, exact", true};
    plot.y = {of_area ? "E* h' A/p" : "p/(K h_rms)", false, 0, of_area ? 3.0 : 1.0};
    const auto shown = [&](const VectorXd& area, const VectorXd& stiffness) -> VectorXd {
        if (of_area)
            return area.array() * of.rms_slope / of.pressure.array();
        return of.pressure.array() / stiffness.array() / of.rms_height;
    };
    plot.series.push_back({"exact", of.contact_fraction, shown(of.contact_fraction, of.stiffness),
                           Colour::text, Style::line_points, 1.5});
    std::size_t colour = 0;
    for (const ModelRun& run : chart.runs)
        if (run.scene == scene && run.family != ModelRun::Family::grid)
            plot.series.push_back({run.model, of.contact_fraction, shown(run.contact_fraction, run.stiffness),
                                   line_colour(colour++), Style::line, 1.5});
    return plot;
}

Table models_errors(const ModelChart& chart) {
    Table table{"Errors over the loads, root mean square, and time of a curve of 12 loads on one core",
                {"Scene", "Model", "Area", "Stiffness", "Time"},
                {},
                {false, false, true, true, true}};
    for (const ModelRun& run : chart.runs) {
        const auto [area, stiffness] = errors_of(run, chart.scenes[run.scene]);
        const Index answers = run.contact_fraction.array().isFinite().count();
        table.rows.push_back(
            {chart.scenes[run.scene].name,
             described(run) + (answers < run.contact_fraction.size()
                                   ? " (" + std::to_string(answers) + " of " +
                                         std::to_string(run.contact_fraction.size()) + " loads)"
                                   : ""),
             share_words(area), share_words(stiffness), time_words(run.seconds)});
    }
    return table;
}

} // namespace

void add_models(Page& page, const ModelChart& chart) {
    if (chart.runs.empty())
        return;
    page.section("Theory, profile or map");
    for (std::size_t scene = 0; scene < chart.scenes.size(); ++scene)
        if (const std::string words = theories_words(chart, scene); !words.empty())
            page.prose(strong("Where theories end") + ", within " + share_words(fair) + " on " +
                       chart.scenes[scene].name + ": " + words + ".");
    for (std::size_t scene = 0; scene < chart.scenes.size(); ++scene) {
        const ModelScene& of = chart.scenes[scene];
        const ModelRun* line = run_of(chart, of.name, "mean-line");
        const ModelRun* section = run_of(chart, of.name, "section");
        const ModelRun* grid = grid_that_is_enough(chart, scene);
        if (!line || !section || !grid)
            continue;
        const auto [area, stiffness] = errors_of(*line, of);
        const bool enough = std::max(area, stiffness) <= fair;
        page.prose(strong(enough ? "Where a profile is enough" : "Where a map is needed") + ": on " +
                   of.name + " (Str " + readable(of.aspect_ratio, 2) +
                   ") one line, the mean along the lay, errs by " + error_words(*line, of) +
                   ", one section by " + error_words(*section, of) + "; the map on " +
                   std::to_string(grid->nodes) + " nodes by " + error_words(*grid, of) + ".");
    }
    page.table(models_errors(chart));
    Figure figure{
        "models",
        "Error against time of models and solvers.",
        "Over 12 loads from 0.5 % to nearly full contact, relative, root mean square. A solver's dots "
        "are grids.",
        {}},
        loads{
            "theories",
            "Area and stiffness beside the theories.",
            "E* h' A/p is 1.60 (Persson) and 2.51 (Bush, Gibson and Thomas) at light load; p/K over the rms "
            "height is Persson's u0/h_rms where K = p/u0.",
            {}};
    for (std::size_t scene = 0; scene < chart.scenes.size(); ++scene)
        for (const bool of_area : {true, false}) {
            figure.panels.push_back(time_plot(chart, scene, of_area));
            loads.panels.push_back(load_plot(chart, scene, of_area));
        }
    page.figure(std::move(figure));
    page.figure(std::move(loads));
}

} // namespace app
