#include "apps/experiments/experiment.hpp"

#include "apps/experiments/growth/run.hpp"
#include "apps/experiments/paper/variant_runs.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/target_files.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "domain/database/law.hpp"
#include "domain/design/search.hpp"
#include "domain/errors.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/words.hpp"
#include "ga/parallel.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace app {

namespace {

using ga::best, ga::refine, ga::score;
using rough::Genome;
using Population = ga::Population<Genome>;

constexpr double good = 0.95; ///< in a part (the paper)
constexpr std::size_t at_least = 3, refined = 3;
/// Children in memory at a time.
constexpr std::size_t block = 20000;

/// A stored genome's scores; the genome itself is drawn again when it is asked for.
struct Stored {
    double scale; ///< by Eq. 11
    Scores scores;
};

class Trial {
  public:
    Trial(const Settings& settings, const Conditions& conditions, Growth& growth)
        : conditions_(conditions), growth_(growth), model_(model_from(settings, "model.")),
          max_pressure_(settings.pressure("targets.max-pressure")),
          seeds_(settings.whole("growth.seeds", 1, 100)),
          budget_(settings.whole("growth.budget", 1, 1000000000)) {
        law_.lambda = model_.grid.length;
        law_.shortest = model_.grid.spacing();
        law_.seed = growth.origin.seed;
        growth.most_pairs = static_cast<std::uint64_t>(settings.whole("growth.pairs", 9, 100000000));
        for (const auto& word : rough::listed(settings.text("growth.sizes"))) {
            const double size = rough::number_from(word, settings.place("growth.sizes"));
            if (!(size >= 10) || size > 1e7 || size != std::floor(size) ||
                (!sizes_.empty() && size <= static_cast<double>(sizes_.back())))
                throw rough::InputError(settings.place("growth.sizes") + ": " + word +
                                        " given, expected whole numbers from 10 to 1e7, increasing");
            sizes_.push_back(static_cast<std::uint64_t>(size));
        }
        for (const auto& file : target_files(settings, "targets.files")) {
            growth.targets.push_back({rough::read_target(file), {}, {}});
            growth.targets.back().target.name = file.stem().string();
        }
    }

    void run() {
        for (GrowthTarget& target : growth_.targets) {
            target_ = &target;
            stored_.clear();
            for (const std::uint64_t size : sizes_) {
                show("database of " + std::to_string(size));
                store(size);
                for (const char* variant : {"sog", "gco", "cco"}) {
                    if (conditions_.stop)
                        return;
                    show(std::string(variant) + " from " + std::to_string(size));
                    target.grown.push_back(grown(variant));
                }
            }
            for (long seed = 0; seed < seeds_ && !conditions_.stop; ++seed) {
                show("default search, run " + std::to_string(seed + 1));
                target.by_default.push_back(
                    default_course(growth_.origin.seed + static_cast<std::uint64_t>(seed)));
            }
        }
    }

  private:
    void show(const std::string& what) const {
        conditions_.progress.show(target_->target.name + ": " + what);
    }

    rough::DesignSetup setup() const {
        return paper_setup(model_, target_->target, max_pressure_, 0.5 * max_pressure_);
    }

    /// Scores the genomes up to `size` that are not yet there.
    void store(std::uint64_t size) {
        const std::size_t from = stored_.size();
        stored_.resize(size, {1, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}});
        const rough::DesignSetup own = setup();
        ga::parallel_for(size - from, growth_.origin.threads, [&](std::size_t i) {
            if (conditions_.stop)
                return;
            auto one = answered({drawn(law_, from + i)}, model_, max_pressure_, 1);
            stored_[from + i] = {one[0].genome.scale, scores_of(one, own)[0]};
        });
    }

    Genome genome(std::uint64_t number) const {
        Genome one = drawn(law_, number);
        one.scale = stored_[number].scale;
        return one;
    }

    /// Those above 0.95 in a part, or the three best, best first.
    std::vector<std::uint64_t> good_in(double Scores::*part) const {
        std::vector<std::uint64_t> order(stored_.size());
        std::iota(order.begin(), order.end(), std::uint64_t{0});
        const auto score_of = [&](std::uint64_t i) { return stored_[i].scores.*part; };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint64_t a, std::uint64_t b) { return score_of(a) > score_of(b); });
        const auto above =
            std::find_if(order.begin(), order.end(), [&](std::uint64_t i) { return !(score_of(i) > good); });
        order.resize(std::max(at_least, static_cast<std::size_t>(above - order.begin())));
        return order;
    }

    /// Cut to the best of each so that no more than `most_pairs` are left, the longer one first.
    void cut(std::vector<std::uint64_t>& low, std::vector<std::uint64_t>& high) const {
        const std::uint64_t most = growth_.most_pairs;
        auto &longer = low.size() > high.size() ? low : high, &other = low.size() > high.size() ? high : low;
        if (low.size() * high.size() <= most)
            return;
        other.resize(std::min(other.size(), static_cast<std::size_t>(std::sqrt(static_cast<double>(most)))));
        longer.resize(most / other.size());
    }

    ga::Result<Genome> ran(const rough::Pipeline& pipeline, const rough::DesignProblem& problem,
                           Population start, bool screening) const {
        ga::RunOptions options;
        options.seed = growth_.origin.seed;
        options.threads = growth_.origin.threads;
        options.budget.stop = &conditions_.stop;
        options.screening = screening;
        return ga::run(pipeline, problem, std::move(start), options);
    }

    Grown grown(const std::string& variant) const {
        const ga::Stopwatch clock;
        Grown result;
        result.variant = variant;
        result.size = stored_.size();
        result.curves = static_cast<long>(stored_.size());
        const auto responses = std::make_shared<rough::LoneResponses>(model_);
        const rough::Vocabulary words{std::make_shared<rough::DominanceRule>(
            responses, rough::DominanceReading::same_pressure, rough::dominance_threshold)};
        const rough::DesignProblem problem(setup());
        const Population candidates =
            variant == "sog" ? three_best(result) : best_children(variant == "cco", words, problem, result);
        const auto phases = words.phases(), dominant = words.dominant(), others = words.others();
        const rough::Pipeline pipeline =
            variant == "cco"
                ? rough::Pipeline(score() | best(refined) | refine(rough::gcmma(3), phases) | best(1))
                : rough::Pipeline(score() | best(refined) |
                                  refine(rough::gcmma(variant == "sog" ? 5 : 3), dominant) |
                                  refine(rough::gcmma(2), others) | best(1));
        const auto found = ran(pipeline, problem, candidates, false);
        result.seconds = clock.seconds();
        if (found.population.empty())
            return result;
        result.curves += found.counters.evaluations + found.counters.gradients + responses->curves();
        const auto& answer = found.population.front();
        result.parents.assign(answer.parents.begin(), answer.parents.end());
        if (variant == "sog")
            result.parents = {answer.identity};
        const auto judged = rough::Judge(as_reported(setup())).of(answer.genome);
        result.similarity = judged.similarity;
        result.worst = judged.worst();
        return result;
    }

    Population three_best(Grown& result) const {
        const auto order = good_in(&Scores::all);
        Population population;
        for (std::size_t i = 0; i < std::min(refined, order.size()); ++i)
            population.push_back({genome(order[i]), order[i], {}, {}, nullptr});
        result.best_child = stored_[order.front()].scores.all;
        return population;
    }

    /// Pairs in blocks, each screened against the three best before it.
    Population best_children(bool reduce, const rough::Vocabulary& words, const rough::DesignProblem& problem,
                             Grown& result) const {
        auto low = good_in(&Scores::low), high = good_in(&Scores::high);
        result.u1 = low.size(), result.u2 = high.size();
        cut(low, high);
        const auto parents_of = [&](const std::vector<std::uint64_t>& numbers) {
            std::vector<Genome> parents(numbers.size());
            ga::parallel_for(numbers.size(), growth_.origin.threads, [&](std::size_t i) {
                parents[i] = genome(numbers[i]);
                if (reduce)
                    parents[i] = reduced_by(words, parents[i]);
            });
            return parents;
        };
        const std::vector<Genome> left = parents_of(low), right = parents_of(high);
        Population population;
        const auto screen = [&] {
            const auto found = ran(score() | best(refined), problem, std::move(population), true);
            result.curves += found.counters.evaluations + found.counters.given_up;
            result.given_up += found.counters.given_up;
            population = found.population;
        };
        std::uint64_t identity = stored_.size();
        for (std::size_t a = 0; a < left.size() && !conditions_.stop; ++a)
            for (std::size_t b = 0; b < right.size(); ++b) {
                // Of twins (i, j) and (j, i) the first.
                const auto twin = std::find(high.begin(), high.end(), low[a]);
                const auto other = std::find(low.begin(), low.end(), high[b]);
                if (twin != high.end() && other != low.end() && other - low.begin() < static_cast<long>(a))
                    continue;
                population.push_back({sum(left[a], right[b]), identity++, {low[a], high[b]}, {}, nullptr});
                ++result.pairs;
                if (population.size() >= block)
                    screen();
            }
        screen();
        if (!population.empty())
            result.best_child = population.front().value();
        return population;
    }

    static Genome reduced_by(const rough::Vocabulary& words, const Genome& genome) {
        return reduced(genome, (*words.rule)(genome));
    }

    Course default_course(std::uint64_t seed) const {
        rough::DesignSetup free;
        free.model = model_;
        free.targets = {target_->target};
        free.max_pressure = max_pressure_;
        rough::SearchOptions options;
        options.seed = seed;
        options.threads = growth_.origin.threads;
        options.evaluations = budget_;
        options.stop = &conditions_.stop;
        Course course{seed, {}, 0};
        static const ga::Name similarity("similarity");
        const auto watch = [&](const ga::Event<Genome>& event) {
            double most = course.best.empty() ? -HUGE_VAL : course.best.back().second;
            for (const auto& one : event.population)
                if (one.fitness.known(similarity) && !one.fitness.has_failed())
                    most = std::max(most, one.fitness.value());
            const auto paid = static_cast<double>(event.counters.evaluations + event.counters.gradients);
            if (std::isfinite(most))
                course.best.emplace_back(std::max(1., paid), most);
        };
        course.worst = rough::search(free, options, {watch}).best.judged();
        return course;
    }

    const Conditions& conditions_;
    Growth& growth_;
    rough::Model model_;
    double max_pressure_;
    long seeds_, budget_;
    rough::GenomeLaw law_;
    std::vector<std::uint64_t> sizes_;
    std::vector<Stored> stored_; ///< under the target at hand
    GrowthTarget* target_ = nullptr;
};

void write_growth(const Growth& growth, const std::filesystem::path& folder) {
    Csv table(
        "target,stored,variant,U1,U2,pairs_tried,given_up,best_child,similarity,similarity_worst,parent1,"
        "parent2,curves,seconds");
    Csv courses("target,seed,curves,similarity");
    for (const GrowthTarget& target : growth.targets) {
        for (const Grown& one : target.grown) {
            const auto parent = [&](std::size_t i) {
                return i < one.parents.size() ? std::to_string(one.parents[i]) : std::string();
            };
            table.row(target.target.name, one.size, one.variant, one.u1, one.u2, one.pairs, one.given_up,
                      one.best_child, one.similarity, one.worst, parent(0), parent(1), one.curves,
                      one.seconds);
        }
        for (const Course& course : target.by_default)
            for (const auto& [paid, similarity] : course.best)
                courses.row(target.target.name, course.seed, paid, similarity);
    }
    rough::write_atomically(folder / "growth.csv", table.text());
    rough::write_atomically(folder / "default.csv", courses.text());
    nlohmann::json result = origin_json(growth.origin);
    result["words"] = growth_words(growth);
    result["rows"] = table.rows();
    result["seconds"] = growth.seconds;
    write_json(folder / "result.json", result);
}

Findings run_growth(const Settings& settings, const Conditions& conditions) {
    const ga::Stopwatch clock;
    const auto growth = std::make_shared<Growth>();
    growth->origin = conditions.origin;
    Trial(settings, conditions, *growth).run();
    growth->seconds = clock.seconds();
    if (growth->targets.front().grown.empty())
        return {};
    return {[growth, folder = conditions.folder] { write_growth(*growth, folder); },
            [growth] { return growth_page(*growth); }, growth_words(*growth).front()};
}

} // namespace

Experiment growth_experiment() {
    return {.kind = "growth",
            .summary = "SOG, GCO and CCO from ever larger databases, beside the default search",
            .settings = joined(
                {{{"growth.sizes", "100, 1000, 10000", "stored genomes, increasing"},
                  {"growth.pairs", "40000", "pairs of parents tried at most, of the best in their parts"},
                  {"growth.seeds", "3", "runs of the default search"},
                  {"growth.budget", "3000", "curves and gradients of each"},
                  {"targets.files", "", "target curves (CSV), with commas between"},
                  {"targets.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                 model_settings("model.")}),
            .files = {"growth.csv", "default.csv"},
            .run = run_growth};
}

} // namespace app
