#include "apps/experiments/paper/fractal_study.hpp"

#include "domain/paper/dominance.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/random.hpp"

namespace app {

namespace {

constexpr double hurst = 0.8; ///< of fracture surfaces (Bouchaud, Lapasset and Planes 1990)
constexpr double rms = 1e-3;  ///< mm; a profile's K does not depend on its amplitude

FractalStudy study_of(const rough::Model& model, std::uint64_t seed, rough::DominanceReading reading,
                      double threshold) {
    const auto answer = [&](const rough::Profile& profile) {
        return respond(profile, model.body, model.loading, model.contact);
    };
    FractalStudy study;
    study.whole = rough::fractal_profile(model.grid, hurst, rms, seed);
    study.whole_response = answer(study.whole);
    study.bands = rough::octave_bands(study.whole);
    std::vector<std::optional<rough::Curve>> alone;
    for (const rough::Band& band : study.bands)
        alone.push_back(compared_curve(answer({band.heights, study.whole.spacing}), reading));
    const rough::DominantParts parts =
        dominant_parts(compared_curve(study.whole_response, reading), alone, threshold, reading);
    study.correlation = parts.correlation;
    study.dominant.assign(parts.dominant.begin(), parts.dominant.end());
    study.reduced = {Eigen::VectorXd::Zero(study.whole.nodes()), study.whole.spacing};
    for (std::size_t b = 0; b < study.bands.size(); ++b)
        if (study.dominant[b])
            study.reduced.heights += study.bands[b].heights;
    study.reduced_response = answer(study.reduced);
    return study;
}

} // namespace

std::vector<FractalStudy> fractal_studies(const rough::Model& model, std::uint64_t seed, int threads,
                                          rough::DominanceReading reading, double threshold) {
    std::vector<FractalStudy> studies(20);
    ga::parallel_for(studies.size(), threads, [&](std::size_t i) {
        studies[i] = study_of(model, ga::fold(seed, i), reading, threshold);
    });
    return studies;
}

} // namespace app
