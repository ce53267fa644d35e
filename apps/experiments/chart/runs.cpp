#include "apps/experiments/chart/runs.hpp"

#include "domain/response/curve.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

/// y against x, which may be read everywhere.
rough::Curve curve_through(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    return {x, y, -HUGE_VAL, HUGE_VAL};
}

/// How long a curve is repeated, s, and how often at most.
constexpr double seconds_of_repeats = 0.1;
constexpr int most_repeats = 9;

} // namespace

void measure_errors(const rough::ContactCurve& curve, const ChartTruth& truth, ChartRun& run) {
    const rough::Response found = rough::response_of(curve.steps, curve.solver, 0);
    const auto root_mean_square = [](const Eigen::VectorXd& errors) {
        return std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size()));
    };
    const auto read = [](const rough::Curve& from, const Eigen::VectorXd& at) -> Eigen::VectorXd {
        return at.unaryExpr([&](double x) { return from.at(x); });
    };
    const auto relative = [](const Eigen::VectorXd& value, const Eigen::VectorXd& exact) -> Eigen::VectorXd {
        return value.array() / exact.array() - 1;
    };
    const Eigen::VectorXd pressure =
                              read(curve_through(truth.displacement, truth.pressure), found.displacement),
                          fraction =
                              read(curve_through(truth.displacement, truth.fraction), found.displacement);
    run.error_pressure = root_mean_square(relative(found.pressure, pressure));
    run.error_contact = root_mean_square(found.contact_fraction - fraction);
    constexpr int samples = 20;
    const double last = truth.pressure.tail(1)[0];
    const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(samples, last / samples, last);
    run.error_stiffness =
        root_mean_square(relative(read(curve_through(found.pressure, found.tangent_stiffness), at),
                                  read(curve_through(truth.pressure, truth.stiffness), at)));
}

std::optional<ChartRun> run_chart(const ChartScene& scene, const ChartTruth& truth,
                                  const ChartSetting& setting, double limit,
                                  const std::function<bool()>& stop) {
    const ContactScene contact{scene.name, scene.profile(setting.nodes), scene.body,
                               scene.displacements(setting.steps)};
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
        if (setting.nodes <= truth.finest_verified)
            measure_errors(trial.curve, truth, run);
    }
    return run;
}

} // namespace app
