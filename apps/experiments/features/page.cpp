#include "apps/report/page.hpp"

#include "apps/experiments/features/run.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using Kind = FeatureVerdict::Kind;

std::string names_of(const FeatureTarget& target, Kind kind) {
    std::string names;
    for (const FeatureVerdict& verdict : target.verdicts)
        if (verdict.kind == kind && verdict.of_shape)
            names += (names.empty() ? "" : ", ") + verdict.name;
    return names.empty() ? "none" : names;
}

std::string waves_of(const FeatureTarget& target) {
    std::string names;
    for (std::size_t octave = 0; octave < wave_octaves; ++octave)
        if (target.needed[octave])
            names += (names.empty() ? "" : ", ") + octave_name(octave);
    return names;
}

/// A series of bars a group: the share of values in each of twenty cells.
Series histogram(const std::string& label, const std::vector<double>& values, double from, double to,
                 Colour colour, double shift) {
    constexpr int cells = 20;
    Series series{label, Eigen::VectorXd(cells), Eigen::VectorXd::Zero(cells), colour, Style::steps, 2};
    for (int c = 0; c < cells; ++c)
        series.x[c] = from + (to - from) * (c + 0.5 + shift) / cells;
    for (const double value : values)
        series.y[std::clamp(static_cast<int>((value - from) / (to - from) * cells), 0, cells - 1)] +=
            1.0 / static_cast<double>(values.size());
    return series;
}

Plot feature_plot(const FeatureTarget& target, std::size_t feature) {
    const auto column = [&](const std::vector<FeatureSample>& samples) {
        return rough::column(samples, [&](const FeatureSample& one) { return one.features[feature].value; });
    };
    const auto answers = column(target.answers), misses = column(target.misses);
    std::vector<double> all = answers;
    all.insert(all.end(), misses.begin(), misses.end());
    const double from = rough::quantile(all, 0.005), to = std::max(rough::quantile(all, 0.995), from + 1e-9);
    Plot plot;
    plot.alt = "Distribution of a feature among surfaces that answer and that miss";
    plot.title = target.verdicts[feature].name;
    plot.x = {target.verdicts[feature].meaning};
    plot.y = {"Share", false, 0, unset};
    plot.series = {histogram("answers", answers, from, to, Colour::blue, 0),
                   histogram("misses", misses, from, to, Colour::orange, 0)};
    return plot;
}

Plot octaves_plot(const FeatureRun& run) {
    Plot plot;
    plot.alt = "How much the misfits change with a phase, by the length of its wave";
    plot.x = {"Octave of the wave length: L over 2 to the power of", false, -0.5, wave_octaves - 0.5};
    plot.y = {"Misfit per rad", true};
    for (std::size_t t = 0; t < run.targets.size(); ++t) {
        Series series{run.targets[t].target.name,
                      Eigen::VectorXd(wave_octaves),
                      Eigen::VectorXd(wave_octaves),
                      line_colours[t % line_colours.size()],
                      Style::line_points,
                      2};
        for (std::size_t octave = 0; octave < wave_octaves; ++octave) {
            series.x[static_cast<Eigen::Index>(octave)] = static_cast<double>(octave);
            const double felt = run.targets[t].phase_sensitivity[octave];
            series.y[static_cast<Eigen::Index>(octave)] = felt > 0 ? felt : unset;
        }
        plot.series.push_back(std::move(series));
    }
    return plot;
}

Table features_table(const FeatureTarget& target) {
    Table table{"",
                {"Feature", "What", "Answers: median (quartiles apart)", "Misses", "p",
                 "Rank correlation with K, low", "middle", "high"},
                {},
                {false, false, true, true, true, true, true, true}};
    std::vector<const FeatureVerdict*> order;
    for (const FeatureVerdict& verdict : target.verdicts)
        order.push_back(&verdict);
    std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
        return std::pair(a->kind, a->answers_width / a->misses_width) <
               std::pair(b->kind, b->answers_width / b->misses_width);
    });
    for (const FeatureVerdict* one : order) {
        const auto shown = [](double median, double width) {
            return readable(median) + " (" + readable(width, 2) + ")";
        };
        table.rows.push_back({one->name + (one->kind == Kind::shared    ? " – shared"
                                           : one->kind == Kind::shifted ? " – shifted"
                                                                        : " – open"),
                              one->meaning, shown(one->answers, one->answers_width),
                              shown(one->misses, one->misses_width), readable(one->p, 2),
                              readable(one->rank_correlation[0], 2), readable(one->rank_correlation[1], 2),
                              readable(one->rank_correlation[2], 2)});
    }
    return table;
}

void add_target(Page& page, const FeatureRun& run, std::size_t t) {
    const FeatureTarget& target = run.targets[t];
    page.section("Target " + target.target.name);
    page.prose(std::to_string(target.answers.size()) + " surfaces of similarity " + readable(run.good) +
               " and more, each different from the others, from " + std::to_string(target.starts) +
               " starts; beside them " + std::to_string(target.misses.size()) + " starts that miss.");
    std::vector<std::size_t> order(target.verdicts.size());
    for (std::size_t f = 0; f < order.size(); ++f)
        order[f] = f;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const auto ratio = [&](std::size_t f) {
            return target.verdicts[f].answers_width / target.verdicts[f].misses_width;
        };
        return ratio(a) < ratio(b);
    });
    Figure figure{"features-" + std::to_string(t + 1),
                  "Who shares what.",
                  "The two features that answers share most, and the two that they share least.",
                  {}};
    for (const std::size_t place : {std::size_t{0}, std::size_t{1}, order.size() - 2, order.size() - 1})
        figure.panels.push_back(feature_plot(target, order[place]));
    page.figure(figure);
    page.table(features_table(target));
    Table regression{"A linear regression of log K on features of shape: R² on fifths left out",
                     {"Features", "K at low pressure", "middle", "high"},
                     {},
                     {false, true, true, true}};
    for (const auto& [name, set] :
         {std::pair("all", 0U), std::pair("those that answers share", 1U), std::pair("waves by octave", 2U)})
        regression.rows.push_back({name, readable(target.regression[set][0], 2),
                                   readable(target.regression[set][1], 2),
                                   readable(target.regression[set][2], 2)});
    page.table(regression);
    Table held{"Held out: new starts, refined by some phases alone",
               {"What may move", "Similarity, median", "worst quarter under", "reach 0.99"},
               {},
               {false, true, true, true}};
    for (const HeldOut& one : target.held_out)
        held.rows.push_back({one.name, readable(rough::median(one.similarity), 4),
                             readable(rough::quantile(one.similarity, 0.25), 4), percent(one.reached(), 2)});
    page.table(held);
    std::string control;
    for (std::size_t i = 0; i < std::min<std::size_t>(6, target.control.size()); ++i)
        control += (i ? "," : "") + target.control[i].first;
    page.prose("To morph the best answer in line, control its chromosomes " + control +
               " (the most felt first; all in result.json):");
    page.code("rugosa design --from genome.json --control " + control + " --largest-change 0.05 --target " +
              target.target.name + ".csv");
}

} // namespace

std::vector<std::string> feature_words(const FeatureRun& run) {
    std::vector<std::string> words;
    for (const FeatureTarget& target : run.targets) {
        if (target.verdicts.empty())
            continue;
        const HeldOut &needed = target.held_out[0], &all = target.held_out[1], &others = target.held_out[2];
        const double gap = rough::median(all.similarity) - rough::median(needed.similarity);
        words.push_back(
            "For the target " + target.target.name + " these waves matter: " + waves_of(target) +
            ". All answers share: " + names_of(target, Kind::shared) +
            ". They lean to one side, but vary, in: " + names_of(target, Kind::shifted) +
            ". May be chosen freely: " + names_of(target, Kind::open) +
            ". Held out: with the phases of those waves alone new surfaces reach " +
            readable(rough::median(needed.similarity), 4) + " in the median, with all phases " +
            readable(rough::median(all.similarity), 4) + ", with the others alone " +
            readable(rough::median(others.similarity), 4) +
            (gap < 0.005 ? ": the waves named are enough" : ": the waves named are not quite enough"));
    }
    return words;
}

std::string features_page(const FeatureRun& run) {
    const auto words = feature_words(run);
    Page page("What matters for a curve, and what does not", words.front() + ".");
    for (std::size_t i = 1; i < words.size(); ++i)
        page.prose(words[i] + ".");
    page.figure(
        {"octaves",
         "Which waves are felt.",
         "Root mean square change of the misfits per rad of a phase, by exact derivatives; in each octave "
         "the "
         "most felt wave, the median over the answers. Needed are those above a quarter of the largest.",
         {octaves_plot(run)}});
    page.prose(
        "Shared: the answers' quartiles lie closer than two thirds of the misses'. Shifted: not so, but the "
        "two "
        "groups differ (rank sums, Holm's correction, 1 %). Open: neither. Both groups are of two series; "
        "answers "
        "are refined from surfaces made for the target, misses are drawn blindly. A surface and its mirror "
        "image "
        "count as one. That a feature is shared says that answers of this kind have it, not that it causes "
        "the "
        "curve; the held-out check, from blind draws, does.");
    for (std::size_t t = 0; t < run.targets.size(); ++t)
        if (!run.targets[t].verdicts.empty())
            add_target(page, run, t);
    page.section("How");
    page.prose(readable(run.seconds) + " s.");
    page.code(run.origin.command);
    page.links({"surfaces.csv", "features.csv", "octaves.csv", "heldout.csv", "genomes.json", "result.json"});
    return page.html();
}

} // namespace app
