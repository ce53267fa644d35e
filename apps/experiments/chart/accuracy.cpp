#include "apps/experiments/chart/accuracy.hpp"

#include "apps/experiments/chart/plots.hpp"
#include "apps/experiments/chart/words.hpp"
#include "apps/experiments/statistics.hpp"

namespace app {

namespace {

/// By what an error is divided on going from one setting to another, over the scenes.
std::vector<double> gains(const ChartData& data, const ErrorKind& kind, const ChartSetting& from,
                          const ChartSetting& to) {
    std::vector<double> gains;
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        ChartSetting a = from, b = to;
        a.scene = b.scene = scene;
        const ChartRun *before = data.at(a), *after = data.at(b);
        if (before && after && before->*kind.value > 0 && after->*kind.value > 0)
            gains.push_back(before->*kind.value / (after->*kind.value));
    }
    return gains;
}

const ChartSetting base{0, rough::Solver::active_set, 512, usual_steps, usual_tolerance};

ChartSetting finer() {
    ChartSetting setting = base;
    setting.nodes = 2048;
    return setting;
}
ChartSetting more_steps() {
    ChartSetting setting = base;
    setting.steps = 80;
    return setting;
}
ChartSetting looser() {
    ChartSetting setting = base;
    setting.tolerance = 1e-3;
    return setting;
}

} // namespace

std::string accuracy_in_words(const ChartData& data) {
    const ErrorKind &pressure = error_kinds[0], &stiffness = error_kinds[1];
    const auto pressure_by_grid = gains(data, pressure, base, finer()),
               stiffness_by_grid = gains(data, stiffness, base, finer()),
               stiffness_by_steps = gains(data, stiffness, base, more_steps());
    if (pressure_by_grid.empty() || stiffness_by_steps.empty())
        return "";
    std::string text =
        "<b>The pressure</b> at a load step is as good as the grid: going from N = 512 to 2048 divides "
        "its error by " +
        range_words(pressure_by_grid) +
        " over the scenes. <b>The stiffness</b> is read between load steps: going from 20 to 80 of "
        "them divides its error by " +
        range_words(stiffness_by_steps) + ", the finer grid by " + range_words(stiffness_by_grid) + ", so " +
        (median(stiffness_by_steps) > median(stiffness_by_grid) ? "add load steps" : "refine the grid") +
        " first.";
    std::vector<double> times, worse;
    for (const double gain : gains(data, pressure, base, looser()))
        worse.push_back(1 / gain);
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene) {
        ChartSetting tight = base, loose = looser();
        tight.scene = loose.scene = scene;
        const ChartRun *a = data.solved(tight), *b = data.solved(loose);
        if (a && b)
            times.push_back(b->seconds / a->seconds);
    }
    if (!times.empty())
        text += " <b>A tolerance</b> of 1e-3 in place of 1e-6 makes active-set take " + range_words(times) +
                " times as long at N = 512, and the pressure's error " + range_words(worse) +
                " times as large.";
    return text;
}

Table what_limits(const ChartData& data) {
    Table table{"Errors of active-set at N = 512 with 20 load steps and a tolerance of 1e-6, and with one of "
                "them changed",
                {"Scene", "Error of the", "as it is", "N = 2048", "tolerance 1e-3", "80 steps"},
                {},
                {false, false, true, true, true, true}};
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const ErrorKind* kind : {&error_kinds[0], &error_kinds[1]}) {
            std::vector<std::string> row{data.scenes[scene].name, kind->name};
            for (ChartSetting setting : {base, finer(), looser(), more_steps()}) {
                setting.scene = scene;
                const ChartRun* run = data.at(setting);
                row.push_back(run && kind->compares(*run) ? share_words(run->*(kind->value)) : "–");
            }
            table.rows.push_back(row);
        }
    return table;
}

} // namespace app
