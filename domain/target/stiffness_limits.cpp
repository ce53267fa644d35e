#include "domain/target/stiffness_limits.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/contact/kernel.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rough {

namespace {

/// More nodes of an area tell nothing more of full contact.
constexpr Index most_area_nodes = 128 * 128;

StiffnessLimits area_limits(const Model& model) {
    Grid grid = model.grid;
    const auto flat = [&] {
        return Profile{Eigen::VectorXd::Zero(grid.shape().nodes()), grid.spacing(), grid.rows,
                       grid.row_spacing()};
    };
    const double entry =
        influence_column(in_units(model.body, grid.spacing(), grid.row_spacing()), grid.shape())[0];
    const double least =
        model.body.effective_modulus / (elements(flat(), model.body.kernel) * grid.spacing() * entry);
    while (grid.shape().nodes() > most_area_nodes) {
        grid.nodes = (grid.nodes + 1) / 2;
        grid.rows = (grid.rows + 1) / 2;
    }
    return {least, full_contact_stiffness(flat(), model.body)};
}

} // namespace

StiffnessLimits stiffness_limits(const Model& given) {
    const Model model = completed(given);
    if (model.grid.is_2d())
        return area_limits(model);
    // Full contact grows stiffer as the grid grows coarser, so a coarse grid's is an upper bound.
    Grid grid = model.grid;
    const double delta = grid.spacing();
    const auto column = [&](const Grid& g) {
        return Eigen::VectorXd(influence_column(in_units(model.body, g.spacing(), 0), g.shape()) *
                               (g.spacing() / model.body.effective_modulus));
    };
    const double least = delta / grid.length / column(grid)[0];
    if (model.body.kernel == Kernel::periodic)
        return {least, full_contact_stiffness(grid.nodes, grid.spacing(), model.body)};
    while (grid.nodes > 1024)
        grid.nodes = (grid.nodes + 1) / 2;
    const Eigen::VectorXd h = column(grid);
    Eigen::MatrixXd H(grid.nodes, grid.nodes);
    for (Index i = 0; i < grid.nodes; ++i)
        for (Index j = 0; j < grid.nodes; ++j)
            H(i, j) = h[std::abs(i - j)];
    return {least, H.llt().solve(Eigen::VectorXd::Ones(grid.nodes)).sum() * grid.spacing() / grid.length};
}

// With secants K_1 <= ... <= K_n in [m, M] and even steps d the last load is P = d sum K_j, the ends lie at
// pi_1 = d K_1/2 and P - pi_n = d K_n/2, and their segments have the slopes 2 (K_2 - K_1)/(d (K_1 + K_2)) and
// 2 (K_n - K_{n-1})/(d (K_{n-1} + K_n)). Between pi_1 and pi_n the scored curve stays within [m, M]; so do
// the ends' lines where they are no continuation.
//
// At p = (1 - t) P beyond pi_n, with a = K_{n-1}, b = K_n:
//     y = 2 b^2/(a + b) - 2 t (b - a) sum K_j/(a + b).
// It is greatest where the other secants are least, sum K_j = a + b + (n - 2) m. Then it is quasiconvex in a
// and convex in b, so an end of each is best: M itself, or a = m and b = M.
//
// At p = t P before pi_1, with a = K_1, b = K_2:
//     y = 2 a^2/(a + b) + 2 t (b - a) sum K_j/(a + b).
// It is least where the others are least, sum K_j = a + (n - 1) b, and, as it is homogeneous in (a, b) and
// above 0, where a = m. Then it is convex in b, of the form c1 (b + m) + c2 + c3/(b + m).
StiffnessLimits scored_limits(const StiffnessLimits& secants, int steps, double share) {
    const auto [m, M] = secants;
    const double n = steps, t = std::clamp(share, 0.0, 1.0);
    const double turn = t > 0 ? m * std::sqrt((1 + t * (2 * n - 4)) / (t * (n - 1))) - m
                              : std::numeric_limits<double>::infinity();
    const double b = std::clamp(turn, m, M);
    const double least = std::isinf(b) ? 0 : 2 * (m * m + t * (b - m) * (m + (n - 1) * b)) / (m + b);
    const double most = std::isinf(M) ? M : 2 * (M * M - (1 - t) * (M - m) * (M + (n - 1) * m)) / (m + M);
    return {std::min(m, least), std::max(M, most)};
}

} // namespace rough
