#include "domain/target/stiffness_limits.hpp"

#include "domain/contact/kernel.hpp"

#include <Eigen/Cholesky>

#include <limits>

namespace rough {

StiffnessLimits stiffness_limits(const Model& given) {
    const Model model = completed(given);
    // Full contact grows stiffer as the grid grows coarser, so a coarse grid's is an upper bound.
    Grid grid = model.grid;
    const double delta = grid.spacing();
    const auto column = [&](const Grid& g) {
        return Eigen::VectorXd(influence_column(model.body.kernel, g.nodes, model.body.datum / g.spacing(),
                                                model.body.strip_width / g.spacing()) *
                               (g.spacing() / model.body.effective_modulus));
    };
    const double least = delta / grid.length / column(grid)[0];
    if (model.body.kernel == Kernel::periodic)
        return {least, std::numeric_limits<double>::infinity()};
    while (grid.nodes > 1024)
        grid.nodes = (grid.nodes + 1) / 2;
    const Eigen::VectorXd h = column(grid);
    Eigen::MatrixXd H(grid.nodes, grid.nodes);
    for (Index i = 0; i < grid.nodes; ++i)
        for (Index j = 0; j < grid.nodes; ++j)
            H(i, j) = h[std::abs(i - j)];
    return {least, H.llt().solve(Eigen::VectorXd::Ones(grid.nodes)).sum() * grid.spacing() / grid.length};
}

} // namespace rough
