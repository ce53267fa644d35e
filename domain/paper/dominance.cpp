#include "domain/paper/dominance.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/prices.hpp"

namespace rough {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double threshold = 0.95; ///< correlation above which a part is dominant (the paper)

/// The response of one length scale alone; none if it is flat at the nodes.
std::optional<Response> response_alone(const Genome& genome, const LengthScale& scale, const Model& model) {
    const Genome alone = only(genome, scale);
    const Profile profile = sample(alone, model.grid);
    if (is_flat(profile, alone)) return std::nullopt;
    return respond(profile, model.body, model.loading, model.contact);
}

} // namespace

DominantParts dominant_parts(const Curve& whole, const std::vector<std::optional<Curve>>& parts) {
    DominantParts result;
    double best = -std::numeric_limits<double>::infinity();
    for (const auto& part : parts) {
        double correlation = undefined;
        if (part) // constant beyond the part's points
            correlation = pearson(whole.y, whole.x.unaryExpr([&](double x) {
                return part->at(std::clamp(x, part->x[0], part->x[part->x.size() - 1]));
            }));
        if (correlation > best) best = correlation;
        result.correlation.push_back(correlation);
        result.dominant.push_back(correlation > threshold); // Algorithm 1
    }
    result.only_best = !(best > threshold);
    if (result.only_best) // our choice; the paper does not treat this case
        for (std::size_t i = 0; i < parts.size(); ++i)
            result.dominant[i] = !std::isfinite(best) || result.correlation[i] == best;
    return result;
}

bool Dominance::at(std::size_t series, std::size_t chromosome) const {
    for (std::size_t i = 0; i < scales.size(); ++i)
        if (std::ranges::count(scales[i].members, std::pair(series, chromosome)) > 0) return dominant[i] != 0;
    return false;
}

DominanceRule::DominanceRule(Model model) : model_(model) {
    for (Grid& grid = model_.grid; grid.is_2d() && std::max(grid.nodes, grid.rows) > 64;) {
        grid.nodes = (grid.nodes + 1) / 2;
        grid.rows = (grid.rows + 1) / 2;
    }
    price_ = relative_price(model_, model);
}

Dominance DominanceRule::operator()(const Genome& genome) const {
    const auto scales = length_scales(genome);
    std::vector<std::optional<Curve>> alone;
    for (const LengthScale& scale : scales) {
        const auto part = response_alone(genome, scale, model_); // none if it is flat
        alone.push_back(part ? std::optional(secant_stiffness(*part)) : std::nullopt);
    }
    const Curve whole = secant_stiffness(respond(genome, model_));
    const auto curves = 1 + std::ranges::count_if(alone, [](const auto& part) { return part.has_value(); });
    return {dominant_parts(whole, alone), scales, price_ * static_cast<double>(curves)};
}

Genome reduced(const Genome& genome, const Dominance& dominance) {
    return filtered(genome, [&](std::size_t s, std::size_t c) { return dominance.at(s, c); });
}

Genome reduced_to_target(const DesignSetup& setup, const Genome& genome, std::size_t target, ga::Work& work) {
    const Target& wanted = setup.targets[target];
    Model model = setup.model;
    (wanted.against_pressure() ? model.loading.to_pressure : model.loading.to_displacement) = wanted.last();
    const auto scales = length_scales(genome);
    std::vector<std::optional<Curve>> alone(scales.size());
    for (std::size_t i = 0; i < scales.size(); ++i) try {
            if (const auto response = response_alone(genome, scales[i], model)) {
                alone[i] = curve_of(wanted.quantity, *response);
                work.price += 1;
            }
        } catch (const InputError&) { // periodic, in full contact below that load
        }
    return reduced(genome, {dominant_parts({wanted.x, wanted.y}, alone), scales});
}

} // namespace rough
