#include "domain/design/search.hpp"

#include "domain/errors.hpp"
#include "domain/mwm/database.hpp"

#include <algorithm>
#include <map>

namespace rough {

namespace {

constexpr std::size_t remembered = 60; ///< individuals an archive keeps
/// Individuals of either kind compared on the finer grid at the end: fewer where there is hardly time for
/// one.
std::size_t judged_most(const SearchOptions& options) { return options.seconds < 2 ? 1 : 3; }

/// The best individuals of all stages, each genome once.
class Archive {
  public:
    explicit Archive(const DesignProblem& problem) : problem_(problem) {}

    void offer(const ga::Individual<Genome>& individual) {
        if (!individual.fitness.known() || individual.fitness.has_failed())
            return;
        const std::string& objective = individual.fitness.objective();
        if (objective != "similarity" && objective != "judged")
            return;
        const std::string key = problem_.key(individual.genome);
        if (const auto found = by_key_.find(key); found != by_key_.end())
            return;
        by_key_.emplace(key, individual.value());
        best_.push_back({individual.value(), individual.genome});
        std::stable_sort(best_.begin(), best_.end(),
                         [](const Kept& a, const Kept& b) { return a.value > b.value; });
        if (best_.size() > remembered) {
            by_key_.erase(problem_.key(best_.back().genome));
            best_.pop_back();
        }
    }

    struct Kept {
        double value;
        Genome genome;
    };
    const std::vector<Kept>& best() const { return best_; }

  private:
    const DesignProblem& problem_;
    std::vector<Kept> best_;
    std::map<std::string, double> by_key_;
};

/// Solved throughout: what is returned owes nothing to the accuracy that the search was allowed.
Answer answer_of(const DesignSetup& searched, const Genome& genome) {
    const DesignSetup setup = exactly(searched);
    Answer answer{folded(genome)};
    const DesignResponse coarse = respond(setup, genome, setup.model);
    if (setup.max_pressure) {
        answer.genome = genome;
        answer.genome.scale = coarse.scale;
        answer.genome = folded(answer.genome);
    }
    answer.similarity = similarity(setup, coarse);
    answer.similarity_refined = similarity(setup, genome, 4);
    return answer;
}

bool holds(const DesignSetup& setup, const Genome& genome) {
    const auto all = margins(genome, setup.model.grid, setup.limits);
    return std::all_of(all.begin(), all.end(), [](const Margin& margin) { return margin.holds(); });
}

std::vector<Genome> database_for(const DesignSetup& setup, int threads) {
    DatabaseLayout layout;
    layout.lambda = std::clamp(setup.model.grid.length, setup.bounds.lambda_from, setup.bounds.lambda_to);
    layout.H_from = std::clamp(layout.H_from, setup.bounds.H_from, setup.bounds.H_to);
    layout.H_to = std::clamp(layout.H_to, setup.bounds.H_from, setup.bounds.H_to);
    layout.gamma_from = std::clamp(layout.gamma_from, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.gamma_to = std::clamp(layout.gamma_to, setup.bounds.gamma_from, setup.bounds.gamma_to);
    layout.shortest =
        setup.limits.shortest_wave > 0 ? setup.limits.shortest_wave : setup.model.grid.spacing();
    std::vector<Genome> genomes = sobol_database(layout);
    ga::parallel_for(genomes.size(), ga::thread_count(threads),
                     [&](std::size_t i) { genomes[i] = with_fitting_amplitude(setup, genomes[i]); });
    return genomes;
}

bool makes_its_own_starts(const std::string& pipeline) {
    const auto first = pipeline.find_first_not_of(" \t\n");
    return pipeline.compare(first, 6, "shape ") == 0 || pipeline.compare(first, 7, "sample ") == 0;
}

} // namespace

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
    const auto registry = design_registry(setup);
    ga::Parser<DesignProblem> parser(registry, design_variants());
    const auto stage =
        options.pipeline.empty() ? parser.variant(options.variant) : parser.parse(options.pipeline);

    Archive archive(problem);
    double judged_from = options.reach.value_or(0);
    observers.insert(observers.begin(), [&](const ga::Event<Genome>& event) {
        for (const auto& individual : event.population)
            archive.offer(individual);
        if (!options.reach || archive.best().empty() || archive.best().front().value < judged_from)
            return;
        const Answer best = answer_of(setup, archive.best().front().genome);
        if (holds(setup, best.genome) && best.judged() >= *options.reach)
            throw ga::Stopped{"the similarity asked for was reached"};
        judged_from =
            std::nextafter(archive.best().front().value, 2.0); // the same one would tell nothing new
    });

    ga::RunOptions run;
    run.variant = options.pipeline.empty() ? options.variant : "pipeline";
    run.seed = options.seed;
    run.threads = options.threads;
    run.budget = {options.evaluations, options.seconds, options.stop};
    const std::string text = stage.text();
    if (!options.starts.empty() && makes_its_own_starts(text))
        throw InputError("design: the pipeline '" + text +
                         "' makes its own starts, expected one that begins with those given (score | ...)");
    SearchResult result;
    ga::Population<Genome> population;
    result.pipeline = text;
    try {
        const std::vector<Genome> starts =
            !options.starts.empty()      ? options.starts
            : makes_its_own_starts(text) ? std::vector<Genome>{shaped_start(setup, ga::Stream(options.seed))}
                                         : database_for(setup, options.threads);
        auto found = ga::run(stage, problem, ga::population(starts), run, observers);
        for (const auto& individual : found.population)
            archive.offer(individual);
        if (found.best)
            archive.offer(*found.best);
        population = std::move(found.population);
        result.counters = found.counters;
        result.notes = found.notes;
        result.stopped = found.stopped;
    } catch (const ga::NothingLeft& nothing) {
        if (archive.best().empty())
            throw NotConverged(nothing.what());
        result.notes.push_back(nothing.what());
    }
    if (archive.best().empty()) // stopped before the first curve
        archive.offer({shaped_start(setup, ga::Stream(options.seed)),
                       0,
                       {},
                       ga::Fitness(ga::Name("similarity"), 0),
                       nullptr});

    // What the pipeline gave, and the best of its way.
    std::vector<Genome> candidates;
    for (const auto& individual : population)
        if (candidates.size() < judged_most(options))
            candidates.push_back(individual.genome);
    for (const auto& kept : archive.best())
        if (candidates.size() < 2 * judged_most(options))
            candidates.push_back(kept.genome);
    std::vector<Answer> answers(candidates.size());
    ga::parallel_for(answers.size(), ga::thread_count(options.threads),
                     [&](std::size_t i) { answers[i] = answer_of(setup, candidates[i]); });
    // Those within the limits first.
    std::stable_sort(answers.begin(), answers.end(), [&](const Answer& a, const Answer& b) {
        return std::pair(holds(setup, a.genome), a.judged()) > std::pair(holds(setup, b.genome), b.judged());
    });
    result.best = answers.front();
    result.within_limits = holds(setup, result.best.genome);

    result.alternatives = {result.best};
    std::vector<Profile> profiles{sample(result.best.genome, setup.model.grid)};
    for (const auto& kept : archive.best()) {
        if (result.alternatives.size() >= options.alternatives)
            break;
        const Profile profile = sample(kept.genome, setup.model.grid);
        double least = 2;
        for (const Profile& other : profiles)
            least = std::min(least, difference(profile, other));
        if (least < different || kept.value < -1)
            continue;
        result.alternatives.push_back(answer_of(setup, kept.genome));
        result.alternatives.back().difference = least;
        profiles.push_back(profile);
    }
    return result;
}

} // namespace rough
