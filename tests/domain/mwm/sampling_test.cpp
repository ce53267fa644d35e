#include "domain/errors.hpp"
#include "ga/base/json.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/random_genome.hpp"

using namespace rough;
using testing::random_genome;

namespace {

using std::numbers::pi;

Grid area(Index columns, Index rows, bool periodic) { return {columns, 0.84942, periodic, 0, rows, 0.7}; }

/// Eq. 1-3 as printed: one cosine for each ridge, on a map along the direction of the ridge.
double height_as_printed(const Genome& genome, double x, double y, bool on_map) {
    double z = 0;
    for (const auto& series : genome.series)
        for (const auto& chromosome : series.chromosomes) {
            const double k = 2 * pi / series.lambda * std::pow(series.gamma, chromosome.n - 1);
            const double M = static_cast<double>(chromosome.phases.size());
            const double G = series.A * std::sqrt(std::log10(series.gamma) / M) *
                             std::pow(2 * pi / series.lambda, -series.H) *
                             std::pow(series.gamma, -(chromosome.n - 1) * series.H);
            for (std::size_t m = 0; m < chromosome.phases.size(); ++m) {
                const double theta = on_map ? pi * static_cast<double>(m) / M : 0, phi = chromosome.phases[m];
                z += G * (std::cos(phi) - std::cos(k * (x * std::cos(theta) + y * std::sin(theta)) + phi));
            }
        }
    return genome.scale * z;
}

} // namespace

TEST_CASE("a genome jumps at the ends of a length that its waves do not divide") {
    Genome wave;
    wave.series = {Series{.A = 1e-3, .H = 1, .gamma = 1.5, .lambda = 2, .chromosomes = {{1, {0.4}}}}};
    const Profile whole = sample(wave, {2001, 2});
    const double range = whole.heights.maxCoeff() - whole.heights.minCoeff();
    // Half a turn after cos(0.4): the jump is twice that part of the amplitude, and the range twice all.
    CHECK(jump_at_ends(wave, 1) == Approx(range * std::cos(0.4)).epsilon(1e-5));
    CHECK(std::abs(jump_at_ends(wave, 2)) < 1e-12 * range);
    CHECK(std::abs(jump_at_ends(wave, 6)) < 1e-12 * range);
}

TEST_CASE("a profile is the sum of the cosines of all ridges") {
    std::mt19937_64 random(1);
    for (std::size_t ridges : {1u, 2u, 8u})
        for (int series : {1, 2}) {
            Genome genome = random_genome(random, series, ridges, 0.84942, 0.84942 / 511);
            genome.scale = 0.3;
            const Grid grid{512, 0.84942, false};
            const Profile profile = sample(genome, grid);
            double bound = 0;
            for (const Wave& wave : waves(genome)) bound += std::abs(wave.amplitude) + std::abs(wave.offset);
            for (Index i = 0; i < 512; i += 7) {
                const double x = static_cast<double>(i) * grid.spacing();
                CHECK(std::abs(profile.heights[i] - height_as_printed(genome, x, 0, false)) < 1e-12 * bound);
            }
        }
}

TEST_CASE("derivatives of linear functionals of heights agree with differences in every gene") {
    std::mt19937_64 random(2);
    const Grid grid{128, 0.84942, false};
    for (std::size_t ridges : {1u, 3u}) {
        Genome genome = random_genome(random, 2, ridges, 0.84942, 0.1);
        genome.scale = 0.7;
        Eigen::MatrixXd functional = Eigen::MatrixXd::Random(3, grid.nodes);
        functional.colwise() -= functional.rowwise().mean().eval(); // blind to a constant
        const Eigen::MatrixXd jacobian = pulled_back(functional, genome, grid);
        const auto values = genes(genome);
        REQUIRE(jacobian.cols() == static_cast<Index>(values.size()));
        for (std::size_t g = 0; g < values.size(); ++g) {
            const double h = 1e-6;
            const auto heights = [&](double by) {
                return sample(with_genes(genome, testing::moved(values, g, by)), grid).heights;
            };
            const Eigen::VectorXd difference = functional * (heights(h) - heights(-h)) / (2 * h);
            INFO("gene " << g);
            CHECK((difference - jacobian.col(static_cast<Index>(g))).norm() < 1e-7 * jacobian.norm());
        }
    }
}

TEST_CASE("adding genomes adds their profiles, in either order to the bit") {
    std::mt19937_64 random(3);
    const Grid grid{64, 0.84942, false};
    for (int i = 0; i < 20; ++i) {
        Genome a = random_genome(random, 1, 1, 0.84942, 0.05), b = random_genome(random, 2, 1, 0.84942, 0.05);
        a.scale = 0.01;
        b.scale = 2.5;
        CHECK(shape_key(sum(a, b)) == shape_key(sum(b, a)));
        const Eigen::VectorXd both = sample(a, grid).heights + sample(b, grid).heights;
        CHECK((sample(sum(a, b), grid).heights - both).norm() < 1e-12 * both.norm());
        CHECK(sum(a, a).series.size() == 1);
    }
}

TEST_CASE("a genome file is read back with the scale in its amplitudes") {
    std::mt19937_64 random(4);
    Genome genome = random_genome(random, 2, 3, 0.84942, 0.05);
    genome.scale = 1e-3;
    const auto text = genome_to_json(genome).dump();
    const Genome again = genome_from_json(nlohmann::json::parse(text), "test");
    CHECK(shape_key(again) == shape_key(folded(genome)));
}

TEST_CASE("a malformed genome is refused with its place and fault") {
    const std::string good =
        R"({"series":[{"A":1,"H":0.8,"gamma":1.5,"lambda":0.84942,"chromosomes":[{"n":1,"phases":[0.3]}]}]})";
    CHECK_NOTHROW(genome_from_json(nlohmann::json::parse(good), "g.json"));
    const std::vector<std::array<std::string, 3>> cases{
        {"\"A\":1", "\"A\":0", "A is 0"},
        {"\"A\":1", "\"A\":{\"b\":1}", "A is {\"b\":1}, which is not a number"},
        {"\"A\":1", "\"a\":1", "unknown key \"a\""},
        {"\"A\":1,", "", "key \"A\" is missing"},
        {"0.84942", "-1", "lambda is -1"},
        {"\"n\":1", "\"n\":0", "n is 0"},
        {"[0.3]", "[]", "no phases"},
        {"[{\"n\":1,\"phases\":[0.3]}]", "[]", "no chromosomes"},
        {"{\"n\":1,\"phases\":[0.3]}", "{\"n\":1,\"phases\":[0.3]},{\"n\":1,\"phases\":[0.3]}", "given twice"},
    };
    for (const auto& [from, to, expected] : cases) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        INFO(text);
        CHECK_THROWS_WITH(genome_from_json(nlohmann::json::parse(text), "g.json"),
                          Catch::StartsWith("g.json: ") && Catch::Contains(expected));
    }
    CHECK_THROWS_AS(read_genome("/no/such/file.json"), InputError);
    CHECK_THROWS_WITH(read_genome(RUGOSA_SOURCE "/experiments/targets/drawn.csv"), Catch::Contains("not a genome"));
}

TEST_CASE("on a map every ridge is a plane wave in its direction", "[areas]") {
    Genome genome;
    genome.scale = 0.4;
    genome.series = {{1e-3, 0.7, 1.6, 0.5, {{1, {0.3, 1.1, 2.5}}, {3, {4, 5}}}}};
    const Grid grid = area(31, 23, false);
    const Profile map = sample(genome, grid);
    for (const Index node : {0, 17, 200, 431, 712}) {
        const double x = grid.spacing() * (static_cast<double>(node % 31) + 0.5),
                     y = grid.row_spacing() * (static_cast<double>(node / 31) + 0.5);
        CHECK(map.heights[node] == Approx(height_as_printed(genome, x, y, true)).epsilon(1e-10).margin(1e-15));
    }
}

TEST_CASE("on a periodic map wave vectors are the nearest of the lattice, but not zero", "[areas]") {
    std::mt19937_64 random(22);
    const Genome genome = random_genome(random, 2, 5, 0.84942, 0.02);
    const auto moved = plane_waves(genome, area(64, 48, true)), free = plane_waves(genome, area(64, 48, false));
    for (std::size_t w = 0; w < moved.size(); ++w) {
        const double i = moved[w].k_x * 0.84942 / (2 * pi), j = moved[w].k_y * 0.7 / (2 * pi);
        CHECK(std::abs(i - std::round(i)) < 1e-9);
        CHECK(std::abs(j - std::round(j)) < 1e-9);
        CHECK(std::hypot(i, j) > 0.5);
        CHECK(std::abs(moved[w].k_x - free[w].k_x) <= (1 + 1e-12) * pi / 0.84942);
        CHECK(std::abs(moved[w].k_y - free[w].k_y) <= (1 + 1e-12) * pi / 0.7);
        const double far = std::hypot(moved[w].k_x - free[w].k_x, moved[w].k_y - free[w].k_y);
        CHECK(moved[w].moved == Approx(far / std::hypot(free[w].k_x, free[w].k_y)).margin(1e-12));
        CHECK(free[w].moved == 0);
    }
    Genome slow;
    slow.series = {Series{.A = 1, .H = 1, .gamma = 1.5, .lambda = 9, .chromosomes = {{1, {0.4}}}}};
    CHECK(plane_waves(slow, area(64, 48, true))[0].k_x == Approx(2 * pi / 0.84942));
}

TEST_CASE("two children of a cross-over of length scales add up to their parents") {
    std::mt19937_64 random(31);
    const Grid grid{64, 0.84942, false};
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Genome a = random_genome(random, 1 + seed % 2, 1 + seed % 3, 0.84942, 0.03),
               b = random_genome(random, 2, 1, 0.84942, 0.05);
        a.scale = 0.01;
        const Genome left = a, right = b;
        ga::Stream stream(seed);
        seed % 3 == 0 ? cross_uniform(a, b, stream) : cross_points(a, b, seed % 3, stream);
        CHECK_NOTHROW(validate(a, "child"));
        CHECK_NOTHROW(validate(b, "child"));
        CHECK(waves(a).size() == waves(left).size());
        CHECK(waves(b).size() == waves(right).size());
        const Eigen::VectorXd before = sample(left, grid).heights + sample(right, grid).heights;
        CHECK((sample(a, grid).heights + sample(b, grid).heights - before).norm() < 1e-12 * before.norm());
    }
}

TEST_CASE("a one-point cross-over exchanges only the short waves, and a uniform one all as often as not") {
    std::mt19937_64 random(33);
    Genome a = random_genome(random, 1, 1, 0.84942, 0.03), b = random_genome(random, 1, 1, 0.84942, 0.03);
    const auto longest = a.series[0].chromosomes[0].phases, shortest = b.series[0].chromosomes.back().phases;
    ga::Stream stream(5);
    cross_points(a, b, 1, stream);
    CHECK(a.series[0].chromosomes[0].phases == longest);
    REQUIRE(a.series.size() == 2);
    if (waves(a).size() >= waves(b).size()) CHECK(a.series[1].chromosomes.back().phases == shortest);
    int held = 0;
    for (int i = 0; i < 400; cross_uniform(a, b, stream), ++i) held += a.series[0].chromosomes[0].phases == longest;
    CHECK(std::abs(held - 200) < 40); // four standard errors
}

TEST_CASE("a genome with a number that is not finite is refused by its name") {
    using Place = double& (*)(Genome&);
    const std::vector<std::pair<std::string, Place>> places{
        {"scale", [](Genome& g) -> double& { return g.scale; }},
        {"a phase", [](Genome& g) -> double& { return g.series[1].chromosomes[0].phases[0]; }}};
    std::mt19937_64 random(5);
    for (const auto& [name, place] : places)
        for (const double wrong : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
            Genome genome = random_genome(random, 2, 2, 0.84942, 0.1);
            CHECK_NOTHROW(validate(genome, "G"));
            place(genome) = wrong;
            CHECK_THROWS_WITH(validate(genome, "G"), Catch::Contains(name + " is "));
        }
}
