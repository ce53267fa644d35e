#include "domain/design/pipelines.hpp"

#include "domain/design/starts.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/paper/variants.hpp"
#include "ga/base/number.hpp"
#include "ga/blocks/derived.hpp"
#include "ga/pipeline/transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// Nodes a side of the coarsest grid, and its spacings to the shortest wave, at least.
constexpr Index coarsest_side = 32;
constexpr double coarsest_wave = 1.9;

/// Without its shortest wave; nothing of a genome with one wave alone.
std::optional<Genome> without_shortest(const Genome& genome) {
    const auto scales = length_scales(genome);
    if (scales.size() < 2)
        return std::nullopt;
    const auto shortest =
        std::max_element(scales.begin(), scales.end(), [](const LengthScale& a, const LengthScale& b) {
            return a.wave_number < b.wave_number;
        });
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return std::find(shortest->members.begin(), shortest->members.end(), std::pair(s, c)) ==
               shortest->members.end();
    });
}

using Designs = ga::Population<Genome>;

/// How far each exceeds the limits; infinite of one that has no answer.
std::vector<double> excesses(Designs& designs, ga::Context<DesignProblem>& context) {
    std::vector<double> all;
    context.evaluate(designs, [&](auto& design, const ga::Evaluation<DesignOutcome>& evaluation) {
        const auto* outcome = std::get_if<DesignOutcome>(&evaluation);
        all.push_back(outcome ? outcome->excess : HUGE_VAL);
        design.fitness = ga::fitness_of(context.problem(), evaluation, context.problem().objectives().front(),
                                        context.objective_name(0));
    });
    return all;
}

/// Of each genome without none, one, two of its shortest waves and on, the one that exceeds the limits least.
Designs shortened(const Designs& designs, ga::Context<DesignProblem>& context) {
    Designs least;
    for (const auto& design : designs) {
        Designs tries{design};
        for (auto next = without_shortest(design.genome); next; next = without_shortest(*next)) {
            tries.push_back(design);
            tries.back().genome = with_fitting_amplitude(context.problem().setup(), *next);
            context.make_child(tries.back(), ga::Parents(design.identity));
        }
        const std::vector<double> over = excesses(tries, context);
        least.push_back(
            tries[static_cast<std::size_t>(std::min_element(over.begin(), over.end()) - over.begin())]);
    }
    return least;
}

/// An area's set-up on a grid of half the nodes a side, `halvings` times, as far as 32 nodes remain and the
/// shortest wave can still be told.
DesignSetup on_coarser_grid(DesignSetup setup, std::size_t halvings) {
    for (std::size_t i = 0; i < halvings; ++i) {
        Grid grid = setup.model.grid;
        grid.nodes /= 2;
        if (grid.is_2d())
            grid.rows /= 2;
        if (std::min(grid.nodes, grid.is_2d() ? grid.rows : grid.nodes) < coarsest_side ||
            setup.limits.shortest_wave < coarsest_wave * grid.widest_spacing())
            break;
        setup.model.grid = grid;
    }
    return setup;
}

/// Runs `body` under that set-up, where a contact curve costs as many times less.
Pipeline coarser(const ga::Arguments& arguments, const Pipeline& body) {
    const std::size_t halvings = arguments.count("n");
    return ga::derived_step<DesignProblem>(
        "coarser " + std::to_string(halvings), body,
        [halvings](Designs designs, const Pipeline& stages, ga::Context<DesignProblem>& context) {
            const DesignProblem coarse(on_coarser_grid(context.problem().setup(), halvings));
            return run_derived(stages, coarse, std::move(designs), context);
        });
}

/// The set-up whose targets are moved by what a verified answer's curve changes on finer grids and in finer
/// steps: to meet them on the set-up's own grid is to miss the given ones by as much on the one side as on
/// the other.
DesignSetup corrected_targets(DesignSetup setup, const Verification& verified) {
    const auto& [own, refined, stepped, both] = verified.misfits;
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        Target& target = setup.targets[t];
        for (Index k = 0; k < target.points(); ++k) {
            const auto [least, most] = std::minmax({own[t][k], refined[t][k], stepped[t][k], both[t][k]});
            const double factor = 1 + (own[t][k] - 0.5 * (least + most)) / target.weight;
            target.y[k] *= factor;
            if (target.has_band())
                target.lower[k] *= factor, target.upper[k] *= factor;
        }
    }
    return setup;
}

/// Runs `body` on the first individual under corrected targets, in front of the population that was given.
Pipeline corrected(const ga::Arguments&, const Pipeline& body) {
    return ga::derived_step<DesignProblem>(
        "corrected", body, [](Designs designs, const Pipeline& stages, ga::Context<DesignProblem>& context) {
            const Verification verified = context.problem().verifier().remembered(designs.front().genome);
            if (std::isnan(verified.worst()))
                throw ga::Stopped{"stop requested"};
            const DesignProblem aimed(corrected_targets(context.problem().setup(), verified));
            Designs all = run_derived(stages, aimed, {designs.front()}, context);
            for (auto& design : all)
                context.make_child(design, ga::Parents(designs.front().identity));
            all.insert(all.end(), designs.begin(), designs.end());
            return all;
        });
}

/// Where no individual is within the limits on shape: runs `body` on each without so many of its shortest
/// waves that it exceeds the limits least, in front of those that were given. Otherwise it does nothing.
Pipeline within_limits(const ga::Arguments&, const Pipeline& body) {
    ga::Step<DesignProblem> step;
    step.text = "within-limits { " + body.text() + " }";
    step.check = [body](ga::CheckState& known) {
        body.check(known);
        body.check_end(known);
    };
    step.apply = [body](Designs designs, ga::Context<DesignProblem>& context) {
        const std::vector<double> over = excesses(designs, context);
        if (std::any_of(over.begin(), over.end(), [](double excess) { return excess <= 0; }))
            return designs;
        Designs all = shortened(designs, context);
        all.insert(all.end(), designs.begin(), designs.end());
        return body(std::move(all), context);
    };
    return step;
}

} // namespace

ga::Registry<DesignProblem> design_registry(const DesignSetup& setup) {
    const auto fit = [setup](const Genome& genome) { return with_fitting_amplitude(setup, genome); };
    auto registry = paper_registry({.rule = std::make_shared<DominanceRule>(setup.model), .fitted = fit});
    // Puts n genomes in the place of the population, the i-th as make(setup, i, stream).
    const auto start = [&](const char* name, const char* meaning, auto make) {
        registry.add({name, "roughness", meaning, {ga::whole("n", std::nullopt, 1, "how many")}},
                     [name, make](const ga::Arguments& a, const auto&...) -> Pipeline {
                         const std::size_t n = a.count("n");
                         ga::Step<DesignProblem> step;
                         step.text = name + (" " + std::to_string(n));
                         step.check = [](ga::CheckState& known) { known.scored.reset(); };
                         step.begins = true;
                         step.apply = [n, make](Designs, ga::Context<DesignProblem>& context) {
                             Designs fresh(n);
                             ga::parallel_for(n, context.threads(), [&](std::size_t i) {
                                 fresh[i].genome = make(context.problem().setup(), i, context.stream(i));
                             });
                             for (auto& design : fresh)
                                 design.identity = context.new_identity();
                             return fresh;
                         };
                         return step;
                     });
    };
    start(
        "shape", "n genomes made for the target, contact solved backwards, in the population's place",
        [](const DesignSetup& asked, std::size_t, ga::Stream random) { return shaped_start(asked, random); });
    start("own",
          "n sums of the measured profile's own waves, each with half as many as the one before, in the "
          "population's place",
          [](const DesignSetup& asked, std::size_t i, ga::Stream) {
              return scan_waves(asked, max_scan_waves(asked) >> i);
          });
    registry.add("fit", "roughness",
                 "each genome in the amplitude at which it meets the first target best; nothing under Eq. 11",
                 ga::transform("fit", fit));
    for (std::size_t g = 0; g < setup.targets.size(); ++g) {
        const std::string name = "reduce goal" + std::to_string(g + 1);
        registry.add(name, "roughness", "keeps the chromosomes that follow that target by themselves (M-CCO)",
                     ga::transform(name, [setup, g](const Genome& genome) {
                         return reduced_to_target(setup, genome, g);
                     }));
    }
    const auto block = [&](const char* name, const char* meaning, std::vector<ga::Parameter> parameters,
                           Pipeline (*make)(const ga::Arguments&, const Pipeline&)) {
        registry.add({name, "roughness", meaning, std::move(parameters), "", 1},
                     [make](const ga::Arguments& a, const std::vector<Pipeline>& bodies, const auto&) {
                         return make(a, bodies[0]);
                     });
    };
    block("coarser", "runs the pipeline on a grid of half the nodes a side, n times",
          {ga::whole("n", std::nullopt, 1, "how many times half")}, coarser);
    block("corrected",
          "runs the pipeline on the first, at the targets less what its curve changes on finer grids and in "
          "more load steps",
          {}, corrected);
    block(
        "within-limits",
        "where no individual is within the limits on shape: the pipeline on each without its shortest waves",
        {}, within_limits);
    const double length = setup.model.grid.length;
    const auto waves = [&](const std::string& name, double from, double to, PhaseReach reach,
                           const std::string& meaning) {
        registry.add(
            ga::Variables<Genome>{
                name, [=](const Genome& genome) { return phases_of_waves(genome, from, to, reach); }},
            meaning);
    };
    waves("macro", length / 8, HUGE_VAL, {}, "phases of waves of at least an eighth of the length");
    waves("micro", 0, length / 8, {}, "phases of shorter waves");
    for (const int parts : {1, 2, 4, 8, 16, 32, 64}) {
        const std::string part = std::to_string(parts);
        const PhaseReach free{0, std::numbers::pi};
        waves("longer-" + part, length / parts, HUGE_VAL, free,
              "phases of waves of L/" + part + " and longer, freely");
        waves("shorter-" + part, 0, length / parts, free, "phases of the waves below L/" + part + ", freely");
    }
    return registry;
}

Pipeline design_pipeline(const DesignSetup& setup, const std::string& text) {
    ga::Parser<DesignProblem> parser(design_registry(setup), design_variants(setup.required_similarity));
    Pipeline pipeline = parser.parse(text);
    if (setup.limits.any_shape() && pipeline.text().find("within-limits") == std::string::npos)
        pipeline.append(parser.parse("within-limits { score | refine lm 40 | best 1 }"));
    return pipeline;
}

std::string usual_variant(const DesignSetup& setup, bool stored) {
    const bool asks_for_area =
        std::any_of(setup.targets.begin(), setup.targets.end(),
                    [](const Target& target) { return is_contact_fraction(target.quantity); });
    return stored                        ? "in-line"
           : setup.model.grid.is_2d()    ? "maps"
           : setup.errors.any()          ? "made"
           : setup.like && asks_for_area ? "like"
                                         : "default";
}

ga::Variants design_variants(double required) {
    // The paper's algorithms (Algorithms 3-5); a target without Eq. 11 gives each genome its amplitude.
    ga::Variants variants = paper_variants();
    const std::string until = "until fitness " + ga::number(required) + " generations ";
    // Starts near the target. The best are brought down the squares, then towards the least largest misfit,
    // in more load steps as well: steps are the larger part of the error. Contact sets make the misfits kink,
    // so the best are moved a little and brought back again and again. The last stage counts the finer grid,
    // too.
    const std::string pass =
        "shape 32 | score | best 10 | refine lm 15 | best 5 | score more_steps | refine lm 25 sharpen=8 | "
        "until fitness 0.9985 generations 3 { parents | mutate 0.2 gaussian 0.001 | score more_steps | "
        "refine lm 20 sharpen=4 | plus 5 } | best 1 | score verified | refine lm 15 sharpen=1";
    variants["pass"] = pass;
    variants["default"] = "pass | " + until + "3 { pass | plus 2 }";
    // Starts near the target. The best are brought nearer to it under all common errors of making at once,
    // on a grid whose curves cost a fifth first.
    variants["made"] = "shape 96 | score | best 32 | refine lm 12 | coarser 1 { score made | best 10 | "
                       "refine lm 15 | best 4 | "
                       "refine lm 30 | best 2 } | score made | refine lm 12 | best 2";
    // An area's, from coarser grids, whose curves cost less, to its own.
    variants["maps"] =
        "coarser 2 { shape 24 | score | best 8 | refine lm 15 | best 4 | refine lm 30 sharpen=10 | "
        "best 2 } | coarser 1 { score | refine lm 15 sharpen=5 | best 2 } | score | "
        "refine lm 12 sharpen=4 | best 1 | corrected { score | refine lm 12 sharpen=4 | best 1 } | "
        "score";
    // Stored genomes that are near already, brought nearer at once: the paper's in-line control.
    variants["in-line"] = "score | best 8 | refine lm 12 | best 4 | refine lm 30 sharpen=8 | best 2 | "
                          "refine lm 200 sharpen=5 | score verified | refine lm 16 sharpen=4";
    // The same effort without a target's shape in the starts and without cross-over: what chance brings.
    variants["multistart"] =
        "sample 60 | score | best 12 | refine lm 12 | best 4 | refine lm 60 sharpen=1 | "
        "until fitness 0.9995 generations 8 { sample 60 | score | best 12 | refine lm 12 | "
        "best 4 | refine lm 60 sharpen=1 | plus 4 } | best 2 | score verified | "
        "refine lm 16 sharpen=4";
    // A scan's own waves, brought back to what the scan answers: stiffness and area together.
    variants["like"] =
        "own 2 | fit | score | refine lm 30 sharpen=8 | score verified | refine lm 30 sharpen=4 | " + until +
        "20 { parents | mutate 0.1 gaussian 0.003 | score verified | "
        "refine lm 10 sharpen=1 | plus 2 }";
    // Selection, cross-over of length scales and mutation, no derivative.
    variants["plain"] = "score | best 50 | repeat 100 { tournament 2 | cross uniform rate=0.8 | "
                        "mutate 0.1 gaussian 0.05 | score | elite 2 } | best 1";
    // Two targets, one list of genomes for each (Cinat, Paggi and Gnecco 2019).
    variants["mcco"] =
        "pair(score goal1 | above 0.95 at_least=5 | reduce goal1, score goal2 | above 0.95 at_least=5 | "
        "reduce goal2, unite) | score | best 3 | refine gcmma 3 genes=macro | refine gcmma 3 "
        "genes=micro | best 1";
    // What two targets cost each other: NSGA-II whose ends and children are refined.
    variants["nsga2"] =
        "shape 40 | score | best 20 | repeat 1 { score goal1 | refine lm 15 | parents } | repeat 1 "
        "{ score goal2 | refine lm 15 | parents } | pareto goal1 goal2 | best 40 | repeat 15 { "
        "tournament 2 | cross uniform rate=0.8 | mutate 0.05 gaussian 0.02 | score | refine lm 5 | "
        "parents | pareto goal1 goal2 | best 40 } | front";
    // Many surfaces of one response: elites of every wave length and skewness, moved along the gradients of
    // these and brought back to the target.
    variants["atlas"] =
        "shape 60 | score | best 24 | refine lm 30 sharpen=4 | repeat 60 { above 0.96 at_least=8 | "
        "emit 12 wavelength skewness sigma=0.07 | score | refine lm 25 sharpen=6 | "
        "map-elites wavelength skewness cells=20 } | best 40 | refine lm 25 sharpen=6";
    return variants;
}

} // namespace rough
