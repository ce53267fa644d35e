#include "domain/design/search.hpp"

#include "domain/design/explore.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/errors.hpp"

template class ga::Checkpoints<rough::DesignProblem>;

namespace rough {
namespace {

constexpr std::size_t max_verified_on_map = 2; ///< answers of the pipeline
constexpr int compared_draws = 200;            ///< draws of noise under which answers are compared

/// Whether answers are compared by their similarity under the set-up's errors; too long on a map.
bool chooses_by_errors(const DesignSetup& setup) { return setup.errors.any() && !setup.model.grid.is_2d(); }

/// A map's set-up whose contact solutions end after this time or when `stop` is true; a line's as it is.
DesignSetup ending(DesignSetup setup, double seconds, const std::atomic<bool>* stop) {
    if (setup.model.grid.is_2d()) setup.model.contact.stop = ending_after(seconds, stop);
    return setup;
}

/// How many answers are verified, and the time for it.
struct VerificationPlan {
    std::size_t answers;      ///< final population; on a line, as many of the best of all stages
    std::size_t alternatives; ///< that are returned
    double seconds = 0;       ///< kept for verifying
};

Genome any_start(const DesignSetup& setup, const SearchOptions& options) {
    return options.starts.empty() ? shaped_start(setup, ga::Stream(options.seed)) : options.starts.front();
}

/// Plans the verification within the search's time from the time of one curve. One answer takes at most 80
/// curves on the search grid (and the draws of noise); at most two threads share the work.
VerificationPlan plan_verification(const DesignSetup& setup, const SearchOptions& options) {
    constexpr double max_share = 0.75, share_for_curve = 0.1;
    const double curves = 80 + (chooses_by_errors(setup) ? compared_draws : 0);
    const bool is_map = setup.model.grid.is_2d();
    VerificationPlan plan{is_map ? std::min(max_verified_on_map, options.verifying) : options.verifying,
                          options.alternatives};
    if (std::isinf(options.seconds)) return plan;
    const Genome start = any_start(setup, options);
    const DesignSetup timed = ending(setup, share_for_curve * options.seconds, options.stop);
    const ga::Stopwatch clock;
    double curve = 0;
    try {
        respond(timed, start, timed.model);
        curve = clock.seconds();
    } catch (const NotConverged&) {
        curve = is_stopped(timed.model.contact) ? HUGE_VAL : clock.seconds();
    } catch (const InputError&) { // the start has no curve; finding that takes as long
        curve = clock.seconds();
    }
    const double each = curves * curve / std::min(ga::thread_count(options.threads), 2);
    const auto needed = [&] {
        return each * static_cast<double>((is_map ? 1 : 2) * plan.answers + plan.alternatives - 1);
    };
    if (needed() > max_share * options.seconds) plan.answers = plan.alternatives = 1;
    // Without time to verify one answer, its curve on the search grid is still solved.
    plan.seconds = needed() <= max_share * options.seconds ? needed() : std::isinf(curve) ? 0 : 2 * curve;
    return plan;
}

/// Whether a genome in final amplitude keeps every limit.
bool holds_limits(const DesignSetup& setup, const Genome& genome) {
    return std::ranges::all_of(margins(genome, setup.model.grid, setup.limits), &Margin::holds);
}

/// The genomes to verify, without duplicates: at most `max_count` of each source of SearchOptions::verifying.
std::vector<Genome> candidates_of(const DesignProblem& problem, const ga::Population<Genome>& population,
                                  const ga::Population<Genome>& verified, const ga::Population<Genome>& seen,
                                  const SearchOptions& options, std::size_t max_count) {
    std::vector<Genome> candidates;
    std::set<std::string> keys;
    const auto consider = [&](const ga::Population<Genome>& best, std::size_t count) {
        for (std::size_t i = 0; i < std::min(best.size(), count); ++i)
            if (keys.insert(problem.key(best[i].genome)).second) candidates.push_back(best[i].genome);
    };
    consider(population, max_count);
    consider(verified, max_count);
    consider(seen, problem.setup().model.grid.is_2d() ? 1 : max_count);
    if (!options.starts.empty()) // the answer is not worse than the nearest start
        consider(ga::population(std::vector{options.starts.front()}), 1);
    return candidates;
}

/// Rank of an answer, higher is better; one that is not verified ranks below all that are.
std::tuple<bool, double, double> rank_of(const Answer& answer) {
    return answer.is_verified() ? std::tuple(answer.within_limits, answer.lowest(), 0.0)
                                : std::tuple(answer.within_limits, -HUGE_VAL, answer.similarity);
}

/// The Pareto front of the similarities with and without errors, by falling similarity without.
std::vector<Answer> best_with_and_without(std::vector<Answer> answers) {
    std::ranges::sort(answers, std::ranges::greater{},
                      [](const Answer& one) { return std::pair(one.similarity, one.similarity_made); });
    std::vector<Answer> front;
    for (Answer& answer : answers)
        if (front.empty() || answer.similarity_made > front.back().similarity_made) front.push_back(std::move(answer));
    return front;
}

/// The answer of a genome with this verification.
Answer answer_of(const DesignSetup& reported, const Genome& genome, Verification verified) {
    DesignSetup setup = reported;
    setup.model.contact.stop = {};
    Answer answer{std::move(verified), genome};
    if (answer.is_verified()) {
        answer.genome = in_final_form(setup, genome);
    } else {
        if (answer.on_grid.empty()) {
            answer.on_grid = responses_of(setup, genome, refined(setup.model, 1));
            answer.misfits[0] = misfits_of(setup, design_response(setup, answer.on_grid));
            answer.similarity = min_similarity(answer.misfits[0]);
        }
        if (setup.max_pressure) answer.genome.scale = eq_11(setup, answer.on_grid.front());
    }
    answer.genome = folded(answer.genome);
    answer.within_limits = holds_limits(setup, answer.genome);
    return answer;
}

} // namespace

Answer verified_answer(const DesignSetup& reported, const Genome& genome) {
    return answer_of(reported, genome, Verifier(reported).of(genome));
}

DesignSetup as_verified(const DesignSetup& given, const Answer& answer) {
    if (!answer.is_verified()) return given;
    constexpr double agreed = 0.01; // largest change of a misfit on joined cells
    const auto misfits_in = [&](const DesignSetup& setup) {
        const SurfaceWithErrors made(setup, answer.genome);
        try {
            return misfits_of(setup, made.response(Eigen::VectorXd::Zero(made.surface().nodes())));
        } catch (const std::exception&) { // e.g. full contact
            return std::vector<Eigen::VectorXd>();
        }
    };
    const double spacing = std::min(shortest_wave(answer.genome) * (1 + 1e-12) / 4, given.errors.noise_length);
    const auto own = misfits_in(given);
    if (own.empty()) return given;
    DesignSetup setup = given, joined = given;
    auto here = own;
    for (Grid& grid = joined.model.grid; grid.is_2d() && grid.nodes % 2 == 0 && grid.rows % 2 == 0;) {
        grid.nodes /= 2, grid.rows /= 2;
        if (grid.widest_spacing() > spacing) break;
        auto there = misfits_in(joined);
        bool agrees = !there.empty();
        for (std::size_t t = 0; agrees && t < own.size(); ++t)
            agrees = (there[t] - own[t]).cwiseAbs().maxCoeff() <= agreed;
        if (!agrees) break;
        setup = joined;
        here = std::move(there);
    }
    return corrected_targets(setup, here, answer.largest);
}

DesignResponse response_of(const DesignSetup& setup, const Answer& answer) {
    return answer.is_verified() ? respond(setup, answer.genome, setup.model) : design_response(setup, answer.on_grid);
}

std::vector<Compromise> compromises(const DesignSetup& given, const std::vector<Genome>& genomes, std::size_t max_count,
                                    int threads) {
    const DesignSetup setup = as_reported(given);
    const auto each = [&](std::vector<Compromise>& all, auto work) {
        ga::parallel_for(all.size(), ga::thread_count(threads), [&](std::size_t i) {
            try {
                work(all[i]);
            } catch (const NotConverged&) {
                if (!is_stopped(setup.model.contact)) throw;
            }
        });
    };
    std::vector<Compromise> all;
    for (const Genome& genome : genomes) all.push_back({genome, {}, {}});
    each(all, [&](Compromise& one) {
        const DesignResponse response = respond(setup, one.genome, setup.model);
        one.similarity = similarities(setup, response);
        if (setup.max_pressure) one.genome.scale = response.scale;
        one.genome = folded(one.genome);
    });
    std::erase_if(all,
                  [&](const Compromise& one) { return one.similarity.empty() || !holds_limits(setup, one.genome); });
    std::vector<ga::Point> points(all.size());
    std::ranges::transform(all, points.begin(), &Compromise::similarity);
    const std::vector<std::size_t> ranks = ga::pareto_ranks(points);
    std::vector<Compromise> front;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (ranks[i] == 0) front.push_back(all[i]);
    std::ranges::stable_sort(front, {}, &Compromise::similarity);
    const auto is_same = [](const Compromise& a, const Compromise& b) { return a.similarity == b.similarity; };
    front.erase(std::unique(front.begin(), front.end(), is_same), front.end());
    if (front.size() > max_count) {
        std::vector<Compromise> spread;
        for (std::size_t i = 0; i < max_count; ++i) spread.push_back(front[i * (front.size() - 1) / (max_count - 1)]);
        front = std::move(spread);
    }
    each(front, [&](Compromise& one) {
        one.similarity_refined.assign(setup.targets.size(), std::numeric_limits<double>::quiet_NaN());
        one.similarity_refined = similarities(setup, respond(setup, one.genome, refined(setup.model, 4)));
    });
    return front;
}

void expect_searchable(const DesignSetup& setup, const std::string& pipeline) {
    ga::check(design_pipeline(setup, pipeline), DesignProblem(setup), ga::population(std::vector<Genome>(1)));
}

SearchResult search(const DesignSetup& given, const SearchOptions& given_options,
                    std::vector<ga::Observer<Genome>> observers) {
    const ga::Stopwatch clock;
    validate(given);
    DesignSetup setup = given;
    setup.model.contact.threads = ga::thread_count(given_options.threads);
    SearchResult result;
    SearchOptions options = given_options;
    for (Genome& genome : options.starts) genome = fitting_grid(setup, genome);
    const std::string text = options.pipeline.empty() ? usual_variant(setup) : options.pipeline;
    const DesignPipeline pipeline = design_pipeline(setup, text);
    if (!options.starts.empty() && pipeline.begins())
        throw InputError("design: the pipeline '" + pipeline.text() +
                         "' makes its starts itself; use one that begins with the given ones (score | ...)");
    const VerificationPlan plan = plan_verification(setup, options);
    const int threads = ga::thread_count(options.threads);
    const double left = options.seconds - clock.seconds();
    const double for_pipeline = std::max(0.0, left - plan.seconds);
    const DesignProblem problem(ending(setup, for_pipeline, options.stop), options.memory, threads);
    const DesignSetup reported = as_reported(ending(setup, left, options.stop));

    Exploration<DesignProblem> explored(problem, options.verifying, chooses_by_errors(setup) ? "made" : "verified");
    const std::vector<Genome> starts = !options.starts.empty() ? options.starts
                                       : pipeline.begins()     ? std::vector<Genome>{any_start(setup, options)}
                                                               : database_starts(setup, options.threads);
    explored.run(pipeline, design_variants().count(text) ? text : "pipeline", starts, options, for_pipeline,
                 std::move(observers));
    const ga::Population<Genome>& seen = explored.seen.members;
    if (seen.empty() && !explored.nothing.empty()) throw NotConverged(explored.nothing);
    static_cast<SearchRun&>(result) = explored.spent;
    std::vector<Genome>& front = explored.front;
    if (!front.empty()) {
        for (const auto& kept : seen) front.push_back(kept.genome);
        result.front = compromises(reported, front, max_compromises, options.threads);
    }
    for (const Compromise& one : result.front) explored.offer(one.genome, std::ranges::min(one.similarity));
    if (seen.empty()) // stopped before the first curve on the search grid
        explored.offer(explored.nearest ? *explored.nearest : any_start(setup, options), 0);

    const Verifier verifier(reported, threads);
    const auto verified = [&](const Genome& genome) {
        auto known = problem.verifier().known(genome); // the search may have verified it
        Answer answer = answer_of(reported, genome, known ? std::move(*known) : verifier.of(genome));
        if (answer.is_verified() && chooses_by_errors(setup))
            answer.similarity_made =
                similarity_under_errors(reported, answer.genome,
                                        {.seed = ga::fold(0, "compared draws"), .threads = 1, .draws = compared_draws});
        return answer;
    };
    std::vector<Genome> candidates =
        candidates_of(problem, explored.population, explored.verified.members, seen, options, plan.answers);
    // A block on another grid or in other load steps that was stopped returned nothing.
    if (!explored.spent.stopped.empty() && explored.nearest) candidates.push_back(*explored.nearest);
    std::vector<Answer> answers(candidates.size());
    ga::parallel_for(answers.size(), threads, [&](std::size_t i) { answers[i] = verified(candidates[i]); });
    result.best = *std::ranges::max_element(answers, {}, rank_of);
    if (chooses_by_errors(setup)) result.made = best_with_and_without(answers);
    const auto others = explored.others_than(
        result.best.genome, plan.alternatives, different,
        [&](const Genome& genome) { return sample(genome, setup.model.grid); },
        [](const Profile& a, const Profile& b) { return difference(a, b); });
    result.alternatives.resize(1 + others.size());
    result.alternatives[0] = result.best;
    ga::parallel_for(others.size(), threads, [&](std::size_t i) {
        result.alternatives[i + 1] = verified(others[i].first);
        result.alternatives[i + 1].difference = others[i].second;
    });
    if (!result.best.is_verified() && !(options.stop && options.stop->load()))
        result.notes.push_back("the answer was not verified on this grid and the finer one, for lack of time");
    return result;
}

std::vector<std::string> doubts(const DesignSetup& setup) {
    constexpr double shown = 4;         // node spacings of a wave that a grid shows
    constexpr double nearly_full = 0.9; // contact fraction
    constexpr std::uint64_t starts = 4;
    const Grid& grid = setup.model.grid;
    std::vector<std::string> all;
    const double shortest = setup.limits.shortest_wave, spacing = grid.widest_spacing();
    if (!setup.phases && setup.bounds.lambda_to < shown * spacing * (1 - 1e-9))
        all.push_back(line_with_digits(4, "lambda-to: no wave has ", shown, " node spacings, ", shown * spacing,
                                       " mm, so the grid shows none; raise lambda-to, or give more nodes"));
    else if (!setup.phases && shortest < shown * spacing * (1 - 1e-9))
        all.push_back(line_with_digits(4, "shortest-wave: waves of ", shortest, " mm are ", shortest / spacing,
                                       " node spacings long, and the grid does not show those below ", shown,
                                       "; raise shortest-wave to ", shown * spacing, " mm, or give more nodes"));
    const Target& target = setup.targets.front();
    const auto& reach = setup.model.loading.reach;
    if (!setup.max_pressure || !reach) return all;
    double least = 1;
    std::uint64_t answered = 0;
    for (std::uint64_t i = 0; i < starts && least >= nearly_full; ++i) try {
            const ga::Stream random(ga::fold(0, "doubts") + i);
            const Genome start = i % 2 ? drawn_start(setup, random) : shaped_start(setup, random);
            least = std::min(least, respond(start, setup.model).contact_fraction.tail(1)[0]);
            ++answered;
        } catch (const std::exception&) { // a start without a response, or the set-up's stop
        }
    if (answered == starts && least >= nearly_full)
        all.push_back(line_with_digits(4, "max-pressure: its load step has nearly full contact, because it presses by ",
                                       *reach, " of the height range: at least ", 100 * least,
                                       " % of the nodes touch in ", starts,
                                       " starts; lower reach if the surface is to touch on less"));
    if (target.quantity == Quantity::stiffness) {
        double approach = 0, from = 0; // at least: K never falls, and is continued at its last value
        for (Index k = 0; k < target.points(); from = target.x[k++])
            approach += (target.x[k] - from) / (target.has_band() ? target.upper[k] : target.y[k]);
        const double range = approach / *reach, slope = setup.limits.max_slope * std::hypot(grid.length, grid.width),
                     highest = std::min(setup.limits.max_height, slope);
        if (!grid.periodic && range * setup.required_similarity > highest)
            all.push_back(line_with_digits(
                4, setup.limits.max_height <= slope ? "max-height" : "max-slope",
                ": no surface within it is near the target, whose stiffness needs an approach of ", approach,
                " mm and so heights of ", range, " mm at a reach of ", *reach, "; the limit allows ", highest, " mm"));
    }
    return all;
}

Unreachable unreachable(std::vector<OutOfReach> reasons, double required) {
    Unreachable found{std::move(reasons)};
    for (const OutOfReach& reason : found.reasons) found.bound = std::min(found.bound, reason.bound);
    if (found.bound >= required) found.reasons.clear();
    return found;
}

Unreachable unreachable(const DesignSetup& setup, double required) {
    return unreachable(out_of_reach(setup.targets, setup.model, setup.max_pressure), required);
}

} // namespace rough
