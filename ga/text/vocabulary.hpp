#pragma once

#include "ga/ga.hpp"
#include "ga/text/registry.hpp"

namespace ga {

namespace words {

const char* const real_genes = "real genes: genes and with_genes, or a vector of double";
const char* const positions = "genes at positions: a random-access range";

template <Problem P>
void add_selection(Registry<P>& registry) {
    const auto add = [&](std::string name, std::string meaning, std::vector<Parameter> parameters,
                         auto make) {
        registry.add({std::move(name), "selection", std::move(meaning), std::move(parameters)},
                     [make](const Arguments& a, const auto&, const auto&) { return Stage<P>(make(a)); });
    };
    add("score", "evaluates what has no fitness under the objective",
        {word("objective", "", "one of the problem's; its first where none is given")},
        [](const Arguments& a) { return score(a.has("objective") ? a.word("objective") : ""); });
    add("best", "keeps the n best, best first", {whole("n", std::nullopt, 1, "how many")},
        [](const Arguments& a) { return best(a.count("n")); });
    const auto least = whole("at_least", "0", 0, "where fewer pass, so many nearest to passing are taken");
    add("above", "keeps those whose fitness is above the threshold",
        {number("threshold", std::nullopt, -no_limit, no_limit, "a fitness"), least},
        [](const Arguments& a) { return above(a.number("threshold"), at_least(a.count("at_least"))); });
    add("below", "keeps those whose fitness is below the threshold",
        {number("threshold", std::nullopt, -no_limit, no_limit, "a fitness"), least},
        [](const Arguments& a) { return below(a.number("threshold"), at_least(a.count("at_least"))); });
    add("tournament", "each place goes to the best of k drawn at random",
        {whole("k", "2", 1, "how many are drawn"),
         whole("size", "0", 0, "places; 0 for as many as there are")},
        [](const Arguments& a) { return tournament(a.count("k"), a.count("size")); });
    add("roulette", "chooses in proportion to the fitness above the worst", {},
        [](const Arguments&) { return roulette(); });
    add("sus", "the same by equally spaced marks on one spin", {}, [](const Arguments&) { return sus(); });
    add("rank", "chooses in linear proportion to the rank",
        {number("pressure", "1.5", 1.0001, 2, "expected places of the best")},
        [](const Arguments& a) { return rank(a.number("pressure")); });
    add("random", "keeps n at random, none twice, in random order",
        {whole("n", "0", 0, "how many; 0 for all")},
        [](const Arguments& a) { return at_random(a.count("n")); });
    add("pareto", "scores by NSGA-II's rank and crowding in several objectives",
        {{"objectives", Parameter::Kind::words, std::nullopt, -no_limit, no_limit,
          "two of the problem's or more"}},
        [](const Arguments& a) { return pareto(a.words("objectives")); });
    add("front", "keeps those that none dominates, after pareto", {},
        [](const Arguments&) { return front(); });
}

template <Problem P>
void add_crossover(Registry<P>& registry) {
    using G = typename P::Genome;
    const auto rate = number("rate", "1", 0, 1, "a pair's chance to be crossed");
    const auto entry = [&](const char* name, const char* meaning, std::vector<Parameter> parameters) {
        parameters.push_back(rate);
        return typename Registry<P>::Entry{std::string("cross ") + name, "cross-over", meaning,
                                           std::move(parameters)};
    };
    registry.template add_if<Crosses<Points, P>>(entry("one_point", "exchanges what lies beyond one cut", {}),
                                                 positions, [](const auto& a, const auto&, const auto&) {
                                                     return Stage<P>(cross(one_point(), a.number("rate")));
                                                 });
    registry.template add_if<Crosses<Points, P>>(
        entry("n_points", "exchanges every other piece between n cuts", {whole("n", "2", 1, "cuts")}),
        positions, [](const auto& a, const auto&, const auto&) {
            return Stage<P>(cross(n_points(a.count("n")), a.number("rate")));
        });
    registry.template add_if<Crosses<Uniform, P>>(
        entry("uniform", "exchanges each position with probability 1/2", {}), positions,
        [](const auto& a, const auto&, const auto&) { return Stage<P>(cross(uniform(), a.number("rate"))); });
    registry.template add_if<Crosses<Blend, P>>(
        entry("blend", "draws each gene uniformly around the parents' (BLX-alpha)",
              {number("alpha", "0.5", 0, no_limit, "how far beyond, in their distance")}),
        real_genes, [](const auto& a, const auto&, const auto&) {
            return Stage<P>(cross(blend(a.number("alpha")), a.number("rate")));
        });
    registry.template add_if<Crosses<SimulatedBinary, P>>(
        entry("sbx", "simulated binary cross-over, symmetric about the parents' mean",
              {number("eta", "15", 0, no_limit, "the greater, the nearer to the parents")}),
        real_genes, [](const auto& a, const auto&, const auto&) {
            return Stage<P>(cross(sbx(a.number("eta")), a.number("rate")));
        });
    registry.template add_if<std::same_as<G, Permutation>>(
        entry("order", "keeps a piece of one permutation in place and the other's order elsewhere", {}),
        "a permutation for a genome",
        [](const auto& a, const auto&, const auto&) { return Stage<P>(cross(order(), a.number("rate"))); });
}

template <Problem P>
void add_mutation(Registry<P>& registry) {
    const auto rate = number("rate", std::nullopt, 0, 1, "a gene's chance to mutate");
    const auto entry = [&](const char* name, const char* meaning, std::vector<Parameter> parameters) {
        parameters.insert(parameters.begin(), rate);
        return typename Registry<P>::Entry{std::string("mutate") + name, "mutation", meaning,
                                           std::move(parameters)};
    };
    registry.template add_if<Mutates<Natural, P>>(
        entry("", "the genome's natural mutation: its own, swap, reset or gaussian 0.1", {}),
        "a mutation of its own or genes",
        [](const auto& a, const auto&, const auto&) { return Stage<P>(mutate(a.number("rate"))); });
    registry.template add_if<Mutates<Gaussian, P>>(
        entry(" gaussian", "adds a normal step",
              {number("sigma", "0.1", above_zero, no_limit, "deviation, in widths between bounds")}),
        real_genes, [](const auto& a, const auto&, const auto&) {
            return Stage<P>(mutate(a.number("rate"), gaussian(a.number("sigma"))));
        });
    registry.template add_if<Mutates<UniformStep, P>>(
        entry(" uniform", "adds a uniform step",
              {number("step", "0.1", above_zero, no_limit, "largest step, in widths between bounds")}),
        real_genes, [](const auto& a, const auto&, const auto&) {
            return Stage<P>(mutate(a.number("rate"), uniform_step(a.number("step"))));
        });
    registry.template add_if<Mutates<Polynomial, P>>(
        entry(" polynomial", "adds a step of polynomial density",
              {number("eta", "20", above_zero, no_limit, "the greater, the smaller")}),
        "real genes with bounds", [](const auto& a, const auto&, const auto&) {
            return Stage<P>(mutate(a.number("rate"), polynomial(a.number("eta"))));
        });
    registry.template add_if<Mutates<Reset, P>>(
        entry(" reset", "draws the gene anew; flips a bit", {}), "bits, or genes with bounds",
        [](const auto& a, const auto&, const auto&) { return Stage<P>(mutate(a.number("rate"), reset())); });
    registry.template add_if<Mutates<Swap, P>>(
        entry(" swap", "exchanges the gene with another of the genome", {}), "genes that may change places",
        [](const auto& a, const auto&, const auto&) { return Stage<P>(mutate(a.number("rate"), swap())); });
    registry.template add_if<Mutates<Reverse, P>>(
        entry(" reverse", "turns round the piece between the gene and another", {}),
        "genes that may change places", [](const auto& a, const auto&, const auto&) {
            return Stage<P>(mutate(a.number("rate"), reverse()));
        });
    registry.template add_if<Sampled<P>>(
        {"sample",
         "mutation",
         "n new individuals drawn at random in the population's place",
         {whole("n", std::nullopt, 1, "how many")}},
        "a problem that samples genomes",
        [](const auto& a, const auto&, const auto&) { return Stage<P>(sample(a.count("n"))); });
}

/// The choice of genes that a stage names; every gene within the problem's bounds where none is named.
template <Problem P, class M>
Stage<P> refined(M method, const Arguments& a, const Registry<P>& registry) {
    std::vector<std::string> names;
    for (const auto& [variables, meaning] : registry.variables()) {
        if (variables.name == a.word("genes"))
            return Stage<P>(refine(std::move(method), variables));
        names.push_back(variables.name);
    }
    if constexpr (Bounded<P>) {
        if (a.word("genes") == EveryGene().name)
            return Stage<P>(refine(std::move(method)));
        names.push_back(EveryGene().name);
    }
    a.refuse("genes", "unknown genes '" + a.word("genes") + "'" + suggestion(a.word("genes"), names));
}

template <Problem P>
void add_refinement(Registry<P>& registry) {
    const auto genes = word("genes", "all", "which genes move, and how far");
    const auto evaluations = whole("evaluations", std::nullopt, 1, "at most, after the start");
    const auto entry = [&](const char* name, const char* meaning, std::vector<Parameter> parameters) {
        parameters.push_back(genes);
        return typename Registry<P>::Entry{std::string("refine ") + name, "refinement", meaning,
                                           std::move(parameters)};
    };
    const char* const residuals = "residuals with their derivatives: sensitivity";
    registry.template add_if<Refinable<P, Gcmma>>(
        entry("gcmma", "GCMMA on s|s|, s = 1 - max|r|: the paper's", {evaluations}), residuals,
        [](const auto& a, const auto&, const auto& r) {
            return refined(gcmma(a.integer("evaluations")), a, r);
        });
    registry.template add_if<Refinable<P, Gcmma>>(
        entry("minimax", "GCMMA on the smallest t with -t <= r <= t", {evaluations}), residuals,
        [](const auto& a, const auto&, const auto& r) {
            return refined(minimax(gcmma(a.integer("evaluations"))), a, r);
        });
    registry.template add_if<Refinable<P, ResidualMethod>>(
        entry("lm", "Levenberg-Marquardt on the residuals' squares",
              {whole("evaluations", "30", 1, "at most, after the start"),
               whole("sharpen", "0", 0, "after so many, great residuals weigh more; 0 for never")}),
        residuals, [](const auto& a, const auto&, const auto& r) {
            return refined(lm(a.integer("evaluations"), a.integer("sharpen")), a, r);
        });
    registry.template add_if<Refinable<P, Method>>(
        entry("nlopt", "any algorithm of NLopt on the fitness",
              {word("algorithm", std::nullopt, "NLopt's name, e.g. LN_COBYLA"), evaluations}),
        real_genes, [](const auto& a, const auto&, const auto& r) {
            return refined(nlopt_method(a.word("algorithm"), a.integer("evaluations")), a, r);
        });
}

template <Problem P>
void add_replacement(Registry<P>& registry) {
    const auto add = [&](std::string name, std::string meaning, std::vector<Parameter> parameters,
                         auto make) {
        registry.add({std::move(name), "replacement", std::move(meaning), std::move(parameters)},
                     [make](const Arguments& a, const auto&, const auto&) { return Stage<P>(make(a)); });
    };
    add("elite", "brings back the k best of the generation's start for the worst",
        {whole("k", "1", 1, "how many")}, [](const Arguments& a) { return elite(a.count("k")); });
    add("plus", "the mu best of the generation's start and its children",
        {whole("mu", "0", 0, "how many; 0 for as many as at the start")},
        [](const Arguments& a) { return plus(a.count("mu")); });
    add("parents", "adds the generation's start, for pareto to rank all together", {},
        [](const Arguments&) { return parents(); });
    add("steady", "the generation's start with its worst replaced by the children", {},
        [](const Arguments&) { return steady(); });
}

template <Problem P>
void add_blocks(Registry<P>& registry) {
    const auto add = [&](std::string name, std::string meaning, std::vector<Parameter> parameters, auto make,
                         bool pairs = false) {
        registry.add({std::move(name), "blocks", std::move(meaning), std::move(parameters), {}, 1, pairs},
                     [make](const Arguments& a, const auto& bodies, const auto&) {
                         return Stage<P>(make(a, bodies[0]));
                     });
    };
    add("repeat", "n generations of the pipeline in braces", {whole("n", std::nullopt, 1, "how many")},
        [](const Arguments& a, const Stage<P>& body) { return repeat(a.count("n"), body); });
    add(
        "until", "generations until the first condition holds",
        {whole("generations", "", 1, "so many were made"),
         whole("evaluations", "", 1, "so many were asked for"),
         number("seconds", "", 0, no_limit, "so long; such a run cannot be repeated bit for bit"),
         number("fitness", "", -no_limit, no_limit, "the best reaches it"),
         whole("stagnation", "", 1, "so many generations without a better best")},
        [](const Arguments& a, const Stage<P>& body) {
            Until end;
            if (a.has("generations"))
                end.generations = a.count("generations");
            if (a.has("evaluations"))
                end.evaluations = static_cast<long>(a.count("evaluations"));
            if (a.has("seconds"))
                end.seconds = a.number("seconds");
            if (a.has("fitness"))
                end.fitness = a.number("fitness");
            if (a.has("stagnation"))
                end.stagnation = a.count("stagnation");
            return until(end, body);
        },
        true);
    add("restarts", "runs the pipeline n times on the same population and joins the answers",
        {whole("n", std::nullopt, 1, "how many")},
        [](const Arguments& a, const Stage<P>& body) { return restarts(a.count("n"), body); });
    add("islands", "n parts of the population evolve apart, a generation a round, with migrants on a ring",
        {whole("n", std::nullopt, 2, "islands"), whole("rounds", "10", 1, "generations of each"),
         whole("migrants", "1", 0, "of the best, copied to the next island after each round")},
        [](const Arguments& a, const Stage<P>& body) {
            return islands(a.count("n"), {a.count("rounds"), a.count("migrants")}, body);
        });
}

} // namespace words

/// The engine's own operators for a type of problem. Those its genome cannot do are listed with what they
/// need.
template <Problem P>
Registry<P> vocabulary() {
    Registry<P> registry;
    words::add_selection(registry);
    words::add_crossover(registry);
    words::add_mutation(registry);
    words::add_refinement(registry);
    words::add_replacement(registry);
    words::add_blocks(registry);
    return registry;
}

} // namespace ga
