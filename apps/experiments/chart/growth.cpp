#include "apps/experiments/chart/growth.hpp"

#include "apps/experiments/chart/words.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/units.hpp"

#include <Eigen/QR>

#include <cmath>

namespace app {

namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using rough::Solver;

/// Coarser grids' times are mostly not of the grid.
constexpr rough::Index coarsest_fitted = 512;
constexpr std::size_t fewest_runs = 4;

/// Columns of what a law is made of, one row a run.
struct Observed {
    ArrayXd nodes, fraction, seconds;

    Observed(Solver method, const std::vector<ChartRun>& runs) {
        std::vector<const ChartRun*> used;
        for (const ChartRun& run : runs)
            if (run.setting.method == method && run.setting.nodes >= coarsest_fitted &&
                counts_for_growth(run))
                used.push_back(&run);
        const auto count = static_cast<Eigen::Index>(used.size());
        for (ArrayXd* column : {&nodes, &fraction, &seconds})
            column->resize(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            const ChartRun& run = *used[static_cast<std::size_t>(k)];
            nodes[k] = static_cast<double>(run.setting.nodes);
            fraction[k] = run.contact_fraction;
            seconds[k] = run.seconds;
        }
    }
    ArrayXd contact() const { return nodes * fraction; }
    double spread_from(const ArrayXd& fit) const {
        return std::exp(std::sqrt((fit / seconds).log().square().mean()));
    }
};

std::string nanoseconds(double seconds) { return brief(1e9 * seconds, 3) + " ns"; }

Growth by_terms(const Observed& runs, const ArrayXd& contact_term, const std::string& contact_word) {
    MatrixXd terms(runs.seconds.size(), 2);
    terms << runs.nodes * (2 * runs.nodes).log() / std::log(2.0), contact_term;
    // Relative errors alone would rather have a law too low than too high: with each weighted by the square
    // root of the law, both count the same.
    ArrayXd weights = 1 / runs.seconds;
    VectorXd fit;
    for (int k = 0; k < 20; ++k) {
        fit = (terms.array().colwise() * weights)
                  .matrix()
                  .colPivHouseholderQr()
                  .solve((runs.seconds * weights).matrix());
        const ArrayXd law = (terms * fit).array().max(1e-3 * runs.seconds);
        weights = 1 / (runs.seconds * law).sqrt();
    }
    const ArrayXd law = (terms * fit).array().max(1e-3 * runs.seconds);
    return {fit, nanoseconds(fit[0]) + " N log<sub>2</sub> 2N + " + nanoseconds(fit[1]) + " " + contact_word,
            runs.spread_from(law), static_cast<std::size_t>(runs.seconds.size())};
}

Growth by_powers(const Observed& runs) {
    MatrixXd terms(runs.seconds.size(), 3);
    terms << ArrayXd::Ones(runs.seconds.size()), runs.nodes.log(), runs.fraction.log();
    VectorXd fit = terms.colPivHouseholderQr().solve(runs.seconds.log().matrix());
    const double spread = runs.spread_from((terms * fit).array().exp());
    fit[0] = std::exp(fit[0]);
    return {fit,
            nanoseconds(fit[0]) + " N<sup>" + brief(fit[1], 3) + "</sup> f<sup>" + brief(fit[2]) + "</sup>",
            spread, static_cast<std::size_t>(runs.seconds.size())};
}

} // namespace

bool counts_for_growth(const ChartRun& run) {
    return run.outcome == Outcome::solved && run.contact_fraction > 0 && run.setting.steps == usual_steps &&
           run.setting.tolerance == usual_tolerance_of(run.setting.method);
}

Growth fitted_growth(Solver method, const std::vector<ChartRun>& runs) {
    const Observed observed(method, runs);
    if (static_cast<std::size_t>(observed.seconds.size()) < fewest_runs)
        return {{}, "too few runs", 0, static_cast<std::size_t>(observed.seconds.size())};
    if (method == Solver::nested)
        return by_terms(observed, observed.contact().cube(), "m<sup>3</sup>");
    if (method == Solver::nnls)
        return by_terms(observed, observed.contact().square() * observed.nodes, "m<sup>2</sup> N");
    return by_powers(observed);
}

std::string growth_csv(const ChartData& data) {
    Csv table("scene,method,nodes,contact_fraction,seconds", 6);
    for (const ChartRun& run : data.runs)
        if (counts_for_growth(run))
            table.row(data.scenes[run.setting.scene].name, name_of(run.setting.method), run.setting.nodes,
                      run.contact_fraction, run.seconds);
    return table.text();
}

} // namespace app
