#include "ga/pareto/pareto.hpp"

namespace ga {

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
        dominated += std::ranges::any_of(
            points, [&](const Point& point) { return std::ranges::equal(point, sample, std::greater_equal()); });
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
    for (const auto& objective : objectives) known.objective(text_of(*this), objective);
    known.scored = text_of(*this);
}

Pareto pareto(std::vector<std::string> objectives) { return checked(Pareto{{}, std::move(objectives)}); }

void Front::check(CheckState& known) const { known.need_several_objectives(text_of(*this)); }

} // namespace ga
