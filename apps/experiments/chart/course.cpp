#include "apps/experiments/chart/course.hpp"

#include "apps/experiments/chart/pace.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/progress.hpp"
#include "domain/errors.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>

namespace app {

namespace {

class Course {
  public:
    Course(const std::vector<ChartScene>& scenes, const ChartExtent& extent, const ChartBounds& bounds)
        : scenes_(scenes), extent_(extent), bounds_(bounds), plan_(chart_plan(extent, scenes.size())) {
        data_.limit = extent.limit;
    }

    ChartData run() {
        find_truths();
        for (next_ = 0; next_ < plan_.size(); ++next_) {
            const ChartSetting& setting = plan_[next_];
            if (next_ == 0 || !differ_by_scene(plan_[next_ - 1], setting))
                fits_ = setting.nodes == plan_.front().nodes || row_fits();
            if (stopped())
                leave_out(setting, LeftOutFor::interrupt);
            else if (const auto bar = bars_.find(ChartPace::kind(setting)); bar != bars_.end())
                leave_out(setting, bar->second);
            else if (pace_.expected(setting) > extent_.limit)
                leave_out(setting, LeftOutFor::limit);
            else if (!fits_)
                leave_out(setting, LeftOutFor::time);
            else
                measure(setting);
        }
        return std::move(data_);
    }

  private:
    bool stopped() const { return bounds_.stop && bounds_.stop(); }
    void leave_out(const ChartSetting& setting, LeftOutFor why) { data_.left_out.push_back({setting, why}); }

    void find_truths() {
        for (const ChartScene& scene : scenes_) {
            tell("reference of " + scene.name);
            try {
                truths_.push_back(truth_of(scene, extent_.most_for_truth, bounds_.stop));
            } catch (const rough::NotConverged&) {
                if (!stopped())
                    throw;
                truths_.emplace_back(); // nothing will be measured against it
            }
            const ChartTruth& truth = truths_.back();
            data_.scenes.push_back({scene.name, scene.words, name_of(scene.body.kernel), truth.origin});
        }
        solving_since_ = clock_.seconds();
    }

    void measure(const ChartSetting& setting) {
        const auto run =
            run_chart(scenes_[setting.scene], truths_[setting.scene], setting, extent_.limit, bounds_.stop);
        if (!run)
            return leave_out(setting, LeftOutFor::interrupt);
        pace_.note(setting, run->seconds);
        solved_in_ += pace_.expected_in_all(setting);
        if (run->outcome != Outcome::solved)
            bars_[ChartPace::kind(setting)] = run->late ? LeftOutFor::limit : LeftOutFor::unsolved;
        data_.runs.push_back(*run);
        tell(scenes_[setting.scene].name + ", " + name_of(setting.method) +
             ", N = " + std::to_string(setting.nodes));
    }

    /// Of the wall's clock for a second that a curve takes, so far.
    double slowness() const {
        return solved_in_ > 1 ? std::max(1.0, (clock_.seconds() - solving_since_) / solved_in_) : 1;
    }

    double expected(std::size_t from, std::size_t to) const {
        double seconds = 0;
        for (std::size_t k = from; k < to; ++k)
            if (bars_.count(ChartPace::kind(plan_[k])) == 0 && pace_.expected(plan_[k]) <= extent_.limit)
                seconds += pace_.expected_in_all(plan_[k]);
        return slowness() * seconds;
    }

    /// Whether there is time for the next setting on all scenes.
    bool row_fits() const {
        return clock_.seconds() + expected(next_, next_ + scenes_.size()) <= bounds_.seconds;
    }

    void tell(const std::string& what) {
        if (!bounds_.watch)
            return;
        const double most = std::max(0.0, bounds_.seconds - clock_.seconds());
        // Growth shows from the second grid on.
        const bool known = !data_.runs.empty() && extent_.nodes.size() > 2 &&
                           data_.runs.back().setting.nodes > extent_.nodes[1];
        bounds_.watch(
            data_, std::to_string(data_.runs.size() + data_.left_out.size()) + " of " +
                       std::to_string(plan_.size()) +
                       (known ? ", about " + duration_words(std::min(most, expected(next_ + 1, plan_.size())))
                              : ", at most " + duration_words(most)) +
                       " left: " + what);
    }

    const std::vector<ChartScene>& scenes_;
    const ChartExtent& extent_;
    const ChartBounds& bounds_;
    std::vector<ChartSetting> plan_;
    std::size_t next_ = 0;
    bool fits_ = true;
    std::vector<ChartTruth> truths_;
    ChartPace pace_;
    std::map<ChartPace::Kind, LeftOutFor> bars_;
    ga::Stopwatch clock_;
    double solving_since_ = 0, solved_in_ = 0; ///< s
    ChartData data_;
};

} // namespace

ChartData charted(const std::vector<ChartScene>& scenes, const ChartExtent& extent,
                  const ChartBounds& bounds) {
    return Course(scenes, extent, bounds).run();
}

} // namespace app
