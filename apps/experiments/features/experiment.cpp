#include "apps/experiments/experiment.hpp"

#include "apps/experiments/features/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/target_files.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/numerics/rank_tests.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/problem/pipeline.hpp"
#include "domain/profile/difference.hpp"
#include "domain/text/atomic_file.hpp"
#include "ga/parallel.hpp"
#include "ga/refinement/vocabulary.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace app {

namespace {

using rough::DesignProblem;
using rough::Genome;

constexpr std::size_t block = 64; ///< starts at a time
/// An octave is needed whose waves are felt more than this share of the most felt.
constexpr double felt = 0.25;

class Trial {
  public:
    Trial(const Settings& settings, const Conditions& conditions, FeatureRun& run)
        : conditions_(conditions), run_(run),
          wanted_(static_cast<std::size_t>(settings.whole("features.answers", 4, 1000000))),
          most_starts_(settings.whole("features.starts", 1, 100000000)),
          tried_(static_cast<std::size_t>(settings.whole("features.held-out", 1, 100000))) {
        run.model = model_from(settings, "model.");
        run.max_pressure = settings.pressure("targets.max-pressure");
        run.good = settings.number("features.similarity", 0, 1);
        for (const auto& file : target_files(settings, "targets.files")) {
            FeatureTarget target;
            target.target = rough::read_target(file);
            target.target.name = file.stem().string();
            run.targets.push_back(std::move(target));
        }
    }

    void run() {
        for (FeatureTarget& target : run_.targets) {
            rough::DesignSetup setup;
            setup.model = run_.model;
            setup.targets = {target.target};
            setup.max_pressure = run_.max_pressure;
            const DesignProblem problem(setup);
            collect(problem, target);
            if (conditions_.stop || target.answers.empty())
                return;
            feel(problem, target);
            judge_features(target);
            hold_out(problem, target);
        }
    }

  private:
    using Population = ga::Population<Genome>;

    /// Starts first .. first + count - 1, each drawn by its number alone: made for the target, or blindly.
    Population starts(const DesignProblem& problem, std::uint64_t first, std::size_t count, bool made) const {
        Population population(count);
        ga::parallel_for(count, run_.origin.threads, [&](std::size_t i) {
            ga::Stream random(ga::fold(ga::fold(run_.origin.seed, "features"), first + i));
            population[i].genome =
                made ? rough::shaped_start(problem.setup(), random) : problem.sample(random);
            population[i].identity = first + i;
        });
        return population;
    }

    ga::Result<Genome> ran(const rough::Pipeline& pipeline, const DesignProblem& problem,
                           Population start) const {
        ga::RunOptions options;
        options.seed = run_.origin.seed;
        options.threads = run_.origin.threads;
        options.budget.stop = &conditions_.stop;
        return ga::run(pipeline, problem, std::move(start), options);
    }

    FeatureSample sample_of(const DesignProblem& problem, const ga::Individual<Genome>& one) const {
        FeatureSample sample{one.identity, one.value(), in_final_form(problem.setup(), one.genome), {}, {}};
        sample.features = features_of(sample.genome, run_.model);
        const rough::Curve curve = secant_stiffness(respond(sample.genome, run_.model));
        const Eigen::VectorXd& x = problem.setup().targets[0].x;
        for (std::size_t k = 0; k < 3; ++k)
            sample.stiffness[k] =
                std::log10(curve.held_at(x[static_cast<Eigen::Index>(k) * (x.size() - 1) / 2]));
        return sample;
    }

    std::vector<FeatureSample> samples_of(const DesignProblem& problem, const Population& population) const {
        std::vector<FeatureSample> samples(population.size());
        ga::parallel_for(samples.size(), run_.origin.threads,
                         [&](std::size_t i) { samples[i] = sample_of(problem, population[i]); });
        return samples;
    }

    /// Answers that differ from each other, and as many blind draws that miss.
    void collect(const DesignProblem& problem, FeatureTarget& target) const {
        using ga::best, ga::lm, ga::refine, ga::score;
        const auto pipeline = score() | refine(lm(8)) | best(block / 2) | refine(lm(45, 8));
        Population answers, misses;
        std::vector<rough::Profile> profiles;
        while (answers.size() < wanted_ && target.starts < most_starts_ && !conditions_.stop) {
            const auto first = static_cast<std::uint64_t>(target.starts);
            conditions_.progress.show(target.target.name + ": " + std::to_string(answers.size()) +
                                      " answers of " + std::to_string(wanted_) + " from " +
                                      std::to_string(target.starts) + " starts");
            for (auto& one :
                 ran(score() | best(block), problem, starts(problem, first, block, false)).population)
                if (one.value() < run_.good && misses.size() < wanted_)
                    misses.push_back(std::move(one));
            for (auto& one : ran(pipeline, problem, starts(problem, first, block, true)).population) {
                if (!(one.value() >= run_.good) || answers.size() >= wanted_)
                    continue;
                rough::Profile profile = sample(one.genome, run_.model.grid);
                if (std::any_of(profiles.begin(), profiles.end(), [&](const rough::Profile& other) {
                        return difference(profile, other) < rough::different;
                    }))
                    continue;
                profiles.push_back(std::move(profile));
                answers.push_back(std::move(one));
            }
            target.starts += static_cast<long>(block);
        }
        misses.resize(std::min(misses.size(), answers.size()));
        target.answers = samples_of(problem, answers);
        target.misses = samples_of(problem, misses);
    }

    /// How much the answers feel the phases of each octave, by the adjoint; for the best, of each chromosome.
    void feel(const DesignProblem& problem, FeatureTarget& target) const {
        const double length = run_.model.grid.length;
        std::vector<std::array<double, wave_octaves>> each(target.answers.size());
        const auto best = static_cast<std::size_t>(
            std::max_element(target.answers.begin(), target.answers.end(),
                             [](const auto& a, const auto& b) { return a.similarity < b.similarity; }) -
            target.answers.begin());
        ga::parallel_for(each.size(), run_.origin.threads, [&](std::size_t i) {
            const Genome& genome = target.answers[i].genome;
            const ga::Sensitivity rows = problem.sensitivity(genome, "similarity");
            const auto places = rough::gene_places(genome);
            each[i].fill(unset_number);
            const double points = std::sqrt(static_cast<double>(rows.residuals.size()));
            for (std::size_t g = 0; g < places.size(); ++g) {
                if (places[g].kind != rough::GenePlace::Kind::phase)
                    continue;
                const rough::Series& series = genome.series[places[g].series];
                const int n = series.chromosomes[places[g].chromosome].n;
                const double size = rows.jacobian.col(static_cast<Eigen::Index>(g)).norm() / points;
                double& octave = each[i][wave_octave(wave_length(series, n), length)];
                octave = std::isnan(octave) ? size : std::max(octave, size);
                if (i == best)
                    target.control.emplace_back(
                        std::to_string(places[g].series + 1) + ":" + std::to_string(n), size);
            }
        });
        std::sort(target.control.begin(), target.control.end(),
                  [](const auto& a, const auto& b) { return a.second > b.second; });
        double most = 0;
        for (std::size_t octave = 0; octave < wave_octaves; ++octave) {
            target.phase_sensitivity[octave] =
                rough::median(rough::column(each, [&](const auto& one) { return one[octave]; }));
            most = std::fmax(most, target.phase_sensitivity[octave]);
        }
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            target.needed[octave] = target.phase_sensitivity[octave] > felt * most;
    }

    /// From starts that no answer came from: refined by the genes of needed waves, of all, of the others
    /// alone.
    void hold_out(const DesignProblem& problem, FeatureTarget& target) const {
        using ga::lm, ga::refine, ga::score;
        const double length = run_.model.grid.length;
        const auto phases = [&](const std::string& name, std::optional<bool> needed) {
            return ga::Variables<Genome>{
                name, [&, needed](const Genome& genome) {
                    const auto places = rough::gene_places(genome);
                    std::vector<ga::Variable> some = problem.bounds(genome);
                    std::erase_if(some, [&](const ga::Variable& variable) {
                        const auto& place = places[variable.gene];
                        if (place.kind != rough::GenePlace::Kind::phase)
                            return true;
                        const auto& series = genome.series[place.series];
                        const double wave = wave_length(series, series.chromosomes[place.chromosome].n);
                        return needed && target.needed[wave_octave(wave, length)] != *needed;
                    });
                    return some;
                }};
        };
        for (const auto& [name, genes] : {std::pair("phases of the needed waves", phases("needed", true)),
                                          std::pair("all phases", phases("phases", std::nullopt)),
                                          std::pair("phases of the other waves", phases("others", false))}) {
            conditions_.progress.show(target.target.name + ": held out, " + name);
            const auto found =
                ran(score() | refine(lm(50, 8), genes), problem,
                    starts(problem, static_cast<std::uint64_t>(most_starts_) + 1, tried_, false));
            HeldOut held{name, {}};
            for (const auto& one : found.population)
                held.similarity.push_back(one.value());
            target.held_out.push_back(std::move(held));
        }
        target.held_out_p = rough::rank_sum_p(target.held_out[0].similarity, target.held_out[1].similarity);
    }

    static constexpr double unset_number = std::numeric_limits<double>::quiet_NaN();

    const Conditions& conditions_;
    FeatureRun& run_;
    std::size_t wanted_;
    long most_starts_;
    std::size_t tried_;
};

void write_features(const FeatureRun& run, const std::filesystem::path& folder) {
    std::string header = "target,group,start,similarity,log10_K_low,log10_K_middle,log10_K_high", text;
    nlohmann::json genomes = nlohmann::json::array(), result = origin_json(run.origin);
    Csv verdicts(
        "target,feature,meaning,kind,answers_median,answers_quartiles,misses_median,misses_quartiles,p,"
        "rank_correlation_low,rank_correlation_middle,rank_correlation_high");
    Csv octaves("target,waves,misfit_per_rad,needed");
    Csv held("target,genes,similarity");
    for (const FeatureTarget& target : run.targets) {
        for (const auto& [group, samples] :
             {std::pair("answer", &target.answers), std::pair("miss", &target.misses)})
            for (const FeatureSample& one : *samples) {
                if (text.empty())
                    for (const SurfaceFeature& feature : one.features)
                        header += "," + feature.name;
                rough::PlainStream row;
                row.precision(17);
                row << target.target.name << "," << group << "," << one.number << "," << one.similarity;
                for (const double k : one.stiffness)
                    row << "," << k;
                for (const SurfaceFeature& feature : one.features)
                    row << "," << feature.value;
                text += row.str() + "\n";
                genomes.push_back({{"target", target.target.name},
                                   {"group", group},
                                   {"start", one.number},
                                   {"similarity", one.similarity},
                                   {"genome", rough::genome_to_json(one.genome)}});
            }
        for (const FeatureVerdict& one : target.verdicts)
            verdicts.row(target.target.name, one.name, one.meaning,
                         std::string(one.kind == FeatureVerdict::Kind::shared    ? "shared"
                                     : one.kind == FeatureVerdict::Kind::shifted ? "shifted"
                                                                                 : "open"),
                         one.answers, one.answers_width, one.misses, one.misses_width, one.p,
                         one.rank_correlation[0], one.rank_correlation[1], one.rank_correlation[2]);
        for (std::size_t octave = 0; octave < wave_octaves; ++octave)
            octaves.row(target.target.name, octave_name(octave), target.phase_sensitivity[octave],
                        target.needed[octave] ? 1 : 0);
        for (const HeldOut& one : target.held_out)
            for (const double similarity : one.similarity)
                held.row(target.target.name, one.name, similarity);
        nlohmann::json& own = result["targets"][target.target.name];
        own["answers"] = target.answers.size(), own["misses"] = target.misses.size();
        own["starts"] = target.starts;
        own["held_out_p"] = target.held_out_p;
        own["control"] = nlohmann::json(target.control);
        own["regression_left_out_r2"] = {
            {"all", target.regression[0]}, {"shared", target.regression[1]}, {"waves", target.regression[2]}};
    }
    rough::write_atomically(folder / "surfaces.csv", header + "\n" + text);
    rough::write_atomically(folder / "features.csv", verdicts.text());
    rough::write_atomically(folder / "octaves.csv", octaves.text());
    rough::write_atomically(folder / "heldout.csv", held.text());
    write_json(folder / "genomes.json", genomes);
    result["words"] = feature_words(run);
    result["features"] = verdicts.rows();
    result["octaves"] = octaves.rows();
    result["seconds"] = run.seconds;
    write_json(folder / "result.json", result);
}

Findings run_features(const Settings& settings, const Conditions& conditions) {
    const ga::Stopwatch clock;
    const auto run = std::make_shared<FeatureRun>();
    run->origin = conditions.origin;
    Trial(settings, conditions, *run).run();
    run->seconds = clock.seconds();
    if (run->targets.front().verdicts.empty())
        return {};
    return {[run, folder = conditions.folder] { write_features(*run, folder); },
            [run] { return features_page(*run); }, feature_words(*run).front()};
}

} // namespace

Experiment features_experiment() {
    return {.kind = "features",
            .summary = "which features of a surface drive its response, and which may be chosen",
            .settings = joined(
                {{{"features.answers", "1000", "different answers a target, and as many surfaces that miss"},
                  {"features.similarity", "0.99", "of an answer, at least"},
                  {"features.starts", "30000", "most starts for them"},
                  {"features.held-out", "64", "starts of the held-out check"},
                  {"targets.files", "", "target curves (CSV), with commas between"},
                  {"targets.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                 model_settings("model.")}),
            .files = {"surfaces.csv", "features.csv", "octaves.csv", "heldout.csv", "genomes.json"},
            .run = run_features};
}

} // namespace app
