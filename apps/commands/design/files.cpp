#include "apps/commands/design/run.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/surface.hpp"
#include "domain/numerics/statistics.hpp"

#include <boost/algorithm/string/replace.hpp>

namespace rough {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, name, similarity, decides)
} // namespace rough

namespace app {
namespace {

using nlohmann::json;

json answer_json(const rough::Answer& answer) {
    return {{"similarity", answer.similarity},
            {"similarity_refined", answer.refined},
            {"similarity_finest", answer.both},
            {"similarity_worst", answer.worst},
            {"similarity_made", answer.similarity_made},
            {"difference", answer.difference},
            {"genome", rough::genome_to_json(answer.genome)}};
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
    for (const rough::MissedPoint& missed : morphed.missed) {
        const rough::Target& target = run.setup.targets[missed.target];
        result["out_of_reach"].push_back(
            {{"target", target.name}, {columns_of(target.quantity).x, missed.x}, {"misfit", missed.misfit}});
    }
    return result;
}

json design_json(const DesignRun& run) {
    VariantRun variant = variant_run(run.found.name, run.found, run.stages, run.seconds);
    variant.answer.response = run.response.responses.front();
    json result = result_json(run.origin, run.setup, {variant});
    result.update(record_json(run, run.setup.targets,
                              std::string(run.found.best.on_finer.empty() ? "" : " finer") +
                                  (run.found.best.is_verified() ? " verified" : "") + (run.from ? " before" : "")));
    result["is_2d"] = run.setup.model.grid.is_2d();
    result["required_similarity"] = run.setup.required_similarity;
    result["verified"] = run.found.best.is_verified();
    result["accounts"] = run.accounts;
    result["like"] = run.setup.measured ? json(run.setup.measured->nodes()) : json();
    result["summary"].update(
        {{"lowest", run.summary.verified}, {"unrequested_errors", run.unrequested_errors.value_or(Shares())}});

    json& answer = result["variants"][run.found.name];
    answer["stopped"] = run.found.stopped;
    answer["alternatives"] = answer["front"] = answer["made"] = json::array();
    for (const auto& alternative : run.found.alternatives) answer["alternatives"].push_back(answer_json(alternative));
    for (const rough::Compromise& one : run.found.front) // similarities in the order of `targets`
        answer["front"].push_back({{"similarity", one.similarity},
                                   {"similarity_refined", one.similarity_refined},
                                   {"genome", rough::genome_to_json(one.genome)}});
    for (const rough::Answer& one : run.found.made) answer["made"].push_back(answer_json(one));
    answer["margins"] = json::array();
    for (const auto& margin : run.margins)
        answer["margins"].push_back({{"name", margin.name},
                                     {"limit", margin.is_limited() ? json(margin.limit) : json()},
                                     {"value", margin.value},
                                     {"margin", margin.is_limited() ? json(margin.margin()) : json()},
                                     {"holds", margin.holds()}});
    result["limits_given"] = run.limits_given;
    answer["within_limits"] = run.found.best.within_limits;
    answer["morph"] = run.morphed ? morph_json(run) : json();
    answer["tolerance"] = run.tolerance ? tolerance_json(*run.tolerance) : json();
    answer["trust"] = run.trust ? trust_json(*run.trust) : json();
    return result;
}

constexpr std::size_t max_surfaces = 6; ///< answers whose heights are drawn

/// Curves and, at the targets' points, misfits; x and y in the units of columns_of(target). Drawn are the
/// answer's response, that on a grid four times finer if it was verified there, and that of the surface in
/// production. The verified misfit is that of the finest curve with its estimated error, which decides.
void write_curves(const DesignRun& run, const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, rough::DesignResponse>> responses{{"answer", run.response}};
    if (const auto& finer = run.found.best.on_finer; !finer.empty())
        responses.emplace_back("finer", design_response(run.setup, finer));
    if (run.from) responses.emplace_back("before", respond(run.setup, run.from->genome, run.setup.model));
    Csv curves("target,curve,x,y"), points("target,x,y,lower,upper,misfit,misfit_verified");
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t) {
        const rough::Target& target = run.setup.targets[t];
        const rough::WrittenColumns columns = columns_of(target);
        Eigen::VectorXd designed, verified = Eigen::VectorXd::Constant(target.points(), NAN);
        if (run.found.best.is_verified()) verified = run.found.best.largest[t] / target.weight;
        for (const auto& [name, response] : responses) {
            const rough::Curve curve = to_its_end(response.curves[t]);
            curves.points(curve.x / columns.x_unit, curve.y / columns.y_unit, t + 1, name);
            if (name == "answer") designed = misfit(target, response.curves[t]) / target.weight;
        }
        add_points(points, t + 1, target, designed, verified);
    }
    rough::write_atomically(folder / "curves.csv", curves.text());
    rough::write_atomically(folder / "points.csv", points.text());
}

/// Heights below the highest point of each answer, and of the scan if one was given.
void write_heights(const DesignRun& run, const std::filesystem::path& folder) {
    const rough::Grid& grid = run.setup.model.grid;
    std::vector<std::pair<std::string, rough::Profile>> surfaces;
    if (run.setup.measured) surfaces.emplace_back("scan", *run.setup.measured);
    for (std::size_t i = 0; i < std::min(max_surfaces, run.found.alternatives.size()); ++i)
        surfaces.emplace_back(std::to_string(i + 1), sample(run.found.alternatives[i].genome, grid));
    if (surfaces.empty()) return;
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

/// The labels of a target's axes in the units of its file, as the figures read them: the word `own` and
/// two texts in quotes.
std::string labels_of(const rough::Target& target) {
    if (!target.written) return "";
    static const std::pair<const char*, const char*> signs[] = {{"_per_", "/"}, {"m2K", "(m²K)"}, {"m2", "m²"},
                                                                {"um", "µm"},   {"uN", "µN"},     {"percent", "%"}};
    static const std::map<std::string, std::string> names{{"pressure", "Mean pressure p"},
                                                          {"load", "Load"},
                                                          {"normal", "Load"},
                                                          {"displacement", "Displacement"},
                                                          {"contact", "Contact area A"},
                                                          {"contact_fraction", "Contact fraction A"},
                                                          {"area", "Contact area"},
                                                          {"friction", "Friction"},
                                                          {"shear", "Friction"},
                                                          {"stiffness", "Stiffness K"},
                                                          {"interface_stiffness", "Interface stiffness K_i"},
                                                          {"conductance", "Conductance"}};
    std::string labels = " own";
    for (const std::string& column : {target.written->x, target.written->y}) {
        std::string what = column, unit;
        if (!names.contains(column)) {
            const std::size_t cut = column.rfind('_', column.find("_per_") - 1);
            what = column.substr(0, cut), unit = column.substr(cut + 1);
        }
        for (const auto& [from, to] : signs) boost::replace_all(unit, from, to);
        labels += " \"" + names.at(what) + (unit.empty() ? "" : " (" + unit + ")") + "\"";
    }
    return labels;
}

} // namespace

json trust_json(const rough::Trust& trust) {
    const std::vector<double> checked = rough::column(trust.checks, &rough::Check::similarity);
    return {{"checks", trust.checks},
            {"median", rough::median(checked)},
            {"tenth_percentile", rough::quantile(checked, 0.1)},
            {"other_kernels", trust.kernels},
            {"phases_redrawn",
             {{"draws", trust.redrawn.size()},
              {"best", rough::quantile(trust.redrawn, 1)},
              {"median", rough::median(trust.redrawn)},
              {"tenth_percentile", rough::quantile(trust.redrawn, 0.1)}}},
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

void add_points(Csv& points, std::size_t number, const rough::Target& target, const Eigen::VectorXd& misfits,
                const Eigen::VectorXd& verified) {
    const rough::WrittenColumns columns = columns_of(target);
    const auto end = [&](const Eigen::VectorXd& values, rough::Index k) {
        return target.has_band() ? values[k] / columns.y_unit : NAN;
    };
    for (rough::Index k = 0; k < target.points(); ++k)
        points.row(number, target.x[k] / columns.x_unit, target.y[k] / columns.y_unit, end(target.lower, k),
                   end(target.upper, k), misfits[k], verified[k]);
}

json record_json(const DesignRecord& run, const std::vector<rough::Target>& targets, const std::string& curves) {
    json result = origin_json(run.origin);
    for (const rough::Target& target : targets) {
        json shown = target_json(target);
        const std::string quantity =
            rough::is_contact_fraction(target.quantity) ? "contact_fraction" : name_of(target.quantity);
        shown["weight"] = target.weight;
        shown["file"] = std::filesystem::path(target.name).filename().string();
        shown["quantity"] = quantity;
        shown["figure"] = std::to_string(result["targets"].size() + 1) + " " + quantity +
                          (target.against_pressure() ? " pressure" : " displacement") + labels_of(target) + curves +
                          (target.has_band() ? " band" : "");
        result["targets"].push_back(std::move(shown));
    }
    result["target"] = result["targets"][0];
    result["verdict"] = run.summary.verdict;
    result["summary"]["found"] = run.summary.found;
    for (const Fact& fact : run.summary.facts) result["summary"][fact.key] = fact.text;
    result["interrupted"] = run.interrupted;
    result["out_of_reach"] = json::array();
    for (const auto& reason : run.unreachable.reasons)
        result["out_of_reach"].push_back({{"reason", reason.reason},
                                          {"at", reason.at},
                                          {"highest_similarity", reason.bound},
                                          {"on_this_grid", reason.on_this_grid}});
    return result;
}

void write_design_result(const DesignRun& run, const std::filesystem::path& folder) {
    write_json(folder / "result.json", design_json(run));
    if (!run.tolerance) return;
    Csv table("noise_rms_mm,quantile,median,draws"); // similarity of the draws
    for (const rough::NoiseQuantile& one : run.tolerance->curve)
        table.row(one.noise_rms, one.quantile, one.median, one.draws);
    rough::write_atomically(folder / "tolerance.csv", table.text());
}

void write_design_tables(const DesignRun& run, const std::filesystem::path& folder) {
    rough::write_atomically(folder / "answer.csv", csv(run.response.responses.front()));
    rough::write_atomically(folder / "genome.json",
                            rough::genome_file_text(run.found.best.genome, run.setup.model.grid.length));
    if (run.setup.model.grid.is_2d()) try { // a design is of use, even if its tile cannot be printed
            const rough::Grid& grid = run.setup.model.grid;
            const rough::Profile tile = sample(run.found.best.genome, grid);
            const rough::Extrusion extrusion{.periodic = grid.periodic};
            write_solids(tile, extrusion, folder, "surface");
            write_height_image(tile, extrusion, folder, "surface");
            say(print_note(tile, extrusion));
        } catch (const rough::InputError& error) {
            say(std::string("note: no solid of the surface is written: ") + error.what());
        }
}

void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder) {
    write_curves(run, folder);
    write_heights(run, folder);
    Csv front("similarity_1,similarity_2,refined_1,refined_2"), made("similarity,similarity_made");
    for (const rough::Compromise& one : run.found.front)
        front.row(one.similarity[0], one.similarity[1], one.similarity_refined[0], one.similarity_refined[1]);
    for (const rough::Answer& one : run.found.made) made.row(one.similarity, one.similarity_made);
    if (!run.found.front.empty()) rough::write_atomically(folder / "front.csv", front.text());
    if (!run.found.made.empty()) rough::write_atomically(folder / "made.csv", made.text());
}

} // namespace app
