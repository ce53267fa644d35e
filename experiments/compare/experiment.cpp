#include "apps/prompt/model_settings.hpp"
#include "domain/problem/stored.hpp"
#include "experiments/compare/contest.hpp"

namespace app {
namespace {

using nlohmann::json;

constexpr const char* usual_problems = "bbob5, bbob20, zdt, dtlz, knapsack, tsp";
constexpr const char* quick_problems =
    "bbob5-1, bbob5-3, bbob5-8, bbob5-10, bbob5-15, bbob5-21, zdt1, knapsack50, tsp14";

std::vector<Setting> compare_settings() {
    std::vector<Setting> settings{
        {"compare.problems", "", std::string("separated by commas [") + usual_problems + "]"},
        {"compare.variants", "",
         "NAME=PIPELINE or names of usual variants, separated by commas, for every problem [sections real, "
         "fronts, constrained, bits, tours and surfaces of the file, or the usual variants]"},
        ga::whole("compare.seeds", "", 1, "runs of each variant on each problem [15]").up_to(1000),
        {"compare.budget", "", "evaluations of a run: 20000, or 1e4*D of a genome of D genes [1e4*D]"},
        ga::whole("compare.curves", "1000", 1,
                  "budget of a run on roughness: the price of its curves and gradients, in curves of the "
                  "search grid")
            .up_to(1e9),
        {"compare.target", "", "target curves (CSV) of roughness, separated by commas"},
        max_pressure_setting("compare."),
        positive("compare.shortest-wave", "", "shortest wave on roughness, mm [8 node spacings]"),
        ga::whole("compare.ridges", "", 1, "ridges of each chromosome on roughness [1; on a map 8 directions]")
            .up_to(64),
        {"compare.coco", "", "write the runs on BBOB's functions to coco/, for cocopp and IOHanalyzer", true},
        {"compare.quick", "", "few problems, 5 seeds and 1e3*D evaluations, unless these are given", true}};
    for (const auto& [kind, usual] : usual_contestants())
        settings.push_back({kind + ".*", "", "a variant on problems of this kind of genome"});
    std::vector<Setting> model = model_settings("model.");
    for (Setting& setting : model)
        if (setting.name == "model.nodes") // several grids, separated by commas
            setting.takes = ga::word_list({}, {});
    return joined({settings, model});
}

std::string text_of(const Settings& settings, const std::string& key, const char* usual, const char* quick) {
    return settings.has(key) ? settings.text(key) : settings.is_on("compare.quick") ? quick : usual;
}

/// The budget for a number of genes: "1e4*D" or a number.
long budget_from(const Settings& settings, const std::string& text, std::size_t genes) {
    std::string number(rough::trim(text));
    double factor = 1;
    if (number.ends_with("*D")) {
        number.resize(number.size() - 2);
        factor = static_cast<double>(genes);
    }
    const std::string place = settings.place("compare.budget");
    const double budget = rough::number_from(number, place) * factor;
    if (!(budget >= 1 && budget <= 1e12))
        rough::refuse(place, ": ", text, " is out of range (1 to 1e12 evaluations, e.g. 20000 or 1e4*D)");
    return static_cast<long>(budget);
}

/// The parts of a text between its commas; commas within brackets do not count.
std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> parts{""};
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
        if (c == ',' && depth == 0)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// The variants for problems of a kind; the name of a usual variant stands for its pipeline.
Contestants contestants_of(const Settings& settings, const std::string& kind) {
    const Contestants& usual = usual_contestants().at(kind);
    const auto meaning = [&](const std::string& text) {
        const auto found = std::ranges::find(usual, text, &Contestants::value_type::first);
        return found == usual.end() ? text : found->second;
    };
    Contestants given;
    if (settings.has("compare.variants")) {
        for (const std::string& part : split_at_commas(settings.text("compare.variants"))) {
            const std::size_t equals = part.find('=');
            std::string name(rough::trim(part.substr(0, equals)));
            std::string text(rough::trim(equals < part.size() ? part.substr(equals + 1) : part));
            if (name.find_first_of("|({ ") != std::string::npos) // the "=" of an argument
                name = text = std::string(rough::trim(part));
            if (name.empty() || text.empty())
                settings.refuse("compare.variants", "\"", part, "\" is not a variant; give NAME=PIPELINE");
            if (std::ranges::find(given, name, &Contestants::value_type::first) != given.end())
                settings.refuse("compare.variants", "'", name, "' is given twice; give it once");
            given.emplace_back(name, meaning(text));
        }
        return given;
    }
    for (const auto& [name, text] : settings.texts_under(kind + ".")) given.emplace_back(name, meaning(text));
    return given.empty() ? usual : given;
}

/// The setup of every target on every grid of model.nodes. A name is the target's, with the grid from the second on.
std::vector<rough::DesignSetup> roughness_from(const Settings& settings) {
    std::vector<std::string> grids = rough::listed(settings.text("model.nodes"));
    if (grids.empty()) grids.emplace_back();
    std::vector<rough::DesignSetup> setups;
    std::set<std::string> names;
    for (const std::string& nodes : grids)
        for (const std::filesystem::path& path : settings.paths("compare.target")) {
            rough::DesignSetup setup{.model = surface_model_from(
                                         settings.with({{"model.nodes", nodes}}, model_settings("model.")), "model."),
                                     .targets = {rough::read_target(path)}};
            settings.take("compare.ridges", setup.ridges);
            setup.targets[0].name = path.stem().string() + (nodes == grids[0] ? "" : "-" + nodes);
            settings.take("compare.max-pressure", setup.max_pressure);
            settings.take("compare.shortest-wave", setup.limits.shortest_wave);
            placing(settings, "compare.", [&] { validate(setup); });
            if (!names.insert(setup.targets[0].name).second)
                settings.refuse("compare.target", "'", setup.targets[0].name,
                                "' is given as a name twice; choose another name");
            setups.push_back(std::move(setup));
        }
    return setups;
}

Contest contest_from(const Settings& settings, const Origin& origin) {
    Contest contest;
    contest.origin = origin;
    contest.seeds = settings.is_on("compare.quick") ? 5 : 15;
    settings.take("compare.seeds", contest.seeds);
    contest.budget = text_of(settings, "compare.budget", "1e4*D", "1e3*D");
    contest.curves = settings.whole("compare.curves");
    std::vector<Benchmark> problems;
    const auto roughness = roughness_from(settings);
    try {
        problems =
            benchmarks(rough::listed(text_of(settings, "compare.problems", usual_problems, quick_problems)), roughness);
    } catch (const rough::InputError& error) {
        settings.refuse("compare.problems", error.what());
    }
    bool has_bbob = false;
    for (Benchmark& problem : problems) {
        ProblemResults results;
        results.variants = contestants_of(settings, problem.kind);
        results.budget = problem.setup ? contest.curves : budget_from(settings, contest.budget, problem.genes);
        for (const auto& [name, text] : results.variants) try {
                problem.check(text);
            } catch (const ga::UsageError& error) {
                const std::string key = problem.kind + "." + name;
                settings.refuse(settings.given(key) ? key : "compare.variants", "'", name, "' on ", problem.name, ": ",
                                error.what());
            }
        has_bbob |= problem.name.starts_with("bbob");
        results.runs.assign(results.variants.size(), std::vector<Reached>(static_cast<std::size_t>(contest.seeds)));
        results.problem = std::move(problem);
        contest.results.push_back(std::move(results));
    }
    if (settings.is_on("compare.coco") && !has_bbob)
        settings.refuse("compare.coco", "no function of BBOB; add one to --problems, e.g. bbob5");
    return contest;
}

/// The work of a rank: runs a race and returns a Reached. `setting` has the names of the problems, and the
/// setups of roughness.
cluster::Work races_under(const json& setting) {
    return [problems = benchmarks(setting.at("problems"), setting.at("roughness"))](const json& race) -> json {
        return problems.at(race.at(0)).run(race.at(1), race.at(2), {race.at(3), race.at(4), &Interrupt::flag()});
    };
}

/// Does all runs, on threads and ranks. Unfinished problems are removed.
void run_all(Contest& contest, const Settings& settings, const RunConditions& conditions) {
    struct RunIndex {
        std::size_t problem, variant, seed;
    };
    std::vector<RunIndex> indices;
    std::vector<long> unfinished; // runs of each problem
    json names = json::array();
    for (const ProblemResults& results : contest.results) {
        for (std::size_t v = 0; v < results.runs.size(); ++v)
            for (std::size_t s = 0; s < results.runs[v].size(); ++s) indices.push_back({names.size(), v, s});
        unfinished.push_back(contest.seeds * static_cast<long>(results.runs.size()));
        names.push_back(results.problem.name);
    }
    std::mutex guard;
    long ended = 0;
    const cluster::Job job{
        .kind = "compare",
        .setting = {{"problems", names}, {"roughness", roughness_from(settings)}},
        .threads = contest.origin.threads,
        .count = indices.size(),
        .task =
            [&](std::size_t i) {
                const ProblemResults& results = contest.results[indices[i].problem];
                const std::uint64_t number = contest.origin.seed + indices[i].seed;
                return json::array(
                    {indices[i].problem, results.variants[indices[i].variant].second, instance_of(number),
                     ga::fold(number, results.problem.setup ? "roughness" : results.problem.name), results.budget});
            },
        .take =
            [&](std::size_t i, const json& reached) {
                const auto [b, variant, seed] = indices[i];
                ProblemResults& results = contest.results[b];
                results.runs[variant][seed] = reached.get<Reached>();
                const std::lock_guard lock(guard);
                unfinished[b] -= !conditions.stop;
                conditions.progress.show(results.problem.name + ": " + results.variants[variant].first + ", run " +
                                         std::to_string(++ended) + " of " + std::to_string(indices.size()));
            },
        .stopped = [&] { return conditions.stop.load(); }};
    if (cluster::is_alone()) {
        const cluster::Work work = races_under(job.setting);
        ga::parallel_for(job.count, job.threads, [&](std::size_t i) {
            if (!conditions.stop) job.take(i, work(*job.task(i)));
        });
    } else {
        cluster::hand_out(job);
    }
    std::size_t b = 0;
    std::erase_if(contest.results, [&](const ProblemResults&) { return unfinished[b++] > 0; });
}

Findings run_compare(const Settings& settings, const RunConditions& conditions) {
    Contest contest = contest_from(settings, conditions.origin);
    run_all(contest, settings, conditions);
    if (contest.results.empty()) return {};
    if (settings.is_on("compare.coco")) write_coco_runs(contest, conditions.folder / "coco");
    return findings_of(contest);
}

} // namespace

Experiment compare_experiment() {
    return {.kind = "compare",
            .settings = compare_settings(),
            .files = {"runs.csv", "ert.csv", "ecdf.csv", "tests.csv", "answers.csv", "progress.csv", "surfaces.csv",
                      "coco"},
            .run = run_compare,
            .takes_file = true,
            .work = races_under};
}

} // namespace app
