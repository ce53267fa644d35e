#include "ga/pareto/many_objectives.hpp"

namespace ga {
namespace {

/// The individuals that are surely kept, and the front from which others fill the room.
struct Classes {
    std::vector<std::size_t> kept; ///< positions
    std::vector<std::size_t> next; ///< positions in the feasible front that does not fit; may be empty
    std::size_t room = 0;          ///< number of places for `next`
};

Classes classes_within(std::span<const Fitness* const> all, std::size_t mu) {
    const std::vector<double> worth = merits(all);
    const auto front = [&](std::size_t i) { return std::ceil(-worth[i]); }; // crowding adds at most 1/2
    Classes classes{ranking(worth), {}, 0};
    auto& order = classes.kept;
    if (mu >= order.size()) return classes;
    const auto same = [&](std::size_t i) { return front(i) == front(order[mu - 1]); };
    const auto begin = std::ranges::find_if(order, same), end = std::find_if_not(begin, order.end(), same);
    classes.room = static_cast<std::size_t>(order.begin() + static_cast<std::ptrdiff_t>(mu) - begin);
    if (all[*begin]->feasible() && end - begin > static_cast<std::ptrdiff_t>(classes.room))
        classes.next.assign(begin, end);
    order.resize(classes.next.empty() ? mu : mu - classes.room);
    return classes;
}

/// Removes the points that another one dominates or equals.
void keep_undominated(std::vector<Point>& points) {
    for (std::size_t i = 0; i < points.size();)
        if (std::ranges::any_of(points, [&point = points[i]](const Point& other) {
                return &other != &point && std::ranges::equal(other, point, std::greater_equal());
            })) {
            points[i].swap(points.back());
            points.pop_back();
        } else {
            ++i;
        }
}

double box(const Point& point, std::size_t m) {
    double volume = 1;
    for (std::size_t k = 0; k < m; ++k) volume *= point[k];
    return volume;
}

/// The part of each point from `first` on that lies within the box of `point`, in m coordinates.
std::vector<Point> limited(const std::vector<Point>& points, std::size_t first, const Point& point, std::size_t m) {
    std::vector<Point> limits;
    limits.reserve(points.size() - std::min(points.size(), first));
    for (std::size_t j = first; j < points.size(); ++j) {
        Point limit(m);
        for (std::size_t k = 0; k < m; ++k) limit[k] = std::min(points[j][k], point[k]);
        limits.push_back(std::move(limit));
    }
    keep_undominated(limits);
    return limits;
}

/// The volume that points above the origin dominate.
double volume_of(std::vector<Point> points, std::size_t m) {
    std::ranges::sort(points, {}, [&](const Point& point) { return point[m - 1]; });
    double volume = 0, height = 0;
    if (m <= 2) {
        for (auto point = points.rbegin(); point != points.rend(); ++point) { // from the highest on
            const double next = std::next(point) == points.rend() ? 0 : (*std::next(point))[m - 1];
            height = m == 1 ? 1 : std::max(height, (*point)[0]);
            volume += height * ((*point)[m - 1] - next);
        }
        return volume;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        volume +=
            points[i][m - 1] * (box(points[i], m - 1) - volume_of(limited(points, i + 1, points[i], m - 1), m - 1));
    return volume;
}

/// The volume that point i dominates and no other point does.
double exclusive_volume(std::vector<Point>& points, std::size_t i) {
    const std::size_t m = points[i].size();
    const Point point = std::exchange(points[i], Point(m, 0));
    const double volume = box(point, m) - volume_of(limited(points, 0, point, m), m);
    points[i] = point;
    return std::max(0.0, volume);
}

/// Adds every point of the simplex that continues `point`, of which `left` of `divisions` are to be shared.
void add_shares(std::vector<Point>& all, Point point, std::size_t objectives, std::size_t left, std::size_t divisions) {
    if (point.size() + 1 == objectives) {
        point.push_back(static_cast<double>(left) / static_cast<double>(divisions));
        return all.push_back(std::move(point));
    }
    for (std::size_t share = 0; share <= left; ++share) {
        point.push_back(static_cast<double>(share) / static_cast<double>(divisions));
        add_shares(all, point, objectives, left - share, divisions);
        point.pop_back();
    }
}

} // namespace

double hypervolume(std::vector<Point> points, const Point& reference) {
    for (Point& point : points) { // 0 in all coordinates if it is not above the reference
        const bool is_above = std::ranges::equal(point, reference, std::greater());
        for (std::size_t k = 0; k < point.size(); ++k) point[k] = is_above ? point[k] - reference[k] : 0;
    }
    keep_undominated(points);
    return volume_of(std::move(points), reference.size());
}

std::vector<std::size_t> chosen_by_hypervolume(std::span<const Fitness* const> all, std::size_t mu, double beyond) {
    auto [kept, next, room] = classes_within(all, mu);
    if (next.empty()) return kept;
    std::vector<Point> points;
    for (const std::size_t i : next) points.push_back(all[i]->values());
    for (std::size_t k = 0; k < points[0].size(); ++k) {
        const auto [low, high] = std::ranges::minmax(points, {}, [k](const Point& p) { return p[k]; });
        const double worst = low[k], range = high[k] > worst ? high[k] - worst : 1;
        for (Point& point : points) point[k] = (point[k] - worst) / range + beyond;
    }
    // A removal never makes an exclusive volume smaller, so only a stale smallest one is computed again.
    std::vector<double> volumes(points.size(), 0);
    std::vector<bool> stale(points.size(), true);
    while (next.size() > room) {
        const auto least = std::ranges::min_element(volumes) - volumes.begin();
        const auto i = static_cast<std::size_t>(least);
        if (stale[i]) {
            stale[i] = false;
            volumes[i] = exclusive_volume(points, i);
            continue;
        }
        points.erase(points.begin() + least);
        volumes.erase(volumes.begin() + least);
        next.erase(next.begin() + least);
        stale.assign(points.size(), true);
    }
    kept.insert(kept.end(), next.begin(), next.end());
    return kept;
}

std::vector<Point> reference_directions(std::size_t objectives, std::size_t divisions, std::size_t inner) {
    std::vector<Point> all, second;
    add_shares(all, {}, objectives, divisions, divisions);
    if (inner > 0) add_shares(second, {}, objectives, inner, inner);
    for (Point& point : second) {
        for (double& share : point) share = (share + 1 / static_cast<double>(objectives)) / 2;
        all.push_back(std::move(point));
    }
    return all;
}

std::vector<std::size_t> chosen_by_directions(std::span<const Fitness* const> all, std::size_t mu,
                                              const std::vector<Point>& directions, Stream& stream) {
    auto [kept, next, room] = classes_within(all, mu);
    if (next.empty()) return kept;
    // Losses: how far each individual is behind the best value, in ranges.
    const std::size_t first_of_next = kept.size(), m = directions[0].size();
    std::vector<std::size_t> both = kept;
    both.insert(both.end(), next.begin(), next.end());
    std::vector<Point> losses;
    for (const std::size_t i : both) losses.push_back(all[i]->values());
    for (std::size_t k = 0; k < m; ++k) {
        const double best = std::ranges::max(losses, {}, [k](const Point& p) { return p[k]; })[k];
        for (Point& loss : losses) loss[k] = best - loss[k];
    }
    Point worst(m, 0);
    for (std::size_t axis = 0; axis < m; ++axis) {
        const Point& extreme = std::ranges::min(losses, {}, [&](const Point& loss) {
            double largest = 0; // achievement scalarizing function
            for (std::size_t k = 0; k < m; ++k) largest = std::max(largest, k == axis ? loss[k] : loss[k] * 1e6);
            return largest;
        });
        for (std::size_t k = 0; k < m; ++k) worst[k] = std::max(worst[k], extreme[k]);
    }
    std::vector<std::size_t> niche(both.size()), count(directions.size(), 0);
    std::vector<double> apart(both.size(), HUGE_VAL);
    for (std::size_t i = 0; i < both.size(); ++i) {
        for (std::size_t k = 0; k < m; ++k) losses[i][k] /= worst[k] > 0 ? worst[k] : 1;
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const Point& w = directions[d];
            const double along = std::inner_product(w.begin(), w.end(), losses[i].begin(), 0.0) /
                                 std::inner_product(w.begin(), w.end(), w.begin(), 0.0);
            double squared = 0;
            for (std::size_t k = 0; k < m; ++k)
                squared += (losses[i][k] - along * w[k]) * (losses[i][k] - along * w[k]);
            if (squared < apart[i]) apart[i] = squared, niche[i] = d;
        }
        if (i < first_of_next) ++count[niche[i]];
    }
    std::vector<std::vector<std::size_t>> waiting(directions.size()); // members of `next`, nearest last
    for (std::size_t i = first_of_next; i < both.size(); ++i) waiting[niche[i]].push_back(i);
    for (auto& members : waiting)
        std::ranges::sort(members, std::greater(), [&](std::size_t i) { return std::pair(apart[i], i); });
    for (; room > 0; --room) {
        std::size_t emptiest = 0, ties = 0;
        for (std::size_t d = 0; d < directions.size(); ++d) {
            if (waiting[d].empty()) continue;
            if (ties > 0 && count[d] < count[emptiest]) ties = 0;
            if ((ties == 0 || count[d] == count[emptiest]) && stream.below(++ties) == 0) emptiest = d;
        }
        auto& members = waiting[emptiest];
        const std::size_t place = count[emptiest]++ == 0 ? members.size() - 1 : stream.below(members.size());
        kept.push_back(both[members[place]]);
        members.erase(members.begin() + static_cast<std::ptrdiff_t>(place));
    }
    return kept;
}

void HypervolumeSelection::check(CheckState& known) const {
    const std::string text = text_of(*this);
    known.need_several_objectives(text);
    const auto objectives = static_cast<std::size_t>(std::ranges::count(*known.scored, ' '));
    if (objectives > max_objectives)
        throw UsageError("stage '" + text + "' takes at most 5 objectives, the population has " +
                         std::to_string(objectives) + "; use directions");
}

std::vector<Point> ReferenceDirections::of(std::size_t objectives) const {
    if (divisions > 0) return reference_directions(objectives, divisions, inner);
    const auto size = [&](std::size_t p) { // C(p + objectives - 1, p)
        double count = 1;
        for (std::size_t k = 1; k < objectives; ++k) count *= static_cast<double>(p + k) / static_cast<double>(k);
        return count;
    };
    const auto most = static_cast<double>(mu);
    std::size_t outer = 1, second = 0;
    while (size(outer + 1) <= most) ++outer;
    while (outer < objectives && second + 1 < outer && size(outer) + size(second + 1) <= most)
        ++second; // one layer with fewer divisions than objectives has no inner point
    return reference_directions(objectives, outer, second);
}

} // namespace ga
