#include "domain/errors.hpp"
#include "domain/mwm/genome_json.hpp"
#include "domain/mwm/sampling.hpp"
#include "tests/domain/random_genome.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace rough;
using testing::random_genome;

namespace {

/// Eq. 1-3 as printed: every ridge its own cosine.
double height_as_printed(const Genome& genome, double x) {
    double z = 0;
    for (const auto& series : genome.series)
        for (const auto& chromosome : series.chromosomes) {
            const double k = 2 * std::numbers::pi / series.lambda * std::pow(series.gamma, chromosome.n - 1);
            const double G =
                series.A *
                std::sqrt(std::log10(series.gamma) / static_cast<double>(chromosome.phases.size())) *
                std::pow(2 * std::numbers::pi / series.lambda, -series.H) *
                std::pow(series.gamma, -(chromosome.n - 1) * series.H);
            for (double phase : chromosome.phases)
                z += G * (std::cos(phase) - std::cos(k * x + phase));
        }
    return genome.scale * z;
}

} // namespace

TEST_CASE("a genome jumps at the ends of a length by what its waves lack of a whole number of turns") {
    Genome wave;
    wave.series = {Series{.A = 1e-3, .H = 1, .gamma = 1.5, .lambda = 2, .chromosomes = {{1, {0.4}}}}};
    const Profile whole = sample(wave, {2001, 2});
    const double range = whole.heights.maxCoeff() - whole.heights.minCoeff();
    // After half a turn cos(0.4) is at its opposite: the jump is twice the amplitude's part, of a range of
    // two.
    CHECK(jump_at_ends(wave, 1) == Approx(range * std::cos(0.4)).epsilon(1e-5));
    CHECK(std::abs(jump_at_ends(wave, 2)) < 1e-12 * range);
    CHECK(std::abs(jump_at_ends(wave, 6)) < 1e-12 * range);
}

TEST_CASE("a profile is the sum of every ridge's cosine, though each chromosome costs one") {
    std::mt19937_64 random(1);
    for (std::size_t ridges : {1u, 2u, 8u})
        for (int series : {1, 2}) {
            Genome genome = random_genome(random, series, ridges, 0.84942, 0.84942 / 511);
            genome.scale = 0.3;
            const Grid grid{512, 0.84942, false};
            const Profile profile = sample(genome, grid);
            double bound = 0;
            for (const Wave& wave : waves(genome))
                bound += std::abs(wave.amplitude) + std::abs(wave.offset);
            for (Index i = 0; i < 512; i += 7)
                CHECK(std::abs(profile.heights[i] -
                               height_as_printed(genome, static_cast<double>(i) * grid.spacing())) <
                      1e-12 * bound);
        }
}

TEST_CASE("the last chromosome of an exact power is kept") {
    CHECK(last_chromosome(1.4 * 1.4, 1.4, 1) == 3);
    CHECK(last_chromosome(std::pow(1.5, 5), 1.5, 1) == 6);
    CHECK(last_chromosome(0.84942, 1.4, 0.84942 / 511) == 19);
    CHECK_THROWS_AS(last_chromosome(1, 1.5, 0), InputError); // there is none
    CHECK(last_chromosome(1, 2, 2) == 0);
}

TEST_CASE("the derivative of any linear functional of heights follows differences in every gene") {
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
            auto up = values, down = values;
            up[g] += h;
            down[g] -= h;
            const Eigen::VectorXd difference = functional *
                                               (sample(with_genes(genome, up), grid).heights -
                                                sample(with_genes(genome, down), grid).heights) /
                                               (2 * h);
            INFO("gene " << g);
            CHECK((difference - jacobian.col(static_cast<Index>(g))).norm() < 1e-7 * jacobian.norm());
        }
    }
}

TEST_CASE("adding genomes adds their profiles, whichever comes first, to the bit") {
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

TEST_CASE("a genome file gives back the genome with its scale folded in") {
    std::mt19937_64 random(4);
    Genome genome = random_genome(random, 2, 3, 0.84942, 0.05);
    genome.scale = 1e-3;
    const auto text = genome_to_json(genome).dump();
    const Genome again = genome_from_json(nlohmann::json::parse(text), "test");
    CHECK(shape_key(again) == shape_key(folded(genome)));
}

TEST_CASE("a malformed genome is refused with its place and what was expected") {
    const std::string good =
        R"({"series":[{"A":1,"H":0.8,"gamma":1.5,"lambda":0.84942,"chromosomes":[{"n":1,"phases":[0.3]}]}]})";
    CHECK_NOTHROW(genome_from_json(nlohmann::json::parse(good), "g.json"));
    const std::vector<std::array<std::string, 3>> cases{
        {"\"A\":1", "\"A\":0", "A is 0"},
        {"\"A\":1", "\"A\":{\"b\":1}", "A is {\"b\":1}, expected a number"},
        {"\"A\":1", "\"a\":1", "unknown key \"a\""},
        {"\"A\":1,", "", "key \"A\" is missing"},
        {"0.84942", "-1", "lambda is -1"},
        {"\"n\":1", "\"n\":0", "n is 0"},
        {"[0.3]", "[]", "no phases"},
        {"[{\"n\":1,\"phases\":[0.3]}]", "[]", "no chromosomes"},
        {"{\"n\":1,\"phases\":[0.3]}", "{\"n\":1,\"phases\":[0.3]},{\"n\":1,\"phases\":[0.3]}",
         "given twice"},
    };
    for (const auto& [from, to, expected] : cases) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        INFO(text);
        CHECK_THROWS_WITH(genome_from_json(nlohmann::json::parse(text), "g.json"),
                          Catch::StartsWith("g.json: ") && Catch::Contains(expected));
    }
    CHECK_THROWS_AS(read_genome("/no/such/file.json"), InputError);
}
