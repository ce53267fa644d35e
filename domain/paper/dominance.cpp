#include "domain/paper/dominance.hpp"

#include "domain/mwm/length_scales.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

DominantParts dominant_parts(const Curve& whole, const std::vector<std::optional<Curve>>& parts,
                             double threshold, DominanceReading reading) {
    DominantParts result;
    double best = -std::numeric_limits<double>::infinity();
    for (const auto& part : parts) {
        double correlation = undefined;
        if (part && reading == DominanceReading::same_step)
            correlation = pearson(whole.y, part->y);
        else if (part)
            correlation = pearson(whole.y, whole.x.unaryExpr([&](double x) { return part->held_at(x); }));
        if (correlation > best)
            best = correlation;
        result.correlation.push_back(correlation);
        result.dominant.push_back(correlation > threshold); // Algorithm 1
    }
    result.only_best = !(best > threshold);
    if (result.only_best) // ours: the paper is silent on genomes of which none passes
        for (std::size_t i = 0; i < parts.size(); ++i)
            result.dominant[i] = !std::isfinite(best) || result.correlation[i] == best;
    return result;
}

DominanceRule::DominanceRule(Model model, DominanceReading reading)
    : model_(std::move(model)), reading_(reading) {
    for (Grid& grid = model_.grid; grid.is_area() && std::max(grid.nodes, grid.rows) > 64;) {
        grid.nodes = (grid.nodes + 1) / 2;
        grid.rows = (grid.rows + 1) / 2;
    }
}

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
    const auto scales = length_scales(genome);
    std::vector<std::optional<Curve>> alone;
    for (const LengthScale& scale : scales)
        alone.push_back(stiffness_of(genome, scale, model_));
    const DominantParts parts =
        dominant_parts(secant_stiffness(respond(genome, model_)), alone, dominance_threshold, reading_);
    Dominance result;
    result.only_best = parts.only_best;
    for (const auto& series : genome.series) {
        result.correlation.emplace_back(series.chromosomes.size(), undefined);
        result.dominant.emplace_back(series.chromosomes.size(), char{0});
    }
    for (std::size_t i = 0; i < scales.size(); ++i)
        for (const auto& [s, c] : scales[i].members) {
            result.correlation[s][c] = parts.correlation[i];
            result.dominant[s][c] = parts.dominant[i];
        }
    return result;
}

Genome reduced(const Genome& genome, const Dominance& dominance) {
    return filtered(genome, [&](std::size_t s, std::size_t c) { return dominance.at(s, c); });
}

} // namespace rough
