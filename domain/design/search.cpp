#include "domain/design/search.hpp"

#include "domain/design/aimed_again.hpp"
#include "domain/design/archive.hpp"
#include "domain/design/coarse_to_fine.hpp"
#include "domain/design/judging.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/within_limits.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/problem/harmonics.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/json.hpp"
#include "ga/checkpoint.hpp"
#include "ga/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rough {

namespace {

constexpr std::size_t remembered = 60; ///< individuals an archive keeps

/// How often a pipeline that makes its own starts is begun for a similarity that is asked for.
constexpr int attempts = 8;
/// Share of the time that is kept for bringing an answer within the limits.
constexpr double share_for_limits = 0.1;
constexpr std::size_t shown_compromises = 24;

/// So often the steps may be refined, and the way to go on from what was found in coarser ones.
constexpr int most_refinements = 2;
const char* const settling =
    "score | best 3 | refine lm 16 sharpen=8 | score stepped | refine lm 30 sharpen=5";
/// The way to go on with a scan's own waves, while there is time.
const char* const going_on =
    "score judged | until fitness 0.99 generations 1000 { parents | mutate 0.1 gaussian "
    "0.003 | score judged | refine lm 10 sharpen=1 | plus 2 }";
/// Share of the time for the first search, where another may follow; the least that one is begun for.
constexpr double first_share = 0.5, least_share = 0.05;

std::vector<Answer> answers_of(const Judge& judge, const std::vector<Genome>& genomes, int threads) {
    std::vector<Answer> answers(genomes.size());
    ga::parallel_for(answers.size(), ga::thread_count(threads),
                     [&](std::size_t i) { answers[i] = judged_answer(judge, genomes[i]); });
    return answers;
}

/// The best answer, then the best of the way and of the pipeline's answers that differ from it and from each
/// other.
std::vector<Answer> alternatives(const DesignProblem& problem, const Judge& judge, const DesignSetup& setup,
                                 const Answer& best, const Archive& found,
                                 const ga::Population<Genome>& population, const SearchOptions& options) {
    Archive archive(found.best.size() + population.size());
    archive.best = found.best;
    for (const auto& individual : population)
        archive.offer(problem, individual);
    std::vector<Profile> profiles{sample(best.genome, setup.model.grid)};
    std::vector<Genome> others;
    std::vector<double> differences;
    for (const auto& kept : archive.best) {
        if (1 + others.size() >= options.alternatives || kept.value < -1)
            break;
        const Profile profile = sample(kept.genome, setup.model.grid);
        double least = 2;
        for (const Profile& other : profiles)
            least = std::min(least, difference(profile, other));
        if (least < different)
            continue;
        others.push_back(kept.genome);
        differences.push_back(least);
        profiles.push_back(profile);
    }
    std::vector<Answer> all = answers_of(judge, others, options.threads);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].difference = differences[i];
    all.insert(all.begin(), best);
    return all;
}

/// What the pipeline gave, and the best of its way, each once; at most `compared` of either; the first start
/// that was given.
std::vector<Genome> candidates_of(const DesignProblem& problem, const ga::Population<Genome>& population,
                                  const Archive& archive, const SearchOptions& options) {
    if (problem.setup().model.grid.is_area()) // judging takes longer than searching
        return {archive.best.front().genome};
    std::vector<Genome> candidates;
    std::set<std::string> keys;
    const auto consider = [&](const Genome& genome) {
        if (keys.insert(problem.key(genome)).second)
            candidates.push_back(genome);
    };
    const std::size_t most = options.compared;
    for (std::size_t i = 0; i < std::min(population.size(), most); ++i)
        consider(population[i].genome);
    for (std::size_t i = 0; i < std::min(archive.best.size(), most); ++i)
        consider(archive.best[i].genome);
    if (!options.starts.empty()) // the nearest of those given: what is found is no worse
        consider(options.starts.front());
    return candidates;
}

/// A line that wraps takes waves that repeat; an area moves those of any genome to its lattice.
bool takes_harmonics(const DesignSetup& setup) {
    return setup.model.grid.wraps && !setup.model.grid.is_area() && !setup.phases;
}

std::vector<Genome> database_for(const DesignSetup& setup, int threads) {
    DatabaseLayout layout;
    layout.lambda = std::clamp(setup.model.grid.length, setup.bounds.lambda_from, setup.bounds.lambda_to);
    layout.H_from = std::clamp(layout.H_from, setup.bounds.H_from, setup.bounds.H_to);
    layout.H_to = std::clamp(layout.H_to, setup.bounds.H_from, setup.bounds.H_to);
    layout.gamma_from = std::clamp(layout.gamma_from, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.gamma_to = std::clamp(layout.gamma_to, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.shortest = setup.limits.shortest_wave;
    layout.ridges = setup.ridges;
    std::vector<Genome> genomes = sobol_database(layout);
    ga::parallel_for(genomes.size(), ga::thread_count(threads), [&](std::size_t i) {
        if (takes_harmonics(setup))
            genomes[i] = in_harmonics(genomes[i], setup.model.grid.length);
        genomes[i] = with_fitting_amplitude(setup, genomes[i]);
    });
    return genomes;
}

bool makes_its_own_starts(const std::string& pipeline) {
    const std::string begun = "restarts " + std::to_string(attempts) + " { ";
    auto first = pipeline.find_first_not_of(" \t\n");
    if (pipeline.compare(first, begun.size(), begun) == 0)
        first += begun.size();
    for (const std::string word : {"shape ", "sample ", "own "})
        if (pipeline.compare(first, word.size(), word) == 0)
            return true;
    return false;
}

bool better(const Answer& a, const Answer& b) {
    const auto rank = [](const Answer& one) { // what is not judged is after what is
        return std::tuple(one.within_limits, one.is_judged() ? one.judged() : -HUGE_VAL,
                          one.is_judged() ? 0 : one.similarity);
    };
    return rank(a) > rank(b);
}

/// One run of a pipeline whose paths begin with `name`; of its seconds so many are kept back.
SearchResult searched_once(const DesignSetup& given, const SearchOptions& asked, const std::string& name,
                           std::vector<ga::Observer<Genome>> observers, double kept_back) {
    const DesignSetup setup = completed(given);
    const DesignProblem problem(ending(setup, asked.seconds - kept_back, asked.stop), asked.memory);
    const DesignSetup reported = as_reported(ending(setup, asked.seconds, asked.stop));
    const Judge judge(reported, ga::thread_count(asked.threads));
    SearchOptions options = asked;
    if (takes_harmonics(setup))
        for (Genome& genome : options.starts)
            genome = in_harmonics(genome, setup.model.grid.length);
    auto stage = options.pipeline.empty() ? design_variant(setup, options.variant)
                                          : design_pipeline(setup, options.pipeline);
    if (options.reach && makes_its_own_starts(stage.text()))
        stage = design_pipeline(setup, "restarts " + std::to_string(attempts) + " { " + stage.text() + " }");

    Archive archive(remembered);
    std::vector<Genome> front; // the last that was ranked
    double judged_from = options.reach.value_or(0);
    observers.insert(observers.begin(), [&](const ga::Event<Genome>& event) {
        for (const auto& individual : event.population)
            archive.offer(problem, individual);
        if (auto ranked = genomes_on_front(event.population); !ranked.empty())
            front = std::move(ranked);
        if (!options.reach || archive.best.empty() || archive.best.front().value < judged_from ||
            setup.model.grid.is_area())
            return;
        const Answer best = judged_answer(judge, archive.best.front().genome);
        // Where steps may be refined, that is done from what is met in these.
        const double reached =
            options.settles_steps ? std::min(best.similarity, best.similarity_refined) : best.judged();
        if (best.within_limits && reached >= *options.reach)
            throw ga::Stopped{"the similarity asked for was reached"};
        judged_from = std::nextafter(archive.best.front().value, 2.0); // the same one would tell nothing new
    });

    ga::RunOptions run;
    run.variant = name;
    run.seed = options.seed;
    run.threads = options.threads;
    run.budget = {options.evaluations, std::max(0.0, options.seconds - kept_back), options.stop};
    if (setup.limits.any_shape())
        run.budget.seconds *= 1 - share_for_limits;
    const std::string text = stage.text();
    if (!options.starts.empty() && makes_its_own_starts(text))
        throw InputError("design: the pipeline '" + text +
                         "' makes its own starts, expected one that begins with those given (score | ...)");
    std::optional<ga::Checkpoints<DesignProblem>> keeper;
    if (options.keeping) {
        keeper.emplace(options.keeping->file, json_text(description(setup), true), options.keeping->resume,
                       options.keeping->interval);
        keeper->keep("archive", archive.best);
        keeper->keep("front", front);
        if (options.keeping->also)
            options.keeping->also(*keeper);
    }
    SearchResult result;
    ga::Population<Genome> population;
    result.pipeline = text;
    try {
        const std::vector<Genome> starts =
            !options.starts.empty()      ? options.starts
            : makes_its_own_starts(text) ? std::vector<Genome>{shaped_start(setup, ga::Stream(options.seed))}
                                         : database_for(setup, options.threads);
        ga::OnThreads<DesignProblem> on_threads(options.threads);
        auto found = ga::run_by(options.evaluator ? *options.evaluator : on_threads, stage, problem,
                                ga::population(starts), run, observers, keeper ? &*keeper : nullptr);
        for (const auto& individual : found.population)
            archive.offer(problem, individual);
        if (found.best)
            archive.offer(problem, *found.best);
        population = std::move(found.population);
        result.counters = found.counters;
        result.notes = found.notes;
        result.stopped = found.stopped;
    } catch (const ga::NothingLeft& nothing) {
        if (archive.best.empty())
            throw NotConverged(nothing.what());
        result.notes.push_back(nothing.what());
    }
    if (!front.empty()) {
        for (const auto& kept : archive.best)
            front.push_back(kept.genome);
        result.front = compromises(reported, front, shown_compromises, options.threads);
    }
    const ga::Name by_similarity("similarity");
    for (const Compromise& one : result.front)
        archive.offer(problem, {one.genome,
                                0,
                                {},
                                ga::Fitness(by_similarity,
                                            *std::min_element(one.similarity.begin(), one.similarity.end())),
                                nullptr});
    if (archive.best.empty()) // stopped before the first curve
        archive.offer(problem, {options.starts.empty() ? shaped_start(setup, ga::Stream(options.seed))
                                                       : options.starts.front(),
                                0,
                                {},
                                ga::Fitness(by_similarity, 0),
                                nullptr});

    const std::vector<Genome> candidates = candidates_of(problem, population, archive, options);
    std::vector<Answer> answers = answers_of(judge, candidates, options.threads);
    if (std::none_of(answers.begin(), answers.end(), [](const Answer& a) { return a.within_limits; }) &&
        !is_stopped(reported.model.contact)) {
        run.budget = {std::numeric_limits<long>::max(), share_for_limits * options.seconds, options.stop};
        const DesignProblem last(ending(setup, asked.seconds, asked.stop), asked.memory);
        if (const auto genome = brought_within(last, candidates, run, result.counters)) {
            answers.push_back(judged_answer(judge, *genome));
            result.notes.push_back("no answer of the pipeline held every limit; one was brought within them, "
                                   "without its shortest waves where these were at fault");
        }
    }
    result.best = *std::max_element(answers.begin(), answers.end(),
                                    [](const Answer& a, const Answer& b) { return better(b, a); });
    result.alternatives = alternatives(problem, judge, reported, result.best, archive, population, options);
    result.setup = setup;
    return result;
}

/// By how much an answer's similarity falls from the set-up's load steps to four times as many.
double fall(const Answer& best) { return std::min(best.similarity, best.similarity_refined) - best.judged(); }

/// The earlier result with what a later search found and took. One in finer steps replaces it: it has
/// judged the earlier answers anew.
SearchResult joined(SearchResult earlier, SearchResult later, bool finer) {
    later.counters = sum(earlier.counters, later.counters);
    later.notes.insert(later.notes.begin(), earlier.notes.begin(), earlier.notes.end());
    later.pipeline = earlier.pipeline + "\n" + later.pipeline;
    if (!finer && !better(later.best, earlier.best)) {
        later.best = earlier.best;
        later.alternatives = earlier.alternatives;
        later.setup = earlier.setup;
    }
    return later;
}

/// What another search may take of the budget.
void take_what_is_left(SearchOptions& next, const SearchOptions& whole, const SearchResult& result,
                       double spent) {
    next.keeping.reset();
    next.seconds = whole.seconds - spent;
    next.evaluations = whole.evaluations - result.counters.asked;
}

/// By coarser grids, then with the errors of the grid and the steps allowed for.
SearchResult searched_by_grids(const DesignSetup& setup, const SearchOptions& options,
                               const std::string& name, const std::vector<ga::Observer<Genome>>& observers,
                               double kept_back) {
    const ga::Stopwatch clock;
    ga::RunOptions run;
    run.variant = name;
    run.seed = options.seed;
    run.threads = options.threads;
    run.budget = {options.evaluations, std::max(0.0, options.seconds - kept_back), options.stop};
    CoarseToFine found{options.starts, {}, ""};
    if (found.starts.empty())
        found = coarse_to_fine(ending(setup, run.budget.seconds, options.stop), run, observers);
    if (found.starts.empty()) // stopped before the first curve
        found.starts = {shaped_start(setup, ga::Stream(options.seed))};
    const double begun = clock.seconds();
    SearchOptions last = options;
    last.starts = found.starts;
    last.pipeline = on_own_grid;
    last.seconds = std::max(0.0, options.seconds - begun);
    last.evaluations = std::max(1L, options.evaluations - found.counters.asked);
    SearchResult result = searched_once(setup, last, name, observers, kept_back);
    result.counters = sum(found.counters, result.counters);
    result.pipeline = found.pipeline + result.pipeline;
    // A round takes about as long as the search and the judgement before it.
    SearchOptions rest = options;
    take_what_is_left(rest, options, result, clock.seconds());
    return aimed_again(std::move(result), rest, name, observers, options.reach.value_or(worth_the_name),
                       clock.seconds() - begun);
}

/// With a remark on what similarity_worst rests on, where it is read between load steps.
SearchResult with_reading_error(SearchResult result) {
    if (const double off = result.best.judgement.reading_error; off > 0 && result.best.is_judged())
        result.notes.push_back(line_of("of the finer grid's load steps some are read between solved ones; "
                                       "similarity_worst is lower by what that is off by on the own grid, ",
                                       off));
    return result;
}

/// An area's search, with time kept back for judging.
SearchResult searched_area(const DesignSetup& given, const SearchOptions& options, const std::string& name,
                           const std::vector<ga::Observer<Genome>>& observers) {
    const ga::Stopwatch clock;
    const DesignSetup setup = completed(given);
    validate(setup);
    const double curve = std::isfinite(options.seconds) ? time_of_curve(setup, options) : 0,
                 judging = curve * curves_to_judge(options.threads);
    SearchOptions left = options;
    left.seconds = std::max(0.0, options.seconds - clock.seconds());
    const double most = most_for_judging * left.seconds;
    if (judging * static_cast<double>(left.alternatives) > most)
        left.alternatives = 1;
    double kept_back = judging * static_cast<double>(std::max<std::size_t>(1, left.alternatives));
    if (kept_back > most) // the answer's own curve is solved in any case
        kept_back = std::isinf(curve) ? 0 : 2 * curve;
    SearchResult result = name == "default" ? searched_by_grids(setup, left, name, observers, kept_back)
                                            : searched_once(setup, left, name, observers, kept_back);
    if (!result.best.is_judged() && !(options.stop && options.stop->load()))
        result.notes.push_back("judging takes " +
                               (std::isinf(judging) ? std::string("far longer than all of the time")
                                                    : line_of("about ", std::ceil(judging), " s")) +
                               " on this grid and the finer one; there was no time for it");
    return with_reading_error(std::move(result));
}

} // namespace

void expect_searchable(const DesignSetup& given, const std::string& way) {
    const DesignSetup setup = completed(given);
    ga::check(design_pipeline(setup, way), DesignProblem(setup), ga::population(std::vector<Genome>(1)));
}

SearchResult search(const DesignSetup& given, const SearchOptions& options,
                    std::vector<ga::Observer<Genome>> observers) {
    const ga::Stopwatch clock;
    const std::string name = options.pipeline.empty() ? options.variant : "pipeline";
    const bool timed = std::isfinite(options.seconds);
    const bool budgeted = timed || options.evaluations < SearchOptions{}.evaluations;
    if (given.model.grid.is_area())
        return searched_area(given, options, name, observers);
    const bool makes_starts = name == "default" || name == "multistart";
    const bool goes_on = name == "like";
    const bool again = options.begins_anew && (makes_starts || goes_on) && budgeted;
    const bool settles = options.settles_steps && (makes_starts || name == "in-line") && !given.phases;
    SearchOptions first = options;
    first.settles_steps = settles;
    if (settles)
        first.pipeline = without_polish(name);
    if (timed && (again || settles))
        first.seconds *= first_share;
    // One search, in steps that settle aimed again; not where more steps than these are needed.
    const auto searched = [&](const DesignSetup& setup, const SearchOptions& next, const std::string& path) {
        SearchResult result = searched_once(setup, next, path, observers, 0);
        const double enough = options.reach.value_or(HUGE_VAL);
        if (!settles ||
            (next.settles_steps && fall(result.best) > 2 * settled && result.best.judged() < enough))
            return result;
        SearchOptions rest = options;
        take_what_is_left(rest, options, result, clock.seconds());
        return aimed_again(std::move(result), rest, path, observers, enough, 0);
    };
    SearchResult result = searched(given, first, name);
    int refinements = settles ? most_refinements : 0;
    for (int round = 2; refinements > 0 || again; ++round) {
        const Answer& best = result.best;
        SearchOptions next = first;
        take_what_is_left(next, options, result, clock.seconds());
        const bool spent = next.evaluations < 1 || (timed && next.seconds < least_share * options.seconds) ||
                           (options.stop && options.stop->load());
        if (spent)
            break;
        const bool enough = best.within_limits && best.judged() >= options.reach.value_or(worth_the_name);
        const bool reached = options.reach && enough;
        const bool unsettled = refinements > 0 && ((!reached && fall(best) > settled) || !is_confirmed(best));
        if (!unsettled && (enough || !again))
            break;
        DesignSetup setup = result.setup;
        if (unsettled || goes_on) {
            if (unsettled) {
                --refinements;
                setup = in_finer_steps(std::move(setup));
            }
            next.pipeline = unsettled ? settling : going_on;
            next.starts.clear();
            for (const Answer& answer : result.alternatives)
                next.starts.push_back(answer.genome);
        }
        next.settles_steps = refinements > 0;
        next.seed = ga::fold(options.seed, static_cast<std::uint64_t>(round));
        try {
            if (unsettled && timed) { // the answers are judged after the search, in so many times the steps
                const double judgements = static_cast<double>(2 * options.compared + options.alternatives);
                next.seconds -= judged_refinement * best.judgement.seconds * judgements /
                                ga::thread_count(options.threads);
                if (next.seconds < least_share * options.seconds)
                    break;
            }
            result = joined(std::move(result), searched(setup, next, name + "-" + std::to_string(round)),
                            unsettled);
        } catch (const NotConverged& nothing) {
            result.notes.push_back(nothing.what());
            break;
        }
    }
    return with_reading_error(std::move(result));
}

} // namespace rough
