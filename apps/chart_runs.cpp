#include "apps/chart_runs.hpp"

#include "apps/model_settings.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

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

ChartRun run_chart(const ChartScene& scene, const ChartTruth* truth, rough::Solver method, rough::Index nodes,
                   int steps, double tolerance, double limit, double share) {
    const ContactScene contact{scene.name, scene.profile(nodes), scene.body,
                               scene.displacements(steps, share)};
    rough::ContactOptions options;
    options.solver = method;
    if (tolerance > 0)
        options.tolerance = tolerance;
    ContactTrial trial = try_contact(contact, options, limit);
    std::vector<double> times{trial.seconds};
    const double enough = std::min(0.1, limit / 4);
    for (double spent = trial.seconds; times.size() < 9 && spent + trial.seconds < enough;
         spent += times.back())
        times.push_back(try_contact(contact, options, limit).seconds);
    std::nth_element(times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());

    ChartRun run;
    run.scene = scene.name;
    run.kernel = name_of(scene.body.kernel);
    run.method = name_of(method);
    run.nodes = nodes;
    run.steps = steps;
    run.tolerance = tolerance;
    run.seconds = times[times.size() / 2];
    run.iterations = trial.curve.iterations;
    run.outcome = trial.outcome;
    if (trial.outcome == Outcome::solved) {
        run.contact_fraction = trial.curve.steps.back().contact_fraction;
        if (truth)
            measure_errors(trial.curve, *truth, run);
    }
    return run;
}

std::string chart_csv(const std::vector<ChartRun>& runs) {
    std::ostringstream out;
    out.precision(6);
    out << "scene,kernel,method,nodes,steps,tolerance,seconds,error_pressure,error_stiffness,error_contact,"
           "iterations,outcome\n";
    for (const ChartRun& run : runs) {
        out << run.scene << "," << run.kernel << "," << run.method << "," << run.nodes << "," << run.steps
            << "," << run.tolerance << "," << run.seconds;
        for (const double error : {run.error_pressure, run.error_stiffness, run.error_contact}) {
            out << ",";
            if (error != ChartRun::unknown)
                out << error;
        }
        out << "," << run.iterations << "," << name_of(run.outcome) << "\n";
    }
    return out.str();
}

} // namespace app
