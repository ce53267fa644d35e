#include "apps/experiments/readings/cross.hpp"

#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/variant_runs.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/recorder.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/target/like.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "ga/base/parallel.hpp"

#include <algorithm>
#include <numbers>

namespace app {

namespace {

using nlohmann::json;

constexpr std::array<double, 3> dominant_above{rough::dominance_threshold, 0.9, 0.99};
constexpr std::array<double, 5> threshold_shares{0.5, 0.31, 0.405, 0.595, 0.69};
constexpr std::array<double, 2> absolute_reach{0, 0.2 * std::numbers::pi};

/// What the claims of one body are verified with.
struct Pressed {
    rough::Model model;
    std::vector<rough::Target> targets;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<FractalStudy>> fractals; ///< by Algorithm 1
};

rough::Model on_body(rough::Model model, std::size_t which) {
    using rough::Kernel;
    model.body.kernel = which == 2 ? Kernel::strip : which == 3 ? Kernel::periodic : Kernel::free;
    model.body.datum = which == 1 ? 4 * model.grid.length : 0;
    model.loading.reach = 0;
    return completed(model);
}

rough::DatabaseLayout layout_on(const rough::Model& model, bool with_first) {
    rough::DatabaseLayout layout;
    layout.lambda = model.grid.length;
    layout.shortest = model.grid.spacing();
    layout.with_first = with_first;
    return layout;
}

/// Drawn in the paper's spirit after a database's curves, each a smoothed quantile of them; then the curve of
/// a genome outside it.
std::vector<rough::Target> targets_on(const rough::Model& model, double max_pressure, int threads) {
    const auto curves = [&](const std::vector<rough::Genome>& genomes) {
        std::vector<rough::Curve> all;
        for (const Answered& one : answered(genomes, model, max_pressure, threads))
            all.push_back(secant_stiffness(one.response));
        return all;
    };
    rough::DatabaseLayout layout = layout_on(model, false);
    const std::vector<rough::Curve> known = curves(sobol_database(layout));
    std::vector<rough::Target> targets;
    for (const auto& [title, share] :
         {std::pair("median", 0.5), std::pair("lower quartile", 0.25), std::pair("upper quartile", 0.75)}) {
        rough::Target target;
        target.name = title;
        target.x = Eigen::VectorXd::LinSpaced(20, 0.025, 0.975) * max_pressure;
        target.y = target.x.unaryExpr([&, share = share](double p) {
            return rough::quantile(rough::column(known, [p](const auto& curve) { return curve.at(p); }),
                                   share);
        });
        for (int pass = 0; pass < 3; ++pass)
            target.y.segment(1, 18) =
                (0.25 * (target.y.head(18) + target.y.tail(18)) + 0.5 * target.y.segment(1, 18)).eval();
        targets.push_back(std::move(target));
    }
    layout.pairs = 54;
    const rough::Curve outside = curves({sobol_database(layout)[53 * 5 + 3]}).front();
    targets.push_back(rough::even_target(rough::Quantity::stiffness, "held-out", 20, max_pressure,
                                         [&](double p) { return outside.at(p); }));
    return targets;
}

/// The database whose phases, the same for all pairs (H, gamma), are drawn; 0: Sobol's.
std::vector<rough::Genome> database_of(const rough::DatabaseLayout& layout, std::size_t number,
                                       std::uint64_t seed) {
    std::vector<rough::Genome> genomes = sobol_database(layout);
    if (number == 0)
        return genomes;
    const auto columns = static_cast<std::size_t>(layout.phase_columns);
    for (std::size_t g = 0; g < genomes.size(); ++g) {
        ga::Stream random(ga::fold(ga::fold(ga::fold(seed, "phases"), number), g % columns));
        for (rough::Chromosome& chromosome : genomes[g].series[0].chromosomes)
            chromosome.phases[0] = random.uniform(0, 2 * std::numbers::pi);
    }
    return genomes;
}

char sign_of(const EvaluatedClaim& claim) {
    return claim.verdict == Verdict::reproduced ? '1' : claim.verdict == Verdict::contradicted ? '0' : '?';
}

class ReadingsTrial {
  public:
    ReadingsTrial(const Settings& settings, const Conditions& conditions)
        : conditions_(conditions), base_(model_from(settings, "model.")),
          max_pressure_(settings.pressure("readings.max-pressure")) {
        expect_none(settings, {{"model.kernel", "", ""}, {"model.datum", "", ""}, {"model.reach", "", ""}},
                    "given, expected none: the readings try several");
        cross_.quick = settings.one_of("readings.quick", {"off", "on"}) == 1;
        cross_.databases = static_cast<std::size_t>(settings.whole("readings.databases", 0, 1000));
        if (cross_.quick)
            cross_.databases = std::min<std::size_t>(cross_.databases, 2);
    }

    ReadingCross run() {
        for (std::size_t which = 0; which < reading_axes()[body].values.size(); ++which) {
            Pressed pressed{on_body(base_, which), {}, {}};
            pressed.targets = targets_on(pressed.model, max_pressure_, conditions_.origin.threads);
            for (const bool first : {false, true})
                unit(pressed, {which, 0, 0, 0, 0, first, 0}, 0);
            for (std::size_t number = 1; number <= cross_.databases; ++number)
                unit(pressed, {which, 0, 0, 0, 0, 0, 0}, number);
            cross_.targets.clear();
            for (const rough::Target& target : pressed.targets) {
                cross_.targets.push_back(target.name);
                std::string name = reading_axes()[body].values[which] + " " + target.name + ".csv";
                std::replace(name.begin(), name.end(), ' ', '-');
                rough::write_atomically(subfolder(conditions_.folder, "targets") / name, to_csv(target));
            }
        }
        return std::move(cross_);
    }

  private:
    bool is_wanted(const Reading& reading, std::size_t database) const {
        return (database == 0 && !cross_.quick) || deviations(reading) <= 1;
    }

    /// One body and database: every wanted reading on every target. Responses are solved once.
    void unit(Pressed& pressed, const Reading& base, std::size_t number) {
        const std::string name = std::to_string(base[body]) + "-" + std::to_string(base[first_point]) + "-" +
                                 std::to_string(number);
        if (const json found = part_of(conditions_, name, [&] { return tried(pressed, base, number); });
            !found.is_null())
            take(found);
    }

    json tried(Pressed& pressed, const Reading& base, std::size_t number) const {
        conditions_.progress.show(reading_axes()[body].values[base[body]] + ", database " +
                                  std::to_string(number) +
                                  (base[first_point] ? " with Sobol's first point" : ""));
        PaperRun run;
        run.origin = conditions_.origin;
        run.model = run.searched = pressed.model;
        run.max_pressure = max_pressure_;
        run.layout = layout_on(run.model, base[first_point] != 0);
        const auto genomes = database_of(run.layout, number, run.origin.seed);
        run.database = answered(genomes, run.model, max_pressure_, run.origin.threads);
        Studies studies;
        add_removals(run, studies);
        const auto responses = std::make_shared<rough::LoneResponses>(run.model);
        const auto memory = std::make_shared<rough::ResponseMemory>();

        std::vector<Part> parts;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t d = 0; d < 3; ++d)
                for (std::size_t r = 0; r < 2; ++r) {
                    Reading reading = base;
                    reading[correlation] = c, reading[dominance] = d, reading[reach] = r;
                    if (!is_wanted(reading, number))
                        continue;
                    const auto rule = std::make_shared<rough::DominanceRule>(
                        responses, static_cast<rough::DominanceReading>(c), dominant_above[d]);
                    auto& fractals = pressed.fractals[{c, d}];
                    if (fractals.empty())
                        fractals =
                            fractal_studies(run.model, run.origin.seed, run.origin.threads,
                                            static_cast<rough::DominanceReading>(c), dominant_above[d]);
                    studies.fractals = fractals;
                    studies.same_pressure = reductions(run, *rule);
                    std::vector<char> own;
                    for (const Claim& claim : paper_claims())
                        own.push_back(claim.find.index() == 0 && claim.depends_on_reading
                                          ? sign_of(evaluated(claim, run, studies))
                                          : '?');
                    for (const rough::Target& target : pressed.targets)
                        parts.push_back({reading,
                                         number,
                                         &target,
                                         {rule, {0.1 - 0.1 * static_cast<double>(r), absolute_reach[r]}},
                                         own});
                }
        if (parts.empty())
            return {};
        run.origin.threads = 1; // in each part
        std::vector<Found> found(parts.size());
        ga::parallel_for(parts.size(), conditions_.origin.threads,
                         [&](std::size_t i) { found[i] = claims_of(parts[i], run, genomes, memory); });
        Found all;
        json cells = json::array();
        for (const Found& one : found) {
            for (const ReadingCell& cell : one.cells)
                cells.push_back({cell.reading, cell.database, cell.target, cell.holds});
            all.runs += one.runs, all.searches += one.searches, all.curves += one.curves;
            if (!one.claims.empty())
                all.claims = one.claims;
        }
        return {{"cells", std::move(cells)},
                {"runs", all.runs},
                {"searches", all.searches},
                {"curves", all.curves},
                {"claims", all.claims}};
    }

    void take(const json& unit) {
        for (const auto& cell : unit.at("cells"))
            cross_.cells.push_back({cell.at(0).get<Reading>(), cell.at(1), cell.at(2), cell.at(3)});
        cross_.runs += unit.at("runs").get<std::string>();
        cross_.searches += unit.at("searches").get<long>();
        cross_.curves += unit.at("curves").get<long>();
        cross_.claims = unit.at("claims").get<decltype(cross_.claims)>();
    }

    struct Part {
        Reading reading; ///< without reduction and threshold
        std::size_t database;
        const rough::Target* target;
        rough::Vocabulary words;
        std::vector<char> own; ///< signs of the claims that do not depend on a target; one for each claim
    };
    struct Found {
        std::vector<ReadingCell> cells;
        std::vector<std::pair<std::string, std::string>> claims;
        std::string runs;
        long searches = 0, curves = 0;
    };

    /// The three algorithms at every threshold, then what each wanted reading makes of them.
    Found claims_of(const Part& part, PaperRun run, const std::vector<rough::Genome>& genomes,
                    const std::shared_ptr<rough::ResponseMemory>& memory) const {
        Found found;
        const auto searched = [&](const NamedPipeline& way, std::size_t t, std::size_t order) -> VariantRun {
            const rough::DesignProblem problem(paper_setup(run.model, *part.target, max_pressure_,
                                                           threshold_shares[t] * max_pressure_,
                                                           part.words.reach),
                                               memory);
            ga::RunOptions options;
            options.variant = way.name;
            options.seed = run.origin.seed;
            options.threads = 1;
            options.budget.stop = &conditions_.stop;
            std::vector<StageRecord> stages;
            const auto result =
                ga::run(way.pipeline, problem, ga::population(genomes), options, {recorder(stages)});
            auto one = finished_run(way.name, problem, result, std::move(stages));
            if (!one || conditions_.stop)
                throw ga::Stopped{"interrupted"};
            ++found.searches;
            found.curves += one->curves + one->gradients;
            found.runs += row_of(part, *one, t, order);
            return *one;
        };
        try {
            const auto ways = paper_three(part.words);
            const VariantRun sog = searched(ways[0], 0, 0);
            std::vector<VariantRun> gco, cco;
            for (std::size_t t = 0; t < threshold_shares.size(); ++t)
                gco.push_back(searched(ways[1], t, 0));
            for (std::size_t order = 0; order < 2; ++order) {
                Reading reading = part.reading;
                reading[reduction] = order;
                if (!is_wanted(reading, part.database))
                    continue;
                cco.clear();
                TargetRun target{part.target->name, *part.target, 0, {}, {}, {}};
                for (std::size_t t = 0; t < threshold_shares.size(); ++t) {
                    cco.push_back(
                        searched(order ? NamedPipeline{"cco", cco_of_sums(part.words)} : ways[2], t, order));
                    for (const VariantRun* one : {&gco[t], &cco[t]})
                        target.thresholds.push_back(threshold_row(*one, threshold_shares[t] * max_pressure_));
                }
                for (std::size_t t = 0; t < threshold_shares.size(); ++t) {
                    reading[threshold] = t;
                    if (!is_wanted(reading, part.database))
                        continue;
                    target.p_bar = threshold_shares[t] * max_pressure_;
                    target.variants = {sog, gco[t], cco[t]};
                    target.database = scores_of(
                        run.database, paper_setup(run.model, *part.target, max_pressure_, target.p_bar));
                    run.targets = {target};
                    found.cells.push_back({reading, part.database, part.target->name, ""});
                    found.claims.clear();
                    for (std::size_t c = 0; c < paper_claims().size(); ++c) {
                        const Claim& claim = paper_claims()[c];
                        if (!claim.depends_on_reading)
                            continue;
                        found.claims.emplace_back(claim.place, claim.sentence);
                        found.cells.back().holds +=
                            claim.find.index() == 0 ? part.own[c] : sign_of(evaluated(claim, run, {}));
                    }
                }
            }
        } catch (const ga::Stopped&) {
        }
        return found;
    }

    std::string row_of(const Part& part, const VariantRun& run, std::size_t t, std::size_t order) const {
        Csv row(run_columns());
        const auto value = [&](ReadingAxes axis) { return reading_axes()[axis].values[part.reading[axis]]; };
        const bool crosses = run.name != "sog";
        const ThresholdRow found = crosses ? threshold_row(run, 0) : ThresholdRow{};
        const auto count = [&](std::size_t number) {
            return crosses ? std::optional(static_cast<double>(number)) : std::nullopt;
        };
        row.row(value(body), value(first_point), part.database, value(correlation), value(dominance),
                value(reach), part.target->name, run.name,
                run.name == "cco" ? reading_axes()[reduction].values[order] : std::string(),
                crosses ? std::optional(threshold_shares[t]) : std::nullopt, count(found.u1), count(found.u2),
                count(found.children), crosses ? std::optional(found.share_above) : std::nullopt,
                crosses ? std::optional(found.best_child) : std::nullopt, run.similarity,
                waves(run.answer.genome).size());
        return row.text().substr(row.text().find('\n') + 1);
    }

    const Conditions& conditions_;
    rough::Model base_;
    double max_pressure_;
    ReadingCross cross_;
};

} // namespace

json part_of(const Conditions& conditions, const std::string& name, const std::function<json()>& find) {
    const auto file = conditions.folder / "checkpoints" / (name + ".json");
    if (conditions.resume && std::filesystem::exists(file)) {
        json kept = rough::parsed_json(rough::read_whole(file), "--resume: " + file.string());
        if (!kept.is_object() || !kept.contains("found") ||
            kept.value("settings", json()) != conditions.settings)
            throw rough::InputError("--resume: " + file.string() +
                                    " is damaged or was kept under other settings, expected those of the "
                                    "interrupted run");
        return std::move(kept.at("found"));
    }
    if (conditions.stop)
        return {};
    const json found = find();
    if (conditions.stop)
        return {};
    std::filesystem::create_directories(file.parent_path());
    const std::string text = json{{"settings", conditions.settings}, {"found", found}}.dump();
    rough::write_atomically(file, text);
    return json::parse(text).at("found"); // as another run will read it
}

const std::string& run_columns() {
    static const std::string columns = "body,first_point,database,correlation,dominant_above,phases_within,"
                                       "target,variant,reduced,p_bar_over_p_max,"
                                       "U1,U2,children,share_above,best_child,similarity,chromosomes";
    return columns;
}

const std::array<ReadingAxis, reading_axes_count>& reading_axes() {
    static const std::array<ReadingAxis, reading_axes_count> axes{
        {{"Body", {"free d = L", "free d = 4 L", "strip", "periodic"}},
         {"Algorithm 1 compares", {"K at equal pressures", "K by load step", "raw tangents"}},
         {"Dominant above", {"0.95", "0.90", "0.99"}},
         {"CCO reduces", {"parents", "children"}},
         {"Phases move within", {"a tenth of the value", "a tenth of 2π"}},
         {"Sobol's first point", {"skipped", "kept"}},
         {"p̄ over p_max", {"0.5", "0.31", "0.405", "0.595", "0.69"}}}};
    return axes;
}

std::size_t deviations(const Reading& reading) {
    return reading_axes_count - static_cast<std::size_t>(std::count(reading.begin(), reading.end(), 0U));
}

double ReadingCross::share(std::size_t claim, const std::function<bool(const ReadingCell&)>& counts) const {
    std::vector<double> holds;
    for (const ReadingCell& cell : cells)
        if (counts(cell))
            holds.push_back(cell.holds[claim] == '1');
    return rough::mean(holds);
}

double ReadingCross::holding(const Reading& reading) const {
    std::vector<double> counts;
    for (const ReadingCell& cell : cells)
        if (cell.database == 0 && cell.reading == reading)
            counts.push_back(static_cast<double>(std::count(cell.holds.begin(), cell.holds.end(), '1')));
    return rough::mean(counts);
}

std::vector<Reading> ReadingCross::ranked() const {
    std::map<Reading, std::pair<double, double>> sums;
    for (const ReadingCell& cell : cells)
        if (cell.database == 0) {
            auto& [sum, count] = sums[cell.reading];
            sum += static_cast<double>(std::count(cell.holds.begin(), cell.holds.end(), '1'));
            ++count;
        }
    std::vector<Reading> order;
    for (const auto& [reading, sum] : sums)
        order.push_back(reading);
    const auto mean = [&](const Reading& reading) { return sums[reading].first / sums[reading].second; };
    // Of equal ones the nearer to ours.
    std::stable_sort(order.begin(), order.end(), [&](const Reading& a, const Reading& b) {
        return std::pair(-mean(a), deviations(a)) < std::pair(-mean(b), deviations(b));
    });
    return order;
}

ReadingCross tried_readings(const Settings& settings, const Conditions& conditions) {
    return ReadingsTrial(settings, conditions).run();
}

} // namespace app
