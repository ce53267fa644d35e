#include "apps/experiments/paper/fractal_study.hpp"

#include "domain/numerics/statistics.hpp"
#include "domain/response/curve.hpp"
#include "ga/parallel.hpp"
#include "ga/random.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

constexpr double hurst = 0.8;      ///< of fracture surfaces (Bouchaud, Lapasset and Planes 1990)
constexpr double rms = 1e-3;       ///< mm; a profile's K does not depend on its amplitude
constexpr double threshold = 0.95; ///< of Algorithm 1

FractalStudy study_of(const rough::Model& model, std::uint64_t seed) {
    const auto answer = [&](const rough::Profile& profile) {
        return respond(profile, model.body, model.loading, model.contact);
    };
    FractalStudy study;
    study.whole = rough::fractal_profile(model.grid, hurst, rms, seed);
    study.whole_response = answer(study.whole);
    study.bands = rough::octave_bands(study.whole);
    const rough::Curve whole = secant_stiffness(study.whole_response);
    for (const rough::Band& band : study.bands) {
        const rough::Curve alone = secant_stiffness(answer({band.heights, study.whole.spacing}));
        Eigen::VectorXd held(whole.x.size());
        for (Eigen::Index j = 0; j < held.size(); ++j)
            held[j] = alone.held_at(whole.x[j]);
        study.correlation.push_back(rough::pearson(whole.y, held));
        study.dominant.push_back(study.correlation.back() > threshold);
    }
    if (std::find(study.dominant.begin(), study.dominant.end(), true) == study.dominant.end()) {
        const auto best =
            std::max_element(study.correlation.begin(), study.correlation.end(), [](double a, double b) {
                return (std::isnan(a) ? -2 : a) < (std::isnan(b) ? -2 : b);
            });
        study.dominant[static_cast<std::size_t>(best - study.correlation.begin())] = true;
    }
    study.reduced = {Eigen::VectorXd::Zero(study.whole.nodes()), study.whole.spacing};
    for (std::size_t b = 0; b < study.bands.size(); ++b)
        if (study.dominant[b])
            study.reduced.heights += study.bands[b].heights;
    study.reduced_response = answer(study.reduced);
    return study;
}

} // namespace

std::vector<FractalStudy> fractal_studies(const rough::Model& model, std::uint64_t seed, int threads) {
    std::vector<FractalStudy> studies(20);
    ga::parallel_for(studies.size(), threads,
                     [&](std::size_t i) { studies[i] = study_of(model, ga::fold(seed, i)); });
    return studies;
}

} // namespace app
