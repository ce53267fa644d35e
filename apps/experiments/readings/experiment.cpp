#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/run.hpp"
#include "apps/experiments/readings/readings.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/record.hpp"
#include "apps/report/result.hpp"
#include "apps/report/units.hpp"
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
constexpr std::array<rough::PhaseReach, 2> phase_reach{{{0.1, 0}, {0, 0.2 * std::numbers::pi}}};

/// The claims that depend on the reading, in the order of the columns.
const std::vector<const Claim*>& tried_claims() {
    static const std::vector<const Claim*> claims = [] {
        std::vector<const Claim*> all;
        for (const Claim& claim : paper_claims())
            if (claim.depends_on_reading)
                all.push_back(&claim);
        return all;
    }();
    return claims;
}

/// Adds the signs of the claims that a run can show; a claim of a target is undecidable in a run without one.
void add_signs(std::string& signs, bool of_targets, const PaperRun& run, const Studies& studies) {
    signs.resize(tried_claims().size(), '?');
    for (std::size_t c = 0; c < signs.size(); ++c)
        if ((tried_claims()[c]->find.index() == 1) == of_targets)
            signs[c] = "10?"[static_cast<std::size_t>(evaluated(*tried_claims()[c], run, studies).verdict)];
}

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

/// The database whose phases, the same for all pairs (H, gamma), are random; number 0 has Sobol's.
std::vector<rough::Genome> database_of(const rough::DatabaseLayout& layout, std::size_t number,
                                       std::uint64_t seed) {
    std::vector<rough::Genome> genomes = sobol_database(layout);
    const auto columns = static_cast<std::size_t>(layout.phase_columns);
    for (std::size_t g = 0; number > 0 && g < genomes.size(); ++g) {
        ga::Stream random(ga::fold(ga::fold(ga::fold(seed, "phases"), number), g % columns));
        for (rough::Chromosome& chromosome : genomes[g].series[0].chromosomes)
            chromosome.phases[0] = random.uniform(0, 2 * std::numbers::pi);
    }
    return genomes;
}

/// What a run has found: cells, and rows of runs.csv.
struct Found {
    ReadingCross cross;
    json runs = json::array();
    long curves = 0; ///< curves and gradients that the searches asked for
    std::size_t targets = 0;
};

class ReadingsTrial {
  public:
    ReadingsTrial(const Settings& settings, const Conditions& conditions)
        : quick_(settings.one_of("readings.quick", {"off", "on"}) == 1), conditions_(conditions),
          base_(model_from(settings, "model.")), max_pressure_(settings.pressure("readings.max-pressure")) {
        expect_none(settings, {{"model.kernel", "", ""}, {"model.datum", "", ""}, {"model.reach", "", ""}},
                    "given, expected none: the readings try several");
    }

    /// Tries the readings on Sobol phases, all or (`quick`) one axis at a time, and one axis at a time from
    /// so many databases with random phases.
    Found run(std::size_t databases) {
        Found found;
        for (std::size_t which = 0; which < reading_axes()[body].values.size(); ++which) {
            const rough::Model model = on_body(base_, which);
            const auto targets = targets_on(model, max_pressure_, conditions_.origin.threads);
            fractals_.clear();
            for (std::size_t unit = 0; unit < 2 + databases; ++unit) {
                const std::size_t number = unit < 2 ? 0 : unit - 1;
                const Reading base{which, 0, 0, 0, 0, unit == 1, 0};
                const std::string name = std::to_string(which) + "-" + std::to_string(base[first_point]) +
                                         "-" + std::to_string(number);
                const json part =
                    part_of(conditions_, name, [&] { return tried(model, targets, base, number); });
                if (part.is_null())
                    continue;
                for (const json& cell : part.at("cells"))
                    found.cross.cells.push_back(
                        {cell.at(0).get<Reading>(), cell.at(1), cell.at(2), cell.at(3)});
                for (const json& row : part.at("runs"))
                    found.runs.push_back(row);
                found.curves += part.at("curves").get<long>();
            }
            for (const rough::Target& target : targets) {
                std::string name = reading_axes()[body].values[which] + " " + target.name + ".csv";
                std::replace(name.begin(), name.end(), ' ', '-');
                rough::write_atomically(subfolder(conditions_.folder, "targets") / name, to_csv(target));
            }
            found.targets = targets.size();
        }
        return found;
    }

  private:
    bool is_wanted(const Reading& reading, std::size_t database) const {
        return (database == 0 && !quick_) || deviations(reading) <= 1;
    }

    /// A rule of Algorithm 1 and a reach of the phases on one target.
    struct Part {
        Reading reading; ///< without reduction and threshold
        std::size_t database;
        const rough::Target* target;
        rough::Vocabulary words;
        std::string signs; ///< of the claims that do not depend on a target
    };

    /// One body and database: every wanted reading on every target. Responses are solved once.
    json tried(const rough::Model& model, const std::vector<rough::Target>& targets, const Reading& base,
               std::size_t number) {
        conditions_.progress.show(reading_axes()[body].values[base[body]] + ", database " +
                                  std::to_string(number) +
                                  (base[first_point] ? " with Sobol's first point" : ""));
        PaperRun run;
        run.origin = conditions_.origin;
        run.model = run.searched = model;
        run.max_pressure = max_pressure_;
        run.layout = layout_on(run.model, base[first_point] != 0);
        const auto genomes = database_of(run.layout, number, run.origin.seed);
        run.database = answered(genomes, run.model, max_pressure_, run.origin.threads);
        Studies studies;
        add_removals(run, studies);
        const auto responses = std::make_shared<rough::LoneResponses>(run.model);
        const auto memory = std::make_shared<rough::ResponseMemory>();

        std::vector<Part> parts;
        for (std::size_t i = 0; i < 18; ++i) {
            Reading reading = base;
            reading[correlation] = i / 6, reading[dominance] = i / 2 % 3, reading[reach] = i % 2;
            if (!is_wanted(reading, number))
                continue;
            const auto compares = static_cast<rough::DominanceReading>(reading[correlation]);
            const double above = dominant_above[reading[dominance]];
            const auto rule = std::make_shared<rough::DominanceRule>(responses, compares, above);
            auto& fractals = fractals_[{reading[correlation], reading[dominance]}];
            if (fractals.empty())
                fractals = fractal_studies(run.model, run.origin.seed, run.origin.threads, compares, above);
            studies.fractals = fractals;
            studies.same_pressure = reductions(run, *rule);
            Part part{reading, number, nullptr, {rule, phase_reach[reading[reach]]}, {}};
            add_signs(part.signs, false, run, studies);
            for (const rough::Target& target : targets) {
                part.target = &target;
                parts.push_back(part);
            }
        }
        if (parts.empty())
            return {};
        run.origin.threads = 1; // in each part
        std::vector<json> found(parts.size());
        ga::parallel_for(parts.size(), conditions_.origin.threads,
                         [&](std::size_t i) { found[i] = claims_of(parts[i], run, genomes, memory); });
        json all{{"cells", json::array()}, {"runs", json::array()}, {"curves", 0L}};
        for (const json& one : found) {
            for (const char* list : {"cells", "runs"})
                all[list].insert(all[list].end(), one[list].begin(), one[list].end());
            all["curves"] = all["curves"].get<long>() + one["curves"].get<long>();
        }
        return all;
    }

    /// The three algorithms at every threshold, then what each wanted reading makes of them.
    json claims_of(const Part& part, PaperRun run, const std::vector<rough::Genome>& genomes,
                   const std::shared_ptr<rough::ResponseMemory>& memory) const {
        json cells = json::array(), runs = json::array();
        long curves = 0;
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
            curves += one->curves + one->gradients;
            runs.push_back(row_of(part, *one, t, order));
            return *one;
        };
        try {
            const auto ways = paper_three(part.words);
            const VariantRun sog = searched(ways[0], 0, 0);
            std::vector<VariantRun> gco;
            for (std::size_t t = 0; t < threshold_shares.size(); ++t)
                gco.push_back(searched(ways[1], t, 0));
            for (std::size_t order = 0; order < 2; ++order) {
                Reading reading = part.reading;
                reading[reduction] = order;
                if (!is_wanted(reading, part.database))
                    continue;
                std::vector<VariantRun> cco;
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
                    std::string signs = part.signs;
                    add_signs(signs, true, run, {});
                    cells.push_back({reading, part.database, target.title, signs});
                }
            }
        } catch (const ga::Stopped&) {
        }
        return {{"cells", std::move(cells)}, {"runs", std::move(runs)}, {"curves", curves}};
    }

    /// A row of runs.csv.
    static json row_of(const Part& part, const VariantRun& run, std::size_t t, std::size_t order) {
        const auto value = [&](ReadingAxes axis) { return reading_axes()[axis].values[part.reading[axis]]; };
        json row{{"body", value(body)},
                 {"first_point", value(first_point)},
                 {"database", part.database},
                 {"correlation", value(correlation)},
                 {"dominant_above", value(dominance)},
                 {"phases_within", value(reach)},
                 {"target", part.target->name},
                 {"variant", run.name},
                 {"similarity", run.similarity},
                 {"chromosomes", waves(run.answer.genome).size()}};
        if (run.name == "cco")
            row["reduced"] = reading_axes()[reduction].values[order];
        if (run.name != "sog") {
            const ThresholdRow found = threshold_row(run, 0);
            row.update({{"p_bar_over_p_max", threshold_shares[t]},
                        {"U1", found.u1},
                        {"U2", found.u2},
                        {"children", found.children},
                        {"share_above", found.share_above},
                        {"best_child", found.best_child}});
        }
        return row;
    }

    bool quick_;
    const Conditions& conditions_;
    rough::Model base_;
    double max_pressure_;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<FractalStudy>> fractals_; ///< of this body
};

bool is_from_sobol(const ReadingCell& cell) { return cell.database == 0; }

double share_with(const ReadingCross& cross, std::size_t claim, std::size_t axis, std::size_t value) {
    return cross.share(
        claim, [&](const ReadingCell& cell) { return is_from_sobol(cell) && cell.reading[axis] == value; });
}

/// The choice that decides most of a claim and the values under which it holds most and least often; null if
/// no choice moves the share by 0.05.
json widest(const ReadingCross& cross, std::size_t claim) {
    json widest;
    double width = 0.05;
    for (const ReadingAxis& axis : reading_axes()) {
        const auto a = static_cast<std::size_t>(&axis - reading_axes().data());
        std::vector<double> shares;
        for (std::size_t value = 0; value < axis.values.size(); ++value)
            shares.push_back(share_with(cross, claim, a, value));
        const auto [low, high] = std::pair(std::min_element(shares.begin(), shares.end()),
                                           std::max_element(shares.begin(), shares.end()));
        if (*high - *low > width || (widest.is_null() && *high - *low >= width)) {
            width = *high - *low;
            widest = {{"choice", axis.name},
                      {"lowest", axis.values[static_cast<std::size_t>(low - shares.begin())]},
                      {"lowest_share", *low},
                      {"highest", axis.values[static_cast<std::size_t>(high - shares.begin())]},
                      {"highest_share", *high}};
        }
    }
    return widest;
}

/// What the readings make of a claim, in words: the column "Other readings" of the paper's page.
std::string claim_words(const Found& found, std::size_t claim, std::size_t readings) {
    const auto share = [&](char sign) {
        std::vector<double> is;
        for (const ReadingCell& cell : found.cross.cells)
            if (is_from_sobol(cell))
                is.push_back(cell.holds[claim] == sign);
        return rough::mean(is);
    };
    std::string words = "holds in " + percent(share('1'), 3) +
                        (share('?') > 0 ? ", is undecidable in " + percent(share('?'), 3) : "") + " of " +
                        std::to_string(readings) + " readings on " + std::to_string(found.targets) +
                        " targets";
    if (const json spread = widest(found.cross, claim); !spread.is_null())
        words += "; depends most on " + spread["choice"].get<std::string>() + ": " +
                 spread["highest"].get<std::string>() + " " + percent(spread["highest_share"], 2) + ", " +
                 spread["lowest"].get<std::string>() + " " + percent(spread["lowest_share"], 2);
    return words;
}

/// One row per cell, one column per claim (1 holds, 0 does not, empty is undecidable).
std::string cells_csv(const ReadingCross& cross) {
    std::string text;
    for (const ReadingAxis& axis : reading_axes())
        text += axis.name + ",";
    text += "database,target";
    for (std::size_t c = 0; c < tried_claims().size(); ++c)
        text += ",claim_" + std::to_string(c + 1);
    for (const ReadingCell& cell : cross.cells) {
        text += "\n";
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
            text += "\"" + reading_axes()[axis].values[cell.reading[axis]] + "\",";
        text += std::to_string(cell.database) + "," + cell.target;
        for (const char sign : cell.holds)
            text += sign == '?' ? std::string(",") : std::string(",") + sign;
    }
    return text + "\n";
}

/// The tables, and result.json: the claims by what the readings make of them, and how clear the first place
/// among the readings is.
void write_readings(const Found& found, json result, const std::filesystem::path& folder) {
    const ReadingCross& cross = found.cross;
    const auto ranked = cross.ranked();
    const auto ours = std::find_if(ranked.begin(), ranked.end(),
                                   [](const auto& one) { return deviations(one.first) == 0; });
    Csv claims("claim,place,says,choice,value,share_holds");
    Csv shares("claim,place,says,ours,best,every,other_phases,choice,highest,highest_share,lowest,"
               "lowest_share");
    json never = json::array(), always = json::array(), deciding = json::array(), words = json::object();
    std::map<std::string, int> decided;
    long depend = 0, firm = 0;
    for (std::size_t c = 0; c < tried_claims().size(); ++c) {
        const Claim& of = *tried_claims()[c];
        const json claim{{"claim", c + 1}, {"place", of.place}, {"says", of.sentence}};
        for (const ReadingAxis& axis : reading_axes())
            for (std::size_t value = 0; value < axis.values.size(); ++value)
                claims.row(
                    c + 1, of.place, of.sentence, axis.name, axis.values[value],
                    share_with(cross, c, static_cast<std::size_t>(&axis - reading_axes().data()), value));
        const auto under = [&](const Reading& reading, bool is_sobol) {
            return cross.share(c, [&](const ReadingCell& cell) {
                return is_from_sobol(cell) == is_sobol && cell.reading == reading;
            });
        };
        const double every = cross.share(c, is_from_sobol), drawn = under({}, false);
        const json spread = widest(cross, c);
        json row{{"ours", under({}, true)},
                 {"best", under(ranked.front().first, true)},
                 {"every", every},
                 {"other_phases", drawn}};
        row.update(claim);
        if (!spread.is_null())
            row.update(spread);
        shares.add(row);
        if (every == 0)
            never.push_back(claim);
        else if (every == 1)
            always.push_back(claim);
        else if (!std::isnan(every))
            ++depend;
        if (!spread.is_null() && every > 0 && every < 1)
            ++decided[spread["choice"]];
        firm += std::min(drawn, 1 - drawn) <= 0.05;
        words[of.id] = claim_words(found, c, ranked.size());
    }
    for (const ReadingAxis& axis : reading_axes())
        if (decided[axis.name] > 0)
            deciding.push_back({{"choice", axis.name}, {"claims", decided[axis.name]}});
    json readings = json::array();
    for (const auto& [reading, holding] : ranked) {
        json one{{"claims_hold", holding}, {"differs", json::array()}};
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis) {
            const auto& [name, values] = reading_axes()[axis];
            one[name] = values[reading[axis]];
            if (reading[axis] != 0)
                one["differs"].push_back({{"choice", name}, {"value", values[reading[axis]]}});
        }
        readings.push_back(std::move(one));
    }
    Csv runs("body,first_point,database,correlation,dominant_above,phases_within,target,variant,reduced,"
             "p_bar_over_p_max,U1,U2,children,share_above,best_child,similarity,chromosomes");
    for (const json& row : found.runs)
        runs.add(row);
    const double most = ranked.front().second;
    result.update({{"claim_count", tried_claims().size()},
                   {"target_count", found.targets},
                   {"reading_count", ranked.size()},
                   {"ours_hold", ours == ranked.end() ? NAN : ours->second},
                   {"best_hold", most},
                   {"worst_hold", ranked.back().second},
                   {"near_best", std::count_if(ranked.begin(), ranked.end(),
                                               [&](const auto& one) { return one.second >= most - 0.25; })},
                   {"never", never},
                   {"always", always},
                   {"depend", depend},
                   {"deciding", deciding},
                   {"firm", firm},
                   {"searches", found.runs.size()},
                   {"curves", found.curves},
                   {"readings", readings},
                   {"claims", claims.rows()}});
    rough::write_atomically(folder / "cells.csv", cells_csv(cross));
    rough::write_atomically(folder / "runs.csv", runs.text());
    rough::write_atomically(folder / "claims.csv", claims.text());
    rough::write_atomically(folder / "shares.csv", shares.text());
    write_json(folder / "result.json", result);
    write_json(folder / "readings.json", {{"command", result["command"]},
                                          {"version", result["version"]},
                                          {"claims", words}}); // for the paper's page
}

Findings run_readings(const Settings& settings, const Conditions& conditions) {
    ReadingsTrial trial(settings, conditions);
    auto databases = static_cast<std::size_t>(settings.whole("readings.databases", 0, 1000));
    if (settings.text("readings.quick") == "on")
        databases = std::min<std::size_t>(databases, 2);
    const Found found = trial.run(databases);
    if (found.cross.cells.empty())
        return {};
    json result = origin_json(conditions.origin);
    result.update({{"database_count", databases}, {"seconds", conditions.clock.seconds()}});
    return {[=, folder = conditions.folder] { write_readings(found, result, folder); },
            {},
            "most claims hold at once: " + readable(found.cross.ranked().front().second)};
}

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
    const json found = conditions.stop ? json() : find();
    if (conditions.stop)
        return {};
    std::filesystem::create_directories(file.parent_path());
    const std::string text = json{{"settings", conditions.settings}, {"found", found}}.dump();
    rough::write_atomically(file, text);
    return json::parse(text).at("found"); // as another run will read it
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

std::vector<std::pair<Reading, double>> ReadingCross::ranked() const {
    std::map<Reading, std::vector<double>> counts;
    for (const ReadingCell& cell : cells)
        if (cell.database == 0)
            counts[cell.reading].push_back(
                static_cast<double>(std::count(cell.holds.begin(), cell.holds.end(), '1')));
    std::vector<std::pair<Reading, double>> order;
    for (const auto& [reading, holding] : counts)
        order.emplace_back(reading, rough::mean(holding));
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return std::pair(-a.second, deviations(a.first)) < std::pair(-b.second, deviations(b.first));
    });
    return order;
}

Experiment readings_experiment() {
    return {.kind = "readings",
            .summary = "the paper's claims under every reading that its text allows",
            .settings = joined(
                {{{"readings.quick", "off", "on tries one choice at a time and two databases: a minute"},
                  {"readings.databases", "20",
                   "databases with other phases, from each of which one choice at a time is tried"},
                  {"readings.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                 model_settings("model.")}),
            .files = {"cells.csv", "claims.csv", "shares.csv", "runs.csv", "readings.json", "targets"},
            .run = run_readings,
            .resumes = true};
}

} // namespace app
