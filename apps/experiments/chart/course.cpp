#include "apps/experiments/chart/course.hpp"

#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/progress.hpp"
#include "domain/errors.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <map>

namespace app {

namespace {

class Course {
  public:
    Course(const std::vector<ChartScene>& scenes, const ChartExtent& extent, const ChartBounds& bounds)
        : scenes_(scenes), extent_(extent), bounds_(bounds), plan_(chart_plan(extent)) {
        data_.limit = extent.limit;
    }

    ChartData run() {
        if (bounds_.finest_map > 0) {
            tell("theories, profiles and maps");
            data_.models = charted_models(bounds_.finest_map, bounds_.stop);
        }
        for (const ChartScene& scene : scenes_)
            find_truth(scene);
        for (const ChartSetting& setting : plan_)
            try_on_all(setting);
        return std::move(data_);
    }

  private:
    bool stopped() const { return bounds_.stop && bounds_.stop(); }
    bool is_over(const ChartSetting& setting) const {
        return setting.nodes > plan_.front().nodes && clock_.seconds() > bounds_.seconds;
    }
    void leave_out(const ChartSetting& setting, LeftOutFor why) { data_.left_out.push_back({setting, why}); }

    void find_truth(const ChartScene& scene) {
        tell("reference of " + scene.name);
        try {
            truths_.push_back(truth_of(scene, extent_.most_for_truth, bounds_.stop));
        } catch (const rough::NotConverged&) {
            if (!stopped())
                throw;
            truths_.emplace_back(); // nothing will be measured against it
        }
        data_.scenes.push_back({scene.name, scene.words, name_of(scene.body.kernel), truths_.back().origin});
    }

    /// The same method, steps and tolerance on the scene, whatever the grid.
    static ChartSetting on_any_grid(ChartSetting setting) {
        setting.nodes = 0;
        return setting;
    }

    /// The least that a curve can take, s.
    double least(const ChartSetting& setting) const {
        const auto coarser = coarser_.find(on_any_grid(setting));
        return coarser == coarser_.end() ? 0
                                         : coarser->second.seconds * static_cast<double>(setting.nodes) /
                                               static_cast<double>(coarser->second.setting.nodes);
    }

    std::optional<LeftOutFor> barred(const ChartSetting& setting) const {
        const auto coarser = coarser_.find(on_any_grid(setting));
        if (coarser != coarser_.end() && coarser->second.outcome != Outcome::solved && !coarser->second.late)
            return LeftOutFor::unsolved;
        return least(setting) > extent_.limit ? std::optional(LeftOutFor::limit) : std::nullopt;
    }

    void try_on_all(ChartSetting setting) {
        std::vector<ChartSetting> row;
        double expected = 0;
        for (setting.scene = 0; setting.scene < scenes_.size(); ++setting.scene)
            if (const auto why = stopped() ? LeftOutFor::interrupt : barred(setting)) {
                leave_out(setting, *why);
            } else {
                row.push_back(setting);
                expected += least(setting);
            }
        const bool fits =
            setting.nodes == plan_.front().nodes || clock_.seconds() + expected <= bounds_.seconds;
        const std::size_t before = data_.runs.size();
        for (const ChartSetting& each : row)
            if (!fits || is_over(each))
                leave_out(each, LeftOutFor::time);
            else
                measure(each);
        if (data_.runs.size() < before + row.size() && !stopped()) { // not of some scenes alone
            for (std::size_t k = before; k < data_.runs.size(); ++k)
                leave_out(data_.runs[k].setting, LeftOutFor::time);
            data_.runs.resize(before);
        }
    }

    void measure(const ChartSetting& setting) {
        const auto run = run_chart(scenes_[setting.scene], truths_[setting.scene], setting, extent_.limit,
                                   [&] { return stopped() || is_over(setting); });
        if (!run)
            return leave_out(setting, stopped() ? LeftOutFor::interrupt : LeftOutFor::time);
        coarser_[on_any_grid(setting)] = *run;
        data_.runs.push_back(*run);
        tell(scenes_[setting.scene].name + ", " + name_of(setting.method) +
             ", N = " + std::to_string(setting.nodes));
    }

    void tell(const std::string& what) const {
        if (bounds_.watch)
            bounds_.watch(data_, std::to_string(data_.runs.size() + data_.left_out.size()) + " of " +
                                     std::to_string(plan_.size() * scenes_.size()) + ", at most " +
                                     duration_words(std::max(0.0, bounds_.seconds - clock_.seconds())) +
                                     " left: " + what);
    }

    const std::vector<ChartScene>& scenes_;
    const ChartExtent& extent_;
    const ChartBounds& bounds_;
    std::vector<ChartSetting> plan_;
    std::vector<ChartTruth> truths_;
    std::map<ChartSetting, ChartRun> coarser_; ///< the last grid's run
    ga::Stopwatch clock_;
    ChartData data_;
};

} // namespace

ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent,
                  const ChartBounds& bounds) {
    return Course(scenes, extent, bounds).run();
}

} // namespace app
