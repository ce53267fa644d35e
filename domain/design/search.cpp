#include "domain/design/search.hpp"

#include "domain/design/archive.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/within_limits.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/problem/stored.hpp"
#include "domain/text/json.hpp"
#include "ga/checkpoint.hpp"

#include <algorithm>
#include <set>

namespace rough {

namespace {

constexpr std::size_t remembered = 60; ///< individuals an archive keeps

/// How often a pipeline that makes its own starts is begun for a similarity that is asked for.
constexpr int attempts = 8;
/// Share of the time that is kept for bringing an answer within the limits.
constexpr double share_for_limits = 0.1;
constexpr std::size_t shown_compromises = 24;

Answer answer_of(const DesignSetup& searched, const Genome& genome) {
    const DesignSetup setup = as_reported(searched);
    Answer answer{folded(genome)};
    const DesignResponse coarse = respond(setup, genome, setup.model);
    if (setup.max_pressure) {
        answer.genome = genome;
        answer.genome.scale = coarse.scale;
        answer.genome = folded(answer.genome);
    }
    answer.similarity = similarity(setup, coarse);
    answer.similarity_refined = similarity(setup, genome, 4);
    answer.within_limits = holds_limits(setup, answer.genome);
    return answer;
}

std::vector<Answer> answers_of(const DesignSetup& setup, const std::vector<Genome>& genomes, int threads) {
    std::vector<Answer> answers(genomes.size());
    ga::parallel_for(answers.size(), ga::thread_count(threads),
                     [&](std::size_t i) { answers[i] = answer_of(setup, genomes[i]); });
    return answers;
}

/// The best answer, then the best of the way that differ from it and from each other.
std::vector<Answer> alternatives(const DesignSetup& setup, const Answer& best, const Archive& archive,
                                 const SearchOptions& options) {
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
    std::vector<Answer> all = answers_of(setup, others, options.threads);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].difference = differences[i];
    all.insert(all.begin(), best);
    return all;
}

/// What the pipeline gave, and the best of its way, each once; at most `most` of either.
std::vector<Genome> candidates_of(const DesignProblem& problem, const ga::Population<Genome>& population,
                                  const Archive& archive, std::size_t most) {
    std::vector<Genome> candidates;
    std::set<std::string> keys;
    const auto consider = [&](const Genome& genome) {
        if (keys.insert(problem.key(genome)).second)
            candidates.push_back(genome);
    };
    for (std::size_t i = 0; i < std::min(population.size(), most); ++i)
        consider(population[i].genome);
    for (std::size_t i = 0; i < std::min(archive.best.size(), most); ++i)
        consider(archive.best[i].genome);
    return candidates;
}

std::vector<Genome> database_for(const DesignSetup& setup, int threads) {
    DatabaseLayout layout;
    layout.lambda = std::clamp(setup.model.grid.length, setup.bounds.lambda_from, setup.bounds.lambda_to);
    layout.H_from = std::clamp(layout.H_from, setup.bounds.H_from, setup.bounds.H_to);
    layout.H_to = std::clamp(layout.H_to, setup.bounds.H_from, setup.bounds.H_to);
    layout.gamma_from = std::clamp(layout.gamma_from, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.gamma_to = std::clamp(layout.gamma_to, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.shortest = setup.limits.shortest_wave;
    std::vector<Genome> genomes = sobol_database(layout);
    ga::parallel_for(genomes.size(), ga::thread_count(threads),
                     [&](std::size_t i) { genomes[i] = with_fitting_amplitude(setup, genomes[i]); });
    return genomes;
}

bool makes_its_own_starts(const std::string& pipeline) {
    const std::string begun = "restarts " + std::to_string(attempts) + " { ";
    auto first = pipeline.find_first_not_of(" \t\n");
    if (pipeline.compare(first, begun.size(), begun) == 0)
        first += begun.size();
    return pipeline.compare(first, 6, "shape ") == 0 || pipeline.compare(first, 7, "sample ") == 0;
}

} // namespace

bool holds_limits(const DesignSetup& setup, const Genome& genome) {
    const auto all = margins(genome, setup.model.grid, setup.limits);
    return std::all_of(all.begin(), all.end(), [](const Margin& margin) { return margin.holds(); });
}

double difference(const Profile& left, const Profile& right) {
    const Eigen::VectorXd a = left.heights.array() - left.heights.mean();
    const Eigen::VectorXd b = right.heights.array() - right.heights.mean();
    const double both = a.norm() * b.norm();
    return both > 0 ? 1 - std::max(a.dot(b), a.dot(b.reverse())) / both : 0;
}

SearchResult search(const DesignSetup& given, const SearchOptions& options,
                    std::vector<ga::Observer<Genome>> observers) {
    const DesignProblem problem(given);
    const DesignSetup& setup = problem.setup();
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
        if (!options.reach || archive.best.empty() || archive.best.front().value < judged_from)
            return;
        const Answer best = answer_of(setup, archive.best.front().genome);
        if (holds_limits(setup, best.genome) && best.judged() >= *options.reach)
            throw ga::Stopped{"the similarity asked for was reached"};
        judged_from = std::nextafter(archive.best.front().value, 2.0); // the same one would tell nothing new
    });

    ga::RunOptions run;
    run.variant = options.pipeline.empty() ? options.variant : "pipeline";
    run.seed = options.seed;
    run.threads = options.threads;
    run.budget = {options.evaluations, options.seconds, options.stop};
    if (setup.limits.any_shape())
        run.budget.seconds *= 1 - share_for_limits;
    const std::string text = stage.text();
    if (!options.starts.empty() && makes_its_own_starts(text))
        throw InputError("design: the pipeline '" + text +
                         "' makes its own starts, expected one that begins with those given (score | ...)");
    std::optional<ga::Checkpoints<DesignProblem>> keeper;
    if (options.keeping) {
        keeper.emplace(options.keeping->file, json_text(description(setup), true), options.keeping->resume);
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
        auto found =
            ga::run(stage, problem, ga::population(starts), run, observers, keeper ? &*keeper : nullptr);
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
        result.front = compromises(setup, front, shown_compromises, options.threads);
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
        archive.offer(
            problem,
            {shaped_start(setup, ga::Stream(options.seed)), 0, {}, ga::Fitness(by_similarity, 0), nullptr});

    const std::vector<Genome> candidates = candidates_of(problem, population, archive, options.compared);
    std::vector<Answer> answers = answers_of(setup, candidates, options.threads);
    if (std::none_of(answers.begin(), answers.end(), [](const Answer& a) { return a.within_limits; })) {
        run.budget = {std::numeric_limits<long>::max(), share_for_limits * options.seconds, options.stop};
        if (const auto genome = brought_within(problem, candidates, run, result.counters)) {
            answers.push_back(answer_of(setup, *genome));
            result.notes.push_back("no answer of the pipeline held every limit; one was brought within them, "
                                   "without its shortest waves where these were at fault");
        }
    }
    result.best = *std::max_element(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
        return std::pair(a.within_limits, a.judged()) < std::pair(b.within_limits, b.judged());
    });
    result.alternatives = alternatives(setup, result.best, archive, options);
    return result;
}

} // namespace rough
