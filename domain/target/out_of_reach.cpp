#include "domain/target/out_of_reach.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/plain_stream.hpp"
#include "domain/response/curve.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Rounding in files with four digits or more is no verdict.
constexpr double negligible = 1e-6;

template <class... Parts>
std::string line_of(const Parts&... parts) {
    PlainStream line;
    (line << ... << parts);
    return line.str();
}

/// What a curve may be at a point: the band, or the value itself.
struct Allowed {
    const Target& target;
    double lower(Index k) const { return target.has_band() ? target.lower[k] : target.y[k]; }
    double upper(Index k) const { return target.has_band() ? target.upper[k] : target.y[k]; }
    /// The misfit of the best value c with lower(i) > c > upper(j): both are missed by
    /// (lower_i - upper_j)/(y_i + y_j) at least.
    double least_misfit(Index i, Index j) const {
        return target.weight * (lower(i) - upper(j)) / (target.y[i] + target.y[j]);
    }
};

const char* unit_of(const Target& target) { return target.against_pressure() ? " MPa" : " mm"; }

const char* name_of(const Target& target) {
    return target.quantity == Quantity::interface_stiffness ? "interface stiffness" : "stiffness";
}

void find_fall(const Target& target, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    Index first = 0, second = 0;
    double worst = 0;
    for (Index i = 0; i < target.points(); ++i)
        for (Index j = i + 1; j < target.points(); ++j)
            if (allowed.least_misfit(i, j) > worst)
                worst = allowed.least_misfit(i, j), first = i, second = j;
    if (worst <= negligible)
        return;
    const char* what = is_contact_fraction(target.quantity) ? "contact fraction" : name_of(target);
    found.push_back({line_of(what, " falls from ", allowed.lower(first), " at ", target.x[first],
                             unit_of(target), " to ", allowed.upper(second), " at ", target.x[second],
                             unit_of(target), ": contact only grows under load, so it never falls"),
                     {target.x[first], target.x[second]},
                     1 - worst});
}

/// Stiffness against load: the last load, and the load steps up to it.
struct Load {
    StiffnessLimits secants;
    int steps;
    double last; ///< MPa
};

void find_too_stiff(const Target& target, const Load& load, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    const auto misfit = [&](Index k, double least_secant) {
        const double most =
            scored_limits({least_secant, load.secants.most}, load.steps, target.x[k] / load.last).most;
        return target.weight * (allowed.lower(k) - most) / target.y[k];
    };
    OutOfReach worst;
    worst.on_this_grid = true;
    for (Index k = 0; k < target.points(); ++k) {
        const double over = misfit(k, load.secants.least);
        if (over <= negligible)
            continue;
        worst.at.push_back(target.x[k]);
        worst.on_this_grid = worst.on_this_grid && misfit(k, 0) <= negligible;
        if (1 - over >= worst.bound)
            continue;
        worst.bound = 1 - over;
        worst.reason = line_of("stiffness ", allowed.lower(k), " MPa/mm at ", target.x[k],
                               " MPa is above that of full contact, ", load.secants.most, " MPa/mm");
        const double most = scored_limits(load.secants, load.steps, target.x[k] / load.last).most;
        if (most > load.secants.most)
            worst.reason += line_of(", even as the last load steps continue it, ", most, " MPa/mm");
    }
    if (!worst.at.empty())
        found.push_back(worst);
}

/// The least that a target of K or K_i can be answered with at a pressure (MPa), MPa/mm. With a second secant
/// near full contact the line that continues K_i below the first is as steep as one likes: no limit there.
/// The first lies at P/(2 n) at most, since secants never fall.
double least_at(double pressure, const Target& target, const Load& load) {
    const double share = pressure / load.last;
    if (target.quantity == Quantity::stiffness || std::isinf(load.secants.most)) // periodic: K_i = K
        return scored_limits(load.secants, load.steps, share).least;
    return 2 * load.steps * share >= 1 ? interface_of(load.secants.least, load.secants.most) : 0;
}

void find_too_soft(const Target& target, const Load& load, std::vector<OutOfReach>& found) {
    const bool of_interface = target.quantity == Quantity::interface_stiffness;
    const double one_node =
        of_interface ? interface_of(load.secants.least, load.secants.most) : load.secants.least;
    const Allowed allowed{target};
    OutOfReach worst;
    worst.on_this_grid = true;
    for (Index k = 0; k < target.points(); ++k) {
        const double least = least_at(target.x[k], target, load);
        const double under = target.weight * (least - allowed.upper(k)) / target.y[k];
        if (under <= negligible)
            continue;
        worst.at.push_back(target.x[k]);
        if (1 - under >= worst.bound)
            continue;
        worst.bound = 1 - under;
        worst.reason = line_of(name_of(target), " ", allowed.upper(k), " MPa/mm at ", target.x[k],
                               " MPa is below that of a single node in contact, ", one_node, " MPa/mm");
        if (least < one_node)
            worst.reason += line_of(", even as its first load steps continue it, ", least, " MPa/mm");
    }
    if (!worst.at.empty())
        found.push_back(worst);
}

/// Three points, the first of which may be (0, 0), of which the middle one lies above the chord.
void find_concave(const Target& target, const StiffnessLimits& limits, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    OutOfReach worst;
    for (Index i = -1; i < target.points(); ++i)
        for (Index j = i + 1; j < target.points(); ++j) {
            const double x_i = i < 0 ? 0 : target.x[i], y_i = i < 0 ? 0 : target.y[i];
            const double high_i = i < 0 ? 0 : allowed.upper(i);
            for (Index k = j + 1; k < target.points(); ++k) {
                const double t = (target.x[j] - x_i) / (target.x[k] - x_i);
                const double chord = (1 - t) * high_i + t * allowed.upper(k);
                // With misfits e, P_j (1 - e) <= chord of P (1 + e).
                const double misfit = target.weight * (allowed.lower(j) - chord) /
                                      (target.y[j] + (1 - t) * y_i + t * target.y[k]);
                if (misfit > negligible && 1 - misfit < worst.bound)
                    worst = {line_of("pressure ", target.y[j], " MPa at ", target.x[j],
                                     " mm is above the straight line from ", y_i, " MPa at ", x_i, " mm to ",
                                     target.y[k], " MPa at ", target.x[k],
                                     " mm: stiffness never falls, so the load curve is convex"),
                             {target.x[j]},
                             1 - misfit};
            }
            const double most = high_i + limits.most * (target.x[j] - x_i);
            const double misfit = target.weight * (allowed.lower(j) - most) / (target.y[j] + y_i);
            if (misfit > negligible && 1 - misfit < worst.bound)
                worst = {line_of("pressure rises to ", target.y[j], " MPa at ", target.x[j],
                                 " mm faster than with full ", "contact, ", limits.most, " MPa/mm"),
                         {target.x[j]},
                         1 - misfit};
        }
    if (worst.bound < 1)
        found.push_back(worst);
}

/// A load that rises by less, between two points or from (0, 0) on, than that of a single node does.
void find_too_light(const Target& target, const StiffnessLimits& limits, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    OutOfReach worst;
    worst.on_this_grid = true;
    for (Index i = -1; i < target.points(); ++i)
        for (Index j = i + 1; j < target.points(); ++j) {
            const double x_i = i < 0 ? 0 : target.x[i], y_i = i < 0 ? 0 : target.y[i];
            const double least = (i < 0 ? 0 : allowed.lower(i)) + limits.least * (target.x[j] - x_i);
            const double misfit = target.weight * (least - allowed.upper(j)) / (target.y[j] + y_i);
            if (misfit > negligible && 1 - misfit < worst.bound)
                worst = {line_of("pressure rises to ", target.y[j], " MPa at ", target.x[j],
                                 " mm slower than with a single node in contact, ", limits.least, " MPa/mm"),
                         {target.x[j]},
                         1 - misfit,
                         true};
        }
    if (worst.bound < 1)
        found.push_back(worst);
}

} // namespace

std::string OutOfReach::verdict() const {
    return (on_this_grid ? "out of reach of every profile on this grid: "
                         : "out of reach of every profile: ") +
           reason;
}

std::vector<OutOfReach> out_of_reach(const std::vector<Target>& targets, const Model& model,
                                     std::optional<double> max_pressure) {
    if (!contact_sets_nest(model.body, completed(model).grid)) // stiffness may fall
        return {};
    Load load{stiffness_limits(model), model.loading.steps, max_pressure.value_or(0)};
    for (const Target& target : targets)
        if (target.against_pressure())
            load.last = std::max(load.last, target.last());
    std::vector<OutOfReach> found;
    for (const Target& target : targets) {
        if (target.quantity == Quantity::load_at_displacement) {
            find_concave(target, load.secants, found);
            find_too_light(target, load.secants, found);
        } else {
            find_fall(target, found);
        }
        if (target.quantity == Quantity::stiffness)
            find_too_stiff(target, load, found);
        if (target.quantity == Quantity::stiffness || target.quantity == Quantity::interface_stiffness)
            find_too_soft(target, load, found);
    }
    return found;
}

} // namespace rough
