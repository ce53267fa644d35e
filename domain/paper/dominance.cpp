#include "domain/paper/dominance.hpp"

#include "domain/mwm/length_scales.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/response/curve.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace rough {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// The secant stiffness of one length scale alone, or nothing where it is flat at the nodes.
std::optional<Curve> stiffness_of(const Genome& genome, const LengthScale& scale, const Model& model) {
    const Genome alone = only(genome, scale);
    const Profile profile = sample(alone, model.grid);
    if (is_flat(profile, alone))
        return std::nullopt;
    return secant_stiffness(respond(profile, model.body, model.loading, model.contact));
}

} // namespace

Dominance DominanceRule::operator()(const Genome& genome) const {
    const std::string key = shape_key(genome);
    {
        const std::lock_guard lock(guard_);
        if (const auto found = known_.find(key); found != known_.end())
            return found->second;
    }
    const Dominance result = judged(genome);
    const std::lock_guard lock(guard_);
    return known_.emplace(key, result).first->second;
}

Dominance DominanceRule::judged(const Genome& genome) const {
    Dominance result;
    for (const auto& series : genome.series) {
        result.correlation.emplace_back(series.chromosomes.size(), undefined);
        result.dominant.emplace_back(series.chromosomes.size(), char{0});
    }
    const Curve whole = secant_stiffness(respond(genome, model_));
    const auto scales = length_scales(genome);
    double best = -std::numeric_limits<double>::infinity();
    for (const LengthScale& scale : scales) {
        double correlation = undefined;
        if (const auto curve = stiffness_of(genome, scale, model_)) {
            Eigen::ArrayXd K = curve->y;
            if (reading_ == DominanceReading::same_pressure)
                for (Index j = 0; j < K.size(); ++j)
                    K[j] = curve->held_at(whole.x[j]);
            correlation = pearson(whole.y, K);
        }
        if (correlation > best)
            best = correlation;
        for (const auto& [s, c] : scale.members) {
            result.correlation[s][c] = correlation;
            result.dominant[s][c] = correlation > threshold_; // Algorithm 1
        }
    }
    result.only_best = !(best > threshold_);
    if (result.only_best) // ours: the paper is silent on genomes of which none passes
        for (std::size_t s = 0; s < result.dominant.size(); ++s)
            for (std::size_t c = 0; c < result.dominant[s].size(); ++c)
                result.dominant[s][c] = !std::isfinite(best) || result.correlation[s][c] == best;
    return result;
}

Genome reduced(const Genome& genome, const Dominance& dominance) {
    return filtered(genome, [&](std::size_t s, std::size_t c) { return dominance.at(s, c); });
}

} // namespace rough
