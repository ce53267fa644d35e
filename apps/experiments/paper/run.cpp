#include "apps/experiments/paper/run.hpp"

#include "apps/report/record.hpp"
#include "domain/target/similarity.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/random.hpp"

#include <cmath>
#include <numbers>

namespace app {

std::vector<rough::Genome> database_of(const PaperRun& run) {
    std::vector<rough::Genome> genomes = sobol_database(run.layout);
    const auto columns = static_cast<std::size_t>(run.layout.phase_columns);
    for (std::size_t g = 0; run.phases > 0 && g < genomes.size(); ++g) { // the same for all pairs (H, gamma)
        ga::Stream random(ga::fold(ga::fold(ga::fold(run.origin.seed, "phases"), run.phases), g % columns));
        for (rough::Chromosome& chromosome : genomes[g].series[0].chromosomes)
            chromosome.phases[0] = random.uniform(0, 2 * std::numbers::pi);
    }
    return genomes;
}

std::optional<VariantRun> finished_run(const std::string& name, const rough::DesignProblem& problem,
                                       const ga::Result<rough::Genome>& result,
                                       std::vector<StageRecord> stages) {
    if (result.population.empty())
        return std::nullopt;
    VariantRun run;
    run.name = name;
    run.stages = std::move(stages);
    run.seconds = result.seconds;
    run.notes = result.notes;
    run.answer.genome = in_final_form(problem.setup(), result.population.front().genome);
    run.answer.response = respond(run.answer.genome, exactly(problem.setup().model));
    run.similarity = similarity(as_reported(problem.setup()), run.answer.genome);
    run.curves = result.counters.evaluations;
    run.gradients = result.counters.gradients;
    return run;
}

ThresholdRow threshold_row(const VariantRun& run, double p_bar) {
    const auto size = [&](const std::string& path) {
        const StageRecord* stage = stage_at(run.stages, run.name + "/" + path);
        return stage ? stage->candidates.size() : 0;
    };
    ThresholdRow row;
    row.p_bar = p_bar;
    row.variant = run.name;
    row.u1 = size("pair.1/left/above.1");
    row.u2 = size("pair.1/right/above.1");
    row.at_least_used = !run.notes.empty();
    row.children = size("score.1");
    row.best_child = -INFINITY;
    double above = 0;
    for (const Candidate& child : stage_at(run.stages, run.name + "/score.1")->candidates) {
        above += child.similarity > 0.95;
        row.best_child = std::max(row.best_child, child.similarity);
    }
    row.share_above = above / static_cast<double>(row.children);
    row.parents = run.stages.back().candidates.front().parents;
    row.similarity = run.similarity;
    return row;
}

std::vector<Answered> answered(const std::vector<rough::Genome>& genomes, const rough::Model& model,
                               double max_pressure, int threads) {
    std::vector<Answered> database(genomes.size());
    ga::parallel_for(genomes.size(), threads, [&](std::size_t i) {
        rough::Genome genome = genomes[i];
        rough::Response response = respond(genome, model);
        genome.scale = max_pressure / response.pressure[response.steps() - 1]; // Eq. 11
        database[i] = {genome, scaled(std::move(response), genome.scale)};
    });
    return database;
}

std::vector<Scores> scores_of(const std::vector<Answered>& database, const rough::DesignSetup& setup) {
    const auto low = points_of_half(setup, false), high = points_of_half(setup, true);
    std::vector<Scores> scores;
    for (const Answered& one : database) {
        const Eigen::VectorXd misfits = misfit(setup.targets.front(), secant_stiffness(one.response));
        scores.push_back(
            {rough::similarity(misfits), rough::similarity(misfits(low)), rough::similarity(misfits(high))});
    }
    return scores;
}

} // namespace app
