#include "domain/mwm/sobol.hpp"
#include "domain/paper/variants.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;

namespace {

using testing::p_max;

/// A coarse set-up of the paper's experiment: 64 nodes, 30 genomes.
struct Coarse {
    Model model = completed({{64, 0.84942, false}, {}, {}, {}});
    DesignProblem problem{
        paper_setup(model, read_target(RUGOSA_SOURCE "/experiments/targets/heldout.csv"), p_max, p_max / 2)};
    Vocabulary words{std::make_shared<DominanceRule>(model)};
    std::vector<Genome> genomes = sobol_database({.pairs = 6, .shortest = model.grid.spacing()});
};

using Stages = std::map<std::string, ga::Population<Genome>>; ///< key: path

/// Runs the pipeline and records the population after each stage.
ga::Result<Genome> run_on(const Coarse& coarse, const std::string& variant, int threads, Stages& stages) {
    return ga::run(ga::Parser<DesignProblem>(paper_registry(coarse.words), paper_variants()).variant(variant),
                   coarse.problem, ga::population(coarse.genomes), {.variant = "test", .threads = threads},
                   {[&](const ga::Event<Genome>& event) { stages[event.path] = event.population; }});
}

} // namespace

TEST_CASE("dominant phases are refined first, then all other phases, by at most 10 %") {
    const Coarse coarse;
    Stages stages;
    run_on(coarse, "gco", 2, stages);
    const auto &before = stages.at("test/best.1"), &first = stages.at("test/refine.1"),
               &second = stages.at("test/refine.2");
    int moved = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Genome& original = before[i].genome;
        const Dominance dominance = (*coarse.words.rule)(original);
        const auto places = gene_places(original);
        const auto g0 = genes(original), g1 = genes(first[i].genome), g2 = genes(second[i].genome);
        for (std::size_t g = 0; g < places.size(); ++g) {
            if (places[g].kind != GenePlace::Kind::phase) {
                CHECK(g2[g] == g0[g]);
                continue;
            }
            const bool dominant = dominance.at(places[g].series, places[g].chromosome);
            CHECK((dominant || g1[g] == g0[g]));
            CHECK((!dominant || g2[g] == g1[g]));
            CHECK(std::abs(g2[g] - g0[g]) <= 0.1 * std::abs(g0[g]) * (1 + 1e-12));
            moved += g2[g] != g0[g];
        }
    }
    CHECK(moved > 0);
}

TEST_CASE("a child of GCO is the sum of its rescaled parents, one per pair") {
    const Coarse coarse;
    Stages stages;
    run_on(coarse, "gco", 2, stages);
    const auto &left = stages.at("test/pair.1/left/above.1"), &right = stages.at("test/pair.1/right/above.1"),
               &children = stages.at("test/pair.1");
    std::map<ga::Identity, Genome> parents;
    for (const auto* side : {&left, &right})
        for (const auto& one : *side) {
            parents[one.identity] = one.genome;
            const Response response = respond(one.genome, coarse.model);
            CHECK(response.pressure[response.steps() - 1] == Approx(p_max).epsilon(1e-9));
        }
    std::set<std::pair<ga::Identity, ga::Identity>> seen;
    for (const auto& child : children) {
        const auto a = *child.parents.begin(), b = *(child.parents.begin() + 1);
        CHECK(shape_key(child.genome) == shape_key(sum(parents.at(a), parents.at(b))));
        CHECK(seen.insert(std::minmax(a, b)).second);
    }
    CHECK(children.size() <= left.size() * right.size());
}

TEST_CASE("CCO's parents are reduced to their dominant chromosomes and keep their scale") {
    const Coarse coarse;
    Stages stages;
    run_on(coarse, "cco", 2, stages);
    const auto &whole = stages.at("test/pair.1/left/above.1"), &part = stages.at("test/pair.1/left/reduce.1");
    REQUIRE(whole.size() == part.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        CHECK(part[i].genome.scale == whole[i].genome.scale);
        CHECK(shape_key(part[i].genome) == shape_key(reduced(whole[i].genome, (*coarse.words.rule)(whole[i].genome))));
    }
}

TEST_CASE("the algorithms read as the paper prints them") {
    const Coarse coarse;
    const auto variants = paper_variants();
    for (const auto& [name, text] : variants)
        CHECK(ga::Parser<DesignProblem>(paper_registry(coarse.words), variants).variant(name).text() == text);
    const std::string parents = "score low | above 0.95 at_least=3, score high | above 0.95 at_least=3, ";
    CHECK(variants.at("sog") ==
          "score | best 3 | refine gcmma 5 genes=dominant | refine gcmma 2 genes=others | best 1");
    CHECK(variants.at("gco") ==
          "pair(" + parents +
              "unite) | score | best 3 | refine gcmma 3 genes=dominant | refine gcmma 2 genes=others | best 1");
    CHECK(variants.at("cco") ==
          "pair(score low | above 0.95 at_least=3 | reduce dominant, score high | above 0.95 at_least=3 | "
          "reduce dominant, unite) | score | best 3 | refine gcmma 3 genes=phases | best 1");
}
