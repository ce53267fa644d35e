#include "apps/experiments/growth/run.hpp"
#include "apps/experiments/paper/variant_runs.hpp"
#include "apps/experiments/study.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/target_files.hpp"
#include "domain/database/law.hpp"
#include "domain/design/search.hpp"
#include "domain/errors.hpp"
#include "domain/target/similarity.hpp"
#include "domain/text/words.hpp"
#include "ga/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace app {

namespace {

using ga::best, ga::refine, ga::score;
using nlohmann::json;
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

/// What SOG, GCO or CCO paid and found on its way.
struct Way {
    std::size_t u1 = 0, u2 = 0; ///< genomes above 0.95 at low and at high pressure, "at least 3" included
    long pairs = 0;             ///< distinct ones that were tried: |U3| = u1 u2, where it is not capped
    long given_up = 0;          ///< of them, as an exact bound showed that they are not among the best
    double best_child = NAN;    ///< before refinement
    long curves = 0;            ///< the database's, Algorithm 1's, the children's and the refinement's
};

class GrowthTrial {
  public:
    GrowthTrial(const Settings& settings, const Conditions& conditions)
        : conditions_(conditions), model_(model_from(settings, "model.")),
          max_pressure_(settings.pressure("targets.max-pressure")),
          most_pairs_(static_cast<std::uint64_t>(settings.whole("growth.pairs", 9, 100000000))),
          seeds_(settings.whole("growth.seeds", 1, 100)),
          budget_(settings.whole("growth.budget", 1, 1000000000)) {
        law_.lambda = model_.grid.length;
        law_.shortest = model_.grid.spacing();
        law_.seed = conditions.origin.seed;
        for (const auto& word : rough::listed(settings.text("growth.sizes"))) {
            const double size = rough::number_from(word, settings.place("growth.sizes"));
            if (!(size >= 10) || size > 1e7 || size != std::floor(size) ||
                (!sizes_.empty() && size <= static_cast<double>(sizes_.back())))
                throw rough::InputError(settings.place("growth.sizes") + ": " + word +
                                        " given, expected whole numbers from 10 to 1e7, increasing");
            sizes_.push_back(static_cast<std::uint64_t>(size));
        }
        for (rough::Target& target : named_targets(settings, "targets.files"))
            targets_.push_back({std::move(target), json::array(), json::array()});
    }

    std::vector<GrowthTarget> run() {
        for (GrowthTarget& target : targets_) {
            target_ = &target.target;
            stored_.clear();
            for (const std::uint64_t size : sizes_) {
                store(size);
                for (const char* variant : {"sog", "gco", "cco"})
                    if (json row = found(std::string(variant) + "-" + std::to_string(size),
                                         [&] { return grown(variant); });
                        !row.is_null())
                        target.grown.push_back(std::move(row));
            }
            for (long i = 0; i < seeds_; ++i) {
                const std::uint64_t seed = law_.seed + static_cast<std::uint64_t>(i);
                if (json course = found("default-" + std::to_string(seed), [&] { return searched(seed); });
                    !course.is_null())
                    target.searched.push_back(std::move(course));
            }
        }
        return std::move(targets_);
    }

  private:
    json found(const std::string& what, const std::function<json()>& find) const {
        conditions_.progress.show(target_->name + ": " + what);
        return part_of(conditions_, target_->name + "-" + what, find);
    }

    rough::DesignSetup setup() const {
        return paper_setup(model_, *target_, max_pressure_, 0.5 * max_pressure_);
    }

    /// Scores the genomes up to `size` that are not yet there.
    void store(std::uint64_t size) {
        const std::size_t from = stored_.size();
        const json rows = found("database-" + std::to_string(size), [&] {
            const rough::DesignSetup own = setup();
            std::vector<std::array<double, 4>> fresh(size - from);
            ga::parallel_for(fresh.size(), conditions_.origin.threads, [&](std::size_t i) {
                if (conditions_.stop)
                    return;
                const auto one = answered({drawn(law_, from + i)}, model_, max_pressure_, 1);
                const Scores scores = scores_of(one, own)[0];
                fresh[i] = {one[0].genome.scale, scores.all, scores.low, scores.high};
            });
            return json(fresh);
        });
        const auto number = [](const json& value) {
            return value.is_null() ? -HUGE_VAL : value.get<double>();
        };
        for (const json& row : rows) {
            Stored& one = stored_.emplace_back();
            one.scale = number(row[0]);
            one.scores.all = number(row[1]), one.scores.low = number(row[2]),
            one.scores.high = number(row[3]);
        }
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
        const std::uint64_t most = most_pairs_;
        auto &longer = low.size() > high.size() ? low : high, &other = low.size() > high.size() ? high : low;
        if (low.size() * high.size() <= most)
            return;
        other.resize(std::min(other.size(), static_cast<std::size_t>(std::sqrt(static_cast<double>(most)))));
        longer.resize(most / other.size());
    }

    ga::Result<Genome> ran(const rough::Pipeline& pipeline, const rough::DesignProblem& problem,
                           Population start, bool screening) const {
        ga::RunOptions options = run_options(conditions_);
        options.screening = screening;
        return ga::run(pipeline, problem, std::move(start), options);
    }

    json grown(const std::string& variant) const {
        const ga::Stopwatch clock;
        Way way;
        const auto responses = std::make_shared<rough::LoneResponses>(model_);
        const rough::Vocabulary words{std::make_shared<rough::DominanceRule>(
            responses, rough::DominanceReading::same_pressure, rough::dominance_threshold)};
        const rough::DesignProblem problem(setup());
        const bool alone = variant == "sog";
        const Population candidates =
            alone ? three_best(way) : best_children(variant == "cco", words, problem, way);
        const auto phases = words.phases(), dominant = words.dominant(), others = words.others();
        const rough::Pipeline pipeline =
            variant == "cco"
                ? rough::Pipeline(score() | best(refined) | refine(rough::gcmma(3), phases) | best(1))
                : rough::Pipeline(score() | best(refined) | refine(rough::gcmma(alone ? 5 : 3), dominant) |
                                  refine(rough::gcmma(2), others) | best(1));
        const auto found = ran(pipeline, problem, candidates, false);
        if (found.population.empty())
            return {};
        const auto& answer = found.population.front();
        const auto judged = rough::Judge(as_reported(setup())).of(answer.genome);
        std::vector<ga::Identity> parents(answer.parents.begin(), answer.parents.end());
        if (alone)
            parents = {answer.identity};
        json row{{"target", target_->name},
                 {"stored", stored_.size()},
                 {"variant", variant},
                 {"best_child", way.best_child},
                 {"similarity", judged.similarity},
                 {"similarity_worst", judged.worst()},
                 {"curves", static_cast<long>(stored_.size()) + way.curves + found.counters.evaluations +
                                found.counters.gradients + responses->curves()},
                 {"seconds", clock.seconds()}};
        if (!alone)
            row.update({{"U1", way.u1},
                        {"U2", way.u2},
                        {"U3", way.u1 * way.u2},
                        {"pairs_tried", way.pairs},
                        {"given_up", way.given_up}});
        for (std::size_t i = 0; i < parents.size(); ++i)
            row["parent" + std::to_string(i + 1)] = parents[i];
        return row;
    }

    Population three_best(Way& way) const {
        const auto order = good_in(&Scores::all);
        Population population;
        for (std::size_t i = 0; i < std::min(refined, order.size()); ++i)
            population.push_back({genome(order[i]), order[i], {}, {}, nullptr});
        way.best_child = stored_[order.front()].scores.all;
        return population;
    }

    /// Pairs in blocks, each screened against the three best before it.
    Population best_children(bool reduce, const rough::Vocabulary& words, const rough::DesignProblem& problem,
                             Way& way) const {
        auto low = good_in(&Scores::low), high = good_in(&Scores::high);
        way.u1 = low.size(), way.u2 = high.size();
        cut(low, high);
        const auto parents_of = [&](const std::vector<std::uint64_t>& numbers) {
            std::vector<Genome> parents(numbers.size());
            ga::parallel_for(numbers.size(), conditions_.origin.threads, [&](std::size_t i) {
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
            way.curves += found.counters.evaluations + found.counters.given_up;
            way.given_up += found.counters.given_up;
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
                ++way.pairs;
                if (population.size() >= block)
                    screen();
            }
        screen();
        if (!population.empty())
            way.best_child = population.front().value();
        return population;
    }

    static Genome reduced_by(const rough::Vocabulary& words, const Genome& genome) {
        return reduced(genome, (*words.rule)(genome));
    }

    json searched(std::uint64_t seed) const {
        rough::DesignSetup free;
        free.model = model_;
        free.targets = {*target_};
        free.max_pressure = max_pressure_;
        rough::SearchOptions options;
        options.seed = seed;
        options.threads = conditions_.origin.threads;
        options.evaluations = budget_;
        options.stop = &conditions_.stop;
        std::vector<std::pair<double, double>> course;
        static const ga::Name similarity("similarity");
        const auto watch = [&](const ga::Event<Genome>& event) {
            double most = course.empty() ? -HUGE_VAL : course.back().second;
            for (const auto& one : event.population)
                if (one.fitness.known(similarity) && !one.fitness.has_failed())
                    most = std::max(most, one.fitness.value());
            const auto paid = static_cast<double>(event.counters.evaluations + event.counters.gradients);
            if (std::isfinite(most))
                course.emplace_back(std::max(1., paid), most);
        };
        const double worst = rough::search(free, options, {watch}).best.judged();
        return {{"seed", seed}, {"best", course}, {"worst", worst}};
    }

    const Conditions& conditions_;
    rough::Model model_;
    double max_pressure_;
    std::uint64_t most_pairs_;
    long seeds_, budget_;
    rough::GenomeLaw law_;
    std::vector<std::uint64_t> sizes_;
    std::vector<GrowthTarget> targets_;
    const rough::Target* target_ = nullptr; ///< at hand
    std::vector<Stored> stored_;            ///< scored on it
};

Findings run_growth(const Settings& settings, const Conditions& conditions) {
    const std::vector<GrowthTarget> targets = GrowthTrial(settings, conditions).run();
    if (targets.front().grown.empty())
        return {};
    Csv grown("target,stored,variant,U1,U2,U3,pairs_tried,given_up,best_child,similarity,similarity_worst,"
              "parent1,parent2,curves,seconds"),
        courses("target,seed,curves,similarity");
    for (const GrowthTarget& target : targets) {
        for (const json& row : target.grown)
            grown.add(row);
        for (const json& course : target.searched)
            for (const json& point : course.at("best"))
                courses.row(target.target.name, course.at("seed").get<long>(), point[0].get<double>(),
                            point[1].get<double>());
    }
    return findings_of(conditions, "What a larger database is worth",
                       {.words = growth_words(targets),
                        .tables = {{"growth.csv", "rows", grown}, {"default.csv", "", courses}}},
                       [targets](Page& page) { fill_growth_page(page, targets); });
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
            .run = run_growth,
            .resumes = true};
}

} // namespace app
