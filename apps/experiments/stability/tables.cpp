#include "apps/experiments/stability/cells.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace app {

namespace {

using nlohmann::json;

constexpr std::array outcomes{Outcome::solved, Outcome::refused, Outcome::not_converged, Outcome::wrong};

template <class Counts>
long count(const std::vector<StabilityCell>& cells, Counts counts) {
    return std::count_if(cells.begin(), cells.end(), counts);
}

/// Outcomes of each method over all scenes.
json by_method(const std::vector<StabilityCell>& cells) {
    json rows = json::array();
    for (const std::string& method : rough::solver_names()) {
        json row{{"method", method}, {"missed", count(cells, [&](const StabilityCell& cell) {
                                          return cell.method == method && cell.has_solution &&
                                                 cell.trial.outcome != Outcome::solved;
                                      })}};
        for (const Outcome outcome : outcomes)
            row["outcomes"].push_back(count(cells, [&](const StabilityCell& cell) {
                return cell.method == method && cell.trial.outcome == outcome;
            }));
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Each scene and kernel with one cell per method.
json by_scene(const std::vector<StabilityCell>& cells) {
    json rows = json::array();
    const std::size_t methods = rough::solver_names().size();
    for (std::size_t first = 0; first < cells.size(); first += methods) {
        json row{{"scene", cells[first].scene}, {"kernel", cells[first].kernel}};
        for (std::size_t k = first; k < first + methods; ++k) {
            const ContactTrial& trial = cells[k].trial;
            const bool solved = trial.outcome == Outcome::solved;
            row["cells"].push_back({{"milliseconds", solved ? json(1000 * trial.seconds) : json()},
                                    {"failure", solved ? "" : name_of(trial.outcome)}});
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// Messages of the cells that were not solved; equal ones of a scene once, with their methods.
json messages(const std::vector<StabilityCell>& cells) {
    std::vector<json> rows;
    std::map<std::string, std::size_t> known;
    for (const StabilityCell& cell : cells) {
        if (cell.trial.outcome == Outcome::solved)
            continue;
        const auto [entry, is_new] =
            known.emplace(cell.scene + "\n" + cell.kernel + "\n" + cell.trial.message, rows.size());
        if (is_new)
            rows.push_back({{"scene", cell.scene},
                            {"kernel", cell.kernel},
                            {"methods", cell.method},
                            {"outcome", name_of(cell.trial.outcome)},
                            {"message", cell.trial.message}});
        else
            rows[entry->second]["methods"] =
                rows[entry->second]["methods"].get<std::string>() + ", " + cell.method;
    }
    return rows;
}

} // namespace

std::string summary_of(const std::vector<StabilityCell>& cells) {
    std::string text = std::to_string(cells.size()) + " cells:";
    for (const Outcome outcome : outcomes)
        text +=
            (outcome == outcomes.front() ? " " : ", ") +
            std::to_string(count(cells, [&](const auto& cell) { return cell.trial.outcome == outcome; })) +
            " " + name_of(outcome);
    return text;
}

void write_stability(const std::vector<StabilityCell>& cells, const Origin& origin,
                     const std::filesystem::path& folder) {
    Csv table("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message", 6);
    for (const StabilityCell& cell : cells) {
        const ContactTrial& trial = cell.trial;
        std::optional<double> residual;
        if (!trial.curve.steps.empty())
            residual = trial.kkt_residual();
        table.row(cell.scene, cell.kernel, cell.method, name_of(trial.outcome), residual,
                  trial.curve.iterations, trial.seconds, trial.message);
    }
    rough::write_atomically(folder / "stability.csv", table.text());
    json result = origin_json(origin);
    result["summary"] = summary_of(cells);
    for (const Outcome outcome : outcomes)
        result["outcomes"].push_back(name_of(outcome));
    result["methods"] = by_method(cells);
    result["scenes"] = by_scene(cells);
    result["messages"] = messages(cells);
    result["runs"] = table.rows();
    write_json(folder / "result.json", result);
}

} // namespace app
