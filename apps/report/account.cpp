#include "apps/report/account.hpp"

#include "apps/prompt/model_settings.hpp"
#include "domain/accuracy/error_bounds.hpp"

#include <sstream>

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

std::string grid_words(const rough::Account& account) {
    std::ostringstream words;
    const std::size_t count = account.grids.size();
    if (account.extrapolated()) {
        const auto first = count - static_cast<std::size_t>(account.read_grids);
        words << "Read off grids of ";
        for (std::size_t i = first; i < count; ++i)
            words << (i == first ? "" : i + 1 == count ? " and " : ", ") << account.grids[i];
        words << " nodes in place of " << account.resolved_nodes;
        if (first > 0)
            words << ", after " << first << " coarser one(s) that did not suffice";
        if (account.resolved_rows > 0)
            words << "; the first " << account.resolved_rows << " load steps, the lightest, on the "
                  << account.resolved_nodes << " nodes themselves";
    } else {
        words << "Solved on " << account.grids.back() << " nodes";
        if (count > 1)
            words << ", the resolved grid, as " << count - 1 << " coarser one(s) up to "
                  << account.grids[count - 2] << " nodes did not suffice";
    }
    return words.str();
}

} // namespace

std::string in_words(const rough::Account& account) {
    std::ostringstream words;
    words.precision(2);
    words << grid_words(account) << "; " << account.solved_rows << " of " << account.rows
          << " load steps solved by " << name_of(account.solver);
    if (account.solved_rows < account.rows)
        words << ", the others read between them within exact bounds";
    words << ". ";
    if (!account.used.empty()) {
        words << account.used.size() << " chromosome(s) modelled";
        if (!account.dropped.empty())
            words << ", " << account.dropped.size() << " shorter one(s) left out: gaps change by "
                  << account.window.lowest << " to " << account.window.highest << " mm, the curve by at most "
                  << account.dropped_error;
        words << ". ";
    }
    if (account.accuracy > 0)
        words << "Against the resolved model's the curve is off by an estimated " << account.estimated_error
              << " at most, relative, in pressure and secant stiffness; " << account.accuracy
              << " was asked for.";
    else
        words << "This is the model as given; what its grid leaves out was not estimated (--accuracy does).";
    return words.str();
}

json account_json(const rough::Account& account) {
    return {{"accuracy", account.accuracy > 0 ? json(account.accuracy) : json()},
            {"nodes", account.grids.back()},
            {"resolved_nodes", account.resolved_nodes},
            {"grids", account.grids},
            {"extrapolated", account.extrapolated()},
            {"steps", account.rows},
            {"solved_steps", account.solved_rows},
            {"resolved_steps", account.resolved_rows},
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
