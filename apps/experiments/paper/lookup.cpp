#include "apps/experiments/paper/lookup.hpp"

#include "domain/numerics/statistics.hpp"

#include <algorithm>

namespace app {

namespace {

/// What `difference` says of the two curves at each point of `a` within the range of `b`.
template <class Difference>
std::vector<double> differences(const rough::Curve& a, const rough::Curve& b, Difference difference) {
    std::vector<double> all;
    for (Eigen::Index i = 0; i < a.x.size(); ++i)
        if (a.x[i] >= b.from && a.x[i] <= b.to && a.y[i] != 0)
            all.push_back(difference(a.y[i], b.at(a.x[i])));
    return all;
}

bool is_refinement(const StageRecord& stage) {
    const std::size_t last = stage.path.rfind('/');
    return stage.path.compare(last == std::string::npos ? 0 : last + 1, 6, "refine") == 0;
}

/// One of the paper's algorithms, in either form.
bool is_papers(const std::string& name) {
    return std::any_of(algorithms.begin(), algorithms.end(), [&](const Algorithm& algorithm) {
        return name == algorithm.name || name == std::string(algorithm.name) + "-minimax";
    });
}

double similarity_of(const StageRecord& stage, std::uint64_t id) {
    for (const Candidate& candidate : stage.candidates)
        if (candidate.id == id)
            return candidate.similarity;
    return unset;
}

} // namespace

const VariantRun* find_variant(const TargetRun& target, const std::string& name) {
    for (const VariantRun& variant : target.variants)
        if (variant.name == name)
            return &variant;
    return nullptr;
}

std::vector<ShownAnswer> shown_answers(const TargetRun& target) {
    std::vector<ShownAnswer> answers;
    for (const Algorithm& algorithm : algorithms)
        if (const VariantRun* variant = find_variant(target, algorithm.name))
            answers.push_back({variant, algorithm.title, algorithm.colour, algorithm.dash});
    constexpr std::array others{Colour::orange, Colour::purple, Colour::sky};
    constexpr std::array dashes{Dash::solid, Dash::dashed, Dash::dotted};
    std::size_t own = 0;
    for (const VariantRun& variant : target.variants)
        if (!is_papers(variant.name)) {
            answers.push_back({&variant, variant.name, others[own % others.size()],
                               dashes[own / others.size() % dashes.size()]});
            ++own;
        }
    return answers;
}

std::string shown_name(const std::string& name) {
    if (!is_papers(name))
        return name;
    std::string result;
    for (char c : name.substr(0, name.find('-')))
        result += static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
    return name.find('-') == std::string::npos ? result : result + ", " + name.substr(name.find('-') + 1);
}

std::string titled(const TargetRun& target) {
    std::string title = target.title + " target";
    if (title[0] >= 'a' && title[0] <= 'z')
        title[0] = static_cast<char>(title[0] - 'a' + 'A');
    return title;
}

std::vector<Refinement> refinements(const VariantRun& variant) {
    const auto& stages = variant.stages;
    const auto first = std::find_if(stages.begin(), stages.end(), is_refinement);
    if (first == stages.end() || first == stages.begin())
        return {};
    const auto second = std::find_if(first + 1, stages.end(), is_refinement);
    std::vector<Refinement> result;
    for (const Candidate& start : (first - 1)->candidates) {
        const double once = similarity_of(*first, start.id);
        result.push_back(
            {start.id,
             {start.similarity, once, second == stages.end() ? once : similarity_of(*second, start.id)}});
    }
    std::stable_sort(result.begin(), result.end(), [](const Refinement& a, const Refinement& b) {
        return a.similarity[0] > b.similarity[0];
    });
    return result;
}

std::vector<ThresholdRow> thresholds_of(const TargetRun& target, const std::string& variant) {
    std::vector<ThresholdRow> rows;
    for (const ThresholdRow& row : target.thresholds)
        if (row.variant == variant)
            rows.push_back(row);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const ThresholdRow& a, const ThresholdRow& b) { return a.p_bar < b.p_bar; });
    return rows;
}

std::optional<Part> best_in_part(const TargetRun& target, bool low) {
    std::optional<Part> best;
    const auto rank = [&](const Scores& scores) {
        return std::pair(!(scores.all > 0.95), low ? scores.low : scores.high);
    };
    for (std::size_t genome = 0; genome < target.database.size(); ++genome)
        if (!best || rank(target.database[genome]) > rank(best->scores))
            best = Part{genome, target.database[genome]};
    return best;
}

Series shown(const rough::Curve& curve, double x_factor, Series look) {
    const rough::Curve whole = to_its_end(curve);
    look.x = whole.x * x_factor;
    look.y = whole.y;
    return look;
}

double relative_gap(const rough::Curve& a, const rough::Curve& b) {
    return rough::mean(
        differences(a, b, [](double here, double there) { return std::abs(there / here - 1); }));
}

double gap(const rough::Curve& a, const rough::Curve& b) {
    const auto all = differences(a, b, [](double here, double there) { return std::abs(there - here); });
    return all.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::max_element(all.begin(), all.end());
}

} // namespace app
