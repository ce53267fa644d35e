#include "domain/design/out_of_reach.hpp"

#include <sstream>

namespace rough {

namespace {

/// Rounding in files with four digits or more is no verdict.
constexpr double negligible = 1e-6;

template <class... Parts>
std::string line_of(const Parts&... parts) {
    std::ostringstream line;
    (line << ... << parts);
    return line.str();
}

/// What a curve may be at a point: the band, or the value itself.
struct Allowed {
    const Goal& goal;
    double lower(Index k) const { return goal.has_band() ? goal.lower[k] : goal.y[k]; }
    double upper(Index k) const { return goal.has_band() ? goal.upper[k] : goal.y[k]; }
    /// The misfit of the best value c with lower(i) > c > upper(j): both are missed by
    /// (lower_i - upper_j)/(y_i + y_j) at least.
    double least_misfit(Index i, Index j) const {
        return goal.weight * (lower(i) - upper(j)) / (goal.y[i] + goal.y[j]);
    }
};

const char* unit_of(const Goal& goal) { return goal.against_pressure() ? " MPa" : " mm"; }

void find_fall(const Goal& goal, std::vector<OutOfReach>& found) {
    const Allowed allowed{goal};
    Index first = 0, second = 0;
    double worst = 0;
    for (Index i = 0; i < goal.points(); ++i)
        for (Index j = i + 1; j < goal.points(); ++j)
            if (allowed.least_misfit(i, j) > worst)
                worst = allowed.least_misfit(i, j), first = i, second = j;
    if (worst <= negligible)
        return;
    const char* what = goal.quantity == Quantity::stiffness ? "stiffness" : "contact fraction";
    found.push_back({line_of(what, " falls from ", allowed.lower(first), " at ", goal.x[first], unit_of(goal),
                             " to ", allowed.upper(second), " at ", goal.x[second], unit_of(goal),
                             ": contact only grows under load, so it never falls"),
                     {goal.x[first], goal.x[second]},
                     1 - worst});
}

void find_beyond(const Goal& goal, const StiffnessLimits& limits, std::vector<OutOfReach>& found) {
    const Allowed allowed{goal};
    Index high = -1, low = -1;
    double above = negligible, below = negligible;
    std::vector<double> all_high, all_low;
    for (Index k = 0; k < goal.points(); ++k) {
        const double over = goal.weight * (allowed.lower(k) - limits.most) / goal.y[k];
        const double under = goal.weight * (limits.least - allowed.upper(k)) / goal.y[k];
        if (over > negligible)
            all_high.push_back(goal.x[k]);
        if (under > negligible)
            all_low.push_back(goal.x[k]);
        if (over > above)
            above = over, high = k;
        if (under > below)
            below = under, low = k;
    }
    if (high >= 0)
        found.push_back({line_of("stiffness ", allowed.lower(high), " MPa/mm at ", goal.x[high],
                                 " MPa is above that of full contact, ", limits.most, " MPa/mm"),
                         all_high, 1 - above});
    if (low >= 0)
        found.push_back({line_of("stiffness ", allowed.upper(low), " MPa/mm at ", goal.x[low],
                                 " MPa is below that of a single node in contact, ", limits.least, " MPa/mm"),
                         all_low, 1 - below, true});
}

/// Three points, the first of which may be (0, 0), of which the middle one lies above the chord.
void find_concave(const Goal& goal, const StiffnessLimits& limits, std::vector<OutOfReach>& found) {
    const Allowed allowed{goal};
    OutOfReach worst;
    for (Index i = -1; i < goal.points(); ++i)
        for (Index j = i + 1; j < goal.points(); ++j) {
            const double x_i = i < 0 ? 0 : goal.x[i], y_i = i < 0 ? 0 : goal.y[i];
            const double high_i = i < 0 ? 0 : allowed.upper(i);
            for (Index k = j + 1; k < goal.points(); ++k) {
                const double t = (goal.x[j] - x_i) / (goal.x[k] - x_i);
                const double chord = (1 - t) * high_i + t * allowed.upper(k);
                // With misfits e, P_j (1 - e) <= chord of P (1 + e).
                const double misfit =
                    goal.weight * (allowed.lower(j) - chord) / (goal.y[j] + (1 - t) * y_i + t * goal.y[k]);
                if (misfit > negligible && 1 - misfit < worst.bound)
                    worst = {line_of("pressure ", goal.y[j], " MPa at ", goal.x[j],
                                     " mm is above the straight line from ", y_i, " MPa at ", x_i, " mm to ",
                                     goal.y[k], " MPa at ", goal.x[k],
                                     " mm: stiffness never falls, so the load curve is convex"),
                             {goal.x[j]},
                             1 - misfit};
            }
            const double most = high_i + limits.most * (goal.x[j] - x_i);
            const double misfit = goal.weight * (allowed.lower(j) - most) / (goal.y[j] + y_i);
            if (misfit > negligible && 1 - misfit < worst.bound)
                worst = {line_of("pressure rises to ", goal.y[j], " MPa at ", goal.x[j],
                                 " mm faster than with full ", "contact, ", limits.most, " MPa/mm"),
                         {goal.x[j]},
                         1 - misfit};
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

std::vector<OutOfReach> out_of_reach(const DesignSetup& setup) {
    const StiffnessLimits limits = stiffness_limits(setup.model);
    std::vector<OutOfReach> found;
    for (const Goal& goal : setup.goals) {
        if (goal.quantity == Quantity::load_at_displacement)
            find_concave(goal, limits, found);
        else
            find_fall(goal, found);
        if (goal.quantity == Quantity::stiffness)
            find_beyond(goal, limits, found);
    }
    return found;
}

} // namespace rough
