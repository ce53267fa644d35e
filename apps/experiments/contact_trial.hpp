#pragma once

#include "domain/contact/names.hpp"

#include <string>

namespace app {

/// A profile pressed on a body, by name.
struct ContactScene {
    std::string name;
    rough::Profile profile;
    rough::Body body;
    std::vector<double> displacements; ///< mm
};

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

/// Solves, by the options as they are.
ContactTrial try_contact(const ContactScene& scene, const rough::ContactOptions& options);

/// Solves, and gives up after `limit` seconds by the wall's clock.
ContactTrial try_contact(const ContactScene& scene, rough::ContactOptions options, double limit);

/// The tolerance that a method's results are held to: 1e-9 for the direct ones, ten times their own for the
/// iterative.
double promised_tolerance(const rough::ContactCurve& curve, const rough::ContactOptions& options);

} // namespace app
