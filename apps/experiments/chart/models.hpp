#pragma once

#include "apps/report/csv.hpp"
#include "domain/profile/profile.hpp"

#include <functional>

namespace app {

/// A random surface that repeats, and its exact curve: what models are measured against.
struct ModelScene {
    std::string name, words;
    std::string reference;                       ///< what it is measured against
    double rms_slope = 0;                        ///< h', rms gradient of a map
    double rms_height = 0;                       ///< mm
    double aspect_ratio = 0;                     ///< Str; 0: a line
    Eigen::VectorXd pressure;                    ///< of the loads, MPa; E* is 1 MPa
    Eigen::VectorXd contact_fraction, stiffness; ///< exact, MPa/mm
};

/// What a model says of a scene: a theory, one line in place of the map, or a coarser grid.
struct ModelRun {
    enum class Family { theory, line, grid };
    std::size_t scene = 0;
    Family family = Family::theory;
    std::string model;                           ///< its name
    rough::Index nodes = 0;                      ///< 0 of a theory
    double seconds = 0;                          ///< of the whole curve on one core, the least of a few
    Eigen::VectorXd contact_fraction, stiffness; ///< at the scene's loads; NaN where it has no answer

    /// Of one load, relative to the exact value; NaN where the model has no answer.
    Eigen::VectorXd area_errors(const ModelScene& of) const {
        return contact_fraction.array() / of.contact_fraction.array() - 1;
    }
    Eigen::VectorXd stiffness_errors(const ModelScene& of) const {
        return stiffness.array() / of.stiffness.array() - 1;
    }
};

/// Theories, lines and grids beside each other.
struct ModelChart {
    std::vector<ModelScene> scenes;
    std::vector<ModelRun> runs;
};

/// The scenes self-affine-line (a profile), self-affine-map (isotropic) and ground-map (ridges along y with a
/// tenth of roughness of every direction on them), H = 0.8, pressed from 0.5 % to nearly full contact. Exact
/// is a map of `finest` nodes a side; shorter waves than 8 nodes of 128 a side there are none. Ends early
/// where `stop` says so, with what there is.
ModelChart charted_models(rough::Index finest, const std::function<bool()>& stop = {});

/// models.csv: a row a load of each run.
Csv models_table(const ModelChart& chart);
/// Of the errors that are known; NaN of none.
double root_mean_square(const Eigen::VectorXd& errors);
/// Of a run over its loads, root mean square, relative: of the area, and of the stiffness; NaN of none.
std::pair<double, double> errors_of(const ModelRun& run, const ModelScene& scene);

} // namespace app
