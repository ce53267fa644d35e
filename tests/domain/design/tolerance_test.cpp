#include "domain/design/search.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/numerics/statistics.hpp"
#include "tests/catch.hpp"
#include "tests/domain/random_genome.hpp"

#include <Eigen/Cholesky>

#include <numbers>

using namespace rough;

namespace {

using testing::two_mm;

struct Case {
    DesignSetup setup;
    Genome genome;
};

/// A random genome of three waves with its stiffness as target, up to a part of the load. With 3 `quantities`
/// every third target is its contact fraction. The genome's amplitude has the relative error `error`.
Case design_of(std::uint64_t seed, Index nodes = 65, double error = 0, std::size_t quantities = 2, Index rows = 1) {
    ga::Stream random(ga::fold(seed, "case"));
    const auto phase = [&] { return random.uniform(0, 2 * std::numbers::pi); };
    const Genome genome{random.uniform(0.001, 0.02),
                        {{1, random.uniform(0.6, 1), 1.5, two_mm, {{1, {phase()}}, {2, {phase()}}, {3, {phase()}}}}}};
    const Model model =
        completed({.grid = {nodes, two_mm, false, 0, rows, rows > 1 ? two_mm : 0}, .body = {Kernel(seed % 3)}});
    const Profile profile = sample(genome, model.grid);
    Model loaded = model; // as a design is loaded
    loaded.loading.to_pressure = random.uniform(0.3, 0.8) * secant_stiffness(respond(profile, loaded)).to;
    Case one{{.model = model,
              .targets = {target_like(profile, loaded, "itself",
                                      std::array{Quantity::stiffness, Quantity::interface_stiffness,
                                                 Quantity::area_at_pressure}[seed / (quantities - 1) % quantities],
                                      {10, loaded.loading.to_pressure})}},
             genome};
    one.genome.scale *= 1 + error;
    return one;
}

double similarity_with(const Case& one, const Eigen::VectorXd& errors) {
    Profile made = sample(one.genome, one.setup.model.grid);
    made.heights += errors;
    std::vector<Response> responses;
    Model model = one.setup.model;
    for (const Loading& loading : loadings_of(one.setup, model.loading)) {
        model.loading = loading;
        responses.push_back(respond(made, model));
    }
    return similarity(one.setup, design_response(one.setup, std::move(responses)));
}

/// Whether each noise tolerance above 0 holds for 92 to 98 % of 1,000 new draws, made from the covariance.
bool holds_for_new_draws(const Case& one, const Tolerance& found) {
    const Grid& grid = one.setup.model.grid;
    Eigen::MatrixXd covariance(grid.nodes, grid.nodes);
    for (Index i = 0; i < grid.nodes; ++i)
        for (Index j = 0; j < grid.nodes; ++j) {
            const double d = std::abs(static_cast<double>(i - j)) * grid.spacing(),
                         nearest = grid.periodic ? std::min(d, two_mm - d) : d;
            covariance(i, j) = std::exp(-std::pow(nearest / found.noise_length, 2)) + (i == j ? 1e-9 : 0);
        }
    const Eigen::MatrixXd factor = covariance.llt().matrixL();
    bool holds = true;
    for (const ToleranceLevel& level : found.levels) {
        if (level.noise_rms == 0) continue;
        ga::Stream random(77);
        int kept = 0;
        for (int draw = 0; draw < 1000; ++draw) {
            Eigen::VectorXd white(grid.nodes);
            for (double& height : white) height = random.normal();
            kept += similarity_with(one, level.noise_rms * factor * white) >= level.similarity;
        }
        UNSCOPED_INFO(level.similarity << ": " << kept);
        holds = holds && kept >= 920 && kept <= 980;
    }
    return holds;
}

/// Checks that every tilt and scale within the tolerance keeps the similarity, and one of 1.02 times it does
/// not.
void check_tilts_and_scales(const Case& one, const Tolerance& found) {
    const Profile profile = sample(one.genome, one.setup.model.grid);
    const double last = static_cast<double>(profile.nodes() - 1) * profile.spacing / two_mm;
    const Eigen::VectorXd slope = Eigen::VectorXd::LinSpaced(profile.nodes(), 0, last);
    for (const ToleranceLevel& level : found.levels)
        for (const auto& [size, shape] : {std::pair(level.tilt, slope), std::pair(level.scale, profile.heights)}) {
            INFO(level.similarity << ", " << size);
            REQUIRE((size > 0) == (level.similarity <= found.similarity));
            if (size == 0) continue;
            for (int i = -100; i <= 100; ++i) CHECK(similarity_with(one, i / 100. * size * shape) >= level.similarity);
            CHECK(std::min(similarity_with(one, 1.02 * size * shape), similarity_with(one, -1.02 * size * shape)) <
                  level.similarity);
        }
}

} // namespace

TEST_CASE("height noise has rms 1 and a Gaussian autocorrelation, on lines and maps") {
    const double l = 0.25; // nodes are l/2 apart
    for (const Grid& grid : {Grid{17, two_mm}, Grid{16, two_mm, true}, Grid{16, two_mm, false, 0, 8, two_mm / 2}}) {
        std::vector<Eigen::VectorXd> fields;
        for (std::uint64_t seed = 0; seed < 4000; ++seed) fields.push_back(height_noise(grid, l, seed));
        const auto correlated = [&](Index i, Index j, double expected) {
            double sum = 0;
            for (const Eigen::VectorXd& field : fields) sum += field[i] * field[j];
            CHECK(sum / static_cast<double>(fields.size()) == Approx(expected).margin(0.07));
        };
        REQUIRE(fields[0].size() == grid.shape().nodes());
        for (const Index i : {0, 7})
            for (const int apart : {0, 1, 2, 5}) correlated(i, i + apart, std::exp(-apart * apart / 4.));
        if (grid.is_2d())
            for (const int apart : {0, 2}) correlated(3, 3 + 2 * grid.nodes + apart, std::exp(-1 - apart / 2.));
        correlated(0, grid.nodes - 1, grid.periodic ? std::exp(-0.25) : 0);
    }
}

TEST_CASE("height noise of one seed is one field on every grid") {
    for (const Grid& grid : {Grid{17, two_mm}, Grid{16, two_mm, true}, Grid{9, two_mm, false, 0, 17, 2 * two_mm}}) {
        const Index times = grid.has_cells() ? 3 : 2, first = grid.has_cells() ? 1 : 0;
        const Grid fine = refined(grid, times); // an odd number keeps the middle of each cell
        const Eigen::VectorXd coarse = height_noise(grid, 0.2, 5), finer = height_noise(fine, 0.2, 5);
        for (Index j = 0; j < grid.rows; ++j)
            for (Index i = 0; i < grid.nodes; ++i)
                CHECK(coarse[j * grid.nodes + i] ==
                      Approx(finer[(first + times * j) * fine.nodes + first + times * i]).margin(1e-7));
    }
}

TEST_CASE("the similarity of a map when made is the lowest under rising and falling tilts along both sides") {
    for (const std::uint64_t seed : {3, 6, 9}) {
        Case one = design_of(seed, 17, 0, 2, 16);
        double lowest = 1;
        for (const Eigen::VectorXd& tilt : unit_tilts(one.setup.model.grid))
            for (const double size : {0.01, -0.01}) lowest = std::min(lowest, similarity_with(one, size * tilt));
        one.setup.errors.tilt = 0.01;
        CHECK(similarity_under_errors(one.setup, one.genome) == Approx(lowest).epsilon(1e-9));
    }
}

TEST_CASE("new draws, tilts and scales within the tolerance keep the similarity") {
    const Case one = design_of(1);
    const Tolerance found = tolerance_of(one.setup, one.genome);
    REQUIRE(found.similarity > 0.95);
    CHECK(holds_for_new_draws(one, found));
    check_tilts_and_scales(one, found);
}

TEST_CASE("the tolerance is the same on one thread and on three") {
    const Case one = design_of(5);
    const Tolerance a = tolerance_of(one.setup, one.genome, {.threads = 1}),
                    b = tolerance_of(one.setup, one.genome, {.threads = 3});
    CHECK(a.draws == 1000);
    for (const auto& [end, side] : {std::pair(a.share_from, -1), {a.share_to, 1}}) // Wilson's interval
        CHECK(end - 0.95 == Approx(side * 1.96 * std::sqrt(end * (1 - end) / 1000)));
    CHECK(a.noise_length == two_mm / 60);
    CHECK(column(a.levels, &ToleranceLevel::similarity) == std::vector<double>{0.99, 0.95, 0.9});
    for (const auto value : {&ToleranceLevel::noise_rms, &ToleranceLevel::tilt, &ToleranceLevel::scale})
        CHECK(column(a.levels, value) == column(b.levels, value));
    CHECK(column(a.curve, &NoiseQuantile::quantile) == column(b.curve, &NoiseQuantile::quantile));
}

TEST_CASE("the tolerance of a surface is the same on twice the nodes") {
    Case coarse = design_of(6, 257), fine = design_of(6, 513);
    coarse.setup.errors.noise_length = fine.setup.errors.noise_length = 0.1;
    const Tolerance a = tolerance_of(coarse.setup, coarse.genome), b = tolerance_of(fine.setup, fine.genome);
    for (const auto value : {&ToleranceLevel::noise_rms, &ToleranceLevel::tilt, &ToleranceLevel::scale})
        for (const std::size_t level : {1u, 2u})
            CHECK(a.levels[level].*value == Approx(b.levels[level].*value).epsilon(0.05));
}

TEST_CASE("errors of a map are tried on its own cells if fewer change the answer", "[map]") {
    const Case one = design_of(6, 32, 0.005, 2, 32);
    const Answer answer = verified_answer(as_reported(one.setup), one.genome);
    const DesignSetup tried = as_verified(one.setup, answer);
    CHECK(tried.model.grid.shape() == Extent{32, 32});
    CHECK(similarity_with({tried, answer.genome}, Eigen::VectorXd::Zero(32 * 32)) == Approx(answer.worst).margin(1e-9));
}

TEST_CASE("errors of a map on joined cells have the effect of those on its own cells", "[map][long]") {
    Case one = design_of(6, 96, 0.005, 2, 96);
    one.setup.errors.noise_length = two_mm / 24;
    const Answer answer = verified_answer(as_reported(one.setup), one.genome);
    const DesignSetup joined = as_verified(one.setup, answer),
                      own = corrected_targets(one.setup, answer.misfits.front(), answer.largest);
    CHECK(joined.model.grid.shape() == Extent{48, 48});
    const Tolerance on_joined = tolerance_of(joined, answer.genome, {.draws = 100}),
                    on_own = tolerance_of(own, answer.genome, {.draws = 100});
    CHECK(on_joined.similarity == Approx(answer.worst).margin(1e-9));
    for (std::size_t i = 1; i < on_own.levels.size(); ++i) { // 0.99 is at the verdict itself
        INFO(on_own.levels[i].similarity);
        CHECK(on_joined.levels[i].noise_rms == Approx(on_own.levels[i].noise_rms).epsilon(0.1));
        CHECK(on_joined.levels[i].tilt == Approx(on_own.levels[i].tilt).epsilon(0.1));
        CHECK(on_joined.levels[i].scale == Approx(on_own.levels[i].scale).epsilon(0.1));
    }
}

TEST_CASE("a lower price makes fewer draws, and a wider interval of their share") {
    const Case one = design_of(5);
    const Tolerance cheap = tolerance_of(one.setup, one.genome, {.price = 1000}),
                    asked = tolerance_of(one.setup, one.genome, {.price = 1000, .draws = 300});
    CHECK((cheap.draws >= 100 && cheap.draws < 300)); // four curves each, and those of tilts and scales
    CHECK(asked.draws == 300);
    CHECK((cheap.share_from < asked.share_from && cheap.share_to > asked.share_to));
    CHECK(!cheap.shortened);
}

TEST_CASE("a design below a similarity has tolerance 0 there") {
    Case one = design_of(4, 65, 0.3);
    one.setup.required_similarity = similarity(one.setup, one.genome) - 0.05;
    const Tolerance found = tolerance_of(one.setup, one.genome);
    CHECK(found.similarity == similarity(one.setup, one.genome));
    CHECK(found.levels.size() == 4);
    for (const ToleranceLevel& level : found.levels) {
        INFO(level.similarity << " of " << found.similarity);
        for (const double value : {level.noise_rms, level.tilt, level.scale})
            CHECK((value > 0) == (level.similarity <= found.similarity));
    }
    CHECK(found.levels.front().noise_rms == 0);
}

TEST_CASE("heights with errors stay as made when the search rescales them by Eq. 11") {
    Case one = design_of(6);
    one.setup.max_pressure = 1.3 * one.setup.targets[0].last();
    one.genome = in_final_form(one.setup, one.genome);
    const double before = similarity(one.setup, one.genome);
    one.setup.required_similarity = before - 0.05;
    const Tolerance found = tolerance_of(one.setup, one.genome);
    CHECK(found.similarity == Approx(before).margin(1e-6));
    // Eq. 11 would undo every error of scale.
    CHECK(found.levels.back().scale > 0);
    CHECK(found.levels.back().scale < 0.9);
}

TEST_CASE("similarity under noise and tilt agrees with the tolerance") {
    Case one = design_of(8);
    const ToleranceLevel level = tolerance_of(one.setup, one.genome).levels[1];
    for (const double factor : {0.98, 1.02})
        for (const MakingErrors& errors :
             {MakingErrors{factor * level.noise_rms, two_mm / 60, 0}, {0, 0, factor * level.tilt}}) {
            one.setup.errors = errors;
            CHECK((similarity_under_errors(one.setup, one.genome) >= 0.95) == (factor < 1));
        }
}

TEST_CASE("a tolerance without time is NaN") {
    Case one = design_of(9);
    one.setup.errors.noise = 1e-6;
    const Tolerance found = tolerance_of(one.setup, one.genome, {.seconds = 0});
    CHECK(!found.complete);
    for (const ToleranceLevel& level : found.levels)
        CHECK((std::isnan(level.noise_rms) && std::isnan(level.tilt) && std::isnan(level.scale)));
    CHECK(std::isnan(similarity_under_errors(one.setup, one.genome, {.seconds = 0})));
}
