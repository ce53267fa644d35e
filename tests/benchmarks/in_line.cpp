// in_line [GENOMES.db [SECONDS]]: the paper's in-line control from stored responses. A missing file is built
// first, with 100,000 genomes; its default name is genomes.db. There are 20 targets that no stored genome was
// made for. For each, prints the similarity that is reached within a second of wall time, which includes
// opening the file, screening and refinement. It is given on the grid and on one four times finer, next to
// the similarities of the paper's three variants.

#include "domain/database/build.hpp"
#include "domain/database/screen.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/mwm/sobol.hpp"
#include "domain/mwm/test_surfaces.hpp"
#include "domain/numerics/statistics.hpp"

#include <cstdio>

using namespace rough;

namespace {

/// Responses of twelve unseen genomes of two series and of six fractal profiles, which are not MWM series,
/// and a curve like the paper's.
std::vector<Target> targets(const DatabaseSetup& setup) {
    std::vector<Target> targets;
    GenomeDistribution law = setup.law;
    law.series = 2;
    law.seed = 987654321;
    for (std::uint64_t i = 0; i < 12; ++i)
        targets.push_back(
            target_like(sample(drawn(law, i), setup.model.grid), setup.model, "genome " + std::to_string(i)));
    for (int i = 0; i < 6; ++i)
        targets.push_back(
            target_like(fractal_profile(setup.model.grid, 0.5 + 0.08 * i, 1e-3, 100 + static_cast<std::uint64_t>(i)),
                        setup.model, "fractal " + std::to_string(i)));
    for (const char* name : {"drawn", "heldout"}) {
        targets.push_back(read_target(std::string(RUGOSA_SOURCE "/experiments/targets/") + name + ".csv"));
        targets.back().name = name;
    }
    return targets;
}

struct Reached {
    double screened, similarity, refined, seconds;
};

Reached in_line(const char* file, const Target& target, double seconds) {
    const ga::Stopwatch clock;
    const GenomeStore store = GenomeStore::open(file);
    const DesignSetup setup{
        .model = store.setup().model, .targets = {target}, .limits = {.shortest_wave = store.setup().law.shortest}};
    const auto genomes = stored_starts(store, setup, 8);
    const DesignProblem problem(setup);
    const DesignPipeline pipeline = design_pipeline(setup, "score | refine lm 12 | best 4 | refine lm 30 sharpen=8 | "
                                                           "best 2 | refine lm 200 sharpen=5 | best 1");
    ga::RunOptions options;
    options.budget.seconds = seconds - clock.seconds() - 0.03; // for evaluations that still run at the end
    const auto result = ga::run(pipeline, problem, ga::population(genomes), options);
    const double taken = clock.seconds();
    return {similarity(setup, genomes[0]), result.best->value(), similarity(setup, result.best->genome, 4), taken};
}

/// The best similarity of a variant of the paper from its hundred genomes.
double by_variant(const char* name, const Target& target, const Model& model) {
    const double highest = target.last();
    const DesignProblem problem(paper_setup(model, target, highest, 0.5 * highest));
    const Vocabulary words{std::make_shared<DominanceRule>(model)};
    const auto start = ga::population(sobol_database({.shortest = model.grid.spacing()}));
    return ga::run(ga::Parser<DesignProblem>(paper_registry(words), paper_variants()).variant(name), problem, start)
        .population.front()
        .value();
}

} // namespace

int main(int count, char** arguments) {
    const char* file = count > 1 ? arguments[1] : "genomes.db";
    const double seconds = count > 2 ? std::atof(arguments[2]) : 1;
    if (!GenomeStore::begun(file)) {
        std::printf("building %s, 100,000 genomes\n", file);
        GenomeStore made = GenomeStore::create(file, {});
        build(made, {});
    }
    const DatabaseSetup setup = GenomeStore::open(file).setup();
    std::array<std::vector<double>, 7> columns;
    const auto print = [](const std::string& name, const std::array<double, 7>& row) {
        std::printf("%-16s", name.c_str());
        for (const double value : row) std::printf(" %9.4f", value);
        std::printf("\n");
    };
    std::printf("%-16s %9s %9s %9s %9s %9s %9s %9s\n", "target", "screened", "reached", "refined", "seconds", "sog",
                "gco", "cco");
    for (const Target& target : targets(setup)) {
        const Reached r = in_line(file, target, seconds);
        const auto by = [&](const char* variant) { return by_variant(variant, target, setup.model); };
        const std::array row{r.screened, r.similarity, r.refined, r.seconds, by("sog"), by("gco"), by("cco")};
        for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
        print(target.name, row);
    }
    std::array<double, 7> medians;
    std::ranges::transform(columns, medians.begin(), median);
    print("median", medians);
}
