#include "apps/experiments/trial.hpp"

#include "domain/errors.hpp"
#include "ga/base/stopwatch.hpp"

#include <array>
#include <ctime>
#include <numbers>

namespace app {

double persson_load(double contact, double slope) {
    double low = 0, high = 4; // between these lies sqrt 2 P/(E* h')
    for (int k = 0; k < 60; ++k) (std::erf(0.5 * (low + high)) < contact ? low : high) = 0.5 * (low + high);
    return low * slope / std::numbers::sqrt2;
}

std::vector<double> even_steps(double last, int steps) {
    std::vector<double> displacements;
    for (int j = 1; j <= steps; ++j) displacements.push_back(last * j / steps);
    return displacements;
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

const std::string& name_of(Outcome outcome) {
    static const std::array<std::string, 4> names{"solved", "refused", "not-converged", "wrong"};
    return names[static_cast<std::size_t>(outcome)];
}

ContactTrial try_contact(const ContactScene& scene, rough::ContactOptions options, double limit) {
    const ga::Stopwatch clock;
    const double start = processor_seconds();
    bool late = false;
    if (std::isfinite(limit)) options.stop = [&] { return late = clock.seconds() > limit; };
    ContactTrial trial;
    try {
        trial.curve = scene.pressures.empty()
                          ? solve_contact(scene.profile, scene.body, scene.displacements, options)
                          : solve_contact_at_pressures(scene.profile, scene.body, scene.pressures, options);
    } catch (const rough::InputError& error) {
        trial.outcome = Outcome::refused;
        trial.message = error.what();
    } catch (const rough::NotConverged& error) {
        trial.outcome = Outcome::not_converged;
        trial.message = late ? "stopped after " + std::to_string(std::lround(limit)) + " s" : error.what();
    }
    trial.seconds = processor_seconds() - start;
    trial.tolerance = is_direct(trial.curve.solver) ? 1e-9 : 10 * options.tolerance;
    return trial;
}

} // namespace app
