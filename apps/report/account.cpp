#include "apps/report/account.hpp"

#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/contact/names.hpp"

namespace app {

namespace {

using nlohmann::json;

json chromosomes_json(const std::vector<rough::ChromosomePlace>& places) {
    json list = json::array();
    for (const auto& place : places)
        list.push_back({{"series", place.series},
                        {"n", place.n},
                        {"wave_length_mm", place.wave_length_mm},
                        {"amplitude_mm", place.amplitude_mm}});
    return list;
}

} // namespace

json account_json(const rough::Account& account) {
    return {{"accuracy", account.accuracy > 0 ? json(account.accuracy) : json()},
            {"nodes", account.grids.back()},
            {"resolved_nodes", account.resolved_nodes},
            {"grids", account.grids},
            {"extrapolated", account.extrapolated()},
            {"steps", account.rows},
            {"solved_steps", account.solved_rows},
            {"resolved_steps", account.resolved_rows},
            {"light_steps", account.light_rows},
            {"chromosomes",
             {{"used", chromosomes_json(account.used)},
              {"dropped", chromosomes_json(account.dropped)},
              {"window_mm", {account.window.lowest, account.window.highest}},
              {"bound", account.dropped_error}}},
            {"solver", name_of(account.solver)},
            {"tolerance", account.tolerance},
            {"seconds", account.seconds},
            {"estimated_error", account.estimated_error},
            {"grid_error", account.grid_error},
            {"step_error", account.step_error},
            {"solver_error", account.solver_error},
            {"area_error", account.area_error},
            {"by_line", account.by_line},
            {"line_error", account.line_error},
            {"aspect_ratio", account.aspect_ratio},
            {"nodes_at_hardness", account.held_nodes},
            {"words", in_words(account)}};
}

json modelled_json(const rough::Genome& genome, const rough::Model& model) {
    const rough::AccountedResponse found = respond_accounted(genome, model);
    json result = account_json(found.account);
    result.erase("seconds"); // of this one curve; the search's own stand beside
    result["true_error"] =
        model.accuracy > 0
            ? rough::relative_error(found.response.pressure, respond(genome, exactly(model)).pressure)
            : 0.0;
    return result;
}

} // namespace app
