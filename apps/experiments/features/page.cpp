#include "apps/report/page.hpp"

#include "apps/experiments/features/run.hpp"
#include "apps/experiments/study.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/profile/profile.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using nlohmann::json;

void append(std::string& list, const std::string& name) { list += (list.empty() ? "" : ", ") + name; }

/// The features of shape of a kind.
std::string names_of(const FeatureTarget& target, const std::string& kind) {
    std::string names;
    for (const json& one : target.verdicts)
        if (one.at("of_shape") && one.at("kind") == kind)
            append(names, one.at("feature"));
    return names.empty() ? "none" : names;
}

/// "slope (-0.81)": the feature of shape whose rank goes best with K's.
std::string best_guess(const FeatureTarget& target, const std::string& pressure) {
    std::string best = "none";
    double most = 0;
    for (const json& one : target.verdicts)
        if (const json& rank = one.at("rank_correlation_" + pressure);
            one.at("of_shape") && rank.is_number() && std::abs(rank.get<double>()) > most) {
            most = std::abs(rank.get<double>());
            best = one.at("feature").get<std::string>() + " (" + readable(rank, 2) + ")";
        }
    return best;
}

Plot octaves_plot(const std::vector<FeatureTarget>& targets) {
    Plot plot;
    plot.alt = "How much the misfits change with a phase, by the length of its wave";
    plot.x = {"Octave of the wave length: L over 2 to the power of", false, -0.5, wave_octaves - 0.5};
    plot.y = {"Misfit per rad", true};
    for (std::size_t t = 0; t < targets.size(); ++t) {
        std::vector<std::pair<double, double>> points;
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            if (const double felt = targets[t].phase_sensitivity[octave]; felt > 0)
                points.emplace_back(static_cast<double>(octave), felt);
        plot.series.push_back(series_of(
            points,
            {targets[t].target.name, {}, {}, line_colours[t % line_colours.size()], Style::line_points, 2}));
    }
    return plot;
}

void add_target(Page& page, const FeatureTarget& target) {
    page.section("Target " + target.target.name);
    page.prose(std::to_string(target.answers.size()) + " answers from " + std::to_string(target.starts) +
               " starts, " + std::to_string(target.found_blindly) + " of them from blind ones; beside them " +
               std::to_string(target.misses.size()) +
               " blind draws that miss. No two answers are nearer than features.difference in 1 less the "
               "correlation "
               "of their heights; " +
               std::to_string(target.far_apart) + " are even apart by " + brief(rough::different) +
               ", as alternatives of a design are.");
    page.table(shown(target.verdicts, {{"feature", "Feature"},
                                       {"kind", "Answers"},
                                       {"meaning", "What"},
                                       {"answers_median", "Answers: median", 3},
                                       {"answers_quartiles", "quartiles apart", 2},
                                       {"misses_median", "Misses: median", 3},
                                       {"misses_quartiles", "quartiles apart", 2},
                                       {"p", "p", 2},
                                       {"rank_correlation_low", "Rank correlation with K, low", 2},
                                       {"rank_correlation_middle", "middle", 2},
                                       {"rank_correlation_high", "high", 2}}));
    page.table(shown(target.laws,
                     {{"features", "Linear law of log K on"},
                      {"count", "Features"},
                      {"pressure", "Pressure"},
                      {"error", "Off on draws left out", 2},
                      {"error_of_mean", "predicting the mean", 2},
                      {"error_on_answers", "Off on answers", 2},
                      {"error_of_mean_on_answers", "predicting the mean", 2}},
                     "What foretells K: root mean square errors of log10 K"));
    json held;
    for (const auto& [name, similarity] : target.held_out)
        held.push_back(
            {{"name", name},
             {"median", rough::median(similarity)},
             {"quarter", rough::quantile(similarity, 0.25)},
             {"reached", percent(1 - rough::share_up_to(similarity, std::nextafter(0.99, 0)), 2)}});
    page.table(shown(held,
                     {{"name", "What may move"},
                      {"median", "Similarity, median"},
                      {"quarter", "worst quarter under"},
                      {"reached", "reach 0.99"}},
                     "Held out: new starts, refined by some phases alone"));
    std::string control;
    for (std::size_t i = 0; i < std::min<std::size_t>(6, target.control.size()); ++i)
        control += (i ? "," : "") + target.control[i].first;
    page.prose("To morph the best answer in line, control its chromosomes " + control +
               " (the most felt first; all in result.json):");
    page.code("rugosa design --from best/" + target.target.name + ".json --control " + control +
              " --largest-change 0.05 --max-pressure " + brief(target.max_pressure, 17) + " --target " +
              target.target.name + ".csv");
}

} // namespace

std::vector<std::string> feature_words(const std::vector<FeatureTarget>& targets) {
    std::vector<std::string> words;
    for (const FeatureTarget& target : targets) {
        if (target.verdicts.empty())
            continue;
        const auto &needed = target.held_out[0].second, &all = target.held_out[1].second;
        const rough::Interval loss = loss_of(all, needed);
        std::string waves, laws;
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            if (target.needed[octave])
                append(waves, octave_name(octave));
        for (std::size_t k = 0; k < 3 && k < target.laws.size(); ++k)
            append(laws, readable(target.laws[k]["error"], 2) + " (" +
                             readable(target.laws[k]["error_of_mean"], 2) + ")");
        words.push_back("For the target " + target.target.name + " these waves matter: " + waves +
                        ". Held out: with their phases alone new surfaces reach " +
                        readable(rough::median(needed), 4) + " in the median, with all phases " +
                        readable(rough::median(all), 4) + ", with the others alone " +
                        readable(rough::median(target.held_out[2].second), 4) + ". The loss of " +
                        std::to_string(all.size()) + " starts, each by itself, is " +
                        readable(loss.lower, 2) + " to " + readable(loss.upper, 2) + " in the median (" +
                        percent(loss.coverage, 2) + " interval): " + whether_enough(loss));
        words.push_back("Its " + std::to_string(target.answers.size()) +
                        " answers share: " + names_of(target, "shared") +
                        ". They lean to one side, but vary, in: " + names_of(target, "shifted") +
                        ". May be chosen freely: " + names_of(target, "open"));
        words.push_back(
            "Among blind draws K goes by rank with: " + best_guess(target, "low") + " at low pressure, " +
            best_guess(target, "middle") + " at middle, " + best_guess(target, "high") +
            " at high. A linear law of all features of shape misses log10 K there, on draws it has not "
            "seen, by " +
            laws + "; in brackets, predicting the mean");
    }
    return words;
}

void fill_features_page(Page& page, const std::vector<FeatureTarget>& targets) {
    page.figure(
        {"octaves",
         "Which waves are felt.",
         "Root mean square change of the misfits per rad of a phase, by exact derivatives; in each octave "
         "the most felt wave, the median over the answers. Needed are as many, the most felt first, as are "
         "enough for starts of their own.",
         {octaves_plot(targets)}});
    page.prose(
        "Shared: the answers' quartiles lie closer than two thirds of the misses'. Shifted: not so, but the "
        "two "
        "groups differ (rank sums, Holm's correction, 1 %). Open: neither. Answers are refined from surfaces "
        "made for the target and, every fourth one, from blind draws; misses are blind draws as they are. A "
        "surface and its mirror image count as one. That a feature is shared says that answers of this kind "
        "have it, not that it causes the curve; the held-out check, from other starts, does. Laws are ridge "
        "regressions learnt on misses: draw i is left out with all of its fifth, i mod 5; the answers are no "
        "part of any.");
    for (const FeatureTarget& target : targets)
        if (!target.verdicts.empty())
            add_target(page, target);
    page.section("How");
}

} // namespace app
