#include "domain/contact/solvers/cascade.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

ContactProblem coarsened(const ContactProblem& problem, Index stride, Index node) {
    ContactProblem coarse = problem;
    const Extent fine = problem.shape;
    const Index first_x = node % fine.columns % stride,
                first_y = node / fine.columns % (fine.rows == 1 ? 1 : stride);
    coarse.shape = {(fine.columns - 1 - first_x) / stride + 1, (fine.rows - 1 - first_y) / stride + 1};
    const double ratio = static_cast<double>(stride);
    const Eigen::Map<const Eigen::MatrixXd> gap(problem.gap.data(), fine.columns, fine.rows);
    coarse.gap = gap(Eigen::seqN(first_x, coarse.shape.columns, stride),
                     Eigen::seqN(first_y, coarse.shape.rows, stride))
                     .reshaped();
    coarse.datum = problem.datum / ratio;
    coarse.strip_width = problem.strip_width / ratio;
    coarse.layering = in_units(problem.layering, ratio, 1);
    coarse.column = influence_on(coarse, coarse.shape);
    coarse.pressure_unit = problem.pressure_unit / ratio;
    coarse.elements = problem.elements / (problem.is_2d() ? ratio * ratio : ratio);
    for (double& load : coarse.load) // the same mean pressures, in the coarse grid's units
        load *= ratio * coarse.elements / problem.elements;
    return coarse;
}

namespace {

/// Squares of pressures along a coarse line, zero off contact, read at the nodes of a fine one; one value
/// beyond each edge is extrapolated, as it may be: negative. `step` apart, from the first on.
void refine_line(const double* squares, Index coarse, Index coarse_step, Index stride, double* fine,
                 Index nodes, Index step) {
    const auto square = [&](Index k) { return squares[k * coarse_step]; };
    auto beyond = [&](Index edge, Index inner) {
        const double slope = inner >= 0 && inner < coarse ? square(inner) - square(edge) : 0;
        return -std::max(slope, square(edge));
    };
    const double unit = static_cast<double>(stride);
    for (Index i = 0; i < nodes; ++i) {
        const Index left = i / stride, right = std::min(left + 1, coarse - 1);
        double a = square(left), b = square(right);
        fine[i * step] = 0;
        if (a == 0 && b == 0)
            continue;
        if (a == 0)
            a = beyond(right, right + 1);
        else if (b == 0)
            b = beyond(left, left - 1);
        const double share = static_cast<double>(i - left * stride) / unit;
        fine[i * step] = std::max(0.0, a + share * (b - a));
    }
}

} // namespace

Eigen::VectorXd refined_pressures(const StepSolution& coarse, Extent from, Index stride, Extent to) {
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(from.nodes());
    for (std::size_t k = 0; k < coarse.nodes.size(); ++k)
        squares[coarse.nodes[k]] = std::pow(coarse.pressure[static_cast<Index>(k)], 2);
    Eigen::VectorXd fine(to.columns * from.rows);
    for (Index j = 0; j < from.rows; ++j)
        refine_line(squares.data() + j * from.columns, from.columns, 1, stride, fine.data() + j * to.columns,
                    to.columns, 1);
    if (to.rows > 1) {
        const Eigen::VectorXd along_x = std::move(fine);
        fine.resize(to.nodes());
        for (Index i = 0; i < to.columns; ++i)
            refine_line(along_x.data() + i, from.rows, to.columns, stride, fine.data() + i, to.rows,
                        to.columns);
    }
    for (double& value : fine) // pressures are in units of 1/delta
        value = std::sqrt(value) / static_cast<double>(stride);
    return fine;
}

} // namespace rough
