#include "domain/numerics/statistics.hpp"

#include <cmath>
#include <limits>

namespace rough {

double pearson(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    const Eigen::ArrayXd da = a - a.mean(), db = b - b.mean();
    const double spread = std::sqrt((da * da).sum() * (db * db).sum());
    const double noise = 1e-12 * std::sqrt((a * a).sum() * (b * b).sum());
    return spread > noise ? (da * db).sum() / spread : std::numeric_limits<double>::quiet_NaN();
}

} // namespace rough
