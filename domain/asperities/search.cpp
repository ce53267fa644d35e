#include "domain/asperities/design.hpp"
#include "domain/design/explore.hpp"
#include "domain/errors.hpp"
#include "ga/blocks/derived.hpp"
#include "ga/refinement/refine.hpp"

namespace rough {

/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CapOutcome, misfits)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CapArray, columns, rows, pitch)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GeneRange, from, to, step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CapSetup, array, effective_modulus, heights, radii, model, targets,
                                   required_similarity, positions)
/// @endcond

namespace {

using Designs = ga::Population<CapGenome>;
using CapStage = ga::Stage<CapProblem>;

constexpr std::size_t hall_size = 60;       ///< best individuals of all stages that are kept
constexpr std::size_t max_compromises = 24; ///< size of the Pareto front
constexpr double search_share =
    0.6; ///< share of the time for the pipeline; boundary elements take the remainder
constexpr double different_heights = 0.05; ///< rms difference of sorted heights over their range

/// Rounds the genes to their steps, then moves single genes by a step while that lowers the misfits of the
/// linear model. Repeats this from the best point on the steps. If the misfits did not fall, it makes half
/// as many moves. At last it makes one move at a time, and tries each move once.
struct RoundGenes {
    std::vector<GeneRange> ranges; ///< values of each gene
    int evaluations = 200;

    Eigen::VectorXd improve(const ga::Landscape& land) const {
        ga::BestPoint best;
        auto model = land.sensitivity(land.start);
        Eigen::VectorXd centre = land.start, x = on_steps(centre);
        Index moves = 4 * x.size();
        std::vector<Eigen::VectorXd> failed; // points tried with one move from the best
        for (int used = 1; model && used < evaluations && !land.exhausted(); ++used) {
            x = moved(best.x.size() > 0 ? best.x : x, centre, *model, land, moves, failed);
            if (best.x.size() > 0 && x == best.x)
                break;
            const auto at = land.sensitivity(x);
            const double merit = at ? -cost(at->residuals) : -HUGE_VAL;
            if (best.x.size() == 0 || merit > best.merit) {
                best.offer(x, merit);
                model = at, centre = x;
                failed.clear();
            } else if (moves > 1)
                moves /= 2;
            else
                failed.push_back(x);
        }
        return best.x.size() > 0 ? best.x : on_steps(land.start);
    }

  private:
    /// Nearly the largest misfit, but smaller if fewer rows have it.
    static double cost(const Eigen::VectorXd& r) {
        const double largest = r.cwiseAbs().maxCoeff();
        return largest > 0 ? largest * std::pow((r / largest).array().pow(8).sum(), 0.125) : 0;
    }
    Eigen::VectorXd on_steps(Eigen::VectorXd x) const {
        for (Index i = 0; i < x.size(); ++i)
            if (const auto& [from, to, step] = ranges[static_cast<std::size_t>(i)]; step > 0)
                x[i] = from + step * std::round((x[i] - from) / step);
        return x;
    }
    /// At most `moves` from x by the linear model around `centre`, without the points that have failed.
    Eigen::VectorXd moved(Eigen::VectorXd x, const Eigen::VectorXd& centre, const ga::Sensitivity& model,
                          const ga::Landscape& land, Index moves,
                          const std::vector<Eigen::VectorXd>& failed) const {
        Eigen::VectorXd r = model.residuals + model.jacobian * (x - centre);
        double now = cost(r);
        for (Index move = 0; move < moves; ++move) {
            Index gene = -1;
            double by = 0, lowest = now * (1 - 1e-9);
            const auto try_step = [&](Index i, double step) {
                const double to = x[i] + step, next = cost(r + step * model.jacobian.col(i));
                if (step == 0 || to < land.lower[i] - 1e-12 || to > land.upper[i] + 1e-12 || next >= lowest)
                    return;
                for (const Eigen::VectorXd& point : failed)
                    if (std::abs(point[i] - to) < 0.5 * std::abs(step))
                        return;
                lowest = next, gene = i, by = step;
            };
            for (Index i = 0; i < x.size(); ++i)
                for (const double sign : {1, -1})
                    try_step(i, sign * ranges[static_cast<std::size_t>(i)].step);
            if (gene < 0)
                break;
            x[gene] += by;
            r += by * model.jacobian.col(gene);
            now = lowest;
        }
        return on_steps(x);
    }
};

/// `round N`: every scored genome on the steps of its genes, found with at most N gradients.
CapStage round_stage(const CapSetup& setup, int evaluations) {
    const CapProblem problem(setup);
    RoundGenes method;
    method.evaluations = evaluations;
    for (const ga::Variable& variable : problem.bounds({}))
        method.ranges.push_back(problem.range(variable.gene));
    ga::Step<CapProblem> step;
    step.text = "round " + std::to_string(evaluations);
    step.check = [text = step.text](ga::CheckState& known) {
        known.need_one_objective(text);
        known.scored.reset();
    };
    step.apply = [method](Designs designs, ga::Context<CapProblem>& context) {
        const ga::Method rounding{"round", [&](const ga::Landscape& land) { return method.improve(land); }};
        ga::Rounds<CapProblem>::run(
            designs.size(), context.door(), [&](std::size_t i, ga::EvaluationQueue<CapProblem>& door) {
                if (designs[i].fitness.has_failed())
                    return;
                auto found = ga::Search<CapProblem>(context.problem(), door, context.watch(), designs[i],
                                                    context.problem().bounds(designs[i].genome), 1 << 20)
                                 .by(rounding, 0);
                if (found)
                    designs[i].genome = std::move(*found);
            });
        for (auto& design : designs)
            context.make_child(design, ga::Parents(design.identity));
        return designs;
    };
    return step;
}

/// `exchange RATE`: each cap changes places with another by this chance.
CapStage exchange_stage(double rate) {
    ga::Step<CapProblem> step;
    step.text = "exchange " + ga::number(rate);
    step.check = [](ga::CheckState& known) { known.scored.reset(); };
    step.apply = [rate](Designs designs, ga::Context<CapProblem>& context) {
        const auto caps = static_cast<std::size_t>(context.problem().setup().array.caps());
        for (std::size_t i = 0; i < designs.size(); ++i) {
            ga::Stream random = context.stream(i);
            CapGenome& genome = designs[i].genome;
            for (std::size_t a = 0; a < caps; ++a)
                if (random.chance(rate)) {
                    const std::size_t b = random.below(caps);
                    for (std::size_t first = 0; first < genome.size(); first += caps)
                        std::swap(genome[first + a], genome[first + b]);
                }
            context.make_child(designs[i], ga::Parents(designs[i].identity));
        }
        return designs;
    };
    return step;
}

/// Runs `body` under independent caps (with_independent_caps). `corrected`: the targets are corrected for the
/// first individual.
CapStage independent_stage(const std::string& name, const CapStage& body, bool corrected) {
    return ga::derived_step<CapProblem>(
        name, body, [corrected](Designs designs, const CapStage& stages, ga::Context<CapProblem>& context) {
            const CapGenome* like = corrected && !designs.empty() ? &designs.front().genome : nullptr;
            const CapProblem problem(with_independent_caps(context.problem().setup(), like));
            if (like) // its curves by both models
                context.counters().asked += 2, context.counters().evaluations += 2;
            return run_derived(stages, problem, std::move(designs), context);
        });
}

/// Solves the caps at the first, the middle and the last point of the first target by boundary elements.
CapVerification verified(const CapSetup& setup, const CapGenome& genome, const ContactOptions& options) {
    const ga::Stopwatch clock;
    const Target& target = setup.targets.front();
    const double nominal = setup.array.nominal_area();
    const Caps caps = caps_of(setup, genome);
    const CapContact contact(setup.array, setup.effective_modulus, setup.model);
    std::vector<Index> points{0, target.points() / 2, target.points() - 1};
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<double> at;
    for (const Index k : points)
        at.push_back(target.x[k] * (target.against_pressure() ? nominal : 1));
    CapVerification found;
    try {
        found.meshed = pressed_on_mesh(caps, setup.effective_modulus, at, target.against_pressure(),
                                       setup.nodes, options);
    } catch (const NotConverged&) {
        if (!is_stopped(options))
            throw;
        return found; // not verified
    }
    found.similarity = 1;
    for (std::size_t s = 0; s < points.size(); ++s) {
        const MeshedCaps& mesh = found.meshed[s];
        const double value = value_of(setup, target.quantity, mesh.load, mesh.area.sum(), mesh.stiffness);
        found.similarity = std::min(found.similarity, 1 - std::abs(misfit(target, points[s], value)));
        const PressedCaps pressed = contact.at_load(caps, mesh.load);
        found.area_error = std::max(found.area_error, std::abs(pressed.total_area() / mesh.area.sum() - 1));
        found.force_error = std::max(found.force_error, (pressed.force - mesh.force).cwiseAbs().maxCoeff() /
                                                            mesh.force.maxCoeff());
        found.pressed.push_back(pressed);
    }
    found.seconds = clock.seconds();
    return found;
}

} // namespace

ga::Registry<CapProblem> cap_registry(const CapSetup& setup) {
    auto registry = cap_engine_words();
    registry.add({"round",
                  "asperities",
                  "puts every gene on its steps, with single steps that repair the curve",
                  {ga::whole("evaluations", "200", 1, "maximum number of gradients").up_to(1e6)}},
                 [setup](const ga::Arguments& a, const auto&...) {
                     return round_stage(setup, static_cast<int>(a.count("evaluations")));
                 });
    for (const auto& [name, meaning] :
         {std::pair("independent",
                    "runs the pipeline with caps that do not interact, if all targets are areas against "
                    "pressure"),
          {"corrected",
           "as independent, with targets corrected for the interaction of the first individual"}})
        registry.add({name, "asperities", meaning, {}, "", 1},
                     [name = std::string(name)](const ga::Arguments&, const std::vector<CapStage>& bodies,
                                                const auto&...) {
                         return independent_stage(name, bodies[0], name == "corrected");
                     });
    registry.add({"exchange",
                  "asperities",
                  "exchanges the places of caps, which changes interaction only",
                  {ga::number("rate", std::nullopt, 0, 1, "a cap's chance to change places")}},
                 [](const ga::Arguments& a, const auto&...) { return exchange_stage(a.number("rate")); });
    return registry;
}

ga::Variants cap_variants(const CapSetup& setup) {
    ga::Variants variants;
    // Random caps, refined by least squares and then for the smallest largest misfit, first as independent
    // caps, on the steps at last.
    variants["pass"] = "independent { sample 1000 | score | best 30 | refine lm 60 | best 8 | "
                       "refine lm 150 sharpen=30 } | score | best 3 | refine lm 30 sharpen=1 | round 200 | "
                       "score | best 1";
    const std::string enough = ga::number(1 - 0.5 * (1 - setup.required_similarity));
    variants["default"] =
        "pass | until fitness " + enough + " generations 4 { pass | plus 1 }" +
        (setup.positions ? " | repeat 30 { parents | exchange 0.05 | score | plus 1 }" : "");
    variants["genetic"] = "independent { sample 50 | score | repeat 500 { tournament 2 | cross uniform | "
                          "mutate 0.03 | score | elite 2 } | best 3 } | score";
    return variants;
}

double CapAnswer::lowest() const {
    return std::isnan(verification.similarity) ? verification.similarity
                                               : std::min(similarity, verification.similarity);
}

CapSearch search(const CapSetup& setup, const SearchOptionsOf<CapProblem>& options,
                 std::vector<ga::Observer<CapGenome>> observers) {
    const ga::Stopwatch clock;
    const CapProblem problem(setup);
    CapSearch result;
    const std::string text = options.pipeline.empty() ? "default" : options.pipeline;
    const ga::Variants variants = cap_variants(setup);
    ga::Parser<CapProblem> parser(cap_registry(setup), variants);
    const CapStage pipeline = parser.parse(text);
    std::vector<CapGenome> starts = options.starts;
    if (starts.empty()) {
        ga::Stream random(options.seed);
        starts.push_back(problem.sample(random));
    }
    Exploration<CapProblem> explored(problem, hall_size, 1, "similarity");
    explored.run(pipeline, variants.count(text) ? text : "pipeline", starts, options,
                 search_share * options.seconds, std::move(observers));
    static_cast<SearchRun&>(result) = explored.spent;

    const auto within = [&](CapGenome genome) {
        for (std::size_t g = 0; g < genome.size(); ++g)
            genome[g] = problem.range(g).nearest(genome[g]);
        return genome;
    };
    std::vector<ga::Point> points;
    for (CapGenome& genome : explored.front) {
        genome = within(genome);
        const CapOutcome outcome = problem.evaluate(genome);
        explored.offer(genome, outcome.similarity());
        points.push_back(similarities(outcome.misfits));
    }
    const auto nearest = explored.seen.members; // genomes of a pipeline that ends before `round`
    std::erase_if(explored.seen.members, [&](const auto& one) {
        for (std::size_t g = 0; g < one.genome.size(); ++g)
            if (std::abs(one.genome[g] - problem.range(g).nearest(one.genome[g])) > 1e-9)
                return true;
        return false;
    });
    if (explored.seen.members.empty()) {
        const CapGenome genome = within(!nearest.empty()   ? nearest.front().genome
                                        : explored.nearest ? *explored.nearest
                                                           : starts.front());
        explored.offer(genome, problem.evaluate(genome).similarity());
    }
    const auto ranks = ga::pareto_ranks(points);
    for (std::size_t i = 0; i < ranks.size() && result.front.size() < max_compromises; ++i)
        if (ranks[i] == 0)
            result.front.emplace_back(explored.front[i], points[i]);
    result.best = {explored.seen.members.front().genome, explored.seen.members.front().value()};
    result.alternatives = {result.best};
    const double range = std::max(setup.heights.to - setup.heights.from, 1e-300);
    for (const auto& [genome, difference] : explored.others_than(
             result.best.genome, options.alternatives, different_heights,
             [&](const CapGenome&genome) { // the curve of separate caps depends on the sorted depths only
                 Eigen::VectorXd heights = caps_of(setup, genome).heights;
                 std::sort(heights.begin(), heights.end());
                 return Eigen::VectorXd(heights.array() - heights.maxCoeff());
             },
             [&](const Eigen::VectorXd&a, const Eigen::VectorXd&b) {
                 return (a - b).norm() / std::sqrt(static_cast<double>(a.size())) / range;
             }))
        result.alternatives.push_back({genome, problem.evaluate(genome).similarity(), difference});
    result.seconds = clock.seconds();
    ContactOptions contact;
    contact.stop = ending_after(options.seconds - clock.seconds(), options.stop);
    result.best.verification = verified(setup, result.best.genome, contact);
    return result;
}

} // namespace rough
