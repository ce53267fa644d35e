#include "apps/commands/design/files.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/drawn.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr std::size_t max_surfaces = 6; ///< answers whose heights are drawn

/// The responses that are drawn. `answer` is on the set-up's grid. `finer` is on a grid four times finer, if
/// the answer was verified there. `before` is that of the surface in production, if there is one.
std::vector<std::pair<std::string, rough::DesignResponse>> drawn_responses(const DesignRun& run) {
    std::vector<std::pair<std::string, rough::DesignResponse>> all{{"answer", run.own}};
    if (const auto& finer = run.found.best.verification.on_finer; !finer.empty())
        all.emplace_back("finer", scored(run.setup, finer));
    if (run.from)
        all.emplace_back("before", respond(run.setup, run.from->genome, run.setup.model));
    return all;
}

/// Curves and, at the targets' points, misfits over the weight; x and y in the units of the target's file.
void write_curves(const DesignRun& run, const std::filesystem::path& folder) {
    Csv curves("target,curve,x,y"), points("target,x,y,lower,upper,misfit,misfit_finer");
    const auto responses = drawn_responses(run);
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t) {
        const rough::Target& target = run.setup.targets[t];
        for (const auto& [name, response] : responses) {
            const rough::Curve curve = to_its_end(response.curves[t]);
            for (rough::Index k = 0; k < curve.x.size(); ++k)
                curves.row(t + 1, name, curve.x[k], curve.y[k]);
        }
        const auto misfits = [&](std::size_t of) -> Eigen::VectorXd {
            return responses.size() > of && responses[of].first != "before"
                       ? Eigen::VectorXd(misfit(target, responses[of].second.curves[t]) / target.weight)
                       : Eigen::VectorXd::Constant(target.points(), NAN);
        };
        const Eigen::VectorXd own = misfits(0), finer = misfits(1);
        for (rough::Index k = 0; k < target.points(); ++k)
            points.row(t + 1, target.x[k], target.y[k], target.has_band() ? target.lower[k] : NAN,
                       target.has_band() ? target.upper[k] : NAN, own[k], finer[k]);
    }
    rough::write_atomically(folder / "curves.csv", curves.text());
    rough::write_atomically(folder / "points.csv", points.text());
}

/// Heights below the highest point of each answer, and of the scan that was given, if there is one.
void write_heights(const DesignRun& run, const std::filesystem::path& folder) {
    const rough::Grid& grid = run.setup.model.grid;
    std::vector<std::pair<std::string, rough::Profile>> surfaces;
    if (run.setup.like)
        surfaces.emplace_back("scan", *run.setup.like);
    for (std::size_t i = 0; i < std::min(max_surfaces, run.found.alternatives.size()); ++i)
        surfaces.emplace_back(std::to_string(i + 1), sample(run.found.alternatives[i].genome, grid));
    if (surfaces.empty())
        return;
    if (grid.is_2d()) {
        std::vector<std::string> names;
        std::vector<Eigen::VectorXd> values;
        for (const auto& [name, surface] : surfaces) {
            names.push_back("height_" + name + "_mm");
            values.push_back(below_highest(surface));
        }
        if (run.trust) {
            names.emplace_back("pressure_MPa");
            values.emplace_back(Eigen::VectorXd::Constant(surfaces.back().second.nodes(), NAN));
            values.back()(run.trust->last.nodes) = run.trust->last.pressure;
        }
        rough::write_atomically(folder / "map.csv", map_csv(surfaces.back().second, names, values));
        return;
    }
    std::string table = "surface,x_mm,height_mm\n";
    for (const auto& [name, surface] : surfaces)
        table += drawn_rows(name, {positions(surface), below_highest(surface)});
    rough::write_atomically(folder / "heights-drawn.csv", table);
}

void write_front(const DesignRun& run, const std::filesystem::path& folder) {
    Csv table("similarity_1,similarity_2,refined_1,refined_2");
    for (const rough::Compromise& one : run.found.front)
        table.row(one.similarity[0], one.similarity[1], one.similarity_refined[0], one.similarity_refined[1]);
    rough::write_atomically(folder / "front.csv", table.text());
}

void write_made(const DesignRun& run, const std::filesystem::path& folder) {
    Csv table("similarity,similarity_made");
    for (const rough::Answer& one : run.found.made)
        table.row(one.similarity, one.similarity_made);
    rough::write_atomically(folder / "made.csv", table.text());
}

} // namespace

void write_design_drawings(const DesignRun& run, const std::filesystem::path& folder) {
    write_curves(run, folder);
    write_heights(run, folder);
    if (!run.found.front.empty())
        write_front(run, folder);
    if (!run.found.made.empty())
        write_made(run, folder);
}

} // namespace app
