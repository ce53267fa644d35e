#include "domain/target/out_of_reach.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"

namespace rough {
namespace {

constexpr double negligible = 1e-6; ///< largest misfit from rounding in files with at least four digits

/// The values that a curve may have at a point: the band, or only y.
struct Allowed {
    const Target& target;
    double lower(Index k) const { return target.has_band() ? target.lower[k] : target.y[k]; }
    double upper(Index k) const { return target.has_band() ? target.upper[k] : target.y[k]; }
    /// If lower(i) > upper(j), a curve that does not fall misses one of both points by at least
    /// (lower_i - upper_j)/(y_i + y_j).
    double min_misfit(Index i, Index j) const {
        return target.weight * (lower(i) - upper(j)) / (target.y[i] + target.y[j]);
    }
};

const char* unit_of(const Target& target) { return target.against_pressure() ? " MPa" : " mm"; }

const char* name_of(const Target& target) {
    return target.quantity == Quantity::interface_stiffness ? "interface stiffness" : "stiffness";
}

/// Whether a misfit that no surface can avoid is the largest so far.
bool is_worse(double misfit, const OutOfReach& worst) { return misfit > negligible && 1 - misfit < worst.bound; }

/// Stiffness and contact fraction never fall.
void find_fall(const Target& target, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    const char* what = is_contact_fraction(target.quantity) ? "contact fraction" : name_of(target);
    OutOfReach worst;
    for (Index i = 0; i < target.points(); ++i)
        for (Index j = i + 1; j < target.points(); ++j)
            if (const double misfit = allowed.min_misfit(i, j); is_worse(misfit, worst))
                worst = {line_with_digits(6, what, " falls from ", allowed.lower(i), " at ", target.x[i],
                                          unit_of(target), " to ", allowed.upper(j), " at ", target.x[j],
                                          unit_of(target), ": contact only grows under load, so it never falls"),
                         {target.x[i], target.x[j]},
                         1 - misfit};
    found.push_back(worst);
}

/// The load steps against which stiffness is scored.
struct Load {
    StiffnessLimits secants;
    int steps;
    double last; ///< MPa
    bool on_map; ///< full contact of a map is stiffer on a finer grid
};

/// The lowest K or K_i that a curve can have at a pressure (MPa), MPa/mm. The limit below the first secant is
/// 0. If the second secant is near full contact, the line that continues K_i there is arbitrarily steep. The
/// first secant lies at P/(2 n) at most, because secants never fall.
double lowest_at(double pressure, const Target& target, const Load& load) {
    const double share = pressure / load.last;
    if (target.quantity == Quantity::stiffness || std::isinf(load.secants.max)) // periodic: K_i = K
        return scored_limits(load.secants, load.steps, share).min;
    return 2 * load.steps * share >= 1 ? interface_of(load.secants.min, load.secants.max) : 0;
}

/// Stiffness above that of full contact, or K or K_i below that of a single node.
void find_beyond_limits(const Target& target, const Load& load, std::vector<OutOfReach>& found) {
    const auto [min, max] = load.secants;
    const bool of_interface = target.quantity == Quantity::interface_stiffness;
    const double one_node = of_interface ? interface_of(min, max) : min;
    const Allowed allowed{target};
    OutOfReach stiff, soft;
    stiff.on_this_grid = soft.on_this_grid = true;
    for (Index k = 0; k < target.points(); ++k) {
        const double x = target.x[k], lowest = lowest_at(x, target, load);
        const auto highest = [&](double min_secant) {
            return scored_limits({min_secant, load.secants.max}, load.steps, x / load.last).max;
        };
        const auto misfit_at = [&](double min_secant) {
            return target.weight * (allowed.lower(k) - highest(min_secant)) / target.y[k];
        };
        if (const double misfit = misfit_at(min); !of_interface && misfit > negligible) {
            stiff.at.push_back(x);
            stiff.on_this_grid = stiff.on_this_grid && (load.on_map || misfit_at(0) <= negligible);
            if (is_worse(misfit, stiff)) {
                stiff.bound = 1 - misfit;
                stiff.reason = line_with_digits(6, "stiffness ", allowed.lower(k), " MPa/mm at ", x,
                                                " MPa is above that of full contact, ", max, " MPa/mm");
                if (highest(min) > max)
                    stiff.reason +=
                        line_with_digits(6, ", even as the last load steps continue it, ", highest(min), " MPa/mm");
            }
        }
        const double under = target.weight * (lowest - allowed.upper(k)) / target.y[k];
        if (under <= negligible) continue;
        soft.at.push_back(x);
        if (!is_worse(under, soft)) continue;
        soft.bound = 1 - under;
        soft.reason = line_with_digits(6, name_of(target), " ", allowed.upper(k), " MPa/mm at ", x,
                                       " MPa is below that of a single node in contact, ", one_node, " MPa/mm");
        if (lowest < one_node)
            soft.reason += line_with_digits(6, ", even as its first load steps continue it, ", lowest, " MPa/mm");
    }
    found.insert(found.end(), {stiff, soft});
}

/// A load above the chord of two points, the first of which may be (0, 0). Or one that rises by more than in
/// full contact, or by less than with a single node.
void find_beyond_loads(const Target& target, const Load& load, std::vector<OutOfReach>& found) {
    const Allowed allowed{target};
    const StiffnessLimits& limits = load.secants;
    OutOfReach steep, light;
    for (Index i = -1; i < target.points(); ++i) {
        const double x_i = i < 0 ? 0 : target.x[i], y_i = i < 0 ? 0 : target.y[i],
                     high_i = i < 0 ? 0 : allowed.upper(i), low_i = i < 0 ? 0 : allowed.lower(i);
        for (Index j = i + 1; j < target.points(); ++j) {
            const double x = target.x[j], y = target.y[j];
            for (Index k = j + 1; k < target.points(); ++k) {
                const double t = (x - x_i) / (target.x[k] - x_i);
                const double chord = (1 - t) * high_i + t * allowed.upper(k);
                // With misfits e, P_j (1 - e) <= chord of P (1 + e).
                const double misfit =
                    target.weight * (allowed.lower(j) - chord) / (y + (1 - t) * y_i + t * target.y[k]);
                if (is_worse(misfit, steep))
                    steep = {line_with_digits(6, "pressure ", y, " MPa at ", x, " mm is above the straight line from ",
                                              y_i, " MPa at ", x_i, " mm to ", target.y[k], " MPa at ", target.x[k],
                                              " mm: stiffness never falls, so the load curve is convex"),
                             {x},
                             1 - misfit};
            }
            const auto rises = [&](double beyond, const char* how, double limit, bool on_this_grid, OutOfReach& worst) {
                const double misfit = target.weight * beyond / (y + y_i);
                if (is_worse(misfit, worst))
                    worst = {line_with_digits(6, "pressure rises to ", y, " MPa at ", x, " mm ", how, ", ", limit,
                                              " MPa/mm"),
                             {x},
                             1 - misfit,
                             on_this_grid};
            };
            rises(allowed.lower(j) - (high_i + limits.max * (x - x_i)), "faster than with full contact", limits.max,
                  load.on_map, steep);
            rises(low_i + limits.min * (x - x_i) - allowed.upper(j), "slower than with a single node in contact",
                  limits.min, true, light);
        }
    }
    found.insert(found.end(), {steep, light});
}

} // namespace

StiffnessLimits stiffness_limits(const Model& model) {
    const auto& [grid, body, loading, contact, accuracy] = model;
    const double spacing = grid.spacing();
    Profile flat{Eigen::VectorXd::Zero(grid.shape().nodes()), spacing, grid.rows, grid.row_spacing()};
    const double entry = influence_column(in_units(body, spacing, flat.row_spacing), grid.shape())[0];
    const double min = body.effective_modulus / (elements(flat, body.kernel) * spacing * entry);
    // Full contact of a line grows stiffer as the grid grows coarser, so a coarse grid gives an upper bound.
    // That of a map grows softer.
    Grid coarse = grid;
    while (!grid.is_2d() && coarse.nodes > 1024) coarse.nodes = (coarse.nodes + 1) / 2;
    flat = {Eigen::VectorXd::Zero(coarse.shape().nodes()), coarse.spacing(), coarse.rows, coarse.row_spacing()};
    return {min, full_contact_stiffness(flat, body)};
}

// With secants m <= K_1 <= ... <= K_n <= M and even steps d, the last load is P = d sum K_j. The ends of the
// curve are at pi_1 = d K_1/2 and P - pi_n = d K_n/2. Their segments have the slopes
//     2 (K_2 - K_1)/(d (K_1 + K_2)) and 2 (K_n - K_{n-1})/(d (K_{n-1} + K_n)).
// Between pi_1 and pi_n the scored curve stays within [m, M], and so do the ends' lines between the points.
//
// The last segment, beyond pi_n, has at p = (1 - t) P, with a = K_{n-1} and b = K_n:
//     y = 2 b^2/(a + b) - 2 t (b - a) sum K_j/(a + b).
// It is highest if all other secants are lowest, sum K_j = a + b + (n - 2) m. It is then quasiconvex in a and
// convex in b, so that each is best at an end of its range. The value is M, or a = m and b = M.
//
// The first segment, before pi_1, has at p = t P, with a = K_1 and b = K_2:
//     y = 2 a^2/(a + b) + 2 t (b - a) sum K_j/(a + b).
// It is lowest if all other secants are lowest, sum K_j = a + (n - 1) b. It is homogeneous in (a, b) and
// above 0, so that a = m is best. It is then convex in b, of the form c1 (b + m) + c2 + c3/(b + m).
StiffnessLimits scored_limits(const StiffnessLimits& secants, int steps, double share) {
    const auto [m, M] = secants;
    const double n = steps, t = std::clamp(share, 0.0, 1.0);
    const double turn =
        t > 0 ? m * std::sqrt((1 + t * (2 * n - 4)) / (t * (n - 1))) - m : std::numeric_limits<double>::infinity();
    const double b = std::clamp(turn, m, M);
    const double min = std::isinf(b) ? 0 : 2 * (m * m + t * (b - m) * (m + (n - 1) * b)) / (m + b);
    const double max = std::isinf(M) ? M : 2 * (M * M - (1 - t) * (M - m) * (M + (n - 1) * m)) / (m + M);
    return {std::min(m, min), std::max(M, max)};
}

std::string OutOfReach::verdict() const {
    return line_of("out of reach of every ", of_map ? "map" : "profile", on_this_grid ? " on this grid: " : ": ",
                   reason);
}

std::vector<OutOfReach> out_of_reach(const std::vector<Target>& targets, const Model& model,
                                     std::optional<double> max_pressure) {
    if (!contact_sets_nest(model.body, model.grid)) // stiffness may fall
        return {};
    Load load{stiffness_limits(model), model.loading.steps, max_pressure.value_or(0), model.grid.is_2d()};
    for (const Target& target : targets)
        if (target.against_pressure()) load.last = std::max(load.last, target.last());
    std::vector<OutOfReach> found;
    for (const Target& target : targets) {
        if (target.quantity == Quantity::load_at_displacement)
            find_beyond_loads(target, load, found);
        else
            find_fall(target, found);
        if (target.quantity == Quantity::stiffness || target.quantity == Quantity::interface_stiffness)
            find_beyond_limits(target, load, found);
    }
    std::erase_if(found, [](const OutOfReach& one) { return one.bound == 1; });
    for (OutOfReach& one : found) {
        one.of_map = load.on_map;
        if (load.on_map && model.grid.periodic)
            one.reason += " (proven without a grid; on the grid of a periodic map it is not)";
    }
    return found;
}

} // namespace rough
