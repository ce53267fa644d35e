#include "apps/experiments/chart/models.hpp"

#include "apps/experiments/contact_trial.hpp"
#include "domain/errors.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/theory/random_surface.hpp"
#include "domain/theory/theory.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using Eigen::VectorXd;
using rough::Index;
using rough::Profile;

constexpr double length = 1;                                         ///< mm
constexpr double longest = 0.25, shortest = 1.0 / 16;                ///< mm, of a map: 8 nodes of 128
constexpr double line_longest = 1.0 / 32, line_shortest = 1.0 / 256; ///< of a line, which has to be longer
constexpr Index line_finest = 4096;

rough::Grid grid_of(Index nodes, bool area) {
    rough::Grid grid{.nodes = nodes, .length = length, .wraps = true};
    if (area) {
        grid.rows = nodes;
        grid.width = length;
    }
    return grid;
}

Profile line_on(Index nodes) {
    return realised({.hurst = 0.8,
                     .longest = line_longest,
                     .shortest = line_shortest,
                     .rms_slope = 0.1,
                     .is_area = false},
                    grid_of(nodes, false), 1);
}

/// Isotropic, or ridges of the same cut-offs.
rough::SelfAffine with_cut_offs(bool area) {
    return {.hurst = 0.8, .longest = longest, .shortest = shortest, .rms_slope = 0.1, .is_area = area};
}
Profile map_on(Index side) { return realised(with_cut_offs(true), grid_of(side, true), 1); }

/// Ridges along y, of the map's cut-offs, and a tenth of the map.
Profile ground_on(Index side) {
    constexpr double share = 0.1;
    Profile map = map_on(side);
    const VectorXd line = realised(with_cut_offs(false), grid_of(side, false), 2).heights;
    map.heights = share * map.heights + line.replicate(side, 1);
    return map;
}

/// The mean over the rows.
Profile mean_line(const Profile& map) {
    const auto [columns, rows] = map.shape();
    return {map.heights.reshaped(columns, rows).rowwise().mean(), map.spacing};
}
Profile first_row(const Profile& map) { return {map.heights.head(map.shape().columns), map.spacing}; }

struct Answer {
    VectorXd contact_fraction, stiffness;
};

Answer pressed(const Profile& surface, const VectorXd& pressures) {
    rough::Body body;
    body.kernel = rough::Kernel::periodic;
    const VectorXd none = VectorXd::Constant(pressures.size(), std::nan(""));
    Answer answer{none, none};
    std::vector<double> loads(pressures.begin(), pressures.end());
    rough::ContactCurve curve;
    for (; !loads.empty() && curve.steps.empty(); loads.pop_back()) // the heaviest may be beyond full contact
        try {
            curve = solve_contact_at_pressures(surface, body, loads);
        } catch (const rough::InputError&) {
        }
    for (std::size_t j = 0; j < curve.steps.size(); ++j) {
        answer.contact_fraction[static_cast<Index>(j)] = curve.steps[j].contact_fraction;
        answer.stiffness[static_cast<Index>(j)] = curve.steps[j].tangent_stiffness;
    }
    return answer;
}

/// The least time of a few, all within a tenth of a second, and what the work gave.
template <class Work>
ModelRun timed(ModelRun run, Work work) {
    double spent = 0;
    for (int k = 0; k < 9 && (k == 0 || spent * (k + 1) < 0.1 * k); ++k) {
        const double start = processor_seconds();
        const auto answer = work();
        const double seconds = processor_seconds() - start;
        run.seconds = k == 0 ? seconds : std::min(run.seconds, seconds);
        spent += seconds;
        run.contact_fraction = answer.contact_fraction;
        run.stiffness = answer.stiffness;
    }
    return run;
}

class ModelCourse {
  public:
    ModelCourse(Index finest, const std::function<bool()>& stop) : finest_(finest), stop_(stop) {}

    ModelChart run() {
        add("self-affine-line", "a self-affine profile, H = 0.8, waves from L/32 to L/256", line_on,
            line_finest, {512, 1024, 2048});
        std::vector<Index> sides;
        for (Index side = 32; side < finest_; side *= 2)
            sides.push_back(side);
        add("self-affine-map", "an isotropic self-affine map, H = 0.8, waves from L/4 to L/16", map_on,
            finest_, sides);
        add("ground-map",
            "ridges along y, self-affine across, with a tenth of the isotropic map's roughness on them",
            ground_on, finest_, sides);
        return std::move(chart_);
    }

  private:
    void add(const std::string& name, const std::string& words, const std::function<Profile(Index)>& on,
             Index finest, const std::vector<Index>& coarser) {
        if (stop_ && stop_())
            return;
        const Profile surface = on(finest);
        const rough::RandomSurface random = random_surface(surface, true);
        ModelScene scene{name,
                         words,
                         "the same surface on " + std::to_string(finest) +
                             (surface.is_2d() ? " x " + std::to_string(finest) : "") + " nodes",
                         rms_slope(random),
                         std::sqrt(spectral_moments(random).m0),
                         surface.is_2d() ? texture(surface, true).Str : 0,
                         {},
                         {},
                         {}};
        constexpr int loads = 12;
        constexpr double lightest = 0.005, heaviest = 1.6; // erf of it over sqrt 2 is what touches
        scene.pressure = scene.rms_slope / 2 *
                         (VectorXd::LinSpaced(loads, std::log(lightest), std::log(heaviest)).array().exp());
        const Answer exact = pressed(surface, scene.pressure);
        scene.contact_fraction = exact.contact_fraction;
        scene.stiffness = exact.stiffness;
        const std::size_t number = chart_.scenes.size();
        chart_.scenes.push_back(scene);
        const auto measure = [&](ModelRun::Family family, const std::string& model, Index nodes, auto work) {
            if (!stop_ || !stop_())
                chart_.runs.push_back(timed({number, family, model, nodes, 0, {}, {}}, work));
        };
        for (const std::string& theory : rough::theory_names()) {
            const auto which = static_cast<rough::Theory>(&theory - rough::theory_names().data());
            if (holds_for(which, surface.is_2d()))
                measure(ModelRun::Family::theory, theory, 0,
                        [&] { return foretold_curve(which, random, 1, scene.pressure); });
        }
        if (surface.is_2d()) {
            measure(ModelRun::Family::line, "section", finest,
                    [&] { return pressed(first_row(surface), scene.pressure); });
            measure(ModelRun::Family::line, "mean-line", finest,
                    [&] { return pressed(mean_line(surface), scene.pressure); });
        }
        for (const Index nodes : coarser) {
            const Profile coarse = on(nodes);
            measure(ModelRun::Family::grid, surface.is_2d() ? "map" : "profile", coarse.nodes(),
                    [&] { return pressed(coarse, scene.pressure); });
        }
    }

    Index finest_;
    const std::function<bool()>& stop_;
    ModelChart chart_;
};

} // namespace

ModelChart charted_models(Index finest, const std::function<bool()>& stop) {
    return ModelCourse(finest, stop).run();
}

double root_mean_square(const VectorXd& errors) {
    double sum = 0;
    int count = 0;
    for (const double error : errors)
        if (std::isfinite(error))
            sum += error * error, ++count;
    return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

std::pair<double, double> errors_of(const ModelRun& run, const ModelScene& scene) {
    return {root_mean_square(run.area_errors(scene)), root_mean_square(run.stiffness_errors(scene))};
}

Csv models_table(const ModelChart& chart) {
    Csv table("scene,model,nodes,seconds,pressure_MPa,contact_fraction,stiffness_MPa_per_mm,error_contact,"
              "error_stiffness",
              6);
    for (const ModelRun& run : chart.runs) {
        const ModelScene& scene = chart.scenes[run.scene];
        const VectorXd area = run.area_errors(scene), stiffness = run.stiffness_errors(scene);
        for (Index j = 0; j < area.size(); ++j)
            table.row(scene.name, run.model, run.nodes, run.seconds, scene.pressure[j],
                      run.contact_fraction[j], run.stiffness[j], area[j], stiffness[j]);
    }
    return table;
}

} // namespace app
