#include "domain/profile/areal.hpp"

#include "domain/errors.hpp"
#include "domain/profile/derivatives.hpp"

#include <cmath>

namespace rough {

ArealParameters areal_parameters(const Profile& map, bool wraps) {
    constexpr Index fewest = 10;
    const auto [columns, rows] = map.shape();
    if (!map.is_2d() || columns < fewest || rows < fewest)
        refuse("areal parameters: a map of ", columns, " x ", rows, " nodes, expected at least 10 x 10");
    Profile about = map;
    about.heights.array() -= map.heights.mean();
    const Eigen::ArrayXd z = about.heights.array();
    ArealParameters s;
    s.Sa = z.abs().mean();
    s.Sq = std::sqrt(z.square().mean());
    if (!(s.Sq > 1e-14 * map.heights.cwiseAbs().maxCoeff()))
        refuse("areal parameters: the map is constant, expected a rough one");
    s.Ssk = (z / s.Sq).cube().mean();
    s.Sku = (z / s.Sq).square().square().mean();
    s.Sp = z.maxCoeff();
    s.Sv = -z.minCoeff();
    s.Sz = s.Sp + s.Sv;
    const Derivatives slopes = derivatives(about, wraps);
    const Eigen::ArrayXXd squares = slopes.x.square() + slopes.y.square();
    s.Sdq = std::sqrt(squares.mean());
    s.Sdr = (squares / ((1 + squares).sqrt() + 1)).mean(); // sqrt(1 + g^2) - 1
    s.Smr = material_ratio(about, 0);
    s.Smc10 = material_height(about.heights, 0.1);
    s.core = core_heights(about.heights);
    s.texture = texture(about, wraps);
    return s;
}

} // namespace rough
