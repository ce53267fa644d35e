#include "apps/prompt/units.hpp"
#include "experiments/chart/chart.hpp"

#include <numbers>

namespace app {

using nlohmann::json;
using rough::Index;

namespace {

/// One of the errors that are charted.
struct ErrorKind {
    const char *name, *words;
    double ChartRun::*value;
    double ChartReference::*floor;
};
constexpr std::array<ErrorKind, 2> error_kinds{
    {{"stiffness", "the stiffness K", &ChartRun::error_stiffness, &ChartReference::floor_stiffness},
     {"contact", "the contact area", &ChartRun::error_contact, &ChartReference::floor_contact}}};
constexpr std::array wanted_errors{0.2, 0.1, 0.05, 0.02, 0.01, 0.001};

bool is_map(const ChartRun& run) { return run.setting.family == "map"; }
bool is_line_of_map(const ChartRun& run) {
    return run.setting.method.ends_with("-line") || run.setting.method == "section";
}

std::string sides(const ChartRun& run) {
    const std::string side = std::to_string(run.setting.side);
    return is_map(run) ? side + " x " + side : side;
}

/// The parts of a setting that are not defaults of the program, in brackets.
std::string extras(const ChartRun& run) {
    const ChartSetting& of = run.setting;
    const bool is_solver = of.family != "theory" && !is_line_of_map(run);
    const std::string words =
        (is_solver && of.method != "auto" ? ", " + of.method : "") +
        (of.tolerance > 0 ? ", tolerance " + brief(of.tolerance) : "") +
        (of.loads < static_cast<int>(ChartScene::counted) ? ", " + std::to_string(of.loads) + " loads" : "");
    return words.empty() ? "" : " (" + words.substr(2) + ")";
}

/// A theory's name as in texts: Greenwood-Williamson.
std::string titled(std::string name) {
    for (std::size_t i = 0; i < name.size(); ++i)
        if (i == 0 || name[i - 1] == '-') name[i] = static_cast<char>(std::toupper(name[i]));
    return name;
}

/// The label of a dot. It has no comma, at which gnuplot 5.4 ends it.
std::string label_of(const ChartRun& run) {
    const ChartSetting& of = run.setting;
    const std::string missing = run.answered < static_cast<int>(ChartScene::counted)
                                    ? " (" + std::to_string(run.answered) + " of 9 loads)"
                                    : "";
    if (of.family == "theory") return titled(of.method) + missing;
    if (is_line_of_map(run)) return (of.method == "section" ? "one section" : "mean line") + missing;
    std::string extra = extras(run);
    std::ranges::replace(extra, ',', ';');
    return (is_map(run) ? "" : "N = ") + sides(run) + extra + missing;
}

/// The model of a setting in a sentence.
std::string model_of(const ChartRun& run) {
    if (run.setting.family == "theory") return titled(run.setting.method) + "'s theory";
    if (is_line_of_map(run))
        return (run.setting.method == "section" ? "one section of " : "the mean line of ") +
               std::to_string(run.setting.side) + " nodes";
    return (is_map(run) ? "a map of " + sides(run) + " cells" : "a profile of " + sides(run) + " nodes") + extras(run);
}

/// A time in ms, s or µs.
std::string time_words(double seconds) {
    const double factor = seconds < 1e-3 ? 1e6 : seconds < 1 ? 1e3 : 1;
    return brief(factor * seconds) + (factor == 1 ? " s" : factor == 1e3 ? " ms" : " µs");
}
std::string percent_words(double share) { return brief(100 * share) + " %"; }

/// The runs of a scene with a known error.
std::vector<const ChartRun*> measured(const ChartData& data, std::size_t scene) {
    std::vector<const ChartRun*> runs;
    for (const ChartRun& run : data.runs)
        if (run.setting.scene == scene && run.outcome == Outcome::solved) runs.push_back(&run);
    return runs;
}

/// The fastest run with at most an error; null without one. The defaults of the program are preferred
/// unless they take half as long again.
const ChartRun* fastest(const std::vector<const ChartRun*>& runs, const ErrorKind& kind, double error) {
    const ChartRun* best = nullptr;
    const auto cost = [](const ChartRun& run) { return run.seconds / (extras(run).empty() ? 1.5 : 1); };
    for (const ChartRun* run : runs)
        if (run->*kind.value <= error && (!best || cost(*run) < cost(*best))) best = run;
    return best;
}

/// The most accurate run within a time; null without one.
const ChartRun* most_accurate(const std::vector<const ChartRun*>& runs, const ErrorKind& kind, double seconds) {
    const ChartRun* best = nullptr;
    for (const ChartRun* run : runs)
        if (run->seconds <= seconds && (!best || run->*kind.value < best->*kind.value)) best = run;
    return best;
}

/// The advice on a scene, in one or two sentences.
std::string advice(const ChartData& data, std::size_t scene, const ErrorKind& kind) {
    const auto runs = measured(data, scene);
    const double floor = data.references[scene].*kind.floor;
    const ChartRun* const best = most_accurate(runs, kind, HUGE_VAL);
    if (!best) return "Nothing was measured here.";
    const auto setting = [](const ChartRun& run) { return model_of(run) + ": " + time_words(run.seconds); };
    const ChartRun *const five = fastest(runs, kind, 0.05), *const one = fastest(runs, kind, 0.01);
    std::string words = five ? std::string("For 5 % error in ") + kind.words + ", take " + setting(*five)
                             : std::string("Nothing that was measured has an error of 5 % or less in ") + kind.words +
                                   "; the lowest is " + percent_words(best->*kind.value) + " with " + setting(*best);
    if (five && one == five)
        words += ", which also has an error below 1 % (" + percent_words(one->*kind.value) + ")";
    else if (one)
        words += "; for less than 1 %, " + setting(*one);
    else if (five && floor >= 0.01)
        words += "; below 1 % nothing is claimed, because the reference itself may be off by " + percent_words(floor);
    else if (five)
        words += "; less than 1 % was not reached, the lowest is " + percent_words(best->*kind.value) + " with " +
                 setting(*best);
    words += ".";
    if (const ChartRun* more = five && one != five ? most_accurate(runs, kind, 10 * five->seconds) : nullptr)
        words += more->*kind.value < 0.9 * (five->*kind.value)
                     ? " Within ten times the time of the first the error falls from " +
                           percent_words(five->*kind.value) + " to " + percent_words(more->*kind.value) + "."
                     : " Within ten times the time of the first the error does not fall.";
    return words;
}

/// Axes of a picture, in decades: time (s) and error.
struct Axes {
    double x_from, x_to, y_from, y_to;
};

/// Positions of labels near dots such that no label covers a dot or another label. Lengths are in pixels.
class Labels {
  public:
    static constexpr double width = 410, height = 424; ///< size of the plot that chart-error.gp draws

    Labels(const Axes& axes, const std::vector<std::pair<double, double>>& points) : axes_(axes) {
        for (const auto& [seconds, error] : points) {
            const Point at = pixel(seconds, error);
            taken_.push_back({at.x - dot, at.y - dot, at.x + dot, at.y + dot});
        }
    }
    /// The beginning (or end, if `left` is -1) and middle height of a label; in seconds and as an error.
    struct Place {
        double seconds, error;
        int left;    ///< 1: the label begins here; -1: it ends here
        bool is_far; ///< whether a line is needed from the dot
    };
    Place place(double seconds, double error, const std::string& text) {
        constexpr double letter = 6.9, tall = 15, gap = 2.9;
        const Point at = pixel(seconds, error);
        const double wide = letter * static_cast<double>(text.size()) + gap;
        Place best{seconds, error, 1, false};
        for (double away = dot + 3; away < width; away += away < 20 ? 7 : 14)
            for (int k = 0; k < 48; ++k) { // the right first; each label begins or ends at its place
                const double angle = std::numbers::pi / 12 * (k % 4 > 1 ? -1 : 1) * ((k / 2 + 1) / 2);
                const int left = (std::cos(angle) > -1e-9) == (k % 2 == 0) ? 1 : -1;
                const Point to{at.x + away * std::cos(angle), at.y + away * std::sin(angle)};
                const Box box{left > 0 ? to.x - gap : to.x - wide, to.y - tall / 2, left > 0 ? to.x + wide : to.x + gap,
                              to.y + tall / 2};
                if (box.left < 0 || box.right > width || box.low < 0 || box.high > height ||
                    std::ranges::any_of(taken_, [&](const Box& other) { return box.meets(other); }))
                    continue;
                taken_.push_back(box);
                return {std::pow(10, axes_.x_from + to.x / width * (axes_.x_to - axes_.x_from)),
                        std::pow(10, axes_.y_from + to.y / height * (axes_.y_to - axes_.y_from)), left, away > 14};
            }
        return best;
    }

  private:
    static constexpr double dot = 5;
    struct Point {
        double x, y;
    };
    struct Box {
        double left, low, right, high;
        bool meets(const Box& other) const {
            return left < other.right && other.left < right && low < other.high && other.low < high;
        }
    };
    Point pixel(double seconds, double error) const {
        return {(std::log10(seconds) - axes_.x_from) / (axes_.x_to - axes_.x_from) * width,
                (std::log10(error) - axes_.y_from) / (axes_.y_to - axes_.y_from) * height};
    }
    Axes axes_;
    std::vector<Box> taken_;
};

/// points.csv and axes.csv: each dot with its label, and the axes of each picture. `best` is 1 if no faster
/// run has a lower error.
void add_points(Findings& found, const ChartData& data) {
    Csv &table = found.table("points.csv",
                             "scene,kind,family,answered,seconds,error,best,label,label_seconds,"
                             "label_error,label_left,label_is_far",
                             6),
        &frames = found.table("axes.csv", "scene,kind,seconds_from,seconds_to,error_from,error_to,floor", 6);
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const ErrorKind& kind : error_kinds) {
            std::vector<const ChartRun*> runs = measured(data, scene);
            std::ranges::stable_sort(runs, {},
                                     [&](const ChartRun* run) { return std::pair(run->seconds, run->*kind.value); });
            const double floor = data.references[scene].*kind.floor;
            if (runs.empty()) continue;
            std::vector<std::pair<double, double>> points;
            for (const ChartRun* run : runs) points.emplace_back(run->seconds, std::max(run->*kind.value, 1e-9));
            const auto [lowest_at, highest_at] =
                std::ranges::minmax_element(points, {}, &std::pair<double, double>::second);
            const double bottom = floor > 1e-9 ? std::min(floor, lowest_at->second) : lowest_at->second;
            const Axes axes{std::log10(points.front().first) - 0.3, std::log10(points.back().first) + 0.3,
                            std::log10(bottom) - 0.3, std::log10(highest_at->second) + 0.2};
            frames.row(data.scenes[scene].name, kind.name, std::pow(10, axes.x_from), std::pow(10, axes.x_to),
                       std::pow(10, axes.y_from), std::pow(10, axes.y_to), floor);
            Labels labels(axes, points);
            double lowest = HUGE_VAL;
            for (std::size_t i = 0; i < runs.size(); ++i) {
                const auto& [seconds, error] = points[i];
                const bool is_best = error < lowest;
                lowest = std::min(lowest, error);
                const std::string label = label_of(*runs[i]);
                const auto at = labels.place(seconds, error, label);
                table.row(data.scenes[scene].name, kind.name, runs[i]->setting.family, runs[i]->answered, seconds,
                          error, is_best ? 1 : 0, label, at.seconds, at.error, at.left, at.is_far ? 1 : 0);
            }
        }
}

/// loads.csv: errors of models at each load of a map.
void add_loads(Findings& found, const ChartData& data) {
    Csv& table = found.table("loads.csv", "scene,label,contact_fraction,error_stiffness,error_contact", 6);
    for (const ChartRun& run : data.runs) {
        const ChartScene& scene = data.scenes[run.setting.scene];
        if (!scene.is_map || !extras(run).empty()) continue;
        const ChartCurve& right = data.references[run.setting.scene].curve;
        for (Index j = 0; j < run.curve.stiffness.size(); ++j)
            table.row(scene.name, label_of(run).substr(0, label_of(run).find(" (")), right.contact_fraction[j],
                      std::abs(run.curve.stiffness[j] / right.stiffness[j] - 1),
                      std::abs(run.curve.contact_fraction[j] / right.contact_fraction[j] - 1));
    }
}

/// Rows of the table of advice: for each scene and error kind one cell per wanted error.
json advice_rows(const ChartData& data) {
    json rows = json::array();
    for (std::size_t scene = 0; scene < data.scenes.size(); ++scene)
        for (const ErrorKind& kind : error_kinds) {
            if (measured(data, scene).empty()) continue;
            json cells = json::array();
            for (const double error : wanted_errors) {
                const ChartRun* const run = fastest(measured(data, scene), kind, error);
                const bool is_below = error < data.references[scene].*kind.floor;
                cells.push_back({{"setting", run ? label_of(*run) : ""},
                                 {"time", run ? time_words(run->seconds) : ""},
                                 {"none", run        ? ""
                                          : is_below ? "below the error of the reference"
                                                     : "not reached"}});
            }
            rows.push_back({{"scene", data.scenes[scene].name}, {"kind", kind.words}, {"cells", cells}});
        }
    return rows;
}

} // namespace

Csv chart_table(const ChartData& data) {
    Csv table("scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
              "iterations,outcome,model,answered",
              6);
    for (const ChartRun& run : data.runs) {
        const ChartSetting& of = run.setting;
        const ChartScene& scene = data.scenes[of.scene];
        table.row(scene.name, name_of(scene.body.kernel), of.method, is_map(run) ? of.side * of.side : of.side,
                  of.loads, of.tolerance, run.seconds, run.error_pressure, run.error_stiffness, run.error_contact,
                  run.iterations, name_of(run.outcome), of.family, run.answered);
    }
    return table;
}

Findings findings_of(const ChartData& data) {
    Findings found;
    found.tables.emplace("chart.csv", chart_table(data));
    add_points(found, data);
    add_loads(found, data);
    json scenes = json::array(), failures = json::array(), wanted = json::array();
    for (const double error : wanted_errors) wanted.push_back(percent_words(error));
    for (std::size_t s = 0; s < data.scenes.size(); ++s) {
        const ChartScene& scene = data.scenes[s];
        const ChartReference& reference = data.references[s];
        if (measured(data, s).empty()) continue;
        const auto fraction = [&](std::size_t load) {
            return reference.curve.contact_fraction[static_cast<Index>(load)];
        };
        const std::string side = std::to_string(reference.side);
        scenes.push_back({{"name", scene.name},
                          {"words", scene.words},
                          {"is_map", scene.is_map},
                          {"is_first", scenes.empty()},
                          {"from", fraction(scene.first)},
                          {"to", fraction(scene.first + ChartScene::counted - 1)},
                          {"reference", scene.exact ? "the exact solution"
                                                    : side + (scene.is_map ? " x " + side + " cells" : " nodes")},
                          {"is_exact", bool(scene.exact)},
                          {"floor_stiffness", reference.floor_stiffness},
                          {"floor_contact", reference.floor_contact},
                          {"stiffness", advice(data, s, error_kinds[0])},
                          {"contact", advice(data, s, error_kinds[1])}});
    }
    for (const ChartRun& run : data.runs)
        if (run.outcome != Outcome::solved)
            failures.push_back({{"setting", model_of(run)},
                                {"scene", data.scenes[run.setting.scene].name},
                                {"outcome", name_of(run.outcome)},
                                {"message", run.message}});
    found.result = {{"scenes", scenes},
                    {"wanted", wanted},
                    {"advice", advice_rows(data)},
                    {"failures", failures},
                    {"measured", data.runs.size()},
                    {"not_measured", data.not_measured},
                    {"why", data.interrupted ? "the run was interrupted" : "the time was over"},
                    {"runs", found.tables.at("chart.csv").rows()}};
    found.summary = scenes.empty()
                        ? "nothing was measured"
                        : scenes[0]["name"].get<std::string>() + ": " + scenes[0]["stiffness"].get<std::string>();
    if (data.not_measured > 0)
        found.summary += " " + std::to_string(data.not_measured) + " of " +
                         std::to_string(data.runs.size() + data.not_measured) + " settings were not measured in time";
    return found;
}

} // namespace app
