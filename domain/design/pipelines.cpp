#include "domain/design/pipelines.hpp"

#include "domain/design/own_waves.hpp"
#include "domain/design/search.hpp"
#include "domain/design/target_dominance.hpp"

namespace rough {

ga::Population<Genome> Shape::operator()(ga::Population<Genome>, ga::Context<DesignProblem>& context) const {
    ga::Population<Genome> fresh(n);
    ga::parallel_for(n, context.threads(), [&](std::size_t i) {
        fresh[i].genome = shaped_start(context.problem().setup(), context.stream(i));
    });
    for (auto& individual : fresh)
        individual.identity = context.new_identity();
    return fresh;
}

ga::Population<Genome> Own::operator()(ga::Population<Genome>, ga::Context<DesignProblem>& context) const {
    ga::Population<Genome> fresh(n);
    ga::parallel_for(n, context.threads(), [&](std::size_t i) {
        const DesignSetup& setup = context.problem().setup();
        fresh[i].genome = own_waves(setup, most_own_waves(setup) >> i);
    });
    for (auto& individual : fresh)
        individual.identity = context.new_identity();
    return fresh;
}

ga::Registry<DesignProblem> design_registry(const DesignSetup& setup) {
    auto registry = engine_words();
    add_words(registry, Vocabulary{std::make_shared<DominanceRule>(setup.model)});
    registry.add<Shape>();
    registry.add<Own>();
    registry.add("fit", "roughness",
                 "each genome in the amplitude at which it meets the first target best; nothing under Eq. 11",
                 ga::transform(
                     "fit", [setup](const Genome& genome) { return with_fitting_amplitude(setup, genome); }));
    for (std::size_t g = 0; g < setup.targets.size(); ++g) {
        const std::string name = "reduce goal" + std::to_string(g + 1);
        registry.add(name, "roughness", "keeps the chromosomes that follow that target by themselves (M-CCO)",
                     ga::transform(name, [setup, g](const Genome& genome) {
                         return reduced_to_target(setup, genome, g);
                     }));
    }
    const double length = setup.model.grid.length;
    registry.add(
        ga::Variables<Genome>{"macro", [length](const Genome& g) { return macro_phases(g, length); }},
        "phases of waves of at least an eighth of the length");
    registry.add(
        ga::Variables<Genome>{"micro", [length](const Genome& g) { return micro_phases(g, length); }},
        "phases of shorter waves");
    return registry;
}

Pipeline design_pipeline(const DesignSetup& setup, const std::string& text) {
    return ga::Parser<DesignProblem>(design_registry(setup), design_variants()).parse(text);
}

Pipeline design_variant(const DesignSetup& setup, const std::string& name) {
    return ga::Parser<DesignProblem>(design_registry(setup), design_variants()).variant(name);
}

namespace {

/// What an answer is judged by, refined: the end of some variants.
const std::string polish = " | best 2 | score judged | refine lm 16 sharpen=4";

/// Those variants without that end.
const ga::Variants& unpolished() {
    static const ga::Variants variants{
        // Starts near the target; the best are brought down the squares, then towards the maximum norm. While
        // that is not enough, fresh ones join and length scales of good ones cross. Both grids at the end.
        {"default",
         "shape 24 | score | best 8 | refine lm 15 | best 5 | refine lm 25 sharpen=8 | "
         "until fitness 0.9995 generations 10 { shape 8 | score | best 2 | refine lm 20 | parents | "
         "tournament 2 size=6 | cross uniform rate=0.7 | mutate 0.05 gaussian 0.02 | score | "
         "refine lm 25 sharpen=10 | plus 5 }"},
        // Stored genomes that are near already, brought nearer at once: the paper's in-line control.
        {"in-line",
         "score | refine lm 12 | best 4 | refine lm 30 sharpen=8 | best 2 | refine lm 200 sharpen=5"},
        // The same effort without a target's shape in the starts and without cross-over: what chance brings.
        {"multistart", "sample 60 | score | best 12 | refine lm 12 | best 4 | refine lm 60 sharpen=1 | until "
                       "fitness 0.9995 "
                       "generations 8 { sample 60 | score | best 12 | refine lm 12 | best 4 | refine lm 60 "
                       "sharpen=1 | plus 4 }"},
    };
    return variants;
}

const ga::Variants& other_variants() {
    static const ga::Variants variants{
        // A scan's own waves, brought back to what the scan answers: stiffness and area together.
        {"like", "own 2 | fit | score | refine lm 30 sharpen=8 | score judged | refine lm 30 sharpen=4"},
        // Selection, cross-over of length scales and mutation, no derivative.
        {"plain",
         "score | best 50 | repeat 100 { tournament 2 | cross uniform rate=0.8 | mutate 0.1 gaussian 0.05 | "
         "score | elite 2 } | best 1"},
        // The paper's algorithms (Algorithms 3-5).
        {"sog", "score | best 3 | refine gcmma 5 genes=dominant | refine gcmma 2 genes=others | best 1"},
        {"gco", "pair(score low | above 0.95 at_least=3, score high | above 0.95 at_least=3, unite) | fit | "
                "score | best 3 | refine gcmma 3 genes=dominant | refine gcmma 2 genes=others | best 1"},
        {"cco",
         "pair(score low | above 0.95 at_least=3 | reduce dominant, score high | above 0.95 at_least=3 | "
         "reduce dominant, unite) | fit | score | best 3 | refine gcmma 3 genes=phases | best 1"},
        // Two targets, one list of genomes for each (Cinat, Paggi and Gnecco 2019).
        {"mcco",
         "pair(score goal1 | above 0.95 at_least=5 | reduce goal1, score goal2 | above 0.95 at_least=5 | "
         "reduce goal2, unite) | fit | score | best 3 | refine gcmma 3 genes=macro | refine gcmma 3 "
         "genes=micro | best 1"},
        // What two targets cost each other: NSGA-II whose ends and children are refined.
        {"nsga2", "shape 40 | score | best 20 | repeat 1 { score goal1 | refine lm 15 | parents } | repeat 1 "
                  "{ score goal2 | refine lm 15 | parents } | pareto goal1 goal2 | best 40 | repeat 15 { "
                  "tournament 2 | cross uniform rate=0.8 | mutate 0.05 gaussian 0.02 | score | refine lm 5 | "
                  "parents | pareto goal1 goal2 | best 40 } | front"},
        // Many surfaces of one response: elites of every wave length and skewness, moved along the gradients
        // of these and brought back to the target.
        {"atlas", "shape 60 | score | best 24 | refine lm 30 sharpen=4 | repeat 60 { above 0.96 at_least=8 | "
                  "emit 12 wavelength skewness sigma=0.07 | score | refine lm 25 sharpen=6 | "
                  "map-elites wavelength skewness cells=20 } | best 40 | refine lm 25 sharpen=6"},
        // Global optimisers of NLopt on every gene of the best start.
        {"esch", "score | best 1 | refine nlopt GN_ESCH 5000"},
        {"crs2", "score | best 1 | refine nlopt GN_CRS2_LM 5000"},
    };
    return variants;
}

} // namespace

std::string without_polish(const std::string& variant) { return unpolished().at(variant); }

const ga::Variants& design_variants() {
    static const ga::Variants variants = [] {
        ga::Variants all = other_variants();
        for (const auto& [name, text] : unpolished())
            all.emplace(name, text + polish);
        return all;
    }();
    return variants;
}

} // namespace rough
