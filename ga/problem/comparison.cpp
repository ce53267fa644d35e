#include "ga/problem/comparison.hpp"

#include <numeric>

namespace ga {

std::vector<std::size_t> pareto_ranks(const std::vector<Point>& points) {
    const std::vector<std::size_t> order =
        in_order(points.size(), [&](std::size_t a, std::size_t b) { return points[a] > points[b]; });
    std::vector<std::vector<std::size_t>> fronts;
    std::vector<std::size_t> rank(points.size());
    for (const std::size_t each : order) {
        const auto free = std::partition_point(fronts.begin(), fronts.end(), [&](const auto& front) {
            return std::any_of(front.rbegin(), front.rend(),
                               [&](std::size_t other) { return dominates(points[other], points[each]); });
        });
        rank[each] = static_cast<std::size_t>(free - fronts.begin());
        if (free == fronts.end())
            fronts.push_back({each});
        else
            free->push_back(each);
    }
    return rank;
}

std::vector<double> crowding_distances(const std::vector<Point>& points, const std::vector<std::size_t>& ranks) {
    std::vector<double> room(points.size(), 0);
    for (std::size_t k = 0; !points.empty() && k < points[0].size(); ++k) {
        const auto order = in_order(points.size(), [&](std::size_t a, std::size_t b) {
            return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : points[a][k] < points[b][k];
        });
        for (std::size_t first = 0, last; first < order.size(); first = last + 1) {
            last = first;
            while (last + 1 < order.size() && ranks[order[last + 1]] == ranks[order[first]]) ++last;
            const double range = points[order[last]][k] - points[order[first]][k];
            room[order[first]] = room[order[last]] = HUGE_VAL;
            for (std::size_t i = first + 1; i < last && range > 0; ++i)
                room[order[i]] += (points[order[i + 1]][k] - points[order[i - 1]][k]) / range;
        }
    }
    return room;
}

std::vector<double> classes_by_rules(std::span<const Fitness* const> all) {
    const auto key = [&](std::size_t i) {
        const Fitness& f = *all[i];
        return std::pair(f.violation(), f.feasible() ? -f.merit() : 0.0);
    };
    const auto order = in_order(all.size(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<double> merits(all.size());
    double place = -1;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i - 1]) < key(order[i])) --place;
        merits[order[i]] = all[order[i]]->has_failed() ? -HUGE_VAL : place;
    }
    return merits;
}

std::vector<double> crowded_merits(std::span<const Fitness* const> all) {
    std::vector<Point> points;
    std::vector<std::size_t> feasible, others;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]->feasible()) {
            feasible.push_back(i);
            points.push_back(all[i]->values());
        } else {
            others.push_back(i);
        }
    const std::vector<std::size_t> ranks = pareto_ranks(points);
    const std::vector<double> room = crowding_distances(points, ranks);
    std::vector<double> merits(all.size(), -HUGE_VAL);
    double last = 0;
    for (std::size_t i = 0; i < feasible.size(); ++i) {
        const double bonus = std::isfinite(room[i]) ? room[i] / (2 * (1 + room[i])) : 0.5;
        merits[feasible[i]] = -static_cast<double>(ranks[i]) + bonus;
        last = std::min(last, -static_cast<double>(ranks[i]));
    }
    double before = -HUGE_VAL;
    for (const std::size_t i : in_order(others.size(), [&](std::size_t a, std::size_t b) {
             return all[others[a]]->violation() < all[others[b]]->violation();
         }))
        if (const Fitness& each = *all[others[i]]; !each.has_failed()) {
            if (each.violation() > std::exchange(before, each.violation())) --last;
            merits[others[i]] = last;
        }
    return merits;
}

std::vector<double> merits(std::span<const Fitness* const> all) {
    bool several = false, ruled = false;
    std::vector<double> merits(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Fitness& each = *all[i];
        if (!each.known() || each.objective_name() != all[0]->objective_name())
            throw UsageError("fitness under '" + all[0]->objective() + "' was compared with '" + each.objective() +
                             "'; score all by one objective first");
        several |= each.several();
        ruled |= !each.feasible();
        merits[i] = several ? 0 : each.merit();
    }
    return several ? crowded_merits(all) : ruled ? classes_by_rules(all) : merits;
}

bool better_by_rules(const Fitness& a, const Fitness& b) {
    const Fitness* const both[] = {&a, &b};
    const std::vector<double> worth = merits(both);
    return worth[0] > worth[1];
}

std::vector<std::size_t> ranking(const std::vector<double>& merits, std::size_t n) {
    std::vector<std::size_t> order(merits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(n, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](std::size_t a, std::size_t b) {
        return merits[a] != merits[b] ? merits[a] > merits[b] : a < b;
    });
    order.erase(end, order.end());
    return order;
}

std::vector<std::size_t> in_order(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& before) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&before](std::size_t a, std::size_t b) { return before(a, b) || (a < b && !before(b, a)); });
    return order;
}

bool dominates(const Point& a, const Point& b) {
    bool better = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] < b[i]) return false;
        better |= a[i] > b[i];
    }
    return better;
}

} // namespace ga
