#pragma once

#include "domain/contact/solve.hpp"

#include <cmath>

/// Trials of a contact solver on a scene, with times.
namespace app {

/// A named surface that is pressed on a body.
struct ContactScene {
    std::string name;
    rough::Profile profile;
    rough::Body body;
    std::vector<double> displacements;  ///< mm
    std::vector<double> pressures = {}; ///< MPa; if there are any, the loads in place of displacements
    bool has_solution = true;
    std::size_t steps() const { return pressures.empty() ? displacements.size() : pressures.size(); }
};
/// The mean pressure over E* at which Persson's theory predicts a contact fraction below 1. `slope` is the
/// rms slope of a profile, or gradient of a map.
double persson_load(double contact, double slope);
/// Displacements of `steps` even load steps up to `last`.
std::vector<double> even_steps(double last, int steps);

enum class Outcome { solved, refused, not_converged, wrong };
const std::string& name_of(Outcome outcome);

/// One method on one scene.
struct ContactTrial {
    Outcome outcome = Outcome::solved;
    std::string message;       ///< the reason if the outcome is not `solved`
    rough::ContactCurve curve; ///< empty if refused or not converged
    double seconds = 0;        ///< processor time of one solution
    /// The tolerance to which its results are verified: 1e-9 for direct methods, ten times the tolerance of
    /// the options for iterative ones.
    double tolerance = 0;
};

/// Processor time of this thread, s.
double processor_seconds();

/// The lowest processor time of several rounds of some work, because other work on the machine only adds to
/// it. There are fewer than `rounds` if these would take more than `within` seconds.
template <class Work>
double lowest_seconds(Work work, int rounds = 9, double within = 0.1) {
    double lowest = 0, spent = 0;
    for (int round = 0; round < rounds && (round == 0 || spent * (round + 1) < within * round); ++round) {
        const double start = processor_seconds();
        work();
        const double seconds = processor_seconds() - start;
        lowest = round == 0 ? seconds : std::min(lowest, seconds);
        spent += seconds;
    }
    return lowest;
}

/// Solves a scene, or stops after `limit` seconds of wall time. Without a limit, options.stop applies.
ContactTrial try_contact(const ContactScene& scene, rough::ContactOptions options, double limit = HUGE_VAL);

} // namespace app
