#include "domain/design/search.hpp"

#include "domain/design/pipelines.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/errors.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/json.hpp"
#include "ga/base/stopwatch.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/hall_of_fame.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rough {

namespace {

constexpr std::size_t remembered = 60; ///< best individuals of all stages
constexpr std::size_t shown_compromises = 24;
/// Of an area's answers, those of the pipeline that are verified.
constexpr std::size_t verified_on_area = 2;
/// Draws of noise under which answers are compared.
constexpr int compared_draws = 200;

/// Whether answers are compared by what survives the set-up's errors. Of an area that takes too long.
bool chooses_by_errors(const DesignSetup& setup) { return setup.errors.any() && !setup.model.grid.is_2d(); }

/// The set-up whose contact solutions end after so many seconds from now, or when `stop` asks for it
/// (ContactOptions::stop), on an area, where a curve may take long. A line's as it is given.
DesignSetup ending(DesignSetup setup, double seconds, const std::atomic<bool>* stop) {
    if (setup.model.grid.is_2d())
        setup.model.contact.stop = [watch = ga::Watch({std::numeric_limits<long>::max(), seconds, stop})] {
            return watch.expired();
        };
    return setup;
}

/// What verifying is given.
struct Verifying {
    std::size_t answers;      ///< of the pipeline, and of the best of its way on a line
    std::size_t alternatives; ///< that are returned
    double seconds = 0;       ///< kept back for it
};

/// Within a search's seconds, as the curve of a start tells: verifying one answer takes so many curves of the
/// own grid, with some to spare, and two threads at most share it.
Verifying verifying_within(const DesignSetup& setup, const SearchOptions& options) {
    constexpr double most = 0.75, share_to_look = 0.1;
    const double curves = 80 + (chooses_by_errors(setup) ? compared_draws : 0);
    const bool area = setup.model.grid.is_2d();
    Verifying plan{area ? std::min(verified_on_area, options.verifying) : options.verifying,
                   options.alternatives};
    if (std::isinf(options.seconds))
        return plan;
    const Genome start =
        options.starts.empty() ? shaped_start(setup, ga::Stream(options.seed)) : options.starts.front();
    const DesignSetup timed = ending(setup, share_to_look * options.seconds, options.stop);
    const ga::Stopwatch clock;
    double curve = 0;
    try {
        respond(timed, start, timed.model);
        curve = clock.seconds();
    } catch (const NotConverged&) {
        curve = is_stopped(timed.model.contact) ? HUGE_VAL : clock.seconds();
    } catch (const InputError&) { // the start has no curve, which takes as long to find
        curve = clock.seconds();
    }
    const double each = curves * curve / std::min(ga::thread_count(options.threads), 2);
    const auto needed = [&] {
        return each * static_cast<double>((area ? 1 : 2) * plan.answers + plan.alternatives - 1);
    };
    if (needed() > most * options.seconds)
        plan.answers = plan.alternatives = 1;
    // Where there is no time to verify even one, its own curve is solved in any case.
    plan.seconds = needed() <= most * options.seconds ? needed() : std::isinf(curve) ? 0 : 2 * curve;
    return plan;
}

/// Verifies answers; what the search has verified is not done again.
class AnswerVerifier {
  public:
    AnswerVerifier(const DesignProblem& problem, const DesignSetup& reported, int threads)
        : problem_(problem), verifier_(reported, ga::thread_count(threads)),
          threads_(ga::thread_count(threads)) {}
    std::vector<Answer> operator()(const std::vector<Genome>& genomes) const {
        std::vector<Answer> answers(genomes.size());
        ga::parallel_for(answers.size(), threads_, [&](std::size_t i) {
            auto verification = problem_.verifier().known(genomes[i]);
            answers[i] = verified_answer(verifier_.setup(), genomes[i],
                                         verification ? std::move(*verification) : verifier_.of(genomes[i]));
            if (answers[i].is_verified() && chooses_by_errors(verifier_.setup()))
                answers[i].similarity_made = similarity_when_made(
                    verifier_.setup(), answers[i].genome,
                    {.seed = ga::fold(0, "compared draws"), .threads = 1}, compared_draws);
        });
        return answers;
    }

  private:
    const DesignProblem& problem_;
    Verifier verifier_;
    int threads_;
};

/// The best answer, then the best of the way and of the pipeline's answers that differ from it and from each
/// other.
std::vector<Answer> alternatives(const Grid& grid, const AnswerVerifier& verified, const Answer& best,
                                 const ga::Population<Genome>& seen, std::size_t most) {
    std::vector<Profile> profiles{sample(best.genome, grid)};
    std::vector<Genome> others;
    std::vector<double> differences;
    for (const auto& kept : seen) {
        if (1 + others.size() >= most || kept.value() < -1)
            break;
        const Profile profile = sample(kept.genome, grid);
        double least = 2;
        for (const Profile& other : profiles)
            least = std::min(least, difference(profile, other));
        if (least < different)
            continue;
        others.push_back(kept.genome);
        differences.push_back(least);
        profiles.push_back(profile);
    }
    std::vector<Answer> all = verified(others);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].difference = differences[i];
    all.insert(all.begin(), best);
    return all;
}

/// What the pipeline gave and the best that it verified; on a line also the best of all stages by similarity,
/// and the first start that was given. Each once.
std::vector<Genome> candidates_of(const DesignProblem& problem, const ga::Population<Genome>& population,
                                  const ga::Population<Genome>& verified, const ga::Population<Genome>& seen,
                                  const SearchOptions& options, std::size_t most) {
    std::vector<Genome> candidates;
    std::set<std::string> keys;
    const auto consider = [&](const Genome& genome) {
        if (keys.insert(problem.key(genome)).second)
            candidates.push_back(genome);
    };
    for (std::size_t i = 0; i < std::min(population.size(), most); ++i)
        consider(population[i].genome);
    for (std::size_t i = 0; i < std::min(verified.size(), most); ++i)
        consider(verified[i].genome);
    const bool area = problem.setup().model.grid.is_2d();
    for (std::size_t i = 0; i < seen.size() && (area ? candidates.empty() : i < most); ++i)
        consider(seen[i].genome);
    if (!options.starts.empty() && !area) // the nearest of those given: what is found is no worse
        consider(options.starts.front());
    return candidates;
}

bool better(const Answer& a, const Answer& b) {
    const auto rank = [](const Answer& one) { // what is not verified is after what is
        return std::tuple(one.within_limits, one.is_verified() ? one.lowest() : -HUGE_VAL,
                          one.is_verified() ? 0 : one.similarity);
    };
    return rank(a) > rank(b);
}

/// Of verified answers those of which none is better with and without errors, by falling similarity without.
std::vector<Answer> best_with_and_without(std::vector<Answer> answers) {
    std::sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
        return std::pair(a.similarity, a.similarity_made) > std::pair(b.similarity, b.similarity_made);
    });
    std::vector<Answer> front;
    for (Answer& answer : answers)
        if (front.empty() || answer.similarity_made > front.back().similarity_made)
            front.push_back(std::move(answer));
    return front;
}

/// Remarks on what an answer's similarities rest on.
std::vector<std::string> remarks_on(const Answer& best, const SearchOptions& options) {
    std::vector<std::string> notes;
    if (!best.is_verified() && !(options.stop && options.stop->load()))
        notes.push_back("there was no time to verify the answer on this grid and the finer one");
    if (const double off = best.verification.reading_error; off > 0 && best.is_verified())
        notes.push_back(line_of("of the finer grid's load steps some are read between solved ones; "
                                "similarity_worst is lower by what that is off by on the own grid, ",
                                off));
    return notes;
}

} // namespace

Answer verified_answer(const DesignSetup& reported, const Genome& genome, Verification verified) {
    DesignSetup setup = reported;
    setup.model.contact.stop = {};
    Answer answer{genome};
    if (std::isnan(verified.worst())) {
        if (verified.on_own.empty()) {
            verified.on_own = pressed(setup, genome, refined(setup.model, 1));
            verified.misfits[0] = misfits_of(setup, scored(setup, verified.on_own));
            verified.similarity = least_similarity(verified.misfits[0]);
        }
        if (setup.max_pressure)
            answer.genome.scale = eq_11(setup, verified.on_own.front());
    } else {
        answer.genome = in_final_form(setup, genome);
    }
    answer.genome = folded(answer.genome);
    answer.similarity = verified.similarity;
    answer.similarity_refined = verified.refined;
    answer.similarity_stepped = verified.stepped;
    answer.similarity_worst = verified.worst();
    answer.within_limits = holds_limits(setup, answer.genome);
    answer.verification = std::move(verified);
    return answer;
}

Answer verified_answer(const DesignSetup& reported, const Genome& genome) {
    return verified_answer(reported, genome, Verifier(reported).of(genome));
}

DesignResponse response_of(const DesignSetup& setup, const Answer& answer) {
    return answer.is_verified() ? respond(setup, answer.genome, setup.model)
                                : scored(setup, answer.verification.on_own);
}

bool holds_limits(const DesignSetup& setup, const Genome& genome) {
    const auto all = margins(genome, setup.model.grid, setup.limits);
    return std::all_of(all.begin(), all.end(), [](const Margin& margin) { return margin.holds(); });
}

void expect_searchable(const DesignSetup& given, const std::string& way) {
    const DesignSetup setup = completed(given);
    ga::check(design_pipeline(setup, way), DesignProblem(setup), ga::population(std::vector<Genome>(1)));
}

SearchResult search(const DesignSetup& given, const SearchOptions& asked,
                    std::vector<ga::Observer<Genome>> observers) {
    const ga::Stopwatch clock;
    SearchResult result;
    const DesignSetup setup = result.setup = completed(given);
    validate(setup);
    SearchOptions options = asked;
    for (Genome& genome : options.starts)
        genome = fitting_grid(setup, genome);
    const std::string text = options.pipeline.empty() ? usual_variant(setup) : options.pipeline;
    const Pipeline pipeline = design_pipeline(setup, text);
    result.name = design_variants().count(text) ? text : "pipeline";
    result.pipeline = pipeline.text();
    if (!options.starts.empty() && pipeline.begins())
        throw InputError("design: the pipeline '" + result.pipeline +
                         "' makes its own starts, expected one that begins with those given (score | ...)");
    const Verifying plan = verifying_within(setup, options);
    const double left = options.seconds - clock.seconds();
    const double for_pipeline = std::max(0.0, left - plan.seconds);
    const DesignProblem problem(ending(setup, for_pipeline, options.stop), options.memory,
                                ga::thread_count(options.threads));
    const DesignSetup reported = as_reported(ending(setup, left, options.stop));
    const auto any_start = [&] {
        return options.starts.empty() ? shaped_start(setup, ga::Stream(options.seed))
                                      : options.starts.front();
    };

    ga::HallOfFame<DesignProblem> seen(problem, remembered);
    ga::HallOfFame<DesignProblem> verified_so_far(problem, options.verifying,
                                                  chooses_by_errors(setup) ? "made" : "verified");
    std::vector<Genome> front;     // the last that was ranked
    std::optional<Genome> nearest; // the best under a derived problem
    observers.insert(observers.begin(), seen.observer());
    observers.insert(observers.begin(), verified_so_far.observer());
    observers.insert(observers.begin(), [&](const ga::Event<Genome>& event) {
        if (event.derived && ga::comparable(event.population) && !event.population.empty())
            nearest = ga::best_of(event.population, 1).front().genome;
        if (event.derived)
            return;
        if (auto ranked = genomes_on_front(event.population); !ranked.empty())
            front = std::move(ranked);
    });

    ga::RunOptions run;
    run.variant = result.name;
    run.seed = options.seed;
    run.threads = options.threads;
    run.budget = {options.evaluations, for_pipeline, options.stop};
    std::optional<ga::Checkpoints<DesignProblem>> keeper;
    if (options.keeping) {
        keeper.emplace(options.keeping->file, json_text(description(setup), true), options.keeping->resume,
                       options.keeping->interval);
        keeper->keep("seen", seen.members);
        keeper->keep("verified", verified_so_far.members);
        keeper->keep("front", front);
        if (options.keeping->also)
            options.keeping->also(*keeper);
    }
    ga::Population<Genome> population;
    try {
        const std::vector<Genome> starts = !options.starts.empty() ? options.starts
                                           : pipeline.begins()     ? std::vector<Genome>{any_start()}
                                                                   : database_starts(setup, options.threads);
        ga::OnThreads<DesignProblem> on_threads(options.threads);
        auto found = ga::run_by(options.evaluator ? *options.evaluator : on_threads, pipeline, problem,
                                ga::population(starts), run, observers, keeper ? &*keeper : nullptr);
        for (const auto& individual : found.population)
            seen.offer(individual);
        if (found.best)
            seen.offer(*found.best);
        population = std::move(found.population);
        result.counters = found.counters;
        result.notes = found.notes;
        result.stopped = found.stopped;
    } catch (const ga::NothingLeft& nothing) {
        if (seen.members.empty())
            throw NotConverged(nothing.what());
        result.notes.push_back(nothing.what());
    }
    if (!front.empty()) {
        for (const auto& kept : seen.members)
            front.push_back(kept.genome);
        result.front = compromises(reported, front, shown_compromises, options.threads);
    }
    const auto offer = [&](const Genome& genome, double similarity) {
        seen.offer({genome, 0, {}, ga::Fitness(ga::Name("similarity"), similarity), nullptr});
    };
    for (const Compromise& one : result.front)
        offer(one.genome, *std::min_element(one.similarity.begin(), one.similarity.end()));
    if (seen.members.empty()) // stopped before the first curve on the own grid
        offer(nearest ? *nearest : any_start(), 0);

    const AnswerVerifier verified(problem, reported, options.threads);
    const std::vector<Answer> answers = verified(
        candidates_of(problem, population, verified_so_far.members, seen.members, options, plan.answers));
    result.best = *std::max_element(answers.begin(), answers.end(),
                                    [](const Answer& a, const Answer& b) { return better(b, a); });
    if (chooses_by_errors(setup))
        result.made = best_with_and_without(answers);
    result.alternatives =
        alternatives(setup.model.grid, verified, result.best, seen.members, plan.alternatives);
    for (std::string& note : remarks_on(result.best, options))
        result.notes.push_back(std::move(note));
    return result;
}

} // namespace rough
