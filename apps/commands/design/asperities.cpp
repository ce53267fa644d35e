#include "apps/commands/design/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/surface.hpp"
#include "ga/observers/progress.hpp"

#include <numbers>

namespace app {
namespace {

using nlohmann::json;

constexpr double independent_error = 0.02; ///< error of A(F) by independent caps
constexpr double base_depth = 0.25;        ///< depth of a tile's base, over the smallest radius
constexpr double solid_nodes = 90000;      ///< nodes of the tile
constexpr int drawn_points = 60;           ///< points of a drawn curve

std::string name_of(rough::CapModel model) {
    return model == rough::CapModel::independent ? "independent" : "interacting";
}

struct CapRun : DesignRecord {
    rough::CapSetup setup;
    rough::SearchOptionsOf<rough::CapProblem> options;
    rough::CapSearch found;
    std::vector<rough::HeightTolerance> tolerance;
    double other_model_error = NAN; ///< relative difference of the curves by independent and interacting caps
};

/// FROM:TO or FROM:TO:STEP, mm.
rough::GeneRange range_from(const Settings& settings, const std::string& name) {
    const std::vector<double> parts = settings.numbers(name);
    if (parts.size() < 2 || parts.size() > 3)
        settings.refuse(name, settings.text(name), " is not a range; give FROM:TO or FROM:TO:STEP");
    return {parts[0], parts[1], parts.size() == 3 ? parts[2] : 0};
}

CapRun cap_run_from(const Settings& settings) {
    // settings without effect on caps
    auto others = names_of(joined({scan_settings(), {resolution_setting()}, search_settings()}));
    others.insert(others.end(), {"like", "from", "control", "largest-change"});
    std::erase_if(others, [](const std::string& name) {
        return rough::is_in(" variant pipeline seconds evaluations alternatives seed threads reach-similarity "
                            "nodes material modulus poisson ",
                            name);
    });
    expect_none(settings, others, "given with --asperities; omit it, as it is for sums of cosines only");
    CapRun run;
    rough::CapSetup& setup = run.setup;
    const auto sides = settings.numbers("asperities");
    if (sides.size() != 2)
        settings.refuse("asperities", settings.text("asperities"), " is not a pair; give NXxNY, e.g. 8x8");
    setup.array = {static_cast<rough::Index>(sides[0]), static_cast<rough::Index>(sides[1])};
    settings.take("pitch", setup.array.pitch);
    if (settings.has("radius") && settings.has("radii"))
        settings.refuse("radii", "given with ", settings.place("radius"), "; give one of both");
    if (settings.has("radius")) setup.radii.from = setup.radii.to = settings.number("radius");
    if (settings.has("radii")) setup.radii = range_from(settings, "radii");
    if (settings.has("heights")) setup.heights = range_from(settings, "heights");
    setup.positions = settings.is_on("positions");
    settings.take("reach-similarity", setup.required_similarity);
    if (settings.has("nodes")) {
        const auto nodes = settings.numbers("nodes");
        setup.nodes = nodes[0] * nodes.back();
    }
    rough::Model model = model_from(settings.with({{"nodes", ""}}));
    model.grid = grid_of(setup.array);
    setup.effective_modulus = model.body.effective_modulus;
    setup.targets = targets_from(settings, model);
    placing(settings, "", [&] { return rough::CapProblem(setup); });
    settings.take("accuracy", model.accuracy);
    if (only_areas(setup) && model.accuracy >= independent_error) setup.model = rough::CapModel::independent;
    run.options.pipeline = pipeline_from(settings, cap_variants(setup), "default");
    take(settings, app::bindings_of(run.options));
    run.unreachable = rough::unreachable(
        out_of_reach(setup), settings.has("reach-similarity") ? setup.required_similarity : rough::exact_enough);
    return run;
}

Summary summary_of(const CapRun& run) {
    const rough::CapVerification& verified = run.found.best.verification;
    const double required = run.setup.required_similarity, lowest = run.found.best.lowest();
    const std::string model = "the " + name_of(run.setup.model) + " model",
                      wanted = "; " + brief(required, 15) + " is required";
    Summary summary{lowest >= required && run.unreachable.reasons.empty(), lowest, "", {}};
    if (!run.unreachable.reasons.empty())
        summary.verdict = "out of reach of these caps: " + run.unreachable.reasons.front().reason +
                          "; no similarity is above " + readable(run.unreachable.bound, 4) +
                          "; the best design found has " + readable(run.found.best.similarity, 4);
    else if (std::isnan(lowest))
        summary.verdict = "not verified: similarity " + readable(run.found.best.similarity, 4) + " by " + model +
                          ", no time was left for boundary elements" + wanted;
    else
        summary.verdict = (summary.found ? "found" : missed_by(run.found)) + ": lowest similarity " +
                          readable(lowest, 5) + ", by " + model + " and by boundary elements at " +
                          std::to_string(verified.meshed.size()) + " points" + wanted;
    std::string errors = "not known, because boundary elements have not verified all loads", tolerated;
    if (!verified.meshed.empty() && !run.interrupted)
        errors = "independent caps differ from interacting ones by " + percent(run.other_model_error) + "; " + model +
                 " from boundary elements by " + percent(verified.area_error) + " in area and by " +
                 percent(verified.force_error) + " of the largest force";
    for (const rough::HeightTolerance& one : run.tolerance)
        tolerated += (tolerated.empty() ? "errors of the heights that keep the law: " : ", ") +
                     (one.rms > 0 ? readable(1000 * one.rms) + " µm rms" : "none") + " within " + percent(one.error);
    summary.facts = {
        {"errors", "Errors", errors},
        {"tolerance", "Tolerance", tolerated},
        {"time", "Time",
         readable(run.found.seconds) + " s of search, " + readable(verified.seconds) + " s of verification"}};
    return summary;
}

json answer_json(const CapRun& run) {
    const auto genome = [&](const rough::CapGenome& genes) {
        const rough::Caps caps = caps_of(run.setup, genes);
        json all = {{"columns", caps.array.columns}, {"rows", caps.array.rows}, {"pitch_mm", caps.array.pitch}};
        for (rough::Index i = 0; i < caps.heights.size(); ++i)
            all["asperities"].push_back({{"height_mm", caps.heights[i]}, {"radius_mm", caps.radii[i]}});
        return all;
    };
    const rough::CapVerification& verified = run.found.best.verification;
    json answer{{"similarity", run.found.best.similarity},
                {"similarity_refined", verified.similarity},
                {"similarity_worst", run.found.best.lowest()},
                {"genome", genome(run.found.best.genome)},
                {"pipeline", run.found.pipeline},
                {"stages", run.stages},
                {"notes", run.found.notes},
                {"stopped", run.found.stopped},
                {"seconds", run.seconds},
                {"search_seconds", run.found.seconds},
                {"curves", run.found.counters.evaluations},
                {"gradients", run.found.counters.gradients},
                {"price", run.found.counters.price},
                {"verification",
                 {{"loads", json::array()},
                  {"area_error", verified.area_error},
                  {"force_error", verified.force_error},
                  {"seconds", verified.seconds}}},
                {"model_difference", run.other_model_error},
                {"alternatives", json::array()}};
    for (json& stage : answer["stages"]) stage.erase("spent"), stage.erase("derived");
    for (std::size_t s = 0; s < verified.meshed.size(); ++s) {
        const rough::MeshedCaps& mesh = verified.meshed[s];
        answer["verification"]["loads"].push_back({{"load_N", mesh.load},
                                                   {"area_mm2", mesh.area.sum()},
                                                   {"area_from_nodes_mm2", {mesh.area_low.sum(), mesh.area_high.sum()}},
                                                   {"area_by_model_mm2", verified.states[s].total_area()},
                                                   {"approach_mm", mesh.approach},
                                                   {"kkt_residual", mesh.kkt_residual}});
    }
    for (const rough::CapAnswer& one : run.found.alternatives)
        answer["alternatives"].push_back(
            {{"similarity", one.similarity}, {"difference", one.difference}, {"genome", genome(one.genome)}});
    for (const auto& [genes, similarities] : run.found.front)
        answer["front"].push_back({{"similarity", similarities}, {"genome", genome(genes)}});
    for (const rough::HeightTolerance& one : run.tolerance)
        answer["tolerance"].push_back({{"error", one.error}, {"height_rms_mm", one.rms}});
    return answer;
}

void write_result(const CapRun& run, const std::filesystem::path& folder) {
    const rough::CapSetup& setup = run.setup;
    const auto range = [](const rough::GeneRange& of) {
        return json{{"from", of.from}, {"to", of.to}, {"step", of.step > 0 ? json(of.step) : json()}};
    };
    json result = record_json(run, setup.targets, "");
    result.update({{"asperities", {setup.array.columns, setup.array.rows}},
                   {"pitch_mm", setup.array.pitch},
                   {"heights_mm", range(setup.heights)},
                   {"radii_mm", range(setup.radii)},
                   {"effective_modulus_MPa", setup.effective_modulus},
                   {"nominal_area_mm2", setup.array.nominal_area()},
                   {"model", name_of(setup.model)},
                   {"required_similarity", setup.required_similarity},
                   {"variants", {{run.found.name, answer_json(run)}}}});
    write_json(folder / "result.json", result);
}

/// Writes the caps, the spots at the verified loads, the curves and their points, the tile and its mould.
void write_tables(const CapRun& run, const std::filesystem::path& folder) {
    const rough::CapSetup& setup = run.setup;
    const rough::CapAnswer& best = run.found.best;
    const rough::CapVerification& verified = best.verification;
    const rough::Caps caps = caps_of(setup, best.genome);
    Csv table("x_mm,y_mm,height_mm,radius_mm"),
        spots("load_N,x_mm,y_mm,spot_radius_mm,force_N,force_by_model_N,area_mm2,area_low_mm2,area_high_mm2"),
        curves("target,curve,x,y"), points("target,x,y,lower,upper,misfit,misfit_verified");
    for (rough::Index i = 0; i < caps.heights.size(); ++i) {
        table.row(setup.array.x(i), setup.array.y(i), caps.heights[i], caps.radii[i]);
        for (std::size_t s = 0; s < verified.meshed.size(); ++s) {
            const rough::MeshedCaps& mesh = verified.meshed[s];
            spots.row(mesh.load, setup.array.x(i), setup.array.y(i), std::sqrt(mesh.area[i] / std::numbers::pi),
                      mesh.force[i], verified.states[s].force[i], mesh.area[i], mesh.area_low[i], mesh.area_high[i]);
        }
    }
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        const rough::Target& target = setup.targets[t];
        rough::Target drawn = target;
        drawn.x = Eigen::VectorXd::LinSpaced(drawn_points, 0.2 * target.x[0], target.last());
        const rough::WrittenColumns columns = columns_of(target);
        curves.points(drawn.x / columns.x_unit,
                      curve_of(setup, drawn, best.genome, setup.model).values / columns.y_unit, t + 1, "answer");
        const Eigen::VectorXd misfits =
            misfit(target, curve_of(setup, target, best.genome, setup.model).values) / target.weight;
        add_points(points, t + 1, target, misfits, Eigen::VectorXd::Constant(target.points(), NAN));
    }
    for (const auto& [name, csv] :
         {std::pair("asperities", &table), {"spots", &spots}, {"curves", &curves}, {"points", &points}})
        rough::write_atomically(folder / (name + std::string(".csv")), csv->text());
    rough::Profile tile = map_of(caps, solid_nodes, true, base_depth * caps.radii.minCoeff());
    write_solids(tile, {}, folder, "tile");
    const rough::Index columns = tile.shape().columns; // the mould is turned over, about y
    for (rough::Index row = 0; row < tile.rows; ++row) tile.heights.segment(row * columns, columns).reverseInPlace();
    tile.heights *= -1;
    write_solids(tile, {}, folder, "mould");
}

} // namespace

std::vector<Setting> asperity_settings() {
    return joined(
        {cap_settings(),
         {{"positions", "", "exchange caps at the end of the usual search, which changes interaction only", true},
          accuracy_setting("interacting caps; from 0.02 on, caps that do not interact serve areas")}});
}

int design_asperities(const Settings& settings, const std::string& line) {
    CapRun run = cap_run_from(settings);
    const auto work = [&](const OutputFolder& output, const Interrupt& interrupt) {
        say_unreachable(run.unreachable, "these caps");
        ProgressLine progress;
        run.found = search(run.setup, run.options,
                           {recorder<rough::CapGenome>(run.stages),
                            ga::progress<rough::CapGenome>([&](const std::string& text) { progress.show(text); })});
        run.interrupted = interrupt.requested();
        run.found.stopped = stop_reason(run.found.stopped, run.interrupted);
        if (!run.interrupted) {
            progress.show("tolerance");
            run.other_model_error = 0;
            for (const rough::Target& target : run.setup.targets)
                run.other_model_error =
                    std::max(run.other_model_error,
                             (interaction_factor(run.setup, target, run.found.best.genome) - 1).abs().maxCoeff());
            run.tolerance =
                height_tolerance(run.setup, run.found.best.genome, run.options.seed, 100, run.options.threads);
        }
        run.summary = summary_of(run);
        run.seconds = run.clock.seconds();
        write_result(run, output.restored());
        write_tables(run, output.path());
    };
    return run_in_folder("asperities", line, settings, run, work);
}

} // namespace app
