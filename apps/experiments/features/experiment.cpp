#include "apps/experiments/features/run.hpp"
#include "apps/experiments/study.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/target_files.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/pipeline.hpp"
#include "domain/profile/profile.hpp"
#include "domain/text/json.hpp"
#include "ga/base/parallel.hpp"
#include "ga/text/refinement_vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace app {

namespace {

using nlohmann::json;
using rough::DesignProblem;
using rough::GenePlace;
using rough::Genome;

constexpr std::size_t batch = 128; ///< starts at a time
/// A part of a descent: gradients, after how many of them great misfits weigh more, and how far under an
/// answer's similarity a surface is given up after it.
struct Leg {
    int gradients, sharpen;
    double hopeless;
};
constexpr std::array<Leg, 3> legs{{{8, 8, 0.19}, {10, 6, 0.09}, {15, 4, 0}}};

/// Every so many-th start knows nothing of the target, the others are made for it.
constexpr std::uint64_t blind_every = 4;
bool is_blind(std::uint64_t start) { return start % blind_every == blind_every - 1; }

json kept(const FeatureSample& sample) {
    return {{"start", sample.start},
            {"similarity", sample.similarity},
            {"genome", rough::genome_to_json(sample.genome)},
            {"features", sample.features},
            {"stiffness", sample.stiffness}};
}

FeatureSample sample_from(const json& one) {
    return {one.at("start"), one.at("similarity"), rough::genome_from_json(one.at("genome"), "genome"),
            one.at("features"), one.at("stiffness")};
}

class FeatureTrial {
  public:
    FeatureTrial(const Settings& settings, const Conditions& conditions)
        : conditions_(conditions),
          wanted_(static_cast<std::size_t>(settings.whole("features.answers", 4, 1000000))),
          most_starts_(settings.whole("features.starts", 1, 100000000)),
          tried_(static_cast<std::size_t>(settings.whole("features.held-out", 1, 100000))),
          good_(settings.number("features.similarity", 0, 1)),
          apart_(settings.number("features.difference", 0, 1)) {
        setup_.model = model_from(settings, "model.");
        setup_.max_pressure = settings.pressure("targets.max-pressure");
        for (rough::Target& target : named_targets(settings, "targets.files"))
            targets_.push_back({std::move(target), *setup_.max_pressure});
    }

    std::vector<FeatureTarget> run() {
        for (FeatureTarget& target : targets_) {
            setup_.targets = {target.target};
            const DesignProblem problem(setup_);
            collect(problem, target);
            if (target.answers.empty() || conditions_.stop)
                break;
            target.features = features_of(target.answers[0].genome, setup_.model);
            feel(problem, target);
            if (!choose_waves(problem, target) || !hold_out(problem, target))
                break;
            assess_features(target);
        }
        return std::move(targets_);
    }

  private:
    using Population = ga::Population<Genome>;

    /// Starts first .. first + count - 1, each drawn by its number alone.
    Population starts(const DesignProblem& problem, const std::string& what, std::uint64_t first,
                      std::size_t count, bool all_blind = false) const {
        Population population(count);
        ga::parallel_for(count, conditions_.origin.threads, [&](std::size_t i) {
            ga::Stream random(ga::fold(ga::fold(conditions_.origin.seed, what), first + i));
            population[i].genome = all_blind || is_blind(first + i)
                                       ? problem.sample(random)
                                       : rough::shaped_start(problem.setup(), random);
            population[i].identity = first + i;
        });
        return population;
    }

    Population ran(const rough::Pipeline& pipeline, const DesignProblem& problem, Population start) const {
        return ga::run(pipeline, problem, std::move(start), run_options(conditions_)).population;
    }

    json samples_of(const DesignProblem& problem, const Population& population) const {
        std::vector<json> samples(population.size());
        ga::parallel_for(samples.size(), conditions_.origin.threads, [&](std::size_t i) {
            FeatureSample sample{population[i].identity,
                                 population[i].value(),
                                 in_final_form(problem.setup(), population[i].genome),
                                 {},
                                 {}};
            sample.features = rough::column(features_of(sample.genome, setup_.model), &SurfaceFeature::value);
            const rough::Curve curve = secant_stiffness(respond(sample.genome, setup_.model));
            const Eigen::VectorXd& x = problem.setup().targets[0].x;
            for (std::size_t k = 0; k < 3; ++k)
                sample.stiffness[k] =
                    std::log10(curve.held_at(x[static_cast<Eigen::Index>(k) * (x.size() - 1) / 2]));
            samples[i] = kept(sample);
        });
        return samples;
    }

    /// Descents by exact gradients from a batch of starts; those that do not come near are given up early.
    /// Beside the answers as many blind draws that miss.
    json descents(const DesignProblem& problem, std::uint64_t first) const {
        using ga::lm, ga::refine, ga::score;
        Population going = starts(problem, "features", first, batch), answers;
        for (const Leg& leg : legs) {
            Population next;
            for (auto& one : ran(score() | refine(lm(leg.gradients, leg.sharpen)), problem, std::move(going)))
                if (one.value() >= good_)
                    answers.push_back(std::move(one));
                else if (one.value() > good_ - leg.hopeless)
                    next.push_back(std::move(one));
            going = std::move(next);
            if (going.empty())
                break;
        }
        std::sort(answers.begin(), answers.end(),
                  [](const auto& a, const auto& b) { return a.identity < b.identity; });
        Population misses = ran(score(), problem, starts(problem, "misses", first, batch, true));
        std::erase_if(misses,
                      [&](const auto& one) { return one.value() >= good_ || one.fitness.has_failed(); });
        misses.resize(std::min(misses.size(), answers.size()));
        return {{"answers", samples_of(problem, answers)}, {"misses", samples_of(problem, misses)}};
    }

    /// Answers that differ from each other, and misses.
    void collect(const DesignProblem& problem, FeatureTarget& target) const {
        std::vector<rough::Profile> profiles, far;
        const auto differs = [](const rough::Profile& profile, const std::vector<rough::Profile>& from,
                                double least) {
            return std::none_of(from.begin(), from.end(), [&](const rough::Profile& other) {
                return difference(profile, other) < least;
            });
        };
        while (target.answers.size() < wanted_ && target.starts < most_starts_) {
            const auto first = static_cast<std::uint64_t>(target.starts);
            conditions_.progress.show(target.target.name + ": " + std::to_string(target.answers.size()) +
                                      " answers of " + std::to_string(wanted_) + " from " +
                                      std::to_string(first) + " starts");
            const json found = part_of(conditions_, target.target.name + "-" + std::to_string(first),
                                       [&] { return descents(problem, first); });
            if (found.is_null())
                break;
            for (const json& one : found.at("answers")) {
                FeatureSample answer = sample_from(one);
                rough::Profile profile = sample(answer.genome, setup_.model.grid);
                if (target.answers.size() == wanted_ || !differs(profile, profiles, apart_))
                    continue;
                target.found_blindly += is_blind(answer.start);
                if (differs(profile, far, rough::different))
                    far.push_back(profile);
                profiles.push_back(std::move(profile));
                target.answers.push_back(std::move(answer));
            }
            for (const json& one : found.at("misses"))
                if (target.misses.size() < wanted_)
                    target.misses.push_back(sample_from(one));
            target.starts += static_cast<long>(batch);
        }
        target.far_apart = far.size();
        target.misses.resize(std::min(target.misses.size(), target.answers.size()));
    }

    /// How much the answers feel the phases of each octave, by the adjoint; for the best, of each chromosome.
    void feel(const DesignProblem& problem, FeatureTarget& target) const {
        const double length = setup_.model.grid.length;
        std::vector<std::array<double, wave_octaves>> each(target.answers.size());
        std::map<std::string, double> squares; ///< the best one's, by chromosome
        ga::parallel_for(each.size(), conditions_.origin.threads, [&](std::size_t i) {
            const Genome& genome = target.answers[i].genome;
            const ga::Sensitivity rows = problem.sensitivity(genome, "similarity");
            const auto places = rough::gene_places(genome);
            each[i].fill(unset);
            for (std::size_t g = 0; g < places.size(); ++g) {
                if (places[g].kind != GenePlace::Kind::phase)
                    continue;
                const rough::Series& series = genome.series[places[g].series];
                const int n = series.chromosomes[places[g].chromosome].n;
                const double size = rms_of(rows.jacobian.col(static_cast<Eigen::Index>(g)));
                double& octave = each[i][wave_octave(wave_length(series, n), length)];
                octave = std::isnan(octave) ? size : std::max(octave, size);
                if (&target.answers[i] == &target.best())
                    squares[std::to_string(places[g].series + 1) + ":" + std::to_string(n)] += size * size;
            }
        });
        for (const auto& [chromosome, square] : squares)
            target.control.emplace_back(chromosome, std::sqrt(square));
        std::stable_sort(target.control.begin(), target.control.end(),
                         [](const auto& a, const auto& b) { return a.second > b.second; });
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            target.phase_sensitivity[octave] =
                rough::median(rough::column(each, [&](const auto& one) { return one[octave]; }));
    }

    static double rms_of(const Eigen::VectorXd& values) {
        return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
    }

    /// Similarities of starts drawn by that name, in their order, refined by the phases of some octaves'
    /// waves alone; none where the run is stopped.
    std::optional<std::vector<double>> refined(const DesignProblem& problem, const FeatureTarget& target,
                                               const std::string& drawn, const std::string& genes,
                                               const Octaves& octaves) const {
        using ga::lm, ga::refine, ga::score;
        const double length = setup_.model.grid.length;
        const ga::Variables<Genome> phases{
            genes, [&](const Genome& genome) {
                const auto places = rough::gene_places(genome);
                std::vector<ga::Variable> some = problem.bounds(genome);
                std::erase_if(some, [&](const ga::Variable& variable) {
                    const GenePlace& place = places[variable.gene];
                    if (place.kind != GenePlace::Kind::phase)
                        return true;
                    const rough::Series& series = genome.series[place.series];
                    return !octaves[wave_octave(wave_length(series, series.chromosomes[place.chromosome].n),
                                                length)];
                });
                return some;
            }};
        conditions_.progress.show(target.target.name + ": " + drawn + ", " + genes);
        const json found = part_of(conditions_, target.target.name + "-" + drawn + "-" + genes, [&] {
            std::vector<double> similarity(tried_);
            for (const auto& one :
                 ran(score() | refine(lm(50, 8), phases), problem, starts(problem, drawn, 0, tried_)))
                similarity[one.identity] = one.value();
            return json(similarity);
        });
        return found.is_null() ? std::nullopt : std::optional(found.get<std::vector<double>>());
    }

    static Octaves every_octave() {
        Octaves all;
        all.fill(true);
        return all;
    }

    /// Octaves, the most felt first, until their phases alone are enough for starts of their own. Whether it
    /// came to its end.
    bool choose_waves(const DesignProblem& problem, FeatureTarget& target) const {
        const auto freely = refined(problem, target, "chosen on", "all phases", every_octave());
        std::vector<std::size_t> order;
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            if (!std::isnan(target.phase_sensitivity[octave]))
                order.push_back(octave);
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return target.phase_sensitivity[a] > target.phase_sensitivity[b];
        });
        for (const std::size_t octave : order) {
            if (!freely)
                return false;
            target.needed[octave] = true;
            const auto some =
                refined(problem, target, "chosen on",
                        "phases of " + octave_name(octave) + " and the more felt", target.needed);
            if (!some)
                return false;
            if (are_enough(loss_of(*freely, *some)))
                break;
        }
        return true;
    }

    /// New starts refined by the phases of needed waves, of all, of the others alone. Whether it came to its
    /// end.
    bool hold_out(const DesignProblem& problem, FeatureTarget& target) const {
        Octaves others = target.needed;
        for (bool& one : others)
            one = !one;
        for (const auto& [name, octaves] :
             {std::pair("phases of the needed waves", target.needed), std::pair("all phases", every_octave()),
              std::pair("phases of the other waves", others)}) {
            auto found = refined(problem, target, "held out", name, octaves);
            if (!found)
                return false;
            target.held_out.emplace_back(name, std::move(*found));
        }
        return true;
    }

    const Conditions& conditions_;
    std::size_t wanted_;
    long most_starts_;
    std::size_t tried_;
    double good_, apart_;
    rough::DesignSetup setup_; ///< of the target at hand
    std::vector<FeatureTarget> targets_;
};

Study study_of(const std::vector<FeatureTarget>& targets, double length) {
    std::string columns = "target,group,start,similarity,log10_K_low,log10_K_middle,log10_K_high";
    for (const SurfaceFeature& feature : targets.front().features)
        columns += "," + feature.name;
    Csv surfaces(columns),
        verdicts(
            "target,feature,meaning,kind,answers_median,answers_quartiles,misses_median,misses_quartiles,p,"
            "rank_correlation_low,rank_correlation_middle,rank_correlation_high"),
        laws("target,features,count,pressure,error,error_of_mean,error_on_answers,error_of_mean_on_"
             "answers"),
        octaves("target,waves,misfit_per_rad,needed"), held("target,genes,similarity");
    json genomes = json::array();
    Study study{.words = feature_words(targets)};
    for (const FeatureTarget& target : targets) {
        if (target.verdicts.empty())
            continue;
        for (const auto& [group, samples] :
             {std::pair("answer", &target.answers), std::pair("miss", &target.misses)})
            for (const FeatureSample& one : *samples) {
                json row{{"target", target.target.name},
                         {"group", group},
                         {"start", one.start},
                         {"similarity", one.similarity}};
                genomes.push_back(row);
                genomes.back()["genome"] = rough::genome_to_json(one.genome);
                row.update({{"log10_K_low", one.stiffness[0]},
                            {"log10_K_middle", one.stiffness[1]},
                            {"log10_K_high", one.stiffness[2]}});
                for (std::size_t f = 0; f < one.features.size(); ++f)
                    row[target.features[f].name] = one.features[f];
                surfaces.add(row);
            }
        for (const json& row : target.verdicts)
            verdicts.add(row);
        for (const json& row : target.laws)
            laws.add(row);
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            octaves.row(target.target.name, octave_name(octave), target.phase_sensitivity[octave],
                        target.needed[octave] ? 1 : 0);
        for (const auto& [genes, reached] : target.held_out)
            for (const double similarity : reached)
                held.row(target.target.name, genes, similarity);
        study.result["targets"][target.target.name] = {{"answers", target.answers.size()},
                                                       {"misses", target.misses.size()},
                                                       {"starts", target.starts},
                                                       {"answers_from_blind_starts", target.found_blindly},
                                                       {"answers_far_apart", target.far_apart},
                                                       {"control", target.control}};
        study.files.emplace_back("best/" + target.target.name + ".json",
                                 rough::genome_file_text(target.best().genome, length));
    }
    study.tables = {{"surfaces.csv", "", surfaces},
                    {"features.csv", "features", verdicts},
                    {"regression.csv", "regression", laws},
                    {"octaves.csv", "octaves", octaves},
                    {"heldout.csv", "", held}};
    study.files.emplace_back("genomes.json", rough::json_text(genomes) + "\n");
    return study;
}

Findings run_features(const Settings& settings, const Conditions& conditions) {
    const std::vector<FeatureTarget> targets = FeatureTrial(settings, conditions).run();
    if (targets.front().verdicts.empty())
        return {};
    return findings_of(conditions, "What matters for a curve, and what does not",
                       study_of(targets, model_from(settings, "model.").grid.length),
                       [targets](Page& page) { fill_features_page(page, targets); });
}

} // namespace

Experiment features_experiment() {
    return {.kind = "features",
            .summary = "which features of a surface drive its response, and which may be chosen",
            .settings = joined(
                {{{"features.answers", "1000", "different answers a target, and as many surfaces that miss"},
                  {"features.similarity", "0.99", "of an answer, at least"},
                  {"features.difference", "0.001",
                   "of two answers, at least: 1 less the correlation of their heights"},
                  {"features.starts", "30000", "most starts for them"},
                  {"features.held-out", "128", "starts of the held-out check"},
                  {"targets.files", "", "target curves (CSV), with commas between"},
                  {"targets.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                 model_settings("model.")}),
            .files = {"surfaces.csv", "features.csv", "regression.csv", "octaves.csv", "heldout.csv",
                      "genomes.json", "best"},
            .run = run_features,
            .resumes = true};
}

} // namespace app
