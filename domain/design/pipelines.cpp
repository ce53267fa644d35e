#include "domain/design/pipelines.hpp"

#include "domain/design/starts.hpp"
#include "ga/blocks/derived.hpp"

#include <boost/algorithm/string/replace.hpp>

#include <numbers>

namespace rough {
namespace {

/// The genome without its shortest wave; none if it has only one.
std::optional<Genome> without_shortest(const Genome& genome) {
    const auto scales = length_scales(genome);
    if (scales.size() < 2) return std::nullopt;
    const auto shortest = std::ranges::max_element(scales, {}, &LengthScale::wave_number);
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return std::ranges::count(shortest->members, std::pair(s, c)) == 0;
    });
}

using Designs = ga::Population<Genome>;

/// Evaluates designs at a level and passes each outcome, or null after a failure, to `read`.
template <class Read>
void read_outcomes(Designs& designs, ga::Level level, ga::Context<DesignProblem>& context, Read read) {
    const auto any = [](const auto&) { return true; };
    context.visit(designs, level, any, [&](auto& design, const ga::Evaluation<DesignOutcome>& evaluation) {
        read(std::get_if<DesignOutcome>(&evaluation));
        const std::size_t objective = level == level::verified ? context.objective_index("verified") : 0;
        design.fitness = ga::fitness_of(context.problem(), evaluation, context.problem().objectives()[objective],
                                        context.objective_name(objective));
    });
}

/// How far each design exceeds the limits; infinity without a response.
std::vector<double> excesses(Designs& designs, ga::Context<DesignProblem>& context) {
    std::vector<double> all;
    read_outcomes(designs, level::search, context,
                  [&](const DesignOutcome* outcome) { all.push_back(outcome ? outcome->excess : HUGE_VAL); });
    return all;
}

/// For each design, the variant that exceeds the limits least if its shortest waves are removed one by one.
Designs shortened(const Designs& designs, ga::Context<DesignProblem>& context) {
    Designs shorter;
    for (const auto& design : designs) {
        Designs tries{design};
        ga::Work work;
        for (auto next = without_shortest(design.genome); next; next = without_shortest(*next)) {
            tries.push_back(design);
            tries.back().genome = with_fitting_amplitude(context.problem().setup(), *next);
            work.price += context.problem().levels()[0].evaluation * fitting_price(context.problem().setup());
            context.make_child(tries.back(), ga::Parents(design.identity));
        }
        context.charge({&work, 1});
        const std::vector<double> exceeded = excesses(tries, context);
        shorter.push_back(tries[static_cast<std::size_t>(std::ranges::min_element(exceeded) - exceeded.begin())]);
    }
    return shorter;
}

/// A block that runs `body` under the problem of the set-up change(setup, n).
DesignPipeline under(const std::string& name, int n, const DesignPipeline& body,
                     DesignSetup (*change)(DesignSetup, int)) {
    return ga::derived_stage<DesignProblem>(
        n > 0 ? name + " " + std::to_string(n) : name, body,
        [=](Designs designs, const DesignPipeline& stages, ga::Context<DesignProblem>& context) {
            const DesignProblem& problem = context.problem();
            return run_derived(stages, problem.with(change(problem.setup(), n)), std::move(designs), context);
        });
}

DesignPipeline coarser(const ga::Arguments& arguments, const DesignPipeline& body) {
    return under("coarser", static_cast<int>(arguments.count("n")), body, on_coarser_grid);
}

DesignPipeline smooth(const ga::Arguments&, const DesignPipeline& body) {
    return under("smooth", 0, body, [](DesignSetup setup, int) {
        setup.smooth_area = true;
        return setup;
    });
}

DesignPipeline in_more_steps(const ga::Arguments& arguments, const DesignPipeline& body) {
    return under("more-steps", static_cast<int>(arguments.count("n")), body, in_finer_steps);
}

/// Runs `body` on the first individual under corrected targets; the given population follows its result.
DesignPipeline corrected(const ga::Arguments&, const DesignPipeline& body) {
    return ga::derived_stage<DesignProblem>(
        "corrected", body, [](Designs designs, const DesignPipeline& stages, ga::Context<DesignProblem>& context) {
            std::vector<DesignOutcome> outcomes;
            for (const ga::Level level : {level::search, level::verified}) {
                Designs first{designs.front()};
                read_outcomes(first, level, context, [&](const DesignOutcome* outcome) {
                    if (outcome) outcomes.push_back(*outcome);
                });
            }
            if (outcomes.size() < 2) return designs;
            const DesignProblem& problem = context.problem();
            Designs all = run_derived(
                stages, problem.with(corrected_targets(problem.setup(), outcomes[0].misfits, outcomes[1].misfits)),
                {designs.front()}, context);
            for (auto& design : all) context.make_child(design, ga::Parents(designs.front().identity));
            all.insert(all.end(), designs.begin(), designs.end());
            return all;
        });
}

/// Runs `body` on the designs shortened(), followed by the given ones, unless a design keeps the limits.
DesignPipeline within_limits(const ga::Arguments&, const DesignPipeline& body) {
    ga::Stage<DesignProblem> stage;
    stage.text = "within-limits { " + body.text() + " }";
    stage.check = [body](ga::CheckState& known) {
        body.check(known);
        body.check_end(known);
    };
    stage.apply = [body](Designs designs, ga::Context<DesignProblem>& context) {
        const std::vector<double> over = excesses(designs, context);
        if (std::ranges::any_of(over, [](double excess) { return excess <= 0; })) return designs;
        Designs all = shortened(designs, context);
        all.insert(all.end(), designs.begin(), designs.end());
        return body(std::move(all), context);
    };
    return stage;
}

} // namespace

ga::Registry<DesignProblem> design_registry(const DesignSetup& setup) {
    const auto fit = [setup](const Genome& genome, ga::Work& work) {
        work.price += fitting_price(setup);
        return with_fitting_amplitude(setup, genome);
    };
    auto registry = paper_registry({.rule = std::make_shared<DominanceRule>(setup.model), .fitted = fit});
    // A stage that replaces the population by n genomes, the i-th from make(setup, i, stream, work).
    const auto start = [&](const char* name, const char* meaning, auto make) {
        registry.add({name, "roughness", meaning, {ga::whole("n", std::nullopt, 1, "how many")}},
                     [name, make](const ga::Arguments& a, const auto&...) -> DesignPipeline {
                         const std::size_t n = a.count("n");
                         ga::Stage<DesignProblem> stage;
                         stage.text = name + (" " + std::to_string(n));
                         stage.check = [](ga::CheckState& known) { known.scored.reset(); };
                         stage.begins = true;
                         stage.apply = [n, make](Designs, ga::Context<DesignProblem>& context) {
                             Designs fresh(n);
                             std::vector<ga::Work> work(n);
                             ga::parallel_for(n, context.threads(), [&](std::size_t i) {
                                 fresh[i].genome = make(context.problem().setup(), i, context.stream(i), work[i]);
                             });
                             context.charge(work);
                             for (auto& design : fresh) design.identity = context.new_identity();
                             return fresh;
                         };
                         return stage;
                     });
    };
    start("shape", "replaces the population by n genomes that are made for the target, with contact solved backwards",
          [](const DesignSetup& given, std::size_t, ga::Stream random, ga::Work&) {
              return shaped_start(given, random);
          });
    start("own",
          "replaces the population by n sums of the measured profile's waves, each of half as many waves as "
          "the one before; for a map by sums of random waves with its spectrum",
          [](const DesignSetup& given, std::size_t i, ga::Stream random, ga::Work& work) {
              if (given.measured && given.measured->is_2d()) return waves_like(given, random);
              work.price += scan_waves_price(given);
              return scan_waves(given, max_scan_waves(given) >> i);
          });
    registry.add("fit", "roughness",
                 "sets each genome's amplitude to fit the first target best; does nothing under Eq. 11",
                 ga::transform("fit", fit));
    for (std::size_t g = 0; g < setup.targets.size(); ++g) {
        const std::string name = "reduce goal" + std::to_string(g + 1);
        registry.add(name, "roughness", "keeps the chromosomes whose curve alone follows this target (M-CCO)",
                     ga::transform(name, [setup, g](const Genome& genome, ga::Work& work) {
                         return reduced_to_target(setup, genome, g, work);
                     }));
    }
    const auto block = [&](const char* name, const char* meaning, std::vector<ga::Parameter> parameters,
                           DesignPipeline (*make)(const ga::Arguments&, const DesignPipeline&)) {
        registry.add({name, "roughness", meaning, std::move(parameters), "", 1},
                     [make](const ga::Arguments& a, const std::vector<DesignPipeline>& bodies, const auto&) {
                         return make(a, bodies[0]);
                     });
    };
    block("coarser", "runs the pipeline on a grid with half the nodes along each side, n times",
          {ga::whole("n", std::nullopt, 1, "how often the nodes are halved")}, coarser);
    block("more-steps", "runs the pipeline in n times the load steps",
          {ga::whole("n", std::nullopt, 2, "the factor").up_to(64)}, in_more_steps);
    block("smooth",
          "runs the pipeline with contact fractions smoothed as in the derivatives, instead of counts of "
          "nodes",
          {}, smooth);
    block("corrected",
          "runs the pipeline on the first individual, with targets corrected by the change of its curve on "
          "the finer grid and in finer load steps",
          {}, corrected);
    block("within-limits",
          "if no individual keeps the limits on shape, runs the pipeline on each without its shortest waves", {},
          within_limits);
    const double length = setup.model.grid.length;
    // The phases of waves whose wavelength (mm) is at least `from` and below `to`.
    const auto waves = [&](const std::string& name, double from, double to, PhaseReach reach,
                           const std::string& meaning) {
        const auto phases = [=](const Genome& genome) {
            return phase_variables(genome, reach, [&](std::size_t s, std::size_t c) {
                const double wave = wave_length(genome.series[s], genome.series[s].chromosomes[c].n);
                return wave >= from && wave < to;
            });
        };
        registry.add(ga::Variables<Genome>{name, phases}, meaning);
    };
    waves("macro", length / 8, HUGE_VAL, {}, "phases of waves of at least an eighth of the length");
    waves("micro", 0, length / 8, {}, "phases of shorter waves");
    for (const int parts : {1, 2, 4, 8, 16, 32, 64}) {
        const std::string part = std::to_string(parts);
        const PhaseReach free{0, std::numbers::pi};
        waves("longer-" + part, length / parts, HUGE_VAL, free,
              "phases of waves of L/" + part + " and longer, without limits");
        waves("shorter-" + part, 0, length / parts, free, "phases of waves below L/" + part + ", without limits");
    }
    return registry;
}

DesignPipeline design_pipeline(const DesignSetup& setup, const std::string& text) {
    ga::Parser<DesignProblem> parser(design_registry(setup), design_variants(setup.required_similarity));
    DesignPipeline pipeline = parser.parse(text);
    if (setup.limits.any_shape() && pipeline.text().find("within-limits") == std::string::npos)
        pipeline.append(parser.parse("within-limits { score | refine lm 40 | best 1 }"));
    return pipeline;
}

std::string usual_variant(const DesignSetup& setup, bool stored) {
    const bool wants_contact_area = std::ranges::any_of(setup.targets, is_contact_fraction, &Target::quantity);
    const bool is_like = setup.measured && wants_contact_area;
    if (setup.model.grid.is_2d()) return stored ? "maps-in-line" : is_like ? "maps-like" : "maps";
    return stored ? "in-line" : setup.errors.any() ? "made" : is_like ? "like" : "default";
}

extern const char* const design_variants_ini; // variants.ini (.cmake/data.cmake)

ga::Variants design_variants(double required) {
    ga::Variants variants =
        variants_in(boost::replace_all_copy<std::string>(design_variants_ini, "{required}", ga::number(required)));
    variants.merge(paper_variants());
    return variants;
}

} // namespace rough
