#include "domain/contact/solvers/cascade.hpp"

#include "domain/contact/kernel.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

ContactProblem coarsened(const ContactProblem& problem, Index stride, Index first) {
    ContactProblem coarse = problem;
    const Index nodes = (problem.nodes() - 1 - first) / stride + 1;
    const double ratio = static_cast<double>(stride);
    coarse.gap = problem.gap(Eigen::seqN(first, nodes, stride));
    coarse.datum = problem.datum / ratio;
    coarse.strip_width = problem.strip_width / ratio;
    coarse.column = influence_column(problem.kernel, nodes, coarse.datum, coarse.strip_width);
    coarse.pressure_unit = problem.pressure_unit / ratio;
    coarse.elements = problem.elements / ratio;
    return coarse;
}

Eigen::VectorXd refined_pressures(const StepSolution& coarse, Index coarse_nodes, Index stride, Index nodes) {
    // Squares of the coarse pressures, with one extrapolated value beyond each edge, as it may be: negative.
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(coarse_nodes);
    for (std::size_t k = 0; k < coarse.nodes.size(); ++k)
        squares[coarse.nodes[k]] = std::pow(coarse.pressure[static_cast<Index>(k)], 2);
    auto beyond = [&](Index edge, Index inner) {
        const double slope = inner >= 0 && inner < coarse_nodes ? squares[inner] - squares[edge] : 0;
        return -std::max(slope, squares[edge]);
    };
    Eigen::VectorXd fine = Eigen::VectorXd::Zero(nodes);
    const double unit = static_cast<double>(stride);
    for (Index i = 0; i < nodes; ++i) {
        const Index left = i / stride, right = std::min(left + 1, coarse_nodes - 1);
        double a = squares[left], b = squares[right];
        if (a == 0 && b == 0)
            continue;
        if (a == 0)
            a = beyond(right, right + 1);
        else if (b == 0)
            b = beyond(left, left - 1);
        const double share = static_cast<double>(i - left * stride) / unit, square = a + share * (b - a);
        if (square > 0) // pressures are in units of 1/delta
            fine[i] = std::sqrt(square) / unit;
    }
    return fine;
}

} // namespace rough
