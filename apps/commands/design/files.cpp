#include "apps/commands/design/run.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "apps/report/surface.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <cmath>

namespace rough {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, name, similarity, decides)
} // namespace rough

namespace app {

namespace {

using nlohmann::json;

json weighted_json(const rough::Target& goal) {
    json result = target_json(goal);
    result["weight"] = goal.weight;
    return result;
}

/// A target as the page shows it: its file's name, its quantity, what this is given against, and which curves
/// its figure has.
json shown_json(const DesignRun& run, std::size_t index) {
    const rough::Target& target = run.setup.targets[index];
    json result = weighted_json(target);
    const std::string quantity =
        rough::is_contact_fraction(target.quantity) ? "contact_fraction" : name_of(target.quantity);
    result["file"] = std::filesystem::path(target.name).filename().string();
    result["quantity"] = quantity;
    result["figure"] = std::to_string(index + 1) + " " + quantity +
                       (target.against_pressure() ? " pressure" : " displacement") +
                       (run.found.best.verification.on_finer.empty() ? "" : " finer") +
                       (run.from ? " before" : "") + (target.has_band() ? " band" : "");
    return result;
}

json answer_json(const rough::Answer& answer) {
    return {{"similarity", answer.similarity},
            {"similarity_refined", answer.similarity_refined},
            {"similarity_worst", answer.similarity_worst},
            {"similarity_made", answer.similarity_made},
            {"difference", answer.difference},
            {"genome", rough::genome_to_json(answer.genome)}};
}

json trust_json(const rough::Trust& trust) {
    return {{"checks", trust.checks},
            {"median", trust.median},
            {"tenth_percentile", trust.tenth},
            {"other_kernels", trust.kernels},
            {"phases_redrawn",
             {{"draws", trust.redrawn},
              {"best", trust.redrawn_best},
              {"median", trust.redrawn_median},
              {"tenth_percentile", trust.redrawn_tenth}}},
            {"rms_slope", trust.rms_slope},
            {"peak_pressure_MPa", trust.peak_pressure},
            {"shortest_wave_nodes", trust.shortest_wave_nodes},
            {"contact_at_ends", trust.contact_at_ends},
            {"flags", trust.flags},
            {"left_out_for_time", trust.left_out}};
}

json tolerance_json(const rough::Tolerance& tolerance) {
    json levels = json::array();
    for (const rough::ToleranceLevel& level : tolerance.levels)
        levels.push_back({{"similarity", level.similarity},
                          {"noise_rms_mm", level.noise_rms},
                          {"tilt_mm", level.tilt},
                          {"scale", level.scale}});
    return {{"noise_length_mm", tolerance.noise_length},
            {"share", rough::Tolerance::share},
            {"share_from", tolerance.share_from},
            {"share_to", tolerance.share_to},
            {"draws", tolerance.draws},
            {"similarity", tolerance.similarity},
            {"complete", tolerance.complete},
            {"levels", levels}};
}

/// Similarities in the order of `targets`.
json front_json(const std::vector<rough::Compromise>& front) {
    json all = json::array();
    for (const auto& one : front)
        all.push_back({{"similarity", one.similarity},
                       {"similarity_refined", one.similarity_refined},
                       {"genome", rough::genome_to_json(one.genome)}});
    return all;
}

json morph_json(const DesignRun& run) {
    const rough::Morphed& morphed = *run.morphed;
    json result{{"from", run.from->file},
                {"largest_change", run.from->largest_change},
                {"similarity_before", morphed.before},
                {"similarity_after", morphed.after},
                {"changes", json::array()},
                {"out_of_reach", json::array()}};
    for (const rough::PhaseChange& change : morphed.changes)
        result["changes"].push_back(
            {{"series", change.place.series + 1},
             {"chromosome", change.n},
             {"ridge", change.place.ridge + 1},
             {"wave_length_mm", rough::wave_length(run.from->genome.series[change.place.series], change.n)},
             {"change", change.after - change.before},
             {"before", change.before},
             {"after", change.after},
             {"at_limit", change.at_limit}});
    for (const rough::PointOff& off : morphed.off) {
        const rough::Target& target = run.setup.targets[off.target];
        result["out_of_reach"].push_back(
            {{"target", target.name}, {columns_of(target.quantity).x, off.x}, {"misfit", off.misfit}});
    }
    return result;
}

json design_json(const DesignRun& run) {
    VariantRun variant = variant_run(run.found.name, run.found, run.stages, run.seconds);
    variant.answer.response = run.own.responses.front();
    json result = result_json({run.origin,
                               run.searched.model,
                               loaded_models(run.searched),
                               run.setup.max_pressure,
                               run.setup.targets.front(),
                               {variant}});
    result["target"] = weighted_json(run.setup.targets.front());
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t)
        result["targets"].push_back(shown_json(run, t));
    result["is_2d"] = run.setup.model.grid.is_2d();
    result["required_similarity"] = run.setup.required_similarity;
    result["verified"] = run.found.best.is_verified();
    result["accounts"] = run.accounts;
    result["like"] = run.setup.like ? json(run.setup.like->nodes()) : json();
    result["verdict"] = run.summary.verdict;
    result["summary"] = summary_json(run);
    result["interrupted"] = run.interrupted;
    result["out_of_reach"] = json::array();
    for (const auto& reason : run.out_of_reach)
        result["out_of_reach"].push_back({{"reason", reason.reason},
                                          {"at", reason.at},
                                          {"highest_similarity", reason.bound},
                                          {"on_this_grid", reason.on_this_grid}});

    json& answer = result["variants"][run.found.name];
    answer["stopped"] = run.found.stopped;
    answer["alternatives"] = json::array();
    for (const auto& alternative : run.found.alternatives)
        answer["alternatives"].push_back(answer_json(alternative));
    if (!run.found.front.empty())
        answer["front"] = front_json(run.found.front);
    for (const rough::Answer& one : run.found.made)
        answer["made"].push_back(answer_json(one));
    answer["margins"] = json::array();
    for (const auto& margin : run.margins)
        answer["margins"].push_back({{"name", margin.name},
                                     {"limit", margin.limit > 0 ? json(margin.limit) : json()},
                                     {"value", margin.value},
                                     {"margin", margin.limit > 0 ? json(margin.margin()) : json()},
                                     {"holds", margin.holds()}});
    result["limits_given"] = run.limits_given;
    answer["within_limits"] = run.found.best.within_limits;
    if (run.morphed)
        answer["morph"] = morph_json(run);
    if (run.tolerance)
        answer["tolerance"] = tolerance_json(*run.tolerance);
    if (run.trust)
        answer["trust"] = trust_json(*run.trust);
    return result;
}

/// Similarity of the draws of noise.
void write_tolerance(const rough::Tolerance& tolerance, const std::filesystem::path& folder) {
    Csv table("noise_rms_mm,quantile,median,draws");
    for (const rough::NoiseQuantile& one : tolerance.curve)
        table.row(one.noise_rms, one.quantile, one.median, one.draws);
    rough::write_atomically(folder / "tolerance.csv", table.text());
}

/// A design stands, whether its tile can be printed or not.
void write_tile(const rough::Profile& surface, const std::filesystem::path& folder) {
    try {
        write_solids(solids_of(surface, {}), folder, "surface");
    } catch (const rough::InputError& error) {
        say(std::string("note: no solid of the surface is written: ") + error.what());
    }
}

} // namespace

void write_design_result(const DesignRun& run, const std::filesystem::path& folder) {
    write_json(folder / "result.json", design_json(run));
    if (run.tolerance)
        write_tolerance(*run.tolerance, folder);
}

void write_design_tables(const DesignRun& run, const std::filesystem::path& folder) {
    rough::write_atomically(folder / "answer.csv", csv(run.own.responses.front()));
    rough::write_atomically(folder / "genome.json",
                            rough::genome_file_text(run.found.best.genome, run.setup.model.grid.length));
    if (run.setup.model.grid.is_2d())
        write_tile(sample(run.found.best.genome, run.setup.model.grid), folder);
}

namespace {

constexpr std::size_t max_surfaces = 6; ///< answers whose heights are drawn

/// The responses that are drawn. `answer` is on the set-up's grid. `finer` is on a grid four times finer, if
/// the answer was verified there. `before` is that of the surface in production, if there is one.
std::vector<std::pair<std::string, rough::DesignResponse>> drawn_responses(const DesignRun& run) {
    std::vector<std::pair<std::string, rough::DesignResponse>> all{{"answer", run.own}};
    if (const auto& finer = run.found.best.verification.on_finer; !finer.empty())
        all.emplace_back("finer", scored(run.setup, finer));
    if (run.from)
        all.emplace_back("before", respond(run.setup, run.from->genome, run.setup.model));
    return all;
}

/// Curves and, at the targets' points, misfits over the weight; x and y in the units of the target's file.
void write_curves(const DesignRun& run, const std::filesystem::path& folder) {
    Csv curves("target,curve,x,y"), points("target,x,y,lower,upper,misfit,misfit_finer");
    const auto responses = drawn_responses(run);
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t) {
        const rough::Target& target = run.setup.targets[t];
        for (const auto& [name, response] : responses) {
            const rough::Curve curve = to_its_end(response.curves[t]);
            for (rough::Index k = 0; k < curve.x.size(); ++k)
                curves.row(t + 1, name, curve.x[k], curve.y[k]);
        }
        const auto misfits = [&](std::size_t of) -> Eigen::VectorXd {
            return responses.size() > of && responses[of].first != "before"
                       ? Eigen::VectorXd(misfit(target, responses[of].second.curves[t]) / target.weight)
                       : Eigen::VectorXd::Constant(target.points(), NAN);
        };
        const Eigen::VectorXd own = misfits(0), finer = misfits(1);
        for (rough::Index k = 0; k < target.points(); ++k)
            points.row(t + 1, target.x[k], target.y[k], target.has_band() ? target.lower[k] : NAN,
                       target.has_band() ? target.upper[k] : NAN, own[k], finer[k]);
    }
    rough::write_atomically(folder / "curves.csv", curves.text());
    rough::write_atomically(folder / "points.csv", points.text());
}

/// Heights below the highest point of each answer, and of the scan that was given, if there is one.
void write_heights(const DesignRun& run, const std::filesystem::path& folder) {
    const rough::Grid& grid = run.setup.model.grid;
    std::vector<std::pair<std::string, rough::Profile>> surfaces;
    if (run.setup.like)
        surfaces.emplace_back("scan", *run.setup.like);
    for (std::size_t i = 0; i < std::min(max_surfaces, run.found.alternatives.size()); ++i)
        surfaces.emplace_back(std::to_string(i + 1), sample(run.found.alternatives[i].genome, grid));
    if (surfaces.empty())
        return;
    if (grid.is_2d()) {
        std::vector<std::string> names;
        std::vector<Eigen::VectorXd> values;
        for (const auto& [name, surface] : surfaces) {
            names.push_back("height_" + name + "_mm");
            values.push_back(below_highest(surface));
        }
        if (run.trust) {
            names.emplace_back("pressure_MPa");
            values.emplace_back(Eigen::VectorXd::Constant(surfaces.back().second.nodes(), NAN));
            values.back()(run.trust->last.nodes) = run.trust->last.pressure;
        }
        rough::write_atomically(folder / "map.csv", map_csv(surfaces.back().second, names, values));
        return;
    }
    std::string table = "surface,x_mm,height_mm\n";
    for (const auto& [name, surface] : surfaces)
        table += drawn_rows(name, {positions(surface), below_highest(surface)});
    rough::write_atomically(folder / "heights-drawn.csv", table);
}

void write_front(const DesignRun& run, const std::filesystem::path& folder) {
    Csv table("similarity_1,similarity_2,refined_1,refined_2");
    for (const rough::Compromise& one : run.found.front)
        table.row(one.similarity[0], one.similarity[1], one.similarity_refined[0], one.similarity_refined[1]);
    rough::write_atomically(folder / "front.csv", table.text());
}

void write_made(const DesignRun& run, const std::filesystem::path& folder) {
    Csv table("similarity,similarity_made");
    for (const rough::Answer& one : run.found.made)
        table.row(one.similarity, one.similarity_made);
    rough::write_atomically(folder / "made.csv", table.text());
}

} // namespace

void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder) {
    write_curves(run, folder);
    write_heights(run, folder);
    if (!run.found.front.empty())
        write_front(run, folder);
    if (!run.found.made.empty())
        write_made(run, folder);
}

} // namespace app
