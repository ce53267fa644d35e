#include "domain/contact/full_contact.hpp"

#include "domain/contact/solvers/set_solver.hpp"
#include "domain/errors.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

namespace rough {

namespace {

/// Largest residual of H w = 1. The stiffness 2 sum w - w'Hw has only its square as an error.
constexpr double tolerance = 1e-8;

/// The sum of H^-1 1.
double sum_of_tangents(const ContactProblem& problem) {
    ContactSet all(problem.nodes());
    all.assign([](Index) { return true; });
    Loaded tangent(problem.nodes());
    SetSolver(problem).tangent(all, tolerance, true, tangent);
    const Eigen::VectorXd image = SplitOperator(problem.column, problem.shape).apply(tangent.pressure);
    const double residual = (image.array() - 1).abs().maxCoeff();
    if (!(residual <= tolerance))
        throw NotConverged(line_of("full contact did not settle: residual ", residual,
                                   " is above the tolerance ", tolerance));
    return tangent.pressure.dot((2 - image.array()).matrix());
}

/// Body, nodes, rows, and the strip's width or the area's row spacing in units of the spacing.
using Key = std::tuple<Kernel, Index, Index, double>;

/// sum_of_tangents, remembered for all threads.
double known_sum(const Key& key, const ContactProblem& problem) {
    static std::mutex lock;
    static std::map<Key, double> known;
    {
        const std::lock_guard held(lock);
        if (const auto found = known.find(key); found != known.end())
            return found->second;
    }
    const double sum = sum_of_tangents(problem);
    const std::lock_guard held(lock);
    return known[key] = sum;
}

} // namespace

double full_contact_stiffness(Index nodes, double spacing, const Body& body) {
    return full_contact_stiffness(Profile{Eigen::VectorXd::Zero(nodes), spacing}, body);
}

double full_contact_stiffness(const Profile& surface, const Body& given) {
    if (given.kernel == Kernel::periodic) { // on a rigid base 1/C0
        const double modulus = given.effective_modulus;
        return modulus / mean_compliance(completed(given, 0).layering, modulus);
    }
    Profile flat = surface;
    flat.heights.setZero();
    const double length = profile_length(flat, given.kernel);
    const Body body = completed(given, length);
    make_problem(flat, body, {}); // refuses what has no solution
    Body at_length = body;
    at_length.datum = length;
    const ContactProblem problem = make_problem(flat, at_length, {});
    const bool strip = body.kernel == Kernel::strip;
    const double other = strip ? problem.strip_width : problem.row_spacing;
    const double stiffness =
        problem.stiffness_unit * known_sum({body.kernel, flat.nodes(), flat.rows, other}, problem);
    if (strip || flat.is_2d())
        return stiffness;
    // 1/K(d) = 1/K(L) + (2 L/(pi E*)) ln(d/L)
    return 1 / (1 / stiffness -
                datum_sensitivity(1, length, body.effective_modulus) * std::log(body.datum / length));
}

double full_contact_load(const Profile& profile, const Body& body) {
    const ContactProblem problem = make_problem(profile, body, {});
    return -full_contact_pressure(problem).minCoeff() * problem.pressure_unit;
}

} // namespace rough
