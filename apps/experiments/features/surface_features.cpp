#include "apps/experiments/features/surface_features.hpp"

#include "apps/report/units.hpp"
#include "domain/contact/pressure_and_gap.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/profile/roughness.hpp"
#include "domain/response/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace app {

namespace {

/// From the middle of the profile, over its length, 0 to 1/2.
double off_middle(Eigen::Index node, Eigen::Index nodes) {
    return std::abs(static_cast<double>(node) / static_cast<double>(nodes - 1) - 0.5);
}

/// The highest node at least an eighth of the length from another.
Eigen::Index second_peak(const Eigen::VectorXd& z, Eigen::Index first) {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < z.size(); ++i)
        if (std::abs(i - first) >= z.size() / 8 && (best < 0 || z[i] > z[best]))
            best = i;
    return best;
}

} // namespace

std::size_t wave_octave(double wave_length, double length) {
    const double octave = std::round(std::log2(length / wave_length));
    return static_cast<std::size_t>(std::clamp(octave, 0., static_cast<double>(wave_octaves - 1)));
}

std::string octave_name(std::size_t octave) {
    return octave == 0 ? "about L and longer"
                       : "about L/" + std::to_string(1 << octave) +
                             (octave + 1 == wave_octaves ? " and shorter" : "");
}

std::vector<SurfaceFeature> features_of(const rough::Genome& genome, const rough::Model& model) {
    const rough::Profile profile = sample(genome, model.grid);
    const Eigen::VectorXd& z = profile.heights;
    Eigen::Index top = 0, bottom = 0;
    const double highest = z.maxCoeff(&top), range = highest - z.minCoeff(&bottom);
    const rough::Roughness about = roughness(profile);
    std::vector<SurfaceFeature> features;
    const auto add = [&](const std::string& name, const std::string& meaning, double value) {
        features.push_back({name, meaning, value});
    };
    add("highest peak", "its distance from the middle, over L", off_middle(top, z.size()));
    add("deepest valley", "its distance from the middle, over L", off_middle(bottom, z.size()));
    const Eigen::Index second = second_peak(z, top);
    add("second peak's depth", "under the highest, at least L/8 away, over the height range",
        (highest - z[second]) / range);
    add("peaks' distance", "of the two, over L",
        static_cast<double>(std::abs(second - top)) / static_cast<double>(z.size() - 1));
    for (const double depth : {0.05, 0.1, 0.25, 0.5})
        add("bearing " + brief(100 * depth) + " %",
            "share of the surface above that depth of the height range",
            static_cast<double>((z.array() > highest - depth * range).count()) /
                static_cast<double>(z.size()));
    add("mean depth", "of the mean line under the top, over the height range", about["Pp"] / range);
    add("Rq", "over the height range", about["Pq"] / range);
    add("skewness", "of the heights", about["Psk"]);
    add("kurtosis", "of the heights", about["Pku"]);
    add("slope", "log10 of the rms slope times L over the height range",
        std::log10(about["Pdq"] * model.grid.length / range));
    add("curvature", "log10 of the rms curvature times L² over the height range",
        std::log10(about["rms curvature"] * model.grid.length * model.grid.length / range));
    add("bandwidth", "log10 of Nayak's alpha", std::log10(about["bandwidth"]));
    std::array<double, wave_octaves> power{};
    double all = 0;
    for (const rough::Wave& wave : waves(genome)) {
        const double square = wave.amplitude * wave.amplitude;
        power[wave_octave(2 * std::numbers::pi / wave.wave_number, model.grid.length)] += square;
        all += square;
    }
    for (std::size_t octave = 0; octave < wave_octaves; ++octave)
        add("waves " + octave_name(octave), "log10 of their share of the power",
            std::log10(std::max(1e-9, power[octave] / all)));
    rough::Loading loading = model.loading;
    loading.steps = 10;
    rough::ContactOptions options = model.contact;
    const auto displacements = step_displacements(profile, model.body, loading, options);
    options.states = true;
    const auto pressed = solve_contact(profile, model.body,
                                       step_displacements(profile, model.body, loading, options), options);
    for (const std::size_t step : {1, 4, 9}) {
        const std::string at = " at " + brief(10 * static_cast<double>(step + 1), 3) + " % of the approach";
        const auto spots = rough::contact_spots(pressed.states[step].nodes, {z.size(), 1}, model.grid.wraps);
        add("spots" + at, "log10 of their number",
            std::log10(static_cast<double>(std::max<std::size_t>(1, spots.size()))));
        features.back().of_shape = false;
        add("contact" + at, "share of the nodes", pressed.steps[step].contact_fraction);
        features.back().of_shape = false;
    }
    return features;
}

} // namespace app
