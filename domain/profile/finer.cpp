#include "domain/profile/finer.hpp"

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

namespace rough {
namespace {

using Heights = Eigen::ArrayXXd;

/// Every column of the heights on `times` elements for each of its own.
Heights finer_columns(const Heights& heights, Index times, Interpolation by, bool periodic) {
    const Index nodes = heights.rows(), open = times * (nodes - 1) + 1;
    Heights fine(periodic ? times * nodes : open, heights.cols());
    for (Index column = 0; column < heights.cols(); ++column) {
        const auto z = heights.col(column);
        auto at = fine.col(column);
        for (Index i = 0; i < fine.rows(); ++i) {
            const double share = static_cast<double>(i % times) / static_cast<double>(times);
            at[i] = z[i / times] + share * (z[(i / times + 1) % nodes] - z[i / times]);
        }
        if (by == Interpolation::linear || nodes < 3)
            continue;
        const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(
            z.data(), z.data() + nodes, 0., 1., 2 * z[1] - 1.5 * z[0] - 0.5 * z[2],
            1.5 * z[nodes - 1] - 2 * z[nodes - 2] + 0.5 * z[nodes - 3]);
        for (Index i = 0; i < open; ++i)
            if (i % times != 0)
                at[i] = spline(static_cast<double>(i) / static_cast<double>(times));
    }
    return fine;
}

} // namespace

Profile finer(const Profile& surface, Index times, Interpolation by, bool periodic) {
    const auto [columns, rows] = surface.shape();
    Heights fine =
        finer_columns(Eigen::Map<const Heights>(surface.heights.data(), columns, rows), times, by, periodic);
    if (surface.is_2d())
        fine = finer_columns(fine.transpose(), times, by, periodic).transpose().eval();
    const double share = 1 / static_cast<double>(times);
    return {fine.reshaped(), surface.spacing * share, fine.cols(), surface.row_spacing * share};
}

} // namespace rough
