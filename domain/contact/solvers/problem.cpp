#include "domain/contact/solvers/problem.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/plain_stream.hpp"

#include <cmath>
#include <limits>

namespace rough {

namespace {

void check_profile(const Profile& profile) {
    if (profile.is_2d()) {
        if (!std::isfinite(profile.row_spacing))
            refuse("row spacing ", profile.row_spacing,
                   " mm was given, a positive finite length is expected");
        if (profile.rows < 1 || profile.nodes() % profile.rows != 0 || profile.shape().columns < 2)
            refuse("a map of ", profile.nodes(), " heights in ", profile.rows,
                   " rows was given, rows of equal lengths of at least 2 are expected");
    }
    if (profile.nodes() < 2)
        refuse("a profile of ", profile.nodes(), " node(s) was given, at least 2 are expected");
    if (!(profile.spacing > 0) || !std::isfinite(profile.spacing))
        refuse("node spacing ", profile.spacing, " mm was given, a positive finite length is expected");
    for (Index i = 0; i < profile.nodes(); ++i)
        if (!std::isfinite(profile.heights[i]))
            refuse("height ", profile.heights[i], " mm at node ", i, ", a finite height is expected");
    if (!std::isfinite(profile.heights.maxCoeff() - profile.heights.minCoeff()))
        refuse("heights from ", profile.heights.minCoeff(), " to ", profile.heights.maxCoeff(),
               " mm, a range that fits double precision is expected");
}

void check_displacements(const Profile& profile, const Body& body, const std::vector<double>& displacements) {
    double previous = 0;
    for (const double displacement : displacements) {
        if (!std::isfinite(displacement) || displacement < previous)
            refuse("displacement ", displacement, " mm was given after ", previous,
                   " mm, increasing finite values are expected");
        previous = displacement;
    }
    if (!body.relative_to_mean())
        return;
    const double full = largest_displacement(profile, body);
    if (profile.heights.maxCoeff() == profile.heights.minCoeff())
        refuse("a flat profile was given, one with height differences is expected: on a periodic half-plane "
               "a flat "
               "one bears any load at no approach");
    const double rounding = 1e-14 * profile.heights.cwiseAbs().maxCoeff();
    if (previous > full * (1 + 1e-12) + rounding)
        refuse("displacement ", previous, " mm was given, at most that of full contact, ", full,
               " mm, is expected: beyond it the periodic half-plane has no solution");
}

} // namespace

double largest_displacement(const Profile& profile, const Body& body) {
    if (!body.relative_to_mean() || body.yields()) // nodes at the hardness may sink in
        return std::numeric_limits<double>::infinity();
    const double highest = profile.heights.maxCoeff();
    return (highest - profile.heights.array()).mean(); // Delta_full = max Z - mean Z
}

ContactProblem make_problem(const Profile& profile, const Body& given,
                            const std::vector<double>& displacements) {
    check_profile(profile);
    if (profile.is_2d() && given.kernel == Kernel::strip)
        refuse_value("kernel", "strip", " given with a map, expected free or periodic: a strip is one row");
    const double length = profile_length(profile, given.kernel);
    Body body = completed(given, length);
    if (profile.is_2d())
        body.datum = profile.spacing * static_cast<double>(profile.nodes()); // none is needed
    validate(body, profile.nodes(), profile.spacing);
    check_displacements(profile, body, displacements);
    const double unit = displacements.empty() || displacements.back() == 0 ? 1 : displacements.back();
    ContactProblem problem;
    problem.kernel = body.kernel;
    problem.datum = body.datum / profile.spacing;
    problem.strip_width = body.strip_width / profile.spacing;
    problem.layering = in_units(body.layering, profile.spacing, body.effective_modulus);
    problem.shape = profile.shape();
    problem.row_spacing = profile.row_spacing / profile.spacing;
    problem.column = influence_on(problem, problem.shape);
    problem.gap = (profile.heights.maxCoeff() - profile.heights.array()) / unit;
    for (const double displacement : displacements)
        problem.approach.push_back(displacement / unit);
    problem.displacement_unit = unit;
    problem.pressure_unit = body.effective_modulus * (unit / profile.spacing);
    problem.cap = body.hardness / problem.pressure_unit;
    problem.elements = elements(profile, body.kernel);
    problem.stiffness_unit =
        body.effective_modulus / (profile.is_2d() ? problem.elements * profile.spacing : length);
    problem.touches_only_overlapping =
        body.kernel == Kernel::strip || (body.kernel == Kernel::free && body.datum >= length);
    return problem;
}

ContactProblem make_problem_at(const Profile& profile, const Body& body,
                               const std::vector<double>& pressures) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    ContactProblem problem =
        make_problem(profile, body, {std::min(range > 0 ? range : 1, largest_displacement(profile, body))});
    problem.approach.clear();
    for (const double pressure : pressures)
        problem.load.push_back(pressure / problem.pressure_unit * problem.elements);
    return problem;
}

Eigen::VectorXd influence_on(const ContactProblem& problem, Extent shape) {
    return problem.is_2d()
               ? area_influence_column(problem.kernel, shape, problem.row_spacing, problem.layering)
               : influence_column(problem.kernel, shape.nodes(), problem.datum, problem.strip_width,
                                  problem.layering);
}

Eigen::VectorXd spectrum_on(const ContactProblem& problem, Extent shape) {
    return problem.is_2d() ? area_spectrum(shape, problem.row_spacing, problem.layering)
                           : periodic_spectrum(shape.nodes(), problem.layering);
}

template <typename Operator>
static Operator operator_of(const ContactProblem& problem) {
    const Extent shape = problem.shape;
    if (problem.kernel == Kernel::periodic && is_good_fourier_length(shape.columns) &&
        is_good_fourier_length(shape.rows))
        return Operator::circulant(shape, spectrum_on(problem, shape));
    return Operator::toeplitz(problem.column, shape);
}

SplitOperator split_operator(const ContactProblem& problem) {
    return SplitOperator(problem.column, problem.shape);
}

FourierOperator fourier_operator(const ContactProblem& problem) {
    return operator_of<FourierOperator>(problem);
}

SingleFourierOperator single_fourier_operator(const ContactProblem& problem) {
    return operator_of<SingleFourierOperator>(problem);
}

LoadStep load_step(const ContactProblem& problem, double displacement, const StepSolution& found) {
    LoadStep step;
    step.displacement = displacement;
    step.pressure = found.pressure.sum() / problem.elements * problem.pressure_unit;
    step.tangent_stiffness = found.stiffness * problem.stiffness_unit;
    step.kkt_residual = found.residual;
    if (!std::isfinite(step.pressure) || !std::isfinite(step.tangent_stiffness))
        refuse(
            "mean pressure ", step.pressure, " MPa and stiffness ", step.tangent_stiffness,
            " MPa/mm at a displacement of ", displacement,
            " mm, a modulus, heights and a node spacing whose response fits double precision are expected");
    step.contact_nodes = static_cast<Index>(found.nodes.size());
    step.held_nodes = found.held;
    step.contact_fraction = static_cast<double>(step.contact_nodes) / static_cast<double>(problem.nodes());
    return step;
}

void check_stop(const ContactOptions& options) {
    if (is_stopped(options))
        throw NotConverged("stopped before the contact was solved");
}

void fail(const char* solver, const ContactProblem& problem, double approach, double residual,
          double tolerance) {
    PlainStream line;
    line << solver << " did not settle at an approach of " << approach * problem.displacement_unit
         << " mm: residual " << residual << " where " << tolerance << " is expected";
    throw NotConverged(line.str());
}

Eigen::VectorXd full_contact_pressure(const ContactProblem& problem) {
    Eigen::ArrayXd stiffness = 1 / spectrum_on(problem, problem.shape).array();
    stiffness[0] = 0;
    FourierOperator inverse = FourierOperator::circulant(problem.shape, stiffness.matrix());
    Eigen::VectorXd::Map(inverse.input(), problem.nodes()) = -problem.gap;
    return Eigen::VectorXd::Map(inverse.apply(), problem.nodes());
}

} // namespace rough
