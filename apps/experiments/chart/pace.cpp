#include "apps/experiments/chart/pace.hpp"

#include "apps/experiments/chart/runs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace app {

namespace {

/// Between N log N of the iterative methods and N^3 of a factor with most nodes in contact; what lies
/// outside is the noise of two short times.
constexpr double least_growth = 1, most_growth = 3, usual_growth = 1.5;
constexpr double unknown = 1e-3; ///< s, for the first curve of all

} // namespace

ChartPace::Kind ChartPace::kind(const ChartSetting& setting) {
    return {setting.scene, setting.method, setting.steps, setting.tolerance, setting.share};
}

void ChartPace::note(const ChartSetting& setting, double seconds) {
    seconds_[kind(setting)][setting.nodes] = seconds;
}

double ChartPace::expected(const ChartSetting& setting) const {
    const auto found = seconds_.find(kind(setting));
    if (found == seconds_.end()) {
        ChartSetting usual = setting;
        usual.steps = usual_steps;
        usual.tolerance = usual_tolerance_of(setting.method);
        usual.share = 1;
        return usual == setting ? unknown
                                : expected(usual) * std::max(1.0, setting.steps / double(usual_steps));
    }
    const auto& [last_nodes, last] = *found->second.rbegin();
    double growth = usual_growth;
    if (found->second.size() > 1) {
        const auto& [nodes, seconds] = *std::next(found->second.rbegin());
        growth = std::clamp(std::log(last / seconds) /
                                std::log(static_cast<double>(last_nodes) / static_cast<double>(nodes)),
                            least_growth, most_growth);
    }
    return last * std::pow(static_cast<double>(setting.nodes) / static_cast<double>(last_nodes), growth);
}

double ChartPace::expected_in_all(const ChartSetting& setting) const {
    const double once = expected(setting);
    return std::max(once, std::min(most_repeats * once, seconds_of_repeats));
}

} // namespace app
