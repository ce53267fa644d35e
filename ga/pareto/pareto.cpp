#include "ga/pareto/pareto.hpp"

namespace ga {

double hypervolume(std::vector<Point> points, const Point& reference) {
    const std::size_t last = reference.size() - 1;
    std::erase_if(points, [&](const Point& point) {
        for (std::size_t k = 0; k <= last; ++k)
            if (!(point[k] > reference[k]))
                return true;
        return false;
    });
    const auto order = in_order(
        points.size(), [&](std::size_t a, std::size_t b) { return points[a][last] > points[b][last]; });
    if (points.empty())
        return 0;
    if (last == 0)
        return points[order[0]][0] - reference[0];
    double volume = 0, widest = reference[0];
    std::vector<Point> above;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point& point = points[order[i]];
        const double next = i + 1 < points.size() ? points[order[i + 1]][last] : reference[last];
        const double thickness = point[last] - next;
        if (last == 1) {
            widest = std::max(widest, point[0]);
            volume += thickness * (widest - reference[0]);
            continue;
        }
        above.push_back(point);
        above.back().pop_back();
        if (thickness > 0)
            volume += thickness * hypervolume(above, Point(reference.begin(), reference.end() - 1));
    }
    return volume;
}

double dominated_share(const std::vector<Point>& points, const Point& reference, const Point& width) {
    constexpr int count = 4096;
    Stream stream(reference.size());
    int dominated = 0;
    Point sample(reference.size());
    for (int i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < sample.size(); ++k) {
            const double u = stream.uniform();
            sample[k] = reference[k] + width[k] * u / (1 - u);
        }
        dominated += std::any_of(points.begin(), points.end(), [&](const Point& point) {
            for (std::size_t k = 0; k < sample.size(); ++k)
                if (!(point[k] >= sample[k]))
                    return false;
            return true;
        });
    }
    return static_cast<double>(dominated) / count;
}

void Pareto::validate() const {
    if (objectives.size() < 2)
        throw UsageError("pareto compares " + std::to_string(objectives.size()) +
                         " objectives; give the names of 2 or more");
    for (auto each = objectives.begin(); each != objectives.end(); ++each)
        if (std::find(objectives.begin(), each, *each) != each)
            throw UsageError("pareto is given '" + *each + "' twice; give different objectives");
}

void Pareto::check(CheckState& known) const {
    for (const auto& objective : objectives)
        known.objective(text_of(*this), objective);
    known.scored = text_of(*this);
}

Pareto pareto(std::vector<std::string> objectives) { return checked(Pareto{{}, std::move(objectives)}); }

void Front::check(CheckState& known) const {
    if (!known.several_objectives())
        throw UsageError("stage 'front' needs a population ranked by pareto; put pareto before it");
}

} // namespace ga
