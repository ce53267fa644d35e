#include "apps/chart/runs.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

/// y at x, linear between increasing nodes, continued by the end segments.
double interpolated(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
    const auto after = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
    const auto k = static_cast<std::size_t>(after - xs.begin());
    return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1]);
}

std::vector<double> list(const Eigen::VectorXd& v) { return {v.data(), v.data() + v.size()}; }

} // namespace

void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run) {
    const auto displacement = list(truth.displacement), pressure = list(truth.pressure),
               stiffness = list(truth.stiffness), fraction = list(truth.fraction);
    const auto square = [](double x) { return x * x; };
    std::vector<double> pressures, tangents;
    double by_pressure = 0, by_contact = 0, by_stiffness = 0;
    for (const rough::LoadStep& step : curve.steps) {
        by_pressure += square(step.pressure / interpolated(displacement, pressure, step.displacement) - 1);
        by_contact += square(step.contact_fraction - interpolated(displacement, fraction, step.displacement));
        pressures.push_back(step.pressure);
        tangents.push_back(step.tangent_stiffness);
    }
    constexpr int samples = 20;
    for (int k = 1; k <= samples; ++k) {
        const double p = pressure.back() * k / samples;
        by_stiffness +=
            square(interpolated(pressures, tangents, p) / interpolated(pressure, stiffness, p) - 1);
    }
    const double steps = static_cast<double>(curve.steps.size());
    run.error_pressure = std::sqrt(by_pressure / steps);
    run.error_contact = std::sqrt(by_contact / steps);
    run.error_stiffness = std::sqrt(by_stiffness / samples);
}

std::optional<ChartRun> run_chart(const ChartScene& scene, const ChartTruth& truth,
                                  const ChartSetting& setting, double limit,
                                  const std::function<bool()>& stop) {
    const ContactScene contact{scene.name, scene.profile(setting.nodes), scene.body,
                               scene.displacements(setting.steps, setting.share)};
    rough::ContactOptions options;
    options.solver = setting.method;
    if (setting.tolerance > 0)
        options.tolerance = setting.tolerance;
    double start = processor_seconds();
    bool late = false;
    options.stop = [&] {
        late = processor_seconds() - start > limit;
        return late || (stop && stop());
    };
    const ContactTrial trial = try_contact(contact, options);
    std::vector<double> times{trial.seconds};
    const bool gave_up = late;
    for (double spent = trial.seconds;
         times.size() < most_repeats && spent + trial.seconds < seconds_of_repeats; spent += times.back()) {
        start = processor_seconds();
        times.push_back(try_contact(contact, options).seconds);
    }
    if (stop && stop())
        return std::nullopt;

    ChartRun run;
    run.setting = setting;
    run.seconds = *std::min_element(times.begin(), times.end());
    run.iterations = trial.curve.iterations;
    run.outcome = trial.outcome;
    run.late = gave_up;
    if (trial.outcome == Outcome::solved) {
        run.contact_fraction = trial.curve.steps.back().contact_fraction;
        if (setting.share == 1 && setting.nodes <= truth.finest_judged)
            measure_errors(trial.curve, truth, run);
    }
    return run;
}

} // namespace app
