#include "domain/contact/solvers/problem.hpp"

#include "domain/errors.hpp"

#include <cmath>

namespace rough {
namespace {

/// Loops over fewer nodes are over before another thread has begun.
constexpr Index shared_nodes = 128 * 128;

void check_profile(const Profile& profile) {
    if (profile.is_2d()) {
        if (!std::isfinite(profile.row_spacing))
            refuse("row spacing: ", profile.row_spacing, " mm is out of range (above 0, finite)");
        if (profile.rows < 1 || profile.nodes() % profile.rows != 0 || profile.shape().columns < 2)
            refuse("map: ", profile.nodes(), " heights do not make ", profile.rows,
                   " rows of equal length; give rows of at least 2 heights");
    }
    if (profile.nodes() < 2) refuse("profile: ", profile.nodes(), " node(s); give at least 2");
    if (!(profile.spacing > 0) || !std::isfinite(profile.spacing))
        refuse("node spacing: ", profile.spacing, " mm is out of range (above 0, finite)");
    for (Index i = 0; i < profile.nodes(); ++i)
        if (!std::isfinite(profile.heights[i]))
            refuse("node ", i, ": ", profile.heights[i], " mm is not a finite height; correct it");
    if (!std::isfinite(profile.heights.maxCoeff() - profile.heights.minCoeff()))
        refuse("heights: ", profile.heights.minCoeff(), " to ", profile.heights.maxCoeff(),
               " mm is a range beyond double precision; scale them");
}

void check_displacements(const Profile& profile, const Body& body, const std::vector<double>& displacements) {
    double previous = 0;
    for (const double displacement : displacements) {
        if (!std::isfinite(displacement) || displacement < previous)
            refuse("displacement: ", displacement, " mm after ", previous,
                   " mm is not a larger finite value; sort the displacements");
        previous = displacement;
    }
    if (!body.relative_to_mean()) return;
    const double full = largest_displacement(profile, body);
    if (profile.heights.maxCoeff() == profile.heights.minCoeff())
        refuse("profile: all heights are equal, and a flat profile carries any load at no approach on a "
               "periodic half-plane; give one with height differences");
    const double rounding = 1e-14 * profile.heights.cwiseAbs().maxCoeff();
    if (previous > full * (1 + 1e-12) + rounding)
        refuse("displacement: ", previous, " mm is out of range (at most ", full,
               " mm: beyond full contact the periodic half-plane has no solution)");
}

} // namespace

int useful_threads(const Profile& profile, int threads) {
    return profile.is_2d() && profile.nodes() >= shared_nodes ? threads : 1;
}

Body checked_body(const Profile& profile, const Body& given, const std::vector<double>& displacements) {
    check_profile(profile);
    if (profile.is_2d() && given.kernel == Kernel::strip)
        refuse_value("kernel", "strip", " cannot press a map, because it is one row; choose free or periodic");
    Body body = completed(given, profile_length(profile, given.kernel));
    if (profile.is_2d()) body.datum = profile.spacing * static_cast<double>(profile.nodes()); // none is needed
    validate(body, profile.nodes(), profile.spacing);
    check_displacements(profile, body, displacements);
    return body;
}

ContactProblem make_problem(const Profile& profile, const Body& given, const std::vector<double>& displacements,
                            Team& team) {
    const Body body = checked_body(profile, given, displacements);
    const double length = profile_length(profile, body.kernel);
    const double unit = displacements.empty() || displacements.back() == 0 ? 1 : displacements.back();
    ContactProblem problem;
    static_cast<UnitBody&>(problem) = in_units(body, profile.spacing, profile.row_spacing);
    problem.shape = profile.shape();
    problem.team = &team;
    problem.column = influence_column(problem, problem.shape, team);
    problem.gap = (profile.heights.maxCoeff() - profile.heights.array()) / unit;
    for (const double displacement : displacements) problem.approach.push_back(displacement / unit);
    problem.displacement_unit = unit;
    problem.pressure_unit = body.effective_modulus * (unit / profile.spacing);
    problem.cap = body.hardness / problem.pressure_unit;
    problem.elements = elements(profile, body.kernel);
    problem.stiffness_unit = body.effective_modulus / (profile.is_2d() ? problem.elements * profile.spacing : length);
    return problem;
}

ContactProblem make_problem_at(const Profile& profile, const Body& body, const std::vector<double>& pressures,
                               Team& team) {
    const double range = profile.heights.maxCoeff() - profile.heights.minCoeff();
    ContactProblem problem =
        make_problem(profile, body, {std::min(range > 0 ? range : 1, largest_displacement(profile, body))}, team);
    problem.approach.clear();
    for (const double pressure : pressures) problem.load.push_back(pressure / problem.pressure_unit * problem.elements);
    return problem;
}

ContactProblem coarsened(const ContactProblem& problem, Index stride, Index node) {
    ContactProblem coarse = problem;
    const Extent fine = problem.shape;
    const Index first_x = node % fine.columns % stride, first_y = node / fine.columns % (fine.rows == 1 ? 1 : stride);
    coarse.shape = {(fine.columns - 1 - first_x) / stride + 1, (fine.rows - 1 - first_y) / stride + 1};
    const double ratio = static_cast<double>(stride);
    const Eigen::Map<const Eigen::MatrixXd> gap(problem.gap.data(), fine.columns, fine.rows);
    coarse.gap =
        gap(Eigen::seqN(first_x, coarse.shape.columns, stride), Eigen::seqN(first_y, coarse.shape.rows, stride))
            .reshaped();
    const double share = problem.is_singular() ? coarse.gap.mean() / problem.gap.mean() : 1;
    for (double& approach : coarse.approach) approach *= share;
    coarse.datum = problem.datum / ratio;
    coarse.strip_width = problem.strip_width / ratio;
    coarse.layering = in_units(problem.layering, ratio, 1);
    if (coarse.nodes() < shared_nodes) coarse.team = &Team::alone();
    coarse.column = influence_column(coarse, coarse.shape, *coarse.team);
    coarse.pressure_unit = problem.pressure_unit / ratio;
    coarse.elements = problem.elements / (problem.is_2d() ? ratio * ratio : ratio);
    for (double& load : coarse.load) // equal mean pressures, in the coarse grid's units
        load *= ratio * coarse.elements / problem.elements;
    return coarse;
}

FourierOperator fourier_operator(const ContactProblem& problem) {
    if (problem.kernel == Kernel::periodic && is_good_fourier_length(problem.shape.columns) &&
        is_good_fourier_length(problem.shape.rows))
        return FourierOperator::circulant(problem.shape, periodic_spectrum(problem, problem.shape), *problem.team);
    return FourierOperator::toeplitz(problem.column, problem.shape, *problem.team);
}

void check_stop(const ContactOptions& options) {
    if (is_stopped(options)) throw NotConverged("stopped before the contact was solved");
}

Eigen::VectorXd full_contact_pressure(const ContactProblem& problem) {
    Eigen::VectorXd stiffness = periodic_spectrum(problem, problem.shape).cwiseInverse();
    stiffness[0] = 0;
    FourierOperator inverse = FourierOperator::circulant(problem.shape, stiffness, *problem.team);
    Eigen::VectorXd::Map(inverse.input(), problem.nodes()) = -problem.gap;
    return Eigen::VectorXd::Map(inverse.apply(), problem.nodes());
}

} // namespace rough
