#include "ga/adaptation/adaptation.hpp"
#include "tests/ga/functions.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

using Vector = std::vector<double>;
const Population<Vector> nobody = population<Vector>({{}});

/// Bits; the fitness is how many are set.
struct Bits {
    using Genome = std::vector<bool>;
    using Outcome = double;
    std::vector<Objective<double>> list = {{"set", [](const double& y) { return y; }}};
    double evaluate(const Genome& x) const {
        return static_cast<double>(std::count(x.begin(), x.end(), true));
    }
    const std::vector<Objective<double>>& objectives() const { return list; }
};

/// Two hills of different height on [0, 1], of one gene: at 0.2 (1) and at 0.8 (0.8).
Function hills() {
    Function f{1,
               [](const Vector& x) {
                   return std::max(1 - std::pow((x[0] - 0.2) / 0.2, 2),
                                   0.8 - std::pow((x[0] - 0.8) / 0.2, 2));
               },
               0, 1};
    f.list[0].minimise = false;
    return f;
}

Population<Vector> scored(const Function& f, const std::vector<Vector>& genomes) {
    return run(Stage<Function>(score()), f, population(genomes)).population;
}

std::vector<double> first_genes(const Population<Vector>& population) {
    std::vector<double> genes;
    for (const auto& each : population)
        genes.push_back(each.genome[0]);
    std::sort(genes.begin(), genes.end());
    return genes;
}

} // namespace

TEST_CASE("the distance of genomes is the rms of genes in widths, or the share of bits that differ") {
    const Function f{2, functions::sphere, 0, 10};
    CHECK(distance(f, {1, 2}, {4, 6}) == Approx(std::sqrt((0.09 + 0.16) / 2)));
    CHECK(distance(f, {1, 2}, {1, 2}) == 0);
    CHECK(distance(Function{1, functions::sphere, 0, 10}, {1}, {4}) == Approx(0.3));
    CHECK(distance(f, {1, 2}, {1, 2, 5}) == Approx(std::sqrt(1 / 3.0)));
    CHECK(distance(Bits{}, {true, false, true, true}, {true, true, true, false}) == 0.5);
}

TEST_CASE("shared fitness is the fitness over its niche's crowd, raised where one is negative") {
    Function line{1, [](const Vector& x) { return x[0]; }, 0, 10};
    line.list[0].minimise = false;
    const auto population = scored(line, {{10}, {9.5}, {5}, {0}});
    const auto shared = Sharing{{}, 0.1, 1}.of(population, line);
    CHECK(shared[0] == Approx(10 / 1.5)); // a neighbour at half the radius
    CHECK(shared[1] == Approx(9.5 / 1.5));
    CHECK(shared[2] == Approx(5));
    CHECK(shared[3] == 0);
    CHECK(Sharing{{}, 0.1, 2}.of(population, line)[0] == Approx(10 / 1.75));
    line.f = [](const Vector& x) { return x[0] - 6; };
    CHECK(Sharing{{}, 0.1, 1}.of(scored(line, {{10}, {9.5}, {5}, {2}}), line) ==
          std::vector<double>{8 / 1.5, 7.5 / 1.5, 3, 0});
}

TEST_CASE("sharing and crowding hold both hills, where selection alone loses the lower one") {
    const auto low = [](const Population<Vector>& population) {
        return std::count_if(population.begin(), population.end(),
                             [](const auto& each) { return each.genome[0] > 0.5; });
    };
    const auto children = Stage<Function>(mutate(1, gaussian(0.01)) | score());
    const auto begin = Stage<Function>(sample(60)) | Stage<Function>(mutate(1, reset())) | score();
    const auto after = [&](auto selection) {
        return low(
            run(begin | Stage<Function>(repeat(80, Stage<Function>(selection) | children)), hills(), nobody)
                .population);
    };
    CHECK(after(tournament(3)) == 0);
    CHECK(after(share(0.3)) > 12);
    const auto crowded =
        run(begin | Stage<Function>(repeat(80, at_random() | cross(uniform()) | mutate(1, gaussian(0.05)) |
                                                   score() | crowding())),
            hills(), nobody)
            .population;
    CHECK(crowded.size() == 60);
    CHECK(low(crowded) > 12);
    CHECK(low(crowded) < 48);
    for (const auto& each : crowded)
        CHECK(std::min(std::abs(each.genome[0] - 0.2), std::abs(each.genome[0] - 0.8)) < 0.05);
}

TEST_CASE("clearing leaves as many of each niche as it holds, best first") {
    Function line{1, [](const Vector& x) { return x[0]; }, 0, 10};
    line.list[0].minimise = false;
    const auto population = scored(line, {{1}, {5}, {10}, {9.5}, {9.2}, {8.9}});
    const auto clear_by = [&](std::size_t capacity) {
        std::vector<double> genes;
        for (const auto& each : run(Stage<Function>(clear(0.1, capacity)), line, population).population)
            genes.push_back(each.genome[0]);
        return genes;
    };
    CHECK(clear_by(1) == Vector{10, 8.9, 5, 1});      // 8.9 is near 9.5, which went
    CHECK(clear_by(2) == Vector{10, 9.5, 8.9, 5, 1}); // 8.9 is near 9.5 alone
}

TEST_CASE("in crowding a child takes the place of the parent it is like, and only where it is better") {
    /// Two children of the first two: near the second, then near the first.
    struct Beget : Operator {
        Vector genes;
        std::string text() const { return "beget"; }
        void check(CheckState& known) const { known.scored.reset(); }
        Population<Vector> operator()(Population<Vector> population, Context<Function>& context) const {
            const Parents both(population[0].identity, population[1].identity);
            Population<Vector> children(genes.size());
            for (std::size_t i = 0; i < genes.size(); ++i) {
                children[i].genome = {genes[i]};
                context.make_child(children[i], both);
            }
            return children;
        }
    };
    const Function f{1, [](const Vector& x) { return std::abs(x[0] - 5); }, 0, 10};
    const auto after = [&](Vector genes) {
        const auto stage =
            Stage<Function>(repeat(1, Stage<Function>(Beget{{}, std::move(genes)}) | score() | crowding()));
        return first_genes(run(stage, f, scored(f, {{1}, {8}, {4}})).population);
    };
    CHECK(after({7, 2}) == Vector{2, 4, 7});   // crosswise
    CHECK(after({2, 7}) == Vector{2, 4, 7});   // straight
    CHECK(after({9, 0.5}) == Vector{1, 4, 8}); // both are worse
    CHECK(after({6, 5}) == Vector{4, 5, 6});   // both near the second: the sum of distances decides
    CHECK(after({4.6}) == Vector{1, 4, 4.6});  // alone: 3.4 from the second, 3.6 from the first
}

TEST_CASE("MAP-Elites holds the best of every cell that was ever seen") {
    Function f{2, [](const Vector& x) { return std::pow(x[0] * x[1] - 0.3, 2); }, -1, 1};
    f.features = {{"x", [](const Vector& x) { return x[0]; }, -1, 1},
                  {"sum", [](const Vector& x) { return x[0] + x[1]; }, -1, 1}};
    std::map<std::pair<int, int>, double> best;
    const auto cell = [](double value) {
        return std::clamp(static_cast<int>(std::floor((value + 1) * 2)), 0, 3);
    };
    const Observer<Vector> observer = [&](const auto& event) {
        for (const auto& each : event.population)
            if (each.fitness.known()) {
                const std::pair place(cell(each.genome[0]), cell(each.genome[0] + each.genome[1]));
                const auto [at, fresh] = best.try_emplace(place, each.value());
                if (!fresh)
                    at->second = std::min(at->second, each.value());
            }
    };
    const auto stage = Stage<Function>(sample(20) | mutate(1, reset())) | score() |
                       Stage<Function>(repeat(30, at_random(15) | mutate(0.7, gaussian(0.2)) | score() |
                                                      map_elites({"x", "sum"}, 4)));
    const auto archive = run(stage, f, nobody, {}, {observer}).population;
    CHECK(archive.size() == best.size());
    CHECK(archive.size() > 10);
    std::vector<double> values, expected;
    for (const auto& each : archive)
        values.push_back(each.value());
    for (const auto& [place, value] : best)
        expected.push_back(value);
    std::sort(values.begin(), values.end());
    std::sort(expected.begin(), expected.end());
    CHECK(values == expected);
}

TEST_CASE("emitted children move along the descriptors' gradients, by normal lengths in widths") {
    Function f{3, functions::sphere, -10, 30};
    f.features = {{"plane", [](const Vector& x) { return 3 * x[0] - 4 * x[2]; }, -1, 1}};
    const auto start = scored(f, {{1, 2, 3}});
    const auto children = run(Stage<Function>(emit(4000, {"plane"}, 0.01)) | score(), f, start).population;
    double mean = 0, square = 0;
    for (const auto& child : children) {
        CHECK(child.genome[1] == 2);
        const double a = child.genome[0] - 1, c = child.genome[2] - 3;
        CHECK(c == Approx(-4 * a / 3).margin(1e-6));
        const double length = (a * 3 - c * 4) / 5 / 40; // in widths
        mean += length / 4000;
        square += length * length / 4000;
        CHECK(child.parents == Parents(start[0].identity));
        CHECK(child.identity != start[0].identity);
        CHECK(child.value() == functions::sphere(child.genome)); // its own, not its parent's
    }
    CHECK(std::abs(mean) < 6e-4);
    CHECK(std::sqrt(square) == Approx(0.01).epsilon(0.05));
    f.features[0].gradient = [](const Vector&) { return Vector{0, 1, 0}; }; // the problem's own goes first
    CHECK(run(Stage<Function>(emit(1, {"plane"}, 0.01)) | score(), f, start).population[0].genome[0] == 1);
    CHECK_THROWS_WITH(run(Stage<Function>(emit(1, {"plain"})) | score(), f, start),
                      "stage 'emit 1 plain sigma=0.1': unknown descriptor 'plain'; expected one of plane");
}

TEST_CASE(
    "the length of an emitted step hangs on no gradient's length, and who stands on flat ground stays") {
    Function f{2, functions::sphere, 0, 1};
    const auto start = scored(f, {{0.5, 0.5}});
    const auto by = [&](double slope) {
        f.features = {{"plane", {}, 0, 1, [slope](const Vector&) { return Vector{3 * slope, 4 * slope}; }}};
        return run(Stage<Function>(emit(50, {"plane"}, 0.01)) | score(), f, start).population;
    };
    const auto steep = by(1e9), gentle = by(1e-9), flat = by(0);
    for (std::size_t i = 0; i < 50; ++i)
        for (std::size_t g = 0; g < 2; ++g) {
            CHECK(gentle[i].genome[g] == Approx(steep[i].genome[g]).epsilon(1e-12));
            CHECK(flat[i].genome[g] == 0.5);
        }
    CHECK(gentle[0].genome != start[0].genome);
}

TEST_CASE("emitted children climb the slope of the fitness by lengths of half a normal distribution") {
    /// The sphere with its gradient.
    struct Sloped : Function {
        std::vector<double> gradient(const Genome& x, const std::string&) const {
            return {2 * x[0], 2 * x[1]};
        }
    };
    /// The same as residuals.
    struct Squares : Function {
        Sensitivity sensitivity(const Genome& x, const std::string&) const {
            return {Eigen::Vector2d(x[0], x[1]), Eigen::Matrix2d::Identity()};
        }
    };
    const auto check = [](auto f, double direction) {
        f.features = {{"flat", [](const Vector&) { return 1.0; }, 0, 1}};
        f.list[0].minimise = direction < 0;
        const auto start = run(Stage<decltype(f)>(score()), f, population<Vector>({{3, 4}})).population;
        const auto result = run(Stage<decltype(f)>(emit(2000, {"flat"}, 0.01)) | score(), f, start);
        CHECK(result.counters.gradients == 2000);
        double mean = 0, square = 0;
        for (const auto& child : result.population) {
            const double a = child.genome[0] - 3, b = child.genome[1] - 4;
            CHECK(b == Approx(4 * a / 3).margin(1e-12));
            const double length = direction * (3 * a + 4 * b) / 5 / 20; // in widths
            CHECK(length >= 0);
            mean += length / 2000;
            square += length * length / 2000;
        }
        CHECK(mean == Approx(0.01 * std::sqrt(2 / std::numbers::pi)).epsilon(0.05));
        CHECK(std::sqrt(square) == Approx(0.01).epsilon(0.05));
    };
    check(Sloped{{2, functions::sphere, -10, 10}}, -1);
    check(Sloped{{2, functions::sphere, -10, 10}}, 1);
    check(Squares{{2, functions::sphere, -10, 10}}, -1);
    Squares f{{2, functions::sphere, -10, 10}};
    f.features = {{"flat", [](const Vector&) { return 1.0; }, 0, 1}};
    const auto start = run(Stage<Squares>(score()), f, population<Vector>({{3, 4}, {1, 1}})).population;
    const auto stopped =
        run(Stage<Squares>(emit(100, {"flat"})) | score(), f, start, {.budget = {.evaluations = 30}});
    CHECK(stopped.stopped == "evaluation budget spent");
    CHECK(stopped.counters.asked == 30);
    CHECK(stopped.population.size() == 2); // who were there before
}

TEST_CASE("an emitter and an archive are refused or stopped where they cannot work") {
    Function f{2, functions::sphere, -1, 1};
    f.features = {{"x", [](const Vector& x) { return x[0]; }, -1, 1}};
    const auto start = scored(f, {{0.1, 0.2}, {0.3, 0.4}});
    const auto large = run(Stage<Function>(emit(100000000, {"x"})) | score(), f, start,
                           {.population_bytes = std::size_t{1} << 20});
    CHECK(large.stopped == "pipeline/emit.1: a population of 100000000 exceeds the 1 MB for one");
    CHECK(large.population.size() == 2);
    CHECK_THROWS_WITH(check(Stage<Function>(score()) | Stage<Function>(map_elites({"x"})), f, start),
                      Catch::Contains("reads the start of a generation"));
}

TEST_CASE("bounds of genes that a genome lacks are left alone") {
    Function f{9, functions::sphere, -1, 1};
    f.features = {{"x", [](const Vector& x) { return x[0]; }, -1, 1}};
    const auto start = scored(f, {{0.1, 0.2, 0.3}});
    for (const auto& each : run(Stage<Function>(emit(50, {"x"})) | score(), f, start).population)
        CHECK(each.genome.size() == 3);
}

TEST_CASE("genes without room, and those that one genome lacks, count as the distance says") {
    CHECK(distance(Function{2, functions::sphere, 1, 1}, {1, 1}, {4, 6}) == 0);
    CHECK(distance(Function{2, functions::sphere, 0, 10}, {1}, {4}) == Approx(0.3));
    CHECK(distance(Function{2, functions::sphere, 0, 10}, {}, {}) == 0);
    CHECK(distance(Bits{}, {}, {}) == 0);
}

TEST_CASE("MAP-Elites passes over who failed and whose descriptors are no numbers") {
    Function f{1, [](const Vector& x) { return x[0] < 0 ? std::nan("") : x[0]; }, -1, 1};
    f.features = {{"x", [](const Vector& x) { return x[0] == 0.25 ? std::nan("") : x[0]; }, -1, 1}};
    const auto archive = [&](const std::vector<Vector>& genomes) {
        return first_genes(run(Stage<Function>(score()) | Stage<Function>(repeat(1, map_elites({"x"}, 4))), f,
                               population(genomes))
                               .population);
    };
    CHECK(archive({{0.25}, {-0.5}, {0.6}, {0.3}, {0.4}, {0.7}}) == archive({{0.6}, {0.3}, {0.4}, {0.7}}));
    CHECK(archive({{0.25}, {-0.5}, {0.6}, {0.3}, {0.4}, {0.7}}) == Vector{0.3, 0.6});
}

TEST_CASE("in crowding a child of one parent meets that one, and who is nobody's child meets nobody") {
    const auto start = scored(hills(), {{0.1}, {0.3}, {0.5}, {0.7}, {0.9}, {0.25}});
    const auto after = [&](const auto& body) {
        return run(Stage<Function>(repeat(1, body)), hills(), start).population;
    };
    const auto mutant = mutate(1, gaussian(0.1)) | score();
    const auto crowded = after(mutant | crowding()), duelled = after(mutant | duel());
    std::size_t born = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        CHECK(crowded[i].identity == duelled[i].identity);
        CHECK(crowded[i].value() >= start[i].value());
        born += crowded[i].parents.size();
    }
    CHECK(born > 0);
    CHECK(born < start.size());
    const auto alone = after(sample(40) | score() | crowding());
    CHECK(first_genes(alone) == first_genes(start));
}
