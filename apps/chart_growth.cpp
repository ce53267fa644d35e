#include "apps/chart_growth.hpp"

#include <Eigen/QR>

#include <cmath>
#include <sstream>

namespace app {

Growth fitted_growth(const std::string& method, const std::vector<ChartRun>& runs) {
    std::vector<const ChartRun*> used;
    for (const ChartRun& run : runs)
        if (run.method == method && run.outcome == Outcome::solved && run.contact_fraction > 0)
            used.push_back(&run);
    Growth growth{method, 0, 0, 0, used.size()};
    if (used.size() < 4)
        return growth;
    const auto count = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd terms(count, 3);
    Eigen::VectorXd seconds(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const ChartRun& run = *used[static_cast<std::size_t>(k)];
        terms.row(k) << 1, std::log(static_cast<double>(run.nodes)), std::log(run.contact_fraction);
        seconds[k] = std::log(run.seconds);
    }
    const Eigen::Vector3d fit = terms.colPivHouseholderQr().solve(seconds);
    return {method, std::exp(fit[0]), fit[1], fit[2], used.size()};
}

std::string growth_csv(const std::vector<ChartRun>& runs) {
    std::ostringstream out;
    out.precision(6);
    out << "scene,method,nodes,contact_fraction,seconds\n";
    for (const ChartRun& run : runs)
        if (run.outcome == Outcome::solved)
            out << run.scene << "," << run.method << "," << run.nodes << "," << run.contact_fraction << ","
                << run.seconds << "\n";
    return out.str();
}

} // namespace app
