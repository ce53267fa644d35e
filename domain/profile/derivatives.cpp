#include "domain/profile/derivatives.hpp"

#include "domain/errors.hpp"

#include <array>

namespace rough {
namespace {

constexpr Index reach = 3;
constexpr std::array<double, 7> first{-1, 9, -45, 0, 45, -9, 1};        // over 60 delta
constexpr std::array<double, 7> second{2, -27, 270, -490, 270, -27, 2}; // over 180 delta^2

/// The surface, continued by three nodes to every side where it is periodic.
Eigen::ArrayXXd continued(const Profile& surface, bool periodic) {
    const auto [columns, rows] = surface.shape();
    const Eigen::Map<const Eigen::ArrayXXd> z(surface.heights.data(), columns, rows);
    const Index across = surface.is_2d() ? reach : 0;
    if (!periodic)
        return z;
    Eigen::ArrayXXd all(columns + 2 * reach, rows + 2 * across);
    for (Index j = 0; j < all.cols(); ++j)
        for (Index i = 0; i < all.rows(); ++i)
            all(i, j) = z((i + columns - reach) % columns, (j + rows - across) % rows);
    return all;
}

} // namespace

Derivatives derivatives(const Profile& surface, bool periodic) {
    const auto [columns, rows] = surface.shape();
    const bool is_area = surface.is_2d();
    if (columns < 2 * reach + 1 || (is_area && rows < 2 * reach + 1))
        refuse("derivatives: ", columns, " x ", rows, " nodes, expected at least 7 along each side");
    const Eigen::ArrayXXd z = continued(surface, periodic);
    const Index across = is_area ? reach : 0, inner = z.rows() - 2 * reach,
                inner_rows = z.cols() - 2 * across;
    const auto along = [&](const std::array<double, 7>& weights, double divisor, bool y) {
        Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(inner, inner_rows);
        for (Index k = 0; k <= 2 * reach; ++k)
            sum += weights[static_cast<std::size_t>(k)] / divisor *
                   (y ? z.block(reach, k, inner, inner_rows) : z.block(k, across, inner, inner_rows));
        return sum;
    };
    const double dx = surface.spacing, dy = surface.row_spacing;
    Derivatives of{along(first, 60 * dx, false), {}, along(second, 180 * dx * dx, false), {}};
    if (is_area) {
        of.y = along(first, 60 * dy, true);
        of.yy = along(second, 180 * dy * dy, true);
    }
    return of;
}

} // namespace rough
