#include "apps/chart_growth.hpp"

#include "apps/model_settings.hpp"

#include <Eigen/QR>

#include <cmath>
#include <sstream>

namespace app {

double Growth::seconds(double nodes, double contact_fraction) const {
    return factor * std::pow(nodes, by_nodes) * std::pow(contact_fraction, by_contact);
}

bool counts_for_growth(const ChartRun& run) {
    return run.outcome == Outcome::solved && run.contact_fraction > 0 && run.setting.steps == usual_steps &&
           run.setting.tolerance == usual_tolerance_of(run.setting.method);
}

namespace {

/// Coarser grids' times are mostly not of the grid.
constexpr rough::Index coarsest_fitted = 512;

} // namespace

Growth fitted_growth(rough::Solver method, const std::vector<ChartRun>& runs) {
    std::vector<const ChartRun*> used;
    for (const ChartRun& run : runs)
        if (run.setting.method == method && run.setting.nodes >= coarsest_fitted && counts_for_growth(run))
            used.push_back(&run);
    Growth growth{method};
    growth.runs = used.size();
    if (used.size() < 4)
        return growth;
    const auto count = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd terms(count, 3);
    Eigen::VectorXd seconds(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const ChartRun& run = *used[static_cast<std::size_t>(k)];
        terms.row(k) << 1, std::log(static_cast<double>(run.setting.nodes)), std::log(run.contact_fraction);
        seconds[k] = std::log(run.seconds);
    }
    const Eigen::Vector3d fit = terms.colPivHouseholderQr().solve(seconds);
    growth.factor = std::exp(fit[0]);
    growth.by_nodes = fit[1];
    growth.by_contact = fit[2];
    growth.spread = std::exp(std::sqrt((terms * fit - seconds).squaredNorm() / static_cast<double>(count)));
    return growth;
}

std::string growth_csv(const ChartData& data) {
    std::ostringstream out;
    out.precision(6);
    out << "scene,method,nodes,contact_fraction,seconds\n";
    for (const ChartRun& run : data.runs)
        if (counts_for_growth(run))
            out << data.scenes[run.setting.scene].name << "," << name_of(run.setting.method) << ","
                << run.setting.nodes << "," << run.contact_fraction << "," << run.seconds << "\n";
    return out.str();
}

} // namespace app
