#include "apps/commands/commands.hpp"
#include "apps/experiments/chart/course.hpp"
#include "apps/experiments/chart/growth.hpp"
#include "apps/experiments/chart/left_out.hpp"
#include "apps/experiments/chart/page.hpp"
#include "apps/experiments/chart/plots.hpp"
#include "apps/prompt/interrupt.hpp"
#include "apps/prompt/progress.hpp"
#include "apps/prompt/settings.hpp"
#include "apps/prompt/voice.hpp"
#include "apps/report/output.hpp"
#include "domain/text/atomic_file.hpp"

#include <chrono>

namespace app {

namespace {

std::vector<Setting> chart_settings() {
    return {
        {"out", "", "folder to write [out/chart]"},
        {"minutes", "10",
         "begin nothing that would not end within so many; the coarsest grid is always done"},
        {"quick", "", "fewer and smaller grids: under a minute", true},
        {"force", "", "write over an existing chart", true},
    };
}

/// chart.csv as it grows, every few seconds.
class GrowingTable {
  public:
    explicit GrowingTable(std::filesystem::path file) : file_(std::move(file)) {}
    void grow(const ChartData& data) {
        using namespace std::chrono_literals;
        if (data.runs.empty())
            return;
        if (const auto now = std::chrono::steady_clock::now(); now - written_ > 3s) {
            rough::write_atomically(file_, chart_csv(data));
            written_ = now;
        }
    }

  private:
    std::filesystem::path file_;
    std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

void write_pictures(const ChartData& data, const std::filesystem::path& folder) {
    for (const ErrorKind& kind : error_kinds)
        for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
            rough::write_atomically(folder / (data.scenes[scene].name + "-" + kind.name + ".svg"),
                                    svg_file(error_plot(data, scene, kind)));
    for (const auto& [name, plot] : growth_plots(data))
        rough::write_atomically(folder / ("growth-" + name + ".svg"), svg_file(plot));
}

} // namespace

int chart(const Words& words) {
    if (shows_help(
            words, "chart [--out DIR] [--minutes M] [--quick]",
            "Charts the time of a pressure curve against its error for every contact solver, grid, number of "
            "load steps and tolerance, on scenes with a known or a refined solution: from coarse grids to "
            "fine, so that a chart that ends early has the same of every scene. Writes chart.csv (as it "
            "goes), growth.csv, pictures (SVG) and chart.html, which says in words which method to take "
            "when, and what was left out and why. Ctrl-C ends it with what there is.",
            chart_settings(), {"chart --quick --out out/chart", "chart --minutes 3 --out out/chart"}))
        return 0;
    const Settings settings = read_command_line(words, chart_settings());
    const double minutes = settings.positive("minutes");
    const OutputFolder folder(
        settings.text("out"), "chart",
        {{"chart.csv", "growth.csv", "chart.html", "*.svg"}, {}, settings.is_on("force")});
    const Interrupt interrupt;
    GrowingTable table(folder.path() / "chart.csv");
    ChartData data;
    {
        Progress progress;
        data = charted(chart_scenes(), settings.is_on("quick") ? quick_extent() : whole_extent(),
                       {60 * minutes, [&] { return interrupt.asked(); },
                        [&](const ChartData& so_far, const std::string& where) {
                            progress.show(where);
                            table.grow(so_far);
                        }});
        if (data.runs.empty()) {
            say("interrupted before the first curve: nothing written");
            return exit_interrupted;
        }
        progress.show("pictures");
        rough::write_atomically(folder.path() / "chart.csv", chart_csv(data));
        rough::write_atomically(folder.path() / "growth.csv", growth_csv(data));
        write_pictures(data, folder.path());
        rough::write_atomically(folder.path() / "chart.html", chart_page(data));
    }
    const std::string left_out = left_out_in_a_line(data);
    say(std::to_string(data.runs.size()) + " settings charted" + (left_out.empty() ? "" : "; " + left_out) +
        "\n" + (folder.path() / "chart.html").string());
    return interrupt.asked() ? exit_interrupted : 0;
}

} // namespace app
