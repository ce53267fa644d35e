#include "apps/experiments/stability/reference.hpp"

#include "domain/contact/solvers/oracle.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/plain_stream.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr rough::Index largest_for_oracle = 256;
constexpr double seconds_per_opinion = 30;

bool within(double value, double least, double most, double tolerance) {
    const double slack = tolerance * std::max(std::abs(least), std::abs(most));
    return value >= least - slack && value <= most + slack;
}

std::string words(std::size_t step, const char* what, double given, double least, double most) {
    rough::PlainStream line;
    line.precision(12);
    line << what << " of step " << step + 1 << " is " << given << " where the reference has " << least;
    if (most > least)
        line << " to " << most;
    return line.str();
}

} // namespace

StabilityReference::StabilityReference(const StabilityScene& scene) : scene_(scene) {}

const std::vector<StabilityReference::Span>& StabilityReference::spans(double tolerance) {
    std::vector<Span>& spans = spans_[tolerance];
    if (!spans.empty())
        return spans;
    const double largest = largest_displacement(scene_.profile, scene_.body);
    const double range = scene_.profile.heights.maxCoeff() - scene_.profile.heights.minCoeff();
    for (const double displacement : scene_.displacements) {
        // First loading: the oracle needs some displacement, which stands for none.
        const double at = displacement > 0 ? displacement : 1e-9 * range;
        const rough::Oracle oracle = consult_oracle(
            scene_.profile, scene_.body,
            {at * (1 - tolerance), std::min(at, largest), std::min(at * (1 + tolerance), largest)});
        const auto [p0, p1] = std::minmax_element(oracle.pressure.begin(), oracle.pressure.end());
        const auto [k0, k1] =
            std::minmax_element(oracle.tangent_stiffness.begin(), oracle.tangent_stiffness.end());
        const auto [n0, n1] = std::minmax_element(oracle.contact_nodes.begin(), oracle.contact_nodes.end());
        const double loaded = displacement > 0;
        spans.push_back({loaded * *p0, loaded * *p1, *k0, *k1, *n0, *n1});
    }
    return spans;
}

std::optional<rough::ContactCurve> StabilityReference::by_another(rough::Solver verified) const {
    rough::ContactOptions options;
    for (const rough::Solver solver :
         {rough::Solver::nested, rough::Solver::active_set, rough::Solver::polonsky_keer}) {
        options.solver = solver;
        ContactTrial other;
        if (solver != verified)
            other = try_contact(scene_, options, seconds_per_opinion);
        if (!other.curve.steps.empty())
            return other.curve;
    }
    return {};
}

/// What differs, or "".
std::string StabilityReference::difference(const rough::LoadStep& step, std::size_t j, const Span& span,
                                           double tolerance) const {
    if (!within(step.pressure, span.least_pressure, span.most_pressure, tolerance))
        return words(j, "pressure", step.pressure, span.least_pressure, span.most_pressure);
    if (!within(step.tangent_stiffness, span.least_stiffness, span.most_stiffness, tolerance))
        return words(j, "stiffness", step.tangent_stiffness, span.least_stiffness, span.most_stiffness);
    if (step.contact_nodes < span.least_nodes || step.contact_nodes > span.most_nodes)
        return words(j, "number of contact nodes", static_cast<double>(step.contact_nodes),
                     static_cast<double>(span.least_nodes), static_cast<double>(span.most_nodes));
    return "";
}

void StabilityReference::verifier(ContactTrial& trial, double tolerance) {
    if (trial.outcome != Outcome::solved)
        return;
    std::vector<Span> expected;
    if (scene_.profile.nodes() <= largest_for_oracle) {
        expected = spans(tolerance);
    } else if (const auto other = by_another(trial.curve.solver)) {
        tolerance = std::max(tolerance, 10 * rough::ContactOptions().tolerance);
        for (const rough::LoadStep& step : other->steps)
            expected.push_back({step.pressure, step.pressure, step.tangent_stiffness, step.tangent_stiffness,
                                step.contact_nodes, step.contact_nodes});
    }
    for (std::size_t j = 0; j < expected.size() && trial.outcome == Outcome::solved; ++j) {
        trial.message = difference(trial.curve.steps[j], j, expected[j], tolerance);
        if (!trial.message.empty())
            trial.outcome = Outcome::wrong;
    }
}

} // namespace app
