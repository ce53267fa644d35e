#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Two hills on [0, 1]: of height 1 at 0.2 and 0.8 at 0.8.
Reals hills() {
    return maximum(
        1,
        [](const Vector& x) {
            return std::max(1 - std::pow((x[0] - 0.2) / 0.2, 2), 0.8 - std::pow((x[0] - 0.8) / 0.2, 2));
        },
        0, 1);
}
/// A gene between 0 and 10 that is its fitness, raised by `by`.
Reals line(double by = 0) {
    return maximum(
        1, [by](const Vector& x) { return x[0] + by; }, 0, 10);
}

Population<Vector> scored(const Reals& problem, const std::vector<Vector>& genomes) {
    return run("score", problem, population(genomes)).population;
}

Vector first_genes(const Population<Vector>& population) {
    Vector genes;
    for (const auto& each : population) genes.push_back(each.genome[0]);
    std::sort(genes.begin(), genes.end());
    return genes;
}

/// Checks mean and root mean square of lengths, in widths.
void check_lengths(const Vector& lengths, double mean, double rms) {
    const auto n = static_cast<double>(lengths.size());
    CHECK(std::accumulate(lengths.begin(), lengths.end(), 0.0) / n == Approx(mean).margin(0.05 * rms));
    CHECK(std::sqrt(functions::sphere(lengths) / n) == Approx(rms).epsilon(0.05));
}

/// Children with these genes, of the first two individuals.
struct Children : Operator {
    Vector genes;
    std::string text() const { return "children"; }
    void check(CheckState& known) const { known.scored.reset(); }
    Population<Vector> operator()(Population<Vector> population, Context<Reals>& context) const {
        const Parents both(population[0].identity, population[1].identity);
        Population<Vector> children(genes.size());
        for (std::size_t i = 0; i < genes.size(); ++i) {
            children[i].genome = {genes[i]};
            context.make_child(children[i], both);
        }
        return children;
    }
};

} // namespace

TEST_CASE("a distance is the rms of genes in widths, or the share of bits that differ") {
    struct Bits {
        using Genome = std::vector<bool>;
        std::vector<Objective<double>> list;
        double evaluate(const Genome&) const { return 0; }
        const std::vector<Objective<double>>& objectives() const { return list; }
    };
    const Reals f = minimum(2, functions::sphere, 0, 10);
    CHECK(distance(f, {1, 2}, {4, 6}) == Approx(std::sqrt((0.09 + 0.16) / 2)));
    CHECK(distance(f, {1, 2}, {1, 2}) == 0);
    CHECK(distance(f, {1}, {4}) == Approx(0.3));
    CHECK(distance(f, {1, 2}, {1, 2, 5}) == Approx(std::sqrt(1 / 3.0)));
    CHECK(distance(f, {}, {}) == 0);
    CHECK(distance(minimum(2, functions::sphere, 1, 1), {1, 1}, {4, 6}) == 0); // no room
    CHECK(distance(Bits{}, {true, false, true, true}, {true, true, true, false}) == 0.5);
    CHECK(distance(Bits{}, {}, {}) == 0);
}

TEST_CASE("shared fitness is the fitness divided by the crowd of its niche") {
    const std::vector<Vector> genomes = {{10}, {9.5}, {5}, {0}};
    const auto shared = Sharing{{}, 0.1, 1}.of(scored(line(), genomes), line());
    CHECK(shared[0] == Approx(10 / 1.5)); // a neighbour at half the radius
    CHECK(shared[1] == Approx(9.5 / 1.5));
    CHECK(shared[2] == Approx(5));
    CHECK(shared[3] == 0);
    CHECK(Sharing{{}, 0.1, 2}.of(scored(line(), genomes), line())[0] == Approx(10 / 1.75));
    CHECK(Sharing{{}, 0.1, 1}.of(scored(line(-6), {{10}, {9.5}, {5}, {2}}), line(-6)) == // raised to 0
          Vector{8 / 1.5, 7.5 / 1.5, 3, 0});
}

TEST_CASE("sharing and crowding keep both hills, unlike selection alone") {
    const auto after = [](const std::string& generation) {
        return run("sample 60 | score | repeat 80 { " + generation + " }", hills()).population;
    };
    const auto on_lower = [](const Population<Vector>& population) {
        return std::count_if(population.begin(), population.end(),
                             [](const auto& each) { return each.genome[0] > 0.5; });
    };
    CHECK(on_lower(after("tournament 3 | mutate 1 gaussian 0.01 | score")) == 0);
    CHECK(on_lower(after("share 0.3 | mutate 1 gaussian 0.01 | score")) > 12);
    const auto crowded = after("random | cross uniform | mutate 1 gaussian 0.05 | score | crowding");
    CHECK(crowded.size() == 60);
    CHECK(on_lower(crowded) > 12);
    CHECK(on_lower(crowded) < 48);
    for (const auto& each : crowded)
        CHECK(std::min(std::abs(each.genome[0] - 0.2), std::abs(each.genome[0] - 0.8)) < 0.05);
}

TEST_CASE("clearing keeps the best of each niche, up to its capacity") {
    const auto start = scored(line(), {{1}, {5}, {10}, {9.5}, {9.2}, {8.9}});
    const auto cleared = [&](const std::string& capacity) {
        return values_of(run("clear 0.1 capacity=" + capacity, line(), start).population);
    };
    CHECK(cleared("1") == Vector{10, 8.9, 5, 1});      // 8.9 is near 9.5, which went
    CHECK(cleared("2") == Vector{10, 9.5, 8.9, 5, 1}); // 8.9 is near 9.5 only
}

TEST_CASE("crowding replaces the more similar parent when the child is better") {
    const Reals f = minimum(
        1, [](const Vector& x) { return std::abs(x[0] - 5); }, 0, 10);
    const auto after = [&](Vector genes) {
        const auto body = Pipeline<Reals>(Children{{}, std::move(genes)}) | reals("score | crowding");
        return first_genes(run(repeat(1, body), f, scored(f, {{1}, {8}, {4}})).population);
    };
    CHECK(after({7, 2}) == Vector{2, 4, 7});
    CHECK(after({2, 7}) == Vector{2, 4, 7});
    CHECK(after({9, 0.5}) == Vector{1, 4, 8}); // both are worse
    CHECK(after({6, 5}) == Vector{4, 5, 6});   // both near the second: the sum of distances decides
    CHECK(after({4.6}) == Vector{1, 4, 4.6});  // one child: 3.4 from the second, 3.6 from the first
}

TEST_CASE("MAP-Elites holds the best individual ever seen in every cell") {
    Reals f = minimum(
        2, [](const Vector& x) { return std::pow(x[0] * x[1] - 0.3, 2); }, -1, 1);
    f.features = {{"x", [](const Vector& x) { return x[0]; }, -1, 1},
                  {"sum", [](const Vector& x) { return x[0] + x[1]; }, -1, 1}};
    std::map<std::pair<int, int>, double> best;
    const auto cell = [](double value) { return std::clamp(int(std::floor((value + 1) * 2)), 0, 3); };
    const Observer<Vector> observer = [&](const auto& event) {
        for (const auto& each : event.population)
            if (each.fitness.known()) {
                const std::pair place(cell(each.genome[0]), cell(each.genome[0] + each.genome[1]));
                const auto at = best.try_emplace(place, each.value()).first;
                at->second = std::min(at->second, each.value());
            }
    };
    const auto archive = run("sample 20 | score | repeat 30 { random 15 | mutate 0.7 gaussian 0.2 | score | "
                             "map-elites x sum cells=4 }",
                             f, {}, {}, {observer})
                             .population;
    CHECK(archive.size() > 10);
    std::multiset<double> values, expected;
    for (const auto& each : archive) values.insert(each.value());
    for (const auto& [place, value] : best) expected.insert(value);
    CHECK(values == expected);
}

TEST_CASE("MAP-Elites ignores failed individuals and descriptors that are not numbers") {
    Reals f = minimum(
        1, [](const Vector& x) { return x[0] < 0 ? std::nan("") : x[0]; }, -1, 1);
    f.features = {{"x", [](const Vector& x) { return x[0] == 0.25 ? std::nan("") : x[0]; }, -1, 1}};
    CHECK(first_genes(run("score | repeat 1 { map-elites x cells=4 }", f, individuals({0.25, -0.5, 0.6, 0.3, 0.4, 0.7}))
                          .population) == Vector{0.3, 0.6});
}

TEST_CASE("emitted children move along a descriptor's gradient by normal lengths in widths") {
    Reals f = minimum(3, functions::sphere, -10, 30);
    f.features = {{"plane", [](const Vector& x) { return 3 * x[0] - 4 * x[2]; }, -1, 1}};
    const auto start = scored(f, {{1, 2, 3}});
    const auto children = run("emit 4000 plane sigma=0.01 | score", f, start).population;
    Vector lengths;
    for (const auto& child : children) {
        CHECK(child.genome[1] == 2);
        const double a = child.genome[0] - 1, c = child.genome[2] - 3;
        CHECK(c == Approx(-4 * a / 3).margin(1e-6));
        lengths.push_back((a * 3 - c * 4) / 5 / 40);
        CHECK(child.parents == Parents(start[0].identity));
        CHECK(child.identity != start[0].identity);
        CHECK(child.value() == functions::sphere(child.genome)); // not its parent's
    }
    check_lengths(lengths, 0, 0.01);
    // a gradient of the problem is preferred, here one without the last gene
    f.features[0].gradient = [](Vector x) { return x.pop_back(), std::move(x); };
    const Vector moved = run("emit 1 plane sigma=0.01 | score", f, start).population[0].genome;
    CHECK((moved[0] != 1 && moved[1] - 2 == Approx(2 * (moved[0] - 1)) && moved[2] == 3));
    CHECK_THROWS_WITH(run("emit 1 plain | score", f, start),
                      Catch::Contains("stage 'emit 1 plain sigma=0.1': unknown descriptor 'plain'; use one of plane"));
}

TEST_CASE("emitted children climb the fitness by lengths of half a normal distribution") {
    for (const bool minimise : {true, false}) {
        Reals f = minimum(2, functions::sphere, -10, 10);
        f.slope = [](const Vector& x) { return Vector{2 * x[0], 2 * x[1]}; };
        f.features = {{"flat", [](const Vector&) { return 1.0; }, 0, 1}};
        f.list[0].minimise = minimise;
        const auto result = run("emit 2000 flat sigma=0.01 | score", f, scored(f, {{3, 4}}));
        CHECK(result.counters.gradients == 2000);
        Vector lengths;
        for (const auto& child : result.population) {
            const double a = child.genome[0] - 3, b = child.genome[1] - 4;
            CHECK(b == Approx(4 * a / 3).margin(1e-12));
            lengths.push_back((minimise ? -1 : 1) * (3 * a + 4 * b) / 5 / 20);
            CHECK(lengths.back() >= 0);
        }
        check_lengths(lengths, 0.01 * std::sqrt(2 / std::numbers::pi), 0.01);
    }
}

TEST_CASE("an emitter returns its parents when budget or memory end before it has moved them") {
    Reals f = minimum(2, functions::sphere, -1, 1);
    f.features = {{"x", [](const Vector& x) { return x[0]; }, -1, 1}};
    const auto start = scored(f, {{0.1, 0.2}, {0.3, 0.4}});
    const auto spent = run("emit 100 x | score", f, start, {.budget = {.evaluations = 30}});
    CHECK(spent.stopped == "evaluation budget spent");
    CHECK(spent.counters.requested == 30);
    CHECK(spent.population.size() == 2);
    const auto large = run("emit 100000000 x | score", f, start, {.population_bytes = std::size_t{1} << 20});
    CHECK(large.stopped == "pipeline/emit.1: a population of 100000000 exceeds the 1 MB for one");
    CHECK(large.population.size() == 2);
    f.n = 9; // bounds of genes that the genomes do not have
    CHECK_THROWS_WITH(scored(f, {{0.1, 0.2, 0.3}}), Catch::Contains("start 1 is not a genome of the problem"));
}
