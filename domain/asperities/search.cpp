#include "domain/asperities/design.hpp"
#include "domain/design/explore.hpp"
#include "domain/errors.hpp"
#include "ga/blocks/derived.hpp"
#include "ga/text/whole_vocabulary.hpp"

namespace rough {

/// @cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CapArray, columns, rows, pitch)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(GeneRange, from, to, step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CapSetup, array, effective_modulus, heights, radii, model, targets,
                                   required_similarity, positions)
/// @endcond

namespace {

using CapDesigns = ga::Population<CapGenome>;
using CapPipeline = ga::Pipeline<CapProblem>;

constexpr double search_share = 0.6;       ///< share of the time that is not for boundary elements
constexpr double different_heights = 0.05; ///< rms difference of sorted heights over their range

/// Nearly the largest misfit, but smaller if fewer rows have it.
double cost_of(const Eigen::VectorXd& r) {
    const double largest = r.cwiseAbs().maxCoeff();
    return largest > 0 ? largest * std::pow((r / largest).array().pow(8).sum(), 0.125) : 0;
}

/// Rounds genes to their steps, then moves single genes by a step while that lowers the misfits of the linear
/// model. Repeats this from the best point on the steps. After the first repetition without success, it makes
/// one move at a time, and tries each move once.
Eigen::VectorXd rounded(const ga::Landscape& land, const CapProblem& problem, std::size_t evaluations) {
    const auto range = [&](Index i) { return problem.range(static_cast<std::size_t>(i)); };
    Eigen::VectorXd best = land.start, centre = best; // the linear model is around `centre`
    for (Index i = 0; i < best.size(); ++i) best[i] = range(i).nearest(best[i]);
    auto model = land.sensitivity(centre);
    double lowest = HUGE_VAL; // cost of `best`
    Index moves = 4 * best.size();
    std::set<std::pair<Index, double>> failed; // single moves from the best point
    for (std::size_t used = 1; model && used < evaluations && !land.exhausted(); ++used) {
        Eigen::VectorXd x = best, r = model->residuals + model->jacobian * (x - centre);
        std::pair<Index, double> move;
        for (Index moved = 0; moved < moves; ++moved) {
            double lowest = cost_of(r) * (1 - 1e-9), by = 0;
            for (Index i = 0; i < x.size(); ++i)
                for (const double step : {range(i).step, -range(i).step}) {
                    const double to = range(i).nearest(x[i] + step);
                    if (to == x[i] || failed.contains({i, to})) continue;
                    const double next = cost_of(r + (to - x[i]) * model->jacobian.col(i));
                    if (next < lowest) lowest = next, move = {i, to}, by = to - x[i];
                }
            if (by == 0) break;
            x[move.first] = move.second;
            r += by * model->jacobian.col(move.first);
        }
        if (x == best && lowest < HUGE_VAL) break;
        const auto at = land.sensitivity(x);
        const double cost = at ? cost_of(at->residuals) : HUGE_VAL;
        if (cost < lowest || lowest == HUGE_VAL) {
            lowest = cost, best = centre = x, model = at;
            failed.clear();
        } else if (moves > 1)
            moves = 1;
        else
            failed.insert(move);
    }
    return best;
}

/// `round N`: every genome on the steps of its genes, found with at most N gradients.
CapPipeline round_stage(std::size_t evaluations) {
    ga::Stage<CapProblem> stage;
    stage.text = "round " + std::to_string(evaluations);
    stage.check = [text = stage.text](ga::CheckState& known) {
        known.need_one_objective(text);
        known.scored.reset();
    };
    stage.apply = [evaluations](CapDesigns designs, ga::Context<CapProblem>& context) {
        const CapProblem& problem = context.problem();
        const ga::Method rounding{"round",
                                  [&](const ga::Landscape& land) { return rounded(land, problem, evaluations); }};
        ga::Rounds<CapProblem>::run(designs.size(), context.queue(), context.ledger().evaluator().threads(),
                                    [&](std::size_t i, ga::EvaluationQueue<CapProblem>& queue) {
                                        if (designs[i].fitness.has_failed()) return;
                                        auto found = ga::Search<CapProblem>(problem, queue, context.watch(), designs[i],
                                                                            problem.bounds(designs[i].genome), 1 << 20)
                                                         .by(rounding, 0);
                                        if (found) designs[i].genome = std::move(*found);
                                    });
        for (auto& design : designs) context.make_child(design, ga::Parents(design.identity));
        return designs;
    };
    return stage;
}

/// The method `exchange` of `mutate`: each cap changes places with another by its chance.
struct ExchangeCaps : ga::NoParameters {
    [[maybe_unused]] static constexpr const char* needs = "caps";
    static ga::Words words() {
        return {"exchange", "asperities", "exchanges the places of caps, which changes interaction only"};
    }
    bool operator()(const CapProblem& problem, CapGenome& genome, const ga::Chance& chance, ga::Stream& random) const {
        const CapGenome before = genome;
        const auto caps = static_cast<std::size_t>(problem.setup().array.caps());
        chance.each(caps, random, [&](std::size_t a) {
            const std::size_t b = random.below(caps);
            for (std::size_t first = 0; first < genome.size(); first += caps)
                std::swap(genome[first + a], genome[first + b]);
        });
        return genome != before;
    }
};

/// Runs `body` with_independent_caps(), with targets corrected for the first individual if `corrected`.
CapPipeline independent_stage(const std::string& name, const CapPipeline& body, bool corrected) {
    return ga::derived_stage<CapProblem>(
        name, body, [corrected](CapDesigns designs, const CapPipeline& stages, ga::Context<CapProblem>& context) {
            const CapGenome* like = corrected && !designs.empty() ? &designs.front().genome : nullptr;
            const CapProblem problem(with_independent_caps(context.problem().setup(), like));
            if (like) // its curves by both models
                context.counters().requested += 2, context.counters().evaluations += 2;
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
    for (const Index k : points) at.push_back(target.x[k] * (target.against_pressure() ? nominal : 1));
    CapVerification found;
    try {
        found.meshed =
            pressed_on_mesh(caps, setup.effective_modulus, at, target.against_pressure(), setup.nodes, options);
    } catch (const NotConverged&) {
        if (!is_stopped(options)) throw;
        return found; // not verified
    }
    found.similarity = 1;
    for (std::size_t s = 0; s < points.size(); ++s) {
        const MeshedCaps& mesh = found.meshed[s];
        const double value = value_of(setup, target.quantity, mesh.load, mesh.area.sum(), mesh.stiffness);
        found.similarity = std::min(found.similarity, 1 - std::abs(misfit(target, points[s], value)));
        const CapState state = contact.at_load(caps, mesh.load);
        found.area_error = std::max(found.area_error, std::abs(state.total_area() / mesh.area.sum() - 1));
        found.force_error =
            std::max(found.force_error, (state.force - mesh.force).cwiseAbs().maxCoeff() / mesh.force.maxCoeff());
        found.states.push_back(state);
    }
    found.seconds = clock.seconds();
    return found;
}

/// The operators of text pipelines for caps.
ga::Registry<CapProblem> cap_registry() {
    auto registry = ga::whole_vocabulary<CapProblem>();
    registry.add({"round",
                  "asperities",
                  "puts every gene on its steps, with single steps that repair the curve",
                  {ga::whole("evaluations", "200", 1, "maximum number of gradients").up_to(1e6)}},
                 [](const ga::Arguments& a, const auto&...) { return round_stage(a.count("evaluations")); });
    for (const auto& [name, meaning] :
         {std::pair("independent", "runs the pipeline without interaction of caps, for areas at pressures"),
          {"corrected", "as independent, with targets corrected for the first individual's interaction"}})
        registry.add(
            {name, "asperities", meaning, {}, "", 1},
            [name = std::string(name)](const ga::Arguments&, const std::vector<CapPipeline>& bodies, const auto&...) {
                return independent_stage(name, bodies[0], name == "corrected");
            });
    registry.add<ga::Mutate<ExchangeCaps>>();
    return registry;
}

} // namespace

ga::Variants cap_variants(const CapSetup& setup) {
    ga::Variants variants;
    // Random caps, refined by least squares, then for the smallest largest misfit; at last on the steps.
    variants["pass"] = "independent { sample 1000 | score | best 30 | refine lm 60 | best 8 | "
                       "refine lm 150 sharpen=30 } | score | best 3 | refine lm 30 sharpen=1 | round 200 | "
                       "score | best 1";
    const double enough = 1 - 0.5 * (1 - setup.required_similarity);
    const bool is_beyond =
        std::ranges::any_of(out_of_reach(setup), [&](const OutOfReach& reason) { return reason.bound < enough; });
    variants["default"] =
        "pass" +
        (is_beyond ? "" // further passes would not reach it
                   : " | until fitness " + ga::number(enough) + " generations 4 { pass | plus 1 }" +
                         (setup.positions ? " | repeat 30 { parents | mutate 0.05 exchange | score | plus 1 }" : ""));
    variants["genetic"] = "independent { sample 50 | score | repeat 500 { tournament 2 | cross uniform | "
                          "mutate 0.03 | score | elite 2 } | best 3 } | score";
    return variants;
}

CapSearch search(const CapSetup& setup, const SearchOptionsOf<CapProblem>& options,
                 std::vector<ga::Observer<CapGenome>> observers) {
    const ga::Stopwatch clock;
    const CapProblem problem(setup);
    CapSearch result;
    const std::string text = options.pipeline.empty() ? "default" : options.pipeline;
    const ga::Variants variants = cap_variants(setup);
    ga::Parser<CapProblem> parser(cap_registry(), variants);
    const CapPipeline pipeline = parser.parse(text);
    std::vector<CapGenome> starts = options.starts;
    if (starts.empty()) {
        ga::Stream random(options.seed);
        starts.push_back(problem.sample(random));
    }
    Exploration<CapProblem> explored(problem, 1, "similarity");
    explored.run(pipeline, variants.count(text) ? text : "pipeline", starts, options, search_share * options.seconds,
                 std::move(observers));
    static_cast<SearchRun&>(result) = explored.spent;

    const auto on_steps = [&](CapGenome genome) {
        for (std::size_t g = 0; g < genome.size(); ++g) genome[g] = problem.range(g).nearest(genome[g]);
        return genome;
    };
    const auto offer = [&](const CapGenome& genome) {
        const CapProblem::Outcome misfits = problem.evaluate(genome);
        explored.offer(genome, min_similarity(misfits));
        return similarities(misfits);
    };
    std::vector<ga::Point> points;
    for (CapGenome& genome : explored.front) points.push_back(offer(genome = on_steps(genome)));
    auto& seen = explored.seen.members;
    const CapGenome nearest = seen.empty() ? explored.nearest.value_or(starts.front()) : seen.front().genome;
    std::erase_if(seen, [&](const auto& one) { return one.genome != on_steps(one.genome); });
    if (seen.empty()) // the pipeline ended before `round`
        offer(on_steps(nearest));
    const auto ranks = ga::pareto_ranks(points);
    for (std::size_t i = 0; i < ranks.size() && result.front.size() < max_compromises; ++i)
        if (ranks[i] == 0) result.front.emplace_back(explored.front[i], points[i]);
    result.best = {seen.front().genome, seen.front().value()};
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
        result.alternatives.push_back({genome, min_similarity(problem.evaluate(genome)), difference});
    result.seconds = clock.seconds();
    ContactOptions contact;
    contact.stop = ending_after(options.seconds - clock.seconds(), options.stop);
    result.best.verification = verified(setup, result.best.genome, contact);
    return result;
}

} // namespace rough
