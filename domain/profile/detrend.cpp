#include "domain/profile/detrend.hpp"

#include "domain/errors.hpp"

namespace rough {

Detrend detrend_named(std::string_view name, const std::string& where) {
    if (name == "none")
        return Detrend::none;
    if (name == "mean")
        return Detrend::mean;
    if (name == "line")
        return Detrend::line;
    if (name == "parabola")
        return Detrend::parabola;
    throw InputError(where + ": '" + std::string(name) + "', expected none, mean, line or parabola");
}

Eigen::VectorXd detrended(const Eigen::VectorXd& heights, Detrend form) {
    const Index powers = static_cast<Index>(form);
    if (powers == 0)
        return heights;
    // Gram-Schmidt over even nodes in [-1, 1]: powers up to 2 are far from dependent there.
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(heights.size(), -1, 1);
    Eigen::VectorXd rest = heights.array() - heights.mean();
    Eigen::VectorXd line = t.matrix();
    if (powers >= 2 && line.squaredNorm() > 0)
        rest -= line * (line.dot(rest) / line.squaredNorm());
    if (powers >= 3 && heights.size() > 2) {
        Eigen::VectorXd parabola = t.square() - t.square().mean();
        parabola -= line * (line.dot(parabola) / line.squaredNorm());
        if (parabola.squaredNorm() > 0)
            rest -= parabola * (parabola.dot(rest) / parabola.squaredNorm());
    }
    return rest;
}

} // namespace rough
