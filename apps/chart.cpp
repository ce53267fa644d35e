#include "apps/chart_page.hpp"
#include "apps/commands.hpp"
#include "apps/model_settings.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/settings.hpp"
#include "apps/voice.hpp"
#include "domain/atomic_file.hpp"

namespace app {

namespace {

using rough::Index;
using rough::Solver;

std::vector<Setting> chart_settings() {
    return {
        {"out", "", "folder to write [out/chart]"},
        {"quick", "", "fewer and smaller grids: under a minute", true},
        {"force", "", "write over an existing chart", true},
    };
}

/// What is tried: how fine, and how long one curve may take.
struct Extent {
    std::vector<Index> nodes, growth_nodes;
    std::vector<int> steps;         ///< besides 20, at one grid size
    std::vector<double> tolerances; ///< of the iterative methods
    Index most_for_nnls, most_for_truth;
    double limit; ///< s
};

const Extent quick{{128, 512, 2048}, {256, 512, 1024, 2048}, {5, 80}, {1e-3, 1e-6}, 512, 16385, 3};
const Extent whole{{128, 256, 512, 1024, 2048, 4096, 8192, 16384, 65536},
                   {256, 512, 1024, 2048, 4096, 8192, 16384},
                   {5, 10, 40, 80, 160},
                   {1e-3, 1e-4, 1e-6, 1e-8},
                   4096,
                   32769,
                   60};

bool is_iterative(Solver method) { return method == Solver::polonsky_keer || method == Solver::active_set; }

std::vector<ChartRun> runs_of(const ChartScene& scene, const ChartTruth& truth, const Extent& extent,
                              Progress& progress) {
    std::vector<ChartRun> runs;
    for (std::size_t m = 0; m < solver_names().size(); ++m) {
        const Solver method = static_cast<Solver>(m);
        const std::vector<double> tolerances =
            is_iterative(method) ? extent.tolerances : std::vector<double>{0};
        for (const Index nodes : extent.nodes) {
            if (method == Solver::nnls && nodes > extent.most_for_nnls)
                continue;
            progress.show(scene.name + ": " + solver_names()[m] + ", N = " + std::to_string(nodes));
            for (const double tolerance : tolerances)
                runs.push_back(run_chart(scene, &truth, method, nodes, 20, tolerance, extent.limit));
            if (nodes != 512 && nodes != 2048)
                continue;
            for (const int steps : extent.steps)
                runs.push_back(run_chart(scene, &truth, method, nodes, steps, is_iterative(method) ? 1e-6 : 0,
                                         extent.limit));
        }
    }
    return runs;
}

std::vector<ChartRun> growth_of(const ChartScene& scene, const Extent& extent, Progress& progress) {
    std::vector<ChartRun> runs;
    for (const Solver method : {Solver::nested, Solver::nnls, Solver::polonsky_keer, Solver::active_set})
        for (const Index nodes : extent.growth_nodes)
            for (const double share : {0.25, 0.5, 1.0}) {
                if (method == Solver::nnls && nodes > extent.most_for_nnls * 2)
                    continue;
                progress.show("growth: " + name_of(method) + ", N = " + std::to_string(nodes));
                runs.push_back(run_chart(scene, nullptr, method, nodes, 20, is_iterative(method) ? 1e-6 : 0,
                                         extent.limit, share));
            }
    return runs;
}

ChartData charted(const Extent& extent, Progress& progress) {
    ChartData data;
    for (const ChartScene& scene : chart_scenes()) {
        progress.show(scene.name + ": reference");
        const ChartTruth truth = truth_of(scene, extent.most_for_truth);
        data.scenes.emplace_back(scene.name, scene.words + "; measured against " + truth.origin);
        for (ChartRun& run : runs_of(scene, truth, extent, progress))
            data.runs.push_back(std::move(run));
        if (scene.name == "mwm-rough")
            data.growth = growth_of(scene, extent, progress);
    }
    return data;
}

} // namespace

int chart(const Words& words) {
    if (shows_help(words, "chart [--out DIR] [--quick]",
                   "Charts the time of a pressure curve against its error for every contact solver, grid, "
                   "number of load\n"
                   "steps and tolerance, on scenes with a known or a refined solution. Writes chart.csv, "
                   "growth.csv,\n"
                   "pictures (SVG) and chart.html, which says in words which method to take when.",
                   chart_settings(), {"chart --quick --out out/chart"}))
        return 0;
    const Settings settings = read_command_line(words, chart_settings());
    const OutputFolder folder(settings.text("out"), "chart", settings.is_on("force"), "chart.csv");
    Progress progress;
    const ChartData data = charted(settings.is_on("quick") ? quick : whole, progress);
    rough::write_atomically(folder.path() / "chart.csv", chart_csv(data.runs));
    rough::write_atomically(folder.path() / "growth.csv", growth_csv(data.growth));
    progress.show("pictures");
    for (const auto& scene : data.scenes) {
        const auto picture = [&](const char* kind, double ChartRun::*error, const char* label) {
            rough::write_atomically(folder.path() / (scene.first + "-" + kind + ".svg"),
                                    svg_file(chart_plot(data, scene.first, error, label)));
        };
        picture("pressure", &ChartRun::error_pressure, "Error of the pressure");
        picture("stiffness", &ChartRun::error_stiffness, "Error of the stiffness");
        picture("contact", &ChartRun::error_contact, "Error of the contact fraction");
    }
    rough::write_atomically(folder.path() / "growth-nodes.svg", svg_file(nodes_plot(data)));
    rough::write_atomically(folder.path() / "growth-contact.svg", svg_file(contact_plot(data)));
    rough::write_atomically(folder.path() / "chart.html", chart_page(data));
    say(std::to_string(data.runs.size()) + " settings charted\n" + (folder.path() / "chart.html").string());
    return 0;
}

} // namespace app
