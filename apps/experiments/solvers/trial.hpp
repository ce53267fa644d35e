#pragma once

#include "domain/contact/names.hpp"

#include <algorithm>
#include <string>

/// What the experiments on contact solvers share: a solver on a scene, and its time.
namespace app {

/// A profile pressed on a body, by name.
struct ContactScene {
    std::string name;
    rough::Profile profile;
    rough::Body body;
    std::vector<double> displacements; ///< mm
};
/// Displacements of so many even load steps up to `last`.
std::vector<double> even_steps(double last, int steps);

enum class Outcome { solved, refused, not_converged, wrong };
const std::string& name_of(Outcome outcome);

/// One method on one scene.
struct ContactTrial {
    Outcome outcome = Outcome::solved;
    std::string message;         ///< why it was refused, did not converge or is wrong
    rough::ContactCurve curve;   ///< where solved
    double seconds = 0;          ///< of one core, for one solution
    double kkt_residual() const; ///< the worst of the curve's steps
};

/// Processor time of this thread: what other work on the machine takes is not counted.
double processor_seconds();

/// The least processor time of a few rounds of some work, as other work on the machine only adds to it: of
/// `rounds`, or of fewer if these would take more than `within` seconds.
template <class Work>
double least_seconds(Work work, int rounds = 9, double within = 0.1) {
    double least = 0, spent = 0;
    for (int round = 0; round < rounds && (round == 0 || spent * (round + 1) < within * round); ++round) {
        const double start = processor_seconds();
        work();
        const double seconds = processor_seconds() - start;
        least = round == 0 ? seconds : std::min(least, seconds);
        spent += seconds;
    }
    return least;
}

/// Solves, by the options as they are.
ContactTrial try_contact(const ContactScene& scene, const rough::ContactOptions& options);

/// Solves, and gives up after `limit` seconds by the wall's clock.
ContactTrial try_contact(const ContactScene& scene, rough::ContactOptions options, double limit);

/// The tolerance that a method's results are held to: 1e-9 for the direct ones, ten times their own for the
/// iterative.
double promised_tolerance(const rough::ContactCurve& curve, const rough::ContactOptions& options);

} // namespace app
