#include "apps/experiments/experiment.hpp"

#include "apps/cluster/evaluator.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/targets.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/text/json.hpp"

namespace app {

namespace {

using nlohmann::json;

/// A moment of a search with its best similarity so far.
struct Spent {
    double evaluations; ///< curves and gradients
    double seconds;     ///< from the start of the search
    double similarity;
};

struct RaceRun : VariantRun {
    std::uint64_t seed = 0;
    std::vector<Spent> history;   ///< after each stage
    double last_displacement = 0; ///< mm, at the answer's last load step
    long crossed = 0, better = 0; ///< children of two scored parents; children better than both
};

struct RaceVariant {
    std::string name;
    std::vector<RaceRun> runs; ///< one per seed

    double median_lowest() const { return rough::median(rough::column(runs, &RaceRun::similarity_worst)); }
    /// The run whose verified similarity is the median, or the next below.
    const RaceRun& median_run() const {
        const auto order = ga::in_order(runs.size(), [&](std::size_t a, std::size_t b) {
            return runs[a].similarity_worst < runs[b].similarity_worst;
        });
        return runs[order[(runs.size() - 1) / 2]];
    }
    /// Median over the runs of the best similarity up to this moment; -1 if a run had none yet.
    double median_at(double Spent::*axis, double spent) const {
        return rough::median(rough::column(runs, [&](const RaceRun& run) {
            double best = -1;
            for (const Spent& one : run.history)
                if (one.*axis <= spent)
                    best = one.similarity;
            return best;
        }));
    }
};

struct RaceTarget {
    rough::DesignSetup setup;
    std::vector<RaceVariant> variants; ///< with at least one finished run

    const std::string& name() const { return setup.targets[0].name; }
    bool is_2d() const { return setup.model.grid.is_2d(); }
    /// The variants by falling similarity.
    std::vector<const RaceVariant*> ranked() const {
        std::vector<const RaceVariant*> order;
        for (const RaceVariant& variant : variants)
            order.push_back(&variant);
        std::ranges::stable_sort(order, std::greater<>(), &RaceVariant::median_lowest);
        return order;
    }
};

/// Every target on every grid of model.nodes. A name is the target's, with the grid from the second on.
std::vector<RaceTarget> targets_from(const Settings& settings) {
    std::vector<std::string> grids = rough::listed(settings.text("model.nodes"));
    if (grids.empty())
        grids.emplace_back();
    std::vector<RaceTarget> targets;
    for (const std::string& nodes : grids)
        for (const std::filesystem::path& path : target_files(settings, "targets.files")) {
            RaceTarget target{
                .setup = {.model = surface_model_from(
                              settings.with({{"model.nodes", nodes}}, model_settings("model.")), "model."),
                          .targets = {rough::read_target(path)}}};
            settings.take("model.accuracy", target.setup.model.accuracy);
            settings.take("database.ridges", target.setup.ridges);
            target.setup.targets[0].name = path.stem().string() + (nodes == grids[0] ? "" : "-" + nodes);
            settings.take("targets.max-pressure", target.setup.max_pressure);
            settings.take("targets.shortest-wave", target.setup.limits.shortest_wave);
            placing(settings, "targets.", [&] { validate(target.setup); });
            targets.push_back(std::move(target));
        }
    // Names of targets are those of folders and of rows.
    const std::vector<std::string>& files = experiment_named("variants").files;
    std::set<std::string> names(files.begin(), files.end());
    names.insert({"", ".", "..", "result.json", "report.html"});
    for (const RaceTarget& target : targets)
        if (!names.insert(target.name()).second)
            settings.refuse("targets.files", "'", target.name(),
                            "' is given as a name twice or used by the run; choose another name");
    return targets;
}

RaceRun run_once(const RaceTarget& target, const std::string& name, const rough::SearchOptions& options) {
    static const ga::Name similarity("similarity");
    RaceRun run;
    std::vector<StageRecord> stages;
    double best = -HUGE_VAL;
    std::map<ga::Identity, double> known; // similarities so far
    const auto watch = [&](const ga::Event<rough::Genome>& event) {
        for (const auto& individual : event.population) {
            if (!individual.fitness.known(similarity) || individual.fitness.has_failed())
                continue;
            const double value = individual.fitness.value();
            best = std::max(best, value);
            const bool is_new = known.insert_or_assign(individual.identity, value).second;
            if (!is_new || individual.parents.size() != 2)
                continue;
            const auto first = known.find(*individual.parents.begin()),
                       second = known.find(*std::next(individual.parents.begin()));
            if (first != known.end() && second != known.end()) {
                ++run.crossed;
                run.better += value > std::max(first->second, second->second);
            }
        }
        if (std::isfinite(best))
            run.history.push_back({static_cast<double>(event.counters.requested), event.seconds, best});
    };
    const ga::Stopwatch clock;
    const rough::SearchResult found = rough::search(target.setup, options, {recorder(stages), watch});
    static_cast<VariantRun&>(run) = variant_run(name, found, std::move(stages), clock.seconds());
    run.seed = options.seed;
    run.last_displacement =
        design_response(target.setup, found.best.on_grid).responses.front().displacement.tail(1)[0];
    run.history.push_back(
        {static_cast<double>(found.counters.requested), run.seconds, std::max(best, run.similarity)});
    return run;
}

/// result.json of one target.
json result_of(const RaceTarget& target, const Origin& origin, long budget) {
    std::vector<VariantRun> runs;
    for (const RaceVariant& variant : target.variants)
        runs.push_back(variant.median_run());
    json result = result_json(origin, target.setup, runs);
    result["budget"] = budget;
    for (const RaceVariant& variant : target.variants) {
        json& one = result["variants"][variant.name];
        one["median_lowest"] = variant.median_lowest();
        for (const RaceRun& race_run : variant.runs) {
            one["runs"].push_back(static_cast<const VariantRun&>(race_run));
            one["runs"].back().update({{"seed", race_run.seed},
                                       {"crossed", race_run.crossed},
                                       {"better_than_parents", race_run.better}});
        }
    }
    return result;
}

std::vector<Setting> variants_settings() {
    const std::vector<Setting> settings{
        ga::whole("experiment.seeds", "3", 1, "runs of each pipeline").up_to(1000),
        ga::whole("experiment.budget", "3000", 1, "maximum number of curves and gradients of a run")
            .up_to(1e9),
        {"targets.files", "", "target curves (CSV), separated by commas"},
        max_pressure_setting("targets."),
        positive("targets.shortest-wave", "", "shortest wave, mm [8 node spacings]"),
        ga::whole("database.ridges", "", 1, "ridges of each chromosome [1; on a map 8 directions]").up_to(64),
        {"variants.*", "", "a named variant or a pipeline as text"},
    };
    std::vector<Setting> model = model_settings("model.");
    for (Setting& setting : model)
        if (setting.name == "model.nodes") // several grids, separated by commas
            setting.takes = ga::word_list({}, {});
    return joined({settings, model, {accuracy_setting("model.")}});
}

/// Runs each pipeline from each seed on each target.
std::vector<RaceTarget> raced(const Settings& settings, const Conditions& conditions, long budget) {
    std::vector<RaceTarget> targets = targets_from(settings);
    const long seeds = settings.whole("experiment.seeds");
    const auto evaluator = design_evaluator(conditions.origin.threads);
    const auto pipelines = settings.texts_under("variants.");
    const auto placed = [&](const std::string& name, auto work) {
        return read_at(settings, "variants." + name, work);
    };
    for (const RaceTarget& target : targets) // before any is run
        for (const auto& [name, pipeline] : pipelines)
            placed(name, [&, &pipeline = pipeline] { rough::expect_searchable(target.setup, pipeline); });
    for (RaceTarget& target : targets) {
        rough::SearchOptions options;
        options.threads = conditions.origin.threads;
        options.evaluator = evaluator.get();
        options.evaluations = budget;
        options.stop = &conditions.stop;
        if (target.is_2d()) {
            options.memory = std::make_shared<rough::ResponseMemory>(); // one database for all pipelines
            options.alternatives = 1;
        }
        for (const auto& [name, pipeline] : pipelines) {
            RaceVariant variant{name, {}};
            options.pipeline = pipeline;
            for (long i = 0; i < seeds && !conditions.stop; ++i) {
                conditions.progress.show(target.name() + ": " + name + ", run " + std::to_string(i + 1) +
                                         " of " + std::to_string(seeds));
                options.seed = conditions.origin.seed + static_cast<std::uint64_t>(i);
                RaceRun run = placed(name, [&, &name = name] { return run_once(target, name, options); });
                if (!std::isnan(run.similarity_worst)) // a map's may be stopped before it is verified
                    variant.runs.push_back(std::move(run));
            }
            if (!variant.runs.empty())
                target.variants.push_back(std::move(variant));
        }
    }
    return targets;
}

/// 1 less the best similarity so far, median over the seeds, against evaluations and seconds.
void add_shortfall(Findings& found, const RaceTarget& target, long budget) {
    constexpr int points = 60;
    Csv& table = found.table("shortfall.csv", "target,variant,axis,spent,shortfall", 6);
    double longest = 0.1;
    for (const RaceVariant& variant : target.variants)
        for (const RaceRun& run : variant.runs)
            longest = std::max(longest, run.seconds);
    for (const RaceVariant& variant : target.variants)
        for (const auto& [name, axis, from, to] :
             {std::tuple("evaluations", &Spent::evaluations, 10.0, static_cast<double>(budget)),
              {"seconds", &Spent::seconds, 0.02, longest}})
            for (int k = 0; k < points; ++k) {
                const double spent = from * std::pow(to / from, k / (points - 1.0));
                const double similarity =
                    variant.median_at(axis, axis == &Spent::evaluations ? std::trunc(spent) : spent);
                if (similarity > -1)
                    table.row(target.name(), variant.name, name, spent, std::max(1e-5, 1 - similarity));
            }
}

/// Medians at the end of each variant's runs.
void add_ends(Findings& found, const RaceTarget& target) {
    Csv& table = found.table("ended.csv", "target,surface,variant,similarity,seconds,curves,gradients,"
                                          "children_of_two,better_than_both");
    for (const RaceVariant* variant : target.ranked()) {
        const RaceRun& run = variant->median_run();
        long crossed = 0, better = 0;
        for (const RaceRun& each : variant->runs)
            crossed += each.crossed, better += each.better;
        table.row(target.name(), target.is_2d() ? "map" : "profile", variant->name, variant->median_lowest(),
                  run.seconds, run.curves, run.gradients, crossed,
                  crossed > 0 ? std::optional(static_cast<double>(better) / static_cast<double>(crossed))
                              : std::nullopt);
    }
}

/// Heights and last contact pressure of the best variant's median run on a map, on at most 128 x 128 nodes.
void add_surface(Findings& found, const RaceTarget& target) {
    Csv& table = found.table("surfaces.csv", "target,x_mm,y_mm,height_mm,pressure_MPa", 6);
    const rough::Model& model = target.setup.model;
    const rough::Grid& grid = model.grid;
    if (!grid.is_2d() || target.variants.empty())
        return;
    const RaceRun& best = target.ranked().front()->median_run();
    const rough::Profile surface = sample(best.answer.genome, grid);
    rough::ContactOptions options = model.contact;
    options.states = true;
    const auto state = solve_contact(surface, model.body, {best.last_displacement}, options).states[0];
    Eigen::VectorXd pressure = Eigen::VectorXd::Zero(surface.nodes());
    pressure(state.nodes) = state.pressure;
    const rough::Index every = 1 + (std::max(grid.nodes, grid.rows) - 1) / 128;
    for (rough::Index j = 0; j < grid.rows; j += every)
        for (rough::Index i = 0; i < grid.nodes; i += every)
            table.row(target.name(), static_cast<double>(i) * grid.spacing(),
                      static_cast<double>(j) * grid.row_spacing(), surface.heights[j * grid.nodes + i],
                      pressure[j * grid.nodes + i]);
}

Findings run_variants(const Settings& settings, const Conditions& conditions) {
    const long budget = settings.whole("experiment.budget");
    const std::vector<RaceTarget> targets = raced(settings, conditions, budget);
    Findings found{.result = result_of(targets.front(), conditions.origin, budget)};
    Csv& table = found.table("variants.csv", "target,variant,seed,curves_and_gradients,seconds,similarity");
    for (const RaceTarget& target : targets) {
        if (&target != &targets.front())
            found.files[target.name() + "/result.json"] =
                rough::json_text(result_of(target, conditions.origin, budget)) + "\n";
        json grid_json = model_json(target.setup.model); // for the page's sentence on the grid
        grid_json.update(
            {{"name", target.name()}, {"is_2d", target.is_2d()}, {"ridges", target.setup.ridges}});
        found.result["targets"].push_back(std::move(grid_json));
        for (const RaceVariant& variant : target.variants)
            for (const RaceRun& run : variant.runs)
                for (const Spent& spent : run.history)
                    table.row(target.name(), variant.name, run.seed, spent.evaluations, spent.seconds,
                              spent.similarity);
        add_shortfall(found, target, budget);
        add_ends(found, target);
        add_surface(found, target);
    }
    return found;
}

} // namespace

Experiment variants_experiment() {
    return {.kind = "variants",
            .settings = variants_settings(),
            .files = {"variants.csv", "shortfall.csv", "ended.csv", "surfaces.csv"},
            .run = run_variants};
}

} // namespace app
