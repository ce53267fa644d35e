#include "domain/contact/datum.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/contact/solvers/problem.hpp"
#include "domain/errors.hpp"

#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// d Delta / d ln d at unit mean pressure, mm/MPa.
double compliance_per_log_datum(double length, double effective_modulus) {
    return 2 * length / (std::numbers::pi * effective_modulus);
}

} // namespace

double datum_sensitivity(double stiffness, double length, double effective_modulus) {
    return -stiffness * stiffness * compliance_per_log_datum(length, effective_modulus);
}

ContactCurve with_datum(ContactCurve curve, const Profile& profile, const Body& body, double datum) {
    if (body.kernel != Kernel::free || profile.is_2d())
        throw InputError("a datum distance was given, none is expected: only the free half-plane has one");
    const double length = profile_length(profile, body.kernel);
    Body changed = body;
    changed.datum = datum;
    make_problem(profile, changed, {});
    const double compliance = compliance_per_log_datum(length, body.effective_modulus) *
                              std::log(datum / completed(body, length).datum);
    for (std::size_t j = 0; j < curve.steps.size(); ++j) {
        LoadStep& step = curve.steps[j];
        // 1/K(d2) = 1/K(d1) + (2 L/(pi E*)) ln(d2/d1), and w = H_AA^-1 1 shrinks as K does
        const double ratio = 1 / (1 + step.tangent_stiffness * compliance);
        step.displacement += step.pressure * compliance;
        step.tangent_stiffness *= ratio;
        if (!curve.states.empty())
            curve.states[j].tangent *= ratio;
    }
    return curve;
}

} // namespace rough
