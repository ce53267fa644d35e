#include "apps/commands/design/page.hpp"

#include "apps/report/map_plot.hpp"
#include "apps/report/page.hpp"
#include "apps/report/units.hpp"
#include "domain/contact/names.hpp"
#include "domain/target/similarity.hpp"

#include <algorithm>
#include <filesystem>

namespace app {

namespace {

struct Shown {
    std::string x, y; ///< axis labels
    Unit unit;        ///< of x
};

Shown shown_as(const rough::Target& goal) {
    const bool by_pressure = goal.against_pressure();
    const Unit unit = by_pressure ? pressure_unit(goal.last()) : length_unit(goal.last());
    const std::string x =
        by_pressure ? "Mean pressure p (" + unit.name + ")" : "Displacement (" + unit.name + ")";
    switch (goal.quantity) {
    case rough::Quantity::stiffness:
        return {x, "Stiffness K (MPa/mm)", unit};
    case rough::Quantity::load_at_displacement:
        return {x, "Mean pressure p (MPa)", unit};
    case rough::Quantity::interface_stiffness:
        return {x, "Interface stiffness K_i (MPa/mm)", unit};
    default:
        return {x, "Contact fraction A", unit};
    }
}

/// One of the answer's responses, as it is drawn.
struct ResponseLine {
    rough::DesignResponse response;
    std::string label;
    Colour colour;
    Dash dash;
};

/// On the set-up's grid and, where it was verified there, on one four times finer.
std::vector<ResponseLine> drawn_responses(const DesignRun& run) {
    std::vector<ResponseLine> all{{run.own, "answer", Colour::blue, Dash::solid}};
    if (const auto& finer = run.found.best.verification.on_finer; !finer.empty())
        all.push_back({scored(run.setup, finer), "on a grid four times finer", Colour::orange, Dash::dashed});
    return all;
}

Plot goal_plot(const DesignRun& run, const std::vector<ResponseLine>& answers, std::size_t g) {
    const rough::Target& goal = run.setup.targets[g];
    const Shown shown = shown_as(goal);
    Plot plot;
    plot.alt = shown.y + " that was asked for and that the answer gives, on both grids";
    plot.title = std::filesystem::path(goal.name).filename().string();
    plot.x = {shown.x, false, 0, unset};
    plot.y = {shown.y, false, 0, unset};
    for (const auto& [response, label, colour, dash] : answers) {
        const rough::Curve curve = to_its_end(response.curves[g]);
        plot.series.push_back({label, shown.unit.factor * curve.x, curve.y, colour, Style::line, 2, dash});
    }
    if (run.from) {
        const rough::Curve before =
            to_its_end(respond(run.setup, run.from->genome, run.setup.model).curves[g]);
        plot.series.push_back(
            {"before", shown.unit.factor * before.x, before.y, Colour::faint, Style::line, 2});
    }
    if (goal.has_band())
        for (const auto& edge : {goal.lower, goal.upper})
            plot.series.push_back({&edge == &goal.lower ? "band" : "", shown.unit.factor * goal.x, edge,
                                   Colour::faint, Style::line, 1});
    plot.series.push_back({"target", shown.unit.factor * goal.x, goal.y, Colour::text, Style::points, 2});
    return plot;
}

Plot misfit_plot(const DesignRun& run, const std::vector<ResponseLine>& answers, std::size_t g) {
    const rough::Target& goal = run.setup.targets[g];
    const Shown shown = shown_as(goal);
    Plot plot;
    plot.alt = "How far the answer is off at each point of the target, in percent";
    plot.title = "Misfit";
    plot.x = {shown.x, false, 0, unset};
    plot.y = {"Misfit (%)"};
    plot.guides = {{0, true}};
    for (const auto& [response, label, colour, dash] : answers)
        plot.series.push_back({label, shown.unit.factor * goal.x,
                               100 / goal.weight * misfit(goal, response.curves[g]), colour,
                               Style::line_points, 1.5});
    return plot;
}

Plot scan_plot(const rough::Profile& scan) {
    const double length = scan.spacing * static_cast<double>(scan.nodes() - 1);
    const Eigen::VectorXd z = scan.heights.array() - scan.heights.maxCoeff();
    const Unit unit = length_unit(z.cwiseAbs().maxCoeff());
    Plot plot;
    plot.alt = "Heights of the measured profile";
    plot.title = "The scan";
    plot.x = {"x (mm)", false, 0, length};
    plot.y = {"Height under the highest point (" + unit.name + ")"};
    plot.series.push_back({"scan, " + std::to_string(scan.nodes()) + " points",
                           Eigen::VectorXd::LinSpaced(z.size(), 0, length), unit.factor * z, Colour::text,
                           Style::line, 1.2});
    return plot;
}

Plot profile_plot(const DesignRun& run) {
    Plot plot;
    plot.alt = "Heights of the different answers along the profile";
    plot.title = "The answers";
    plot.key += " maxcols 2";
    plot.x = {"x (mm)", false, 0, run.setup.model.grid.length};
    double largest = 0;
    std::vector<Eigen::VectorXd> all;
    for (const auto& answer : run.found.alternatives) {
        Eigen::VectorXd z = sample(answer.genome, run.setup.model.grid).heights;
        z.array() -= z.maxCoeff();
        largest = std::max(largest, z.cwiseAbs().maxCoeff());
        all.push_back(std::move(z));
    }
    const Unit unit = length_unit(largest);
    plot.y = {"Height under the highest point (" + unit.name + ")"};
    for (std::size_t i = 0; i < all.size() && i < line_colours.size(); ++i)
        plot.series.push_back(
            {"answer " + std::to_string(i + 1),
             Eigen::VectorXd::LinSpaced(
                 all[i].size(), 0, run.setup.model.grid.spacing() * static_cast<double>(all[i].size() - 1)),
             unit.factor * all[i], line_colours[i], Style::line, i == 0 ? 2 : 1.2});
    return plot;
}

void add_answer(Page& page, const DesignRun& run) {
    page.section("The answer");
    const std::vector<ResponseLine> answers = drawn_responses(run);
    for (std::size_t g = 0; g < run.setup.targets.size(); ++g)
        page.figure(
            {"goal-" + std::to_string(g + 1),
             "Figure " + std::to_string(g + 1) + ". Asked and found.",
             run.found.best.is_verified()
                 ? "Points are the target; the answer is verified by its worst similarity: on its own grid, "
                   "on "
                   "one four times finer, in four times the load steps, and both."
                 : "Points are the target. There was no time to verify the answer by its worst similarity, "
                   "over finer grids and load steps.",
             {goal_plot(run, answers, g), misfit_plot(run, answers, g)}});
    Table limits{
        "What can be made", {"Quantity", "Limit", "Of the answer", "Margin"}, {}, {false, true, true, true}};
    const auto in_words = [](const std::string& name) -> std::string {
        return name == "shortest_wave_mm" ? "shortest wave (mm)"
               : name == "height_mm"      ? "height range (mm)"
               : name == "radius_mm"      ? "smallest radius of curvature (mm)"
                                          : "largest " + name;
    };
    for (const auto& margin : run.margins)
        limits.rows.push_back({in_words(margin.name), margin.limit > 0 ? readable(margin.limit) : "none",
                               readable(margin.value), margin.limit > 0 ? percent(margin.margin()) : "–"});
    page.table(limits);
}

void add_change(Page& page, const rough::Morphed& morphed, const rough::Genome& genome) {
    page.section("The change");
    Table table{"",
                {"Chromosome", "Wave length (mm)", "Phase before (rad)", "after", "Change", "Limit"},
                {},
                {false, true, true, true, true, false}};
    for (const rough::PhaseChange& change : morphed.changes)
        table.rows.push_back({std::to_string(change.place.series + 1) + ":" + std::to_string(change.n),
                              readable(rough::wave_length(genome.series[change.place.series], change.n)),
                              readable(change.before, 5), readable(change.after, 5),
                              readable(change.after - change.before), change.at_limit ? "reached" : ""});
    page.table(table);
}

Plot front_plot(const DesignRun& run) {
    const auto& front = run.found.front;
    const auto column = [&](auto member, std::size_t goal) {
        Eigen::VectorXd values(static_cast<rough::Index>(front.size()));
        for (std::size_t i = 0; i < front.size(); ++i)
            values[static_cast<rough::Index>(i)] = (front[i].*member)[goal];
        return values;
    };
    Plot plot;
    plot.alt = "Similarity to the second target against that to the first, of the genomes that no other is "
               "better than in both";
    plot.x = {"Similarity to " + run.setup.targets[0].name};
    plot.y = {"Similarity to " + run.setup.targets[1].name};
    plot.series = {{"front", column(&rough::Compromise::similarity, 0),
                    column(&rough::Compromise::similarity, 1), Colour::blue, Style::line_points, 2},
                   {"on a grid four times finer", column(&rough::Compromise::similarity_refined, 0),
                    column(&rough::Compromise::similarity_refined, 1), Colour::orange, Style::points, 1.5}};
    return plot;
}

void add_front(Page& page, const DesignRun& run) {
    page.section("What the targets cost each other");
    page.prose("Of the genomes found these " + std::to_string(run.found.front.size()) +
               " are left than which no other is better in every target; the answer above is the one whose "
               "worst similarity is best.");
    page.figure(
        {"front",
         "The front.",
         Html::raw("Each point is a genome, all of which are in result.json under <code>front</code>."),
         {front_plot(run)}});
}

void add_alternatives(Page& page, const DesignRun& run) {
    page.section("Different answers");
    page.prose("How much two profiles differ is 1 less the correlation coefficient of their heights, the "
               "better one of as they are and one of them mirrored; answers that differ by " +
               readable(rough::different) + " or more are listed.");
    Figure surfaces{"profiles",
                    "Figure " + std::to_string(run.setup.targets.size() + 1) + ". The surfaces.",
                    "Heights under the highest point of each.",
                    {}};
    if (run.setup.model.grid.is_2d()) {
        surfaces.caption = "Heights, and where the first answer touches at the end of the load.";
        for (std::size_t i = 0; i < run.found.alternatives.size() && i < line_colours.size(); ++i)
            surfaces.panels.push_back(heights_plot(
                run.setup.model.grid, sample(run.found.alternatives[i].genome, run.setup.model.grid).heights,
                "Answer " + std::to_string(i + 1)));
        if (run.trust)
            surfaces.panels.insert(
                surfaces.panels.begin() + 1,
                pressure_plot(run.setup.model.grid, run.trust->last, "Where it touches at the last load"));
    } else {
        surfaces.panels.push_back(profile_plot(run));
    }
    if (run.setup.like) {
        surfaces.caption = "The surface that was measured, and those that answer a load as it does.";
        surfaces.panels.insert(surfaces.panels.begin(),
                               run.setup.like->is_2d()
                                   ? heights_plot(run.setup.model.grid, run.setup.like->heights, "The map")
                                   : scan_plot(*run.setup.like));
    }
    page.figure(surfaces);
    Table table{"",
                {"Answer", "At worst", "Similarity", "On the finer grid", "Difference from those before"},
                {},
                {false, true, true, true, true}};
    for (std::size_t i = 0; i < run.found.alternatives.size(); ++i) {
        const auto& answer = run.found.alternatives[i];
        table.rows.push_back({std::to_string(i + 1), readable(answer.lowest(), 5),
                              readable(answer.similarity, 5), readable(answer.similarity_refined, 5),
                              i == 0 ? "–" : readable(answer.difference)});
    }
    page.table(table);
}

void add_trust(Page& page, const rough::Trust& trust) {
    page.section("How far to trust it");
    if (!trust.checks.empty()) {
        Table checks{"The same asked again", {"Under", "Similarity"}, {}, {false, true}};
        for (const auto& check : trust.checks)
            checks.rows.push_back({check.name, readable(check.similarity, 5)});
        checks.rows.push_back({"median", readable(trust.median, 5)});
        checks.rows.push_back({"tenth percentile", readable(trust.tenth, 5)});
        page.table(checks);
    }
    Table kernels{"On other bodies, for comparison", {"Kernel", "Similarity"}, {}, {false, true}};
    for (const auto& check : trust.kernels)
        kernels.rows.push_back({check.name, readable(check.similarity, 4)});
    if (!trust.kernels.empty())
        page.table(kernels);
    if (trust.redrawn > 0)
        page.prose("With its phases drawn anew, " + std::to_string(trust.redrawn) +
                   " times, the same spectrum gives similarity " + readable(trust.redrawn_median) +
                   " in the median, " + readable(trust.redrawn_tenth) + " in the tenth percentile and " +
                   readable(trust.redrawn_best) +
                   " at best: what is missing to the answer's own is the work of its phases.");
    if (!trust.left_out.empty()) {
        std::string all;
        for (const auto& name : trust.left_out)
            all += (all.empty() ? "" : "; ") + name;
        page.prose("There was no time for: " + all + ".");
    }
    if (trust.flags.empty())
        page.prose("Nothing strains the model: rms slope " + readable(trust.rms_slope) + ", shortest wave " +
                   readable(trust.shortest_wave_nodes) + " nodes.");
    for (const auto& flag : trust.flags)
        page.prose(Html::raw("<strong>Note:</strong> ") + flag + ".");
}

} // namespace

std::string design_page(const DesignRun& run, double seconds) {
    Page page("A surface by design", run.summary.verdict);
    Table box{run.summary.found ? "Found" : "Not found", {"What", "Of the answer"}, {}, {}, true};
    for (const Fact& fact : run.summary.facts)
        box.rows.push_back({fact.name, fact.text});
    page.table(box);
    for (const auto& reason : run.out_of_reach)
        page.prose(Html::raw("<strong>Out of reach:</strong> ") + reason.reason + ". No profile " +
                   (reason.on_this_grid ? "on this grid " : "") + "has a similarity above " +
                   readable(reason.bound, 4) + ".");
    add_answer(page, run);
    if (!run.found.front.empty())
        add_front(page, run);
    if (run.morphed)
        add_change(page, *run.morphed, run.from->genome);
    add_alternatives(page, run);
    if (run.trust)
        add_trust(page, *run.trust);
    else
        page.prose("There was no time to verify the answer; expected more --seconds for it.");
    page.section("How it was found");
    for (const auto& account : run.accounts)
        page.prose(account + ".");
    page.code(run.origin.command);
    const rough::Model& model = run.setup.model;
    page.prose("Seed " + std::to_string(run.origin.seed) + "; " + name_of(model.body.kernel) +
               " body, E* = " + readable(model.body.effective_modulus) + " MPa" +
               (model.body.kernel == rough::Kernel::free && !model.grid.is_2d()
                    ? ", datum " + readable(model.body.datum) + " mm"
                    : "") +
               "; " + std::to_string(model.grid.nodes) +
               (model.grid.is_2d() ? " x " + std::to_string(model.grid.rows) : "") + " nodes on " +
               (model.grid.is_2d() ? brief(model.grid.length, 6) + " x " + brief(model.grid.width, 6)
                                   : readable(model.grid.length, 6)) +
               " mm; " + std::to_string(model.loading.steps) + " load steps; rugosa " + run.origin.version +
               ". The search:");
    page.code(run.found.pipeline);
    page.prose(std::to_string(run.found.counters.evaluations) + " curves and " +
               std::to_string(run.found.counters.gradients) + " gradients in " + readable(run.seconds) +
               " s.");
    if (!run.found.stopped.empty())
        page.prose("The search ended early: " + run.found.stopped + ".");
    for (const auto& note : run.found.notes)
        page.prose(note);
    return page.html(seconds);
}

} // namespace app
