#include "apps/experiments/stability/page.hpp"

#include "apps/prompt/model_settings.hpp"
#include "apps/report/page.hpp"
#include "apps/report/units.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace app {

namespace {

constexpr std::array outcomes{Outcome::solved, Outcome::refused, Outcome::not_converged, Outcome::wrong};

long count(const std::vector<StabilityCell>& cells, const std::string& method, Outcome outcome) {
    return std::count_if(cells.begin(), cells.end(), [&](const StabilityCell& cell) {
        return (method.empty() || cell.method == method) && cell.trial.outcome == outcome;
    });
}

Table by_method(const std::vector<StabilityCell>& cells) {
    Table table{"Each method over all scenes", {"Method"}, {}, {false}};
    for (const Outcome outcome : outcomes) {
        table.header.push_back(name_of(outcome));
        table.numeric.push_back(true);
    }
    table.header.emplace_back("unsolved though there is a solution");
    table.numeric.push_back(true);
    for (const std::string& method : rough::solver_names()) {
        std::vector<Html> row{method};
        for (const Outcome outcome : outcomes)
            row.push_back(std::to_string(count(cells, method, outcome)));
        row.push_back(
            std::to_string(std::count_if(cells.begin(), cells.end(), [&](const StabilityCell& cell) {
                return cell.method == method && cell.has_solution && cell.trial.outcome != Outcome::solved;
            })));
        table.rows.push_back(row);
    }
    return table;
}

/// A row a scene and kernel, a column a method: outcome, and the time where solved.
Table by_scene(const std::vector<StabilityCell>& cells) {
    Table table{"Every scene", {"Scene", "Kernel"}, {}};
    for (const std::string& method : rough::solver_names())
        table.header.push_back(method);
    for (std::size_t first = 0; first < cells.size(); first += rough::solver_names().size()) {
        std::vector<Html> row{cells[first].scene, cells[first].kernel};
        for (std::size_t k = first; k < first + rough::solver_names().size(); ++k) {
            const ContactTrial& trial = cells[k].trial;
            row.push_back(trial.outcome == Outcome::solved
                              ? Html(brief(1000 * trial.seconds) + " ms")
                              : Html::raw("<b>" + name_of(trial.outcome) + "</b>"));
        }
        table.rows.push_back(row);
    }
    return table;
}

Table complaints(const std::vector<StabilityCell>& cells) {
    Table table{"What rugosa says", {"Scene", "Kernel", "Methods", "Outcome", "Words"}, {}, {}, true};
    std::map<std::string, std::size_t> known;
    for (const StabilityCell& cell : cells) {
        if (cell.trial.outcome == Outcome::solved)
            continue;
        const auto [entry, is_new] =
            known.emplace(cell.scene + "\n" + cell.kernel + "\n" + cell.trial.message, table.rows.size());
        if (is_new)
            table.rows.push_back(
                {cell.scene, cell.kernel, cell.method, name_of(cell.trial.outcome), cell.trial.message});
        else
            table.rows[entry->second][2] += ", " + cell.method;
    }
    return table;
}

} // namespace

std::string summary_of(const std::vector<StabilityCell>& cells) {
    std::string text = std::to_string(cells.size()) + " cells:";
    for (const Outcome outcome : outcomes)
        text += (outcome == outcomes.front() ? " " : ", ") + std::to_string(count(cells, "", outcome)) + " " +
                name_of(outcome);
    return text;
}

std::string stability_page(const std::vector<StabilityCell>& cells) {
    Page page("Where contact methods fail",
              "Every solver on scenes made to break it. A result counts as solved only where it carries its "
              "certificate and a second opinion agrees; otherwise the program says so and gives no curve.");
    page.prose(summary_of(cells) + ".");
    page.table(by_method(cells));
    page.prose(
        "On up to 256 nodes the second opinion is an oracle in extended precision that shares no code "
        "with the solvers; direct methods are held to 1e-9 and iterative ones to ten times their "
        "tolerance of 1e-6, in pressure and tangent stiffness, and to its number of contact nodes. On "
        "larger grids the direct and the iterative method verifier each other. A cell ends after 30 s.");
    page.section("Scene by scene");
    page.table(by_scene(cells));
    if (const Table said = complaints(cells); !said.rows.empty()) {
        page.section("Refused or not converged");
        page.table(said);
    }
    return page.html();
}

} // namespace app
