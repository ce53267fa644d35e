#include "apps/report/page.hpp"

#include "apps/experiments/growth/run.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

const std::array<std::tuple<const char*, const char*, Colour>, 3> variants{
    {{"sog", "SOG", Colour::blue}, {"gco", "GCO", Colour::red}, {"cco", "CCO", Colour::green}}};

/// The default search's median similarity when so many curves were paid.
double default_at(const GrowthTarget& target, double paid) {
    std::vector<double> values;
    for (const Course& course : target.by_default) {
        double best = -1;
        for (const auto& [when, similarity] : course.best)
            if (when <= paid)
                best = similarity;
        values.push_back(best);
    }
    return rough::median(values);
}

/// The best of a variant for no more than so many curves.
const Grown* best_for(const GrowthTarget& target, const std::string& variant, long curves) {
    const Grown* best = nullptr;
    for (const Grown& one : target.grown)
        if (one.variant == variant && one.curves <= curves && (!best || one.similarity > best->similarity))
            best = &one;
    return best;
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
        for (const Grown& one : target.grown)
            if (one.variant == name)
                points.emplace_back(static_cast<double>(one.curves), shortfall(one.similarity));
        Series series{title, {}, {}, colour, Style::line_points, 2};
        series.x.resize(static_cast<Eigen::Index>(points.size()));
        series.y.resize(series.x.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            series.x[static_cast<Eigen::Index>(i)] = points[i].first,
            series.y[static_cast<Eigen::Index>(i)] = points[i].second;
        plot.series.push_back(std::move(series));
    }
    double most = 0;
    for (const Course& course : target.by_default)
        most = std::max(most, course.best.empty() ? 0 : course.best.back().first);
    if (most > 30) {
        constexpr int points = 50;
        Series series{
            "default",   Eigen::VectorXd(points), Eigen::VectorXd(points), Colour::text, Style::line, 2,
            Dash::dashed};
        for (int k = 0; k < points; ++k) {
            series.x[k] = 30 * std::pow(most / 30, k / (points - 1.0));
            const double similarity = default_at(target, series.x[k]);
            series.y[k] = similarity > -1 ? shortfall(similarity) : unset;
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

} // namespace

std::vector<std::string> growth_words(const Growth& growth) {
    std::vector<std::string> words;
    for (const GrowthTarget& target : growth.targets) {
        if (target.grown.empty())
            continue;
        std::string line = "Target " + target.target.name + ": ";
        for (const auto& [name, title, colour] : variants) {
            std::string along;
            for (const Grown& one : target.grown)
                if (one.variant == name)
                    along += (along.empty() ? "" : ", ") + readable(one.similarity);
            line += std::string(line.ends_with(": ") ? "" : "; ") + title + " " + along;
        }
        line += " from " + std::to_string(target.grown.front().size) + " to " +
                std::to_string(target.grown.back().size) + " genomes";
        // Sizes whose children beat refinement of every size that costs no more.
        std::vector<std::uint64_t> pays;
        for (const Grown& one : target.grown) {
            const Grown* alone = best_for(target, "sog", one.curves);
            if (one.variant != "sog" && (!alone || one.similarity > alone->similarity) &&
                std::find(pays.begin(), pays.end(), one.size) == pays.end())
                pays.push_back(one.size);
        }
        std::string sizes;
        for (const std::uint64_t size : pays)
            sizes += (sizes.empty() ? "" : ", ") + std::to_string(size);
        line += ". Cross-over is " + (sizes.empty() ? "at no size" : "with " + sizes + " genomes") +
                " worth its curves beside refinement alone";
        const Grown* nearest = nullptr;
        for (const Grown& one : target.grown)
            if (!nearest || one.similarity > nearest->similarity)
                nearest = &one;
        const double searched = default_at(target, static_cast<double>(nearest->curves));
        bool ever = false;
        for (const Grown& one : target.grown)
            ever = ever || one.similarity > default_at(target, static_cast<double>(one.curves));
        line += ". Best of all: " + nearest->variant + " from " + std::to_string(nearest->size) + " with " +
                readable(nearest->similarity, 4) + " for " + std::to_string(nearest->curves) +
                " curves; the default search has " + readable(searched, 4) + " by then, and is " +
                (ever ? "beaten at some size" : "never beaten for the same curves");
        words.push_back(line);
    }
    return words;
}

std::string growth_page(const Growth& growth) {
    const auto words = growth_words(growth);
    Page page("What a larger database is worth", words.empty() ? std::string() : words.front() + ".");
    for (std::size_t i = 1; i < words.size(); ++i)
        page.prose(words[i] + ".");
    Figure figure{"costs",
                  "Similarity against what was paid.",
                  "Each point is a size of the database; the lower the nearer. Paid are the "
                  "database's own curves, Algorithm 1's, the children's (one each, given up or not) and the "
                  "refinement's gradients. The default search needs no database.",
                  {}};
    for (const GrowthTarget& target : growth.targets)
        figure.panels.push_back(costs_plot(target));
    page.figure(figure);
    for (const GrowthTarget& target : growth.targets) {
        page.section("Target " + target.target.name);
        Table table{"",
                    {"Genomes", "Variant", "U1", "U2", "|U3|", "Pairs tried", "given up", "Best child",
                     "Similarity", "At worst", "Parents", "Curves", "Seconds"},
                    {},
                    {true, false, true, true, true, true, true, true, true, true, false, true, true}};
        for (const Grown& one : target.grown) {
            std::string parents;
            for (const std::uint64_t parent : one.parents)
                parents += (parents.empty() ? "" : " + ") + std::to_string(parent);
            const bool crosses = one.variant != "sog";
            const auto count = [&](auto number) {
                return crosses ? std::to_string(number) : std::string("–");
            };
            table.rows.push_back({std::to_string(one.size), one.variant, count(one.u1), count(one.u2),
                                  count(one.u1 * one.u2), count(one.pairs), count(one.given_up),
                                  readable(one.best_child, 4), readable(one.similarity, 4),
                                  readable(one.worst, 4), parents, std::to_string(one.curves),
                                  readable(one.seconds)});
        }
        page.table(table);
        std::string worst;
        for (const Course& course : target.by_default)
            worst += (worst.empty() ? "" : ", ") + readable(course.worst, 4);
        page.prose("Default search, at worst, a seed each: " + worst + ".");
    }
    page.section("How");
    page.prose(
        "Genome i of a database is drawn of the paper's ranges and depends on the seed and i alone, so that "
        "a "
        "larger database holds the smaller ones. Children are summed in blocks; a bound that is exact gives "
        "up those that cannot be among the three best. Of more than " +
        std::to_string(growth.most_pairs) +
        " pairs those of the best parents in their parts are tried; |U3| counts all. " +
        readable(growth.seconds) + " s.");
    page.code(growth.origin.command);
    page.links({"growth.csv", "default.csv", "result.json"});
    return page.html();
}

} // namespace app
