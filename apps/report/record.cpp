#include "apps/report/record.hpp"

#include "domain/design/search.hpp"
#include "domain/numerics/vector_loops.hpp"

namespace rough {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PlacedWave, series, n, wave_length_mm, amplitude_mm)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AccuracyReport, resolved_nodes, grids, tolerance, seconds, estimated_error,
                                   grid_error, step_error, solver_error, area_error, tangent_error, by_line, line_error,
                                   aspect_ratio)
} // namespace rough

namespace app {

using nlohmann::json;

json account_json(const rough::AccuracyReport& account) {
    json result = account;
    result.update({{"accuracy", account.accuracy > 0 ? json(account.accuracy) : json()},
                   {"nodes", account.grids.back()},
                   {"extrapolated", account.extrapolated()},
                   {"steps", account.rows},
                   {"solved_steps", account.solved_rows},
                   {"resolved_steps", account.resolved_rows},
                   {"light_steps", account.light_rows},
                   {"chromosomes",
                    {{"used", account.used},
                     {"dropped", account.dropped},
                     {"window_mm", {account.window.lowest, account.window.highest}},
                     {"bound", account.dropped_error}}},
                   {"solver", name_of(account.solver)},
                   {"nodes_at_hardness", account.held_nodes},
                   {"words", in_words(account)}});
    return result;
}

namespace {

json variant_json(const VariantRun& variant, const rough::Model& model) {
    json stages = variant.stages;
    for (json& stage : stages) stage.erase("spent"), stage.erase("derived");
    json result = variant;
    result.update(
        {{"genome", genome_to_json(variant.answer.genome)}, {"stages", std::move(stages)}, {"notes", variant.notes}});
    if (!variant.pipeline.empty()) result["pipeline"] = variant.pipeline;
    if (model.body.kernel == rough::Kernel::free && !model.grid.is_2d())
        for (const double stiffness : variant.answer.response.tangent_stiffness)
            result["tangent_stiffness_per_ln_datum_MPa_per_mm"].push_back(
                rough::datum_sensitivity(stiffness, model.grid.length, model.body.effective_modulus));
    return result;
}

} // namespace

VariantRun variant_run(const std::string& name, const rough::SearchResult& found, std::vector<StageRecord> stages,
                       double seconds) {
    return {.name = name,
            .pipeline = found.pipeline,
            .stages = std::move(stages),
            .notes = found.notes,
            .answer = {found.best.genome, {}},
            .similarity = found.best.similarity,
            .similarity_refined = found.best.refined,
            .similarity_worst = found.best.worst,
            .seconds = seconds,
            .curves = found.counters.evaluations,
            .gradients = found.counters.gradients,
            .price = found.counters.price};
}

json model_json(const rough::Model& model) {
    json result = {{"nodes", model.grid.nodes},
                   {"length_mm", model.grid.length},
                   {"effective_modulus_MPa", model.body.effective_modulus},
                   {"kernel", name_of(model.body.kernel)},
                   {"datum_mm", nullptr},
                   {"strip_width_mm", nullptr},
                   {"steps", model.loading.steps},
                   {"reach", *model.loading.reach}};
    if (model.grid.is_2d()) {
        result["nodes"] = {model.grid.nodes, model.grid.rows};
        result["length_mm"] = {model.grid.length, model.grid.width};
    } else if (model.body.kernel == rough::Kernel::free)
        result["datum_mm"] = *model.body.datum;
    if (model.body.kernel == rough::Kernel::strip) result["strip_width_mm"] = *model.body.strip_width;
    if (const rough::Layering& layering = model.body.layering; !layering.layers.empty()) {
        result["layers"] = json::array();
        for (const rough::Layer& layer : layering.layers)
            result["layers"].push_back({{"thickness_mm", layer.thickness},
                                        {"modulus_MPa", layer.modulus},
                                        {"poissons_ratio", layer.poissons_ratio}});
        result["base"] = layering.rigid_base ? "rigid" : "elastic";
    }
    return result;
}

json target_json(const rough::Target& target) {
    const rough::Columns columns = columns_of(target.quantity);
    json points = json::array();
    for (rough::Index k = 0; k < target.points(); ++k) {
        points.push_back({{columns.x, target.x[k]}, {columns.y, target.y[k]}});
        if (target.has_band()) points.back()["lower"] = target.lower[k], points.back()["upper"] = target.upper[k];
    }
    return {{"name", target.name}, {"points", std::move(points)}};
}

json origin_json(const Origin& origin) {
    const rough::Build build = rough::build();
    json result = origin;
    result["version"] = RUGOSA_VERSION;
    result["build"] = {{"compiler", build.compiler}, {"flags", build.flags}, {"vectors", build.vectors}};
    return result;
}

json result_json(const Origin& origin, const rough::DesignSetup& setup, const std::vector<VariantRun>& variants) {
    json result = model_json(setup.model);
    result.update(origin_json(origin));
    result["max_pressure_MPa"] = setup.max_pressure ? json(*setup.max_pressure) : json();
    result["target"] = target_json(setup.targets.front());
    result["variants"] = json::object();
    for (const VariantRun& variant : variants) result["variants"][variant.name] = variant_json(variant, setup.model);
    return result;
}

} // namespace app
