#include "apps/experiments/experiment.hpp"

#include "apps/cluster/evaluator.hpp"
#include "apps/experiments/variants/run.hpp"
#include "apps/prompt/goals.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/record.hpp"
#include "apps/report/result.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/setup.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/words.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace app {

namespace {

using nlohmann::json;

/// Every target on every grid of model.nodes; those of the first grid are called by the target alone.
std::vector<RaceTarget> targets_from(const Settings& settings) {
    std::vector<std::string> grids = rough::listed(settings.text("model.nodes"));
    if (grids.empty())
        grids.emplace_back();
    std::vector<RaceTarget> targets;
    for (const std::string& nodes : grids)
        for (const std::filesystem::path& path : target_files(settings, "targets.files")) {
            RaceTarget target;
            target.setup.model = surface_model_from(settings.with({{"model.nodes", nodes}}), "model.");
            target.setup.model.accuracy = accuracy_from(settings, "model.");
            if (settings.has("database.ridges"))
                target.setup.ridges = static_cast<int>(settings.whole("database.ridges", 1, 64));
            target.setup.targets = {rough::read_target(path)};
            target.setup.targets[0].name = path.stem().string() + (nodes == grids[0] ? "" : "-" + nodes);
            if (settings.has("targets.max-pressure"))
                target.setup.max_pressure = settings.pressure("targets.max-pressure");
            if (settings.has("targets.shortest-wave"))
                target.setup.limits.shortest_wave = settings.positive("targets.shortest-wave");
            target.setup = placing(settings, "targets.", [&] { return completed(target.setup); });
            targets.push_back(std::move(target));
        }
    std::vector<std::string> names;
    for (const RaceTarget& target : targets)
        names.push_back(target.setup.targets[0].name);
    expect_distinct(
        names, {"result.json", "variants.csv", "shortfall.csv", "ended.csv", "surfaces.csv", "report.html"},
        settings.place("targets.files"));
    return targets;
}

/// An individual's similarity, where it was found.
std::optional<double> similarity_of(const ga::Individual<rough::Genome>& individual) {
    static const ga::Name similarity("similarity");
    const ga::Fitness& fitness = individual.fitness;
    return fitness.known(similarity) && !fitness.has_failed() ? std::optional(fitness.value()) : std::nullopt;
}

/// Counts children of two parents whose similarity is known, and how many are better than both, as they come.
class ParentsWatch {
  public:
    explicit ParentsWatch(RaceRun& run) : run_(run) {}

    void operator()(const ga::Event<rough::Genome>& event) {
        for (const auto& individual : event.population) {
            const auto similarity = similarity_of(individual);
            if (!similarity)
                continue;
            const bool fresh = similarity_.emplace(individual.identity, *similarity).second;
            if (fresh && individual.parents.size() == 2) {
                const auto first = similarity_.find(*individual.parents.begin()),
                           second = similarity_.find(*(individual.parents.begin() + 1));
                if (first != similarity_.end() && second != similarity_.end()) {
                    ++run_.crossed;
                    run_.better += *similarity > std::max(first->second, second->second);
                }
            }
            similarity_[individual.identity] = *similarity;
        }
    }

  private:
    RaceRun& run_;
    std::map<ga::Identity, double> similarity_;
};

RaceRun run_once(const RaceTarget& target, const std::string& name, const rough::SearchOptions& options) {
    RaceRun run{options.seed, {}, {}, 0};
    std::vector<StageRecord> stages;
    double best = -HUGE_VAL;
    ParentsWatch parents(run);
    const auto watch = [&](const ga::Event<rough::Genome>& event) {
        for (const auto& individual : event.population)
            best = std::max(best, similarity_of(individual).value_or(-HUGE_VAL));
        if (std::isfinite(best))
            run.history.push_back({event.counters.asked, event.seconds, best});
        parents(event);
    };
    const ga::Stopwatch clock;
    const rough::SearchResult found = rough::search(target.setup, options, {recorder(stages), watch});
    run.run = variant_run(name, found, std::move(stages), clock.seconds());
    run.last_displacement =
        scored(found.setup, found.best.verification.on_own).responses.front().displacement.tail(1)[0];
    run.history.push_back({found.counters.asked, run.run.seconds, std::max(best, run.run.similarity)});
    return run;
}

template <class Reached>
double median_when(const RaceVariant& variant, Reached reached) {
    std::vector<double> values;
    for (const RaceRun& run : variant.runs) {
        double best = NAN;
        for (const Spent& spent : run.history)
            if (reached(spent))
                best = spent.similarity;
        values.push_back(std::isnan(best) ? -1 : best);
    }
    return rough::median(values);
}

json race_json(const Race& race, const RaceTarget& target) {
    const rough::DesignSetup& setup = target.setup;
    Record record{race.origin,        setup.model,           loaded_models(setup),
                  setup.max_pressure, setup.targets.front(), {}};
    for (const RaceVariant& variant : target.variants)
        if (!variant.runs.empty())
            record.variants.push_back(variant.median_run().run);
    json result = result_json(record);
    result["budget"] = race.budget;
    for (const RaceVariant& variant : target.variants) {
        if (variant.runs.empty())
            continue;
        json& one = result["variants"][variant.name];
        one["median_lowest"] = variant.median_lowest();
        for (const RaceRun& race_run : variant.runs) {
            const VariantRun& run = race_run.run;
            one["runs"].push_back({{"seed", race_run.seed},
                                   {"similarity", run.similarity},
                                   {"similarity_refined", run.similarity_refined},
                                   {"similarity_worst", run.similarity_worst},
                                   {"seconds", run.seconds},
                                   {"curves", run.curves},
                                   {"gradients", run.gradients},
                                   {"crossed", race_run.crossed},
                                   {"better_than_parents", race_run.better}});
        }
    }
    return result;
}

} // namespace

double RaceVariant::median_lowest() const {
    return rough::median(rough::column(runs, [](const RaceRun& one) { return one.run.lowest(); }));
}

const RaceRun& RaceVariant::median_run() const {
    std::vector<const RaceRun*> order;
    for (const RaceRun& one : runs)
        order.push_back(&one);
    std::stable_sort(order.begin(), order.end(),
                     [](const RaceRun* a, const RaceRun* b) { return a->run.lowest() < b->run.lowest(); });
    return *order[(order.size() - 1) / 2];
}

double RaceVariant::median_at(long asked) const {
    return median_when(*this, [&](const Spent& spent) { return spent.asked <= asked; });
}

double RaceVariant::median_at_seconds(double seconds) const {
    return median_when(*this, [&](const Spent& spent) { return spent.seconds <= seconds; });
}

namespace {

std::vector<Setting> variants_settings() {
    const std::vector<Setting> settings{
        {"experiment.seeds", "3", "runs of each way"},
        {"experiment.budget", "3000", "curves and gradients each run may ask for"},
        {"targets.files", "", "target curves (CSV), with commas between"},
        {"targets.max-pressure", "", "p_max of Eq. 11, MPa [amplitude is a gene]"},
        {"targets.shortest-wave", "", "shortest wave, mm [8 node distances]"},
        {"database.ridges", "", "ridges of each chromosome [1; an area, their directions: 8]"},
        {"variants.*", "", "a way to search: a named variant or a pipeline as text"},
    };
    return joined({settings, model_settings("model."), {accuracy_setting("model.")}});
}

Race raced(const Settings& settings, const Conditions& conditions) {
    Race race;
    race.targets = targets_from(settings);
    race.origin = conditions.origin;
    race.budget = settings.whole("experiment.budget", 1, 1000000000);
    const long seeds = settings.whole("experiment.seeds", 1, 1000);
    const auto evaluator = design_evaluator(race.origin.threads);
    const auto ways = settings.texts_under("variants.");
    for (const RaceTarget& target : race.targets) // before any is run
        for (const auto& [name, way] : ways)
            read_at(settings, "variants." + name,
                    [&, &way = way] { rough::expect_searchable(target.setup, way); });
    for (RaceTarget& target : race.targets) {
        const bool area = target.setup.model.grid.is_2d();
        const auto memory = area ? std::make_shared<rough::ResponseMemory>() : nullptr;
        for (const auto& [name, way] : ways) {
            RaceVariant variant{name, way, {}};
            for (long i = 0; i < seeds && !conditions.stop; ++i) {
                conditions.progress.show(target.setup.targets[0].name + ": " + name + ", run " +
                                         std::to_string(i + 1) + " of " + std::to_string(seeds));
                rough::SearchOptions options;
                options.pipeline = way;
                options.seed = race.origin.seed + static_cast<std::uint64_t>(i);
                options.threads = race.origin.threads;
                options.evaluator = evaluator.get();
                options.evaluations = race.budget;
                options.stop = &conditions.stop;
                options.memory = memory; // an area's database is pressed once for all ways
                if (area)
                    options.alternatives = 1;
                RaceRun run = read_at(settings, "variants." + name,
                                      [&, &name = name] { return run_once(target, name, options); });
                if (!std::isnan(run.run.lowest())) // an area's may be stopped before it is verified
                    variant.runs.push_back(std::move(run));
            }
            target.variants.push_back(std::move(variant));
        }
    }
    return race;
}

/// 1 less the best similarity so far, in the median over the seeds, against what was spent.
Csv shortfall_table(const Race& race) {
    constexpr int points = 60;
    Csv table("target,variant,axis,spent,shortfall", 6);
    for (const RaceTarget& target : race.targets) {
        double longest = 0.1;
        for (const auto& variant : target.variants)
            for (const auto& run : variant.runs)
                longest = std::max(longest, run.run.seconds);
        for (const auto& variant : target.variants)
            for (const auto& [axis, from, to] :
                 {std::tuple("evaluations", 10.0, static_cast<double>(race.budget)),
                  std::tuple("seconds", 0.02, longest)})
                for (int k = 0; k < points && !variant.runs.empty(); ++k) {
                    const double spent = from * std::pow(to / from, k / (points - 1.0));
                    const double similarity = axis[0] == 'e' ? variant.median_at(static_cast<long>(spent))
                                                             : variant.median_at_seconds(spent);
                    if (similarity > -1)
                        table.row(target.setup.targets[0].name, variant.name, axis, spent,
                                  std::max(1e-5, 1 - similarity));
                }
    }
    return table;
}

/// Variants that ran, the highest similarity first.
std::vector<const RaceVariant*> ranked(const RaceTarget& target) {
    std::vector<const RaceVariant*> order;
    for (const auto& variant : target.variants)
        if (!variant.runs.empty())
            order.push_back(&variant);
    std::stable_sort(order.begin(), order.end(), [](const RaceVariant* a, const RaceVariant* b) {
        return a->median_lowest() > b->median_lowest();
    });
    return order;
}

/// Medians at the end of each variant's runs.
Csv ended_table(const Race& race) {
    Csv table("target,surface,variant,similarity,seconds,curves,gradients,children_of_two,better_than_both");
    for (const RaceTarget& target : race.targets)
        for (const RaceVariant* variant : ranked(target)) {
            const VariantRun& run = variant->median_run().run;
            long crossed = 0, better = 0;
            for (const auto& each : variant->runs)
                crossed += each.crossed, better += each.better;
            table.row(target.setup.targets[0].name, target.setup.model.grid.is_2d() ? "map" : "profile",
                      variant->name, variant->median_lowest(), run.seconds, run.curves, run.gradients,
                      crossed,
                      crossed > 0 ? std::optional(static_cast<double>(better) / static_cast<double>(crossed))
                                  : std::nullopt);
        }
    return table;
}

/// Heights and last contact pressure of the best variant's median run on each map, on at most 128 x 128
/// nodes.
Csv surfaces_table(const Race& race) {
    Csv table("target,x_mm,y_mm,height_mm,pressure_MPa", 6);
    for (const RaceTarget& target : race.targets) {
        const rough::Model& model = target.setup.model;
        const rough::Grid& grid = model.grid;
        const auto order = ranked(target);
        if (!grid.is_2d() || order.empty())
            continue;
        const RaceRun& best = order.front()->median_run();
        const rough::Profile surface = sample(best.run.answer.genome, grid);
        rough::ContactOptions options = model.contact;
        options.states = true;
        const auto state = solve_contact(surface, model.body, {best.last_displacement}, options).states[0];
        Eigen::VectorXd pressure = Eigen::VectorXd::Zero(surface.nodes());
        for (std::size_t i = 0; i < state.nodes.size(); ++i)
            pressure[state.nodes[i]] = state.pressure[static_cast<rough::Index>(i)];
        const rough::Index every = 1 + (std::max(grid.nodes, grid.rows) - 1) / 128;
        for (rough::Index j = 0; j < grid.rows; j += every)
            for (rough::Index i = 0; i < grid.nodes; i += every)
                table.row(target.setup.targets[0].name, static_cast<double>(i) * grid.spacing(),
                          static_cast<double>(j) * grid.row_spacing(), surface.heights[j * grid.nodes + i],
                          pressure[j * grid.nodes + i]);
    }
    return table;
}

/// What the page says of a target's grid.
json told(const RaceTarget& target) {
    json result = model_json(target.setup.model);
    result["name"] = target.setup.targets[0].name;
    result["is_2d"] = target.setup.model.grid.is_2d();
    result["ridges"] = target.setup.ridges;
    return result;
}

/// result.json (a further target's in a folder of its name) and the tables.
void write_race(const Race& race, const std::filesystem::path& folder) {
    Csv table("target,variant,seed,curves_and_gradients,seconds,similarity");
    for (const RaceTarget& target : race.targets) {
        const bool first = &target == &race.targets.front();
        const auto place = first ? folder : subfolder(folder, target.setup.targets[0].name);
        json result = race_json(race, target);
        for (const RaceTarget& one : race.targets)
            if (first)
                result["targets"].push_back(told(one));
        write_json(place / "result.json", result);
        for (const RaceVariant& variant : target.variants)
            for (const RaceRun& run : variant.runs)
                for (const Spent& spent : run.history)
                    table.row(target.setup.targets[0].name, variant.name, run.seed, spent.asked,
                              spent.seconds, spent.similarity);
    }
    for (const auto& [name, text] : {std::pair("variants.csv", table.text()),
                                     {"shortfall.csv", shortfall_table(race).text()},
                                     {"ended.csv", ended_table(race).text()},
                                     {"surfaces.csv", surfaces_table(race).text()}})
        rough::write_atomically(folder / name, text);
}

Findings run_variants(const Settings& settings, const Conditions& conditions) {
    const auto race = std::make_shared<Race>(raced(settings, conditions));
    return {[race, folder = conditions.folder] { write_race(*race, folder); }};
}

} // namespace

Experiment variants_experiment() {
    return {.kind = "variants",
            .summary = "ways to search, on the same targets with the same budget and seeds",
            .settings = variants_settings(),
            .files = {"variants.csv", "shortfall.csv", "ended.csv", "surfaces.csv"},
            .run = run_variants};
}

} // namespace app
