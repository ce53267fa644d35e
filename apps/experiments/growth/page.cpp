#include "apps/experiments/growth/run.hpp"
#include "apps/experiments/study.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using nlohmann::json;

const std::array<std::tuple<const char*, const char*, Colour>, 3> variants{
    {{"sog", "SOG", Colour::blue}, {"gco", "GCO", Colour::red}, {"cco", "CCO", Colour::green}}};

double similarity_in(const json& row) { return row.at("similarity"); }
double curves_in(const json& row) { return row.at("curves"); }

/// The default search's median similarity when so many curves were paid.
double default_at(const GrowthTarget& target, double paid) {
    std::vector<double> values;
    for (const json& course : target.searched) {
        double best = -1;
        for (const json& point : course.at("best"))
            if (point[0] <= paid)
                best = point[1];
        values.push_back(best);
    }
    return rough::median(values);
}

Plot costs_plot(const GrowthTarget& target) {
    Plot plot;
    plot.alt = "1 less similarity against contact curves paid, for every variant and database size";
    plot.title = target.target.name;
    plot.x = {"Contact curves and gradients paid", true};
    plot.y = {"1 - similarity", true};
    plot.key += " maxcols 4";
    plot.height = 380;
    const auto shortfall = [](double similarity) { return std::max(1e-5, 1 - similarity); };
    for (const auto& [name, title, colour] : variants) {
        std::vector<std::pair<double, double>> points;
        for (const json& row : target.grown)
            if (row.at("variant") == name)
                points.emplace_back(curves_in(row), shortfall(similarity_in(row)));
        plot.series.push_back(series_of(points, {title, {}, {}, colour, Style::line_points, 2}));
    }
    double most = 0;
    for (const json& course : target.searched)
        for (const json& point : course.at("best"))
            most = std::max(most, point[0].get<double>());
    std::vector<std::pair<double, double>> points;
    for (int k = 0; most > 30 && k < 50; ++k) {
        const double paid = 30 * std::pow(most / 30, k / 49.), similarity = default_at(target, paid);
        points.emplace_back(paid, similarity > -1 ? shortfall(similarity) : unset);
    }
    plot.series.push_back(series_of(points, {"default", {}, {}, Colour::text, Style::line, 2, Dash::dashed}));
    return plot;
}

std::string words_on(const GrowthTarget& target) {
    const auto joined = [](const std::vector<std::string>& words, const std::string& between) {
        std::string all;
        for (const std::string& word : words)
            all += (all.empty() ? "" : between) + word;
        return all;
    };
    std::vector<std::string> courses, pays;
    for (const auto& [name, title, colour] : variants) {
        std::vector<std::string> along;
        for (const json& row : target.grown)
            if (row.at("variant") == name)
                along.push_back(readable(similarity_in(row)));
        courses.push_back(std::string(title) + " " + joined(along, ", "));
    }
    // Sizes whose children beat refinement of every size that costs no more.
    const json* nearest = &target.grown.front();
    bool ever = false;
    for (const json& one : target.grown) {
        double alone = -1;
        for (const json& other : target.grown)
            if (other.at("variant") == "sog" && curves_in(other) <= curves_in(one))
                alone = std::max(alone, similarity_in(other));
        const std::string size = std::to_string(one.at("stored").get<long>());
        if (one.at("variant") != "sog" && similarity_in(one) > alone && (pays.empty() || pays.back() != size))
            pays.push_back(size);
        if (similarity_in(one) > similarity_in(*nearest))
            nearest = &one;
        ever = ever || similarity_in(one) > default_at(target, curves_in(one));
    }
    return "Target " + target.target.name + ": " + joined(courses, "; ") + " from " +
           std::to_string(target.grown.front().at("stored").get<long>()) + " to " +
           std::to_string(target.grown.back().at("stored").get<long>()) + " genomes. Cross-over is " +
           (pays.empty() ? "at no size" : "with " + joined(pays, ", ") + " genomes") +
           " worth its curves beside refinement alone. Best of all: " +
           nearest->at("variant").get<std::string>() + " from " +
           std::to_string(nearest->at("stored").get<long>()) + " with " +
           readable(similarity_in(*nearest), 4) + " for " + brief(curves_in(*nearest), 9) +
           " curves; the default search has " + readable(default_at(target, curves_in(*nearest)), 4) +
           " by then, and is " + (ever ? "beaten at some size" : "never beaten for the same curves");
}

} // namespace

std::vector<std::string> growth_words(const std::vector<GrowthTarget>& targets) {
    std::vector<std::string> words;
    for (const GrowthTarget& target : targets)
        if (!target.grown.empty())
            words.push_back(words_on(target));
    return words;
}

void fill_growth_page(Page& page, const std::vector<GrowthTarget>& targets) {
    Figure figure{
        "costs",
        "Similarity against what was paid.",
        "Each point is a size of the database; the lower the nearer. Paid are the database's own curves, "
        "Algorithm 1's, the children's (one each, given up or not) and the refinement's gradients. The "
        "default search needs no database.",
        {}};
    for (const GrowthTarget& target : targets)
        figure.panels.push_back(costs_plot(target));
    page.figure(figure);
    for (const GrowthTarget& target : targets) {
        page.section("Target " + target.target.name);
        page.table(shown(target.grown, {{"stored", "Genomes"},
                                        {"variant", "Variant"},
                                        {"U1", "U1"},
                                        {"U2", "U2"},
                                        {"U3", "|U3|"},
                                        {"pairs_tried", "Pairs tried"},
                                        {"given_up", "given up"},
                                        {"best_child", "Best child"},
                                        {"similarity", "Similarity"},
                                        {"similarity_worst", "At worst"},
                                        {"parent1", "Parents"},
                                        {"parent2", ""},
                                        {"curves", "Curves"},
                                        {"seconds", "Seconds", 3}}));
        page.table(
            shown(target.searched, {{"seed", "Seed"}, {"worst", "Similarity at worst"}}, "Default search"));
    }
    page.section("How");
    page.prose("Genome i of a database is drawn of the paper's ranges and depends on the seed and i alone, "
               "so that a "
               "larger database holds the smaller ones. Children are summed in blocks; a bound that is exact "
               "gives up "
               "those that cannot be among the three best. Of more than growth.pairs pairs those of the best "
               "parents "
               "in their parts are tried; |U3| counts all.");
}

} // namespace app
