#include "domain/design/search.hpp"
#include "domain/target/like.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace rough;

namespace {

constexpr double L = 2, turn = 2 * std::numbers::pi;

Genome waves_of(double first, double second, double scale = 0.01) {
    return {scale, {{1, 0.8, 2, L, {{1, {first}}, {2, {second}}}}}};
}

DesignSetup set_up() {
    DesignSetup setup;
    setup.model.grid = {65, L};
    const Profile profile = sample(waves_of(0.3, 1), setup.model.grid);
    setup.targets = {target_like(profile, completed(setup.model), "waves", Quantity::stiffness, 10)};
    return setup;
}

/// One period of a wave of unit amplitude, n to the length, at even nodes.
Profile cosine(int n, double phase = 0) {
    Profile profile{Eigen::VectorXd(64), 0.1};
    for (Index i = 0; i < 64; ++i)
        profile.heights[i] = std::cos(n * turn * (static_cast<double>(i) + 0.5) / 64 + phase);
    return profile;
}

Profile plus(Profile left, double factor, const Profile& right) {
    left.heights += factor * right.heights;
    return left;
}

} // namespace

TEST_CASE("profiles differ by one less their correlation, mirrored or not, whatever their height and size") {
    const Profile skew = plus(cosine(1, 0.4), 0.7, cosine(2, 1.1));
    Profile mirrored = skew, larger = skew, lower = skew;
    mirrored.heights = skew.heights.reverse().eval();
    larger.heights *= 3;
    lower.heights.array() -= 5;
    CHECK(difference(skew, skew) == Approx(0).margin(1e-14));
    CHECK(difference(skew, mirrored) == Approx(0).margin(1e-14));
    CHECK(difference(mirrored, skew) == Approx(0).margin(1e-14));
    CHECK(difference(skew, larger) == Approx(0).margin(1e-14));
    CHECK(difference(lower, skew) == Approx(0).margin(1e-14));
    // Even waves, which mirror onto themselves: correlations by hand.
    CHECK(difference(cosine(1), cosine(2)) == Approx(1));
    CHECK(difference(cosine(1), cosine(1, std::numbers::pi)) == Approx(2));
    CHECK(difference(cosine(1), plus(cosine(1), 1, cosine(2))) == Approx(1 - 1 / std::sqrt(2.0)));
    Profile flat = cosine(1);
    flat.heights.setConstant(4);
    CHECK(difference(flat, flat) == 0);
    CHECK(different == 0.05);
}

TEST_CASE("an answer's twin, its mirror image and what hardly differs are no alternatives to it") {
    const DesignSetup setup = set_up();
    SearchOptions options;
    options.pipeline = "score | best 5";
    options.alternatives = 5;
    // A wave that fits the length is mirrored by its phase's sign. All meet the target about as well.
    options.starts = {waves_of(0.3, 1), waves_of(0.301, 1), waves_of(-0.3, -1), waves_of(0.3, 2.2),
                      waves_of(0.3, 1, 0.011)};
    options.threads = 1;
    const SearchResult found = search(setup, options);
    REQUIRE(found.alternatives.size() == 2);
    CHECK(found.alternatives[0].lowest() == found.best.lowest());
    CHECK(found.alternatives[0].difference == 1);
    const Profile first = sample(found.alternatives[0].genome, setup.model.grid),
                  second = sample(found.alternatives[1].genome, setup.model.grid);
    CHECK(found.alternatives[1].difference == Approx(difference(first, second)));
    CHECK(found.alternatives[1].difference >= different);
    CHECK(found.best.similarity > 0.98);
    options.alternatives = 1;
    CHECK(search(setup, options).alternatives.size() == 1);
}

TEST_CASE(
    "alternatives differ from each other, are as many as asked for, and are verified on a grid four times "
    "finer") {
    const DesignSetup setup = set_up();
    SearchOptions options;
    options.pipeline = "score | best 4";
    options.starts = {waves_of(0.3, 1), waves_of(0.3, 2.2), waves_of(0.3, 2.201), waves_of(0.3, 0.2)};
    options.threads = 1;
    for (const auto& [asked, given] : {std::pair(5, 3), std::pair(3, 3), std::pair(2, 2)}) {
        options.alternatives = static_cast<std::size_t>(asked);
        const auto found = search(setup, options).alternatives;
        REQUIRE(found.size() == static_cast<std::size_t>(given));
        for (const Answer& answer : found) {
            const DesignSetup reported = as_reported(completed(setup));
            CHECK(answer.similarity == Approx(similarity(reported, answer.genome, 1)).epsilon(1e-9));
            CHECK(answer.similarity_refined == Approx(similarity(reported, answer.genome, 4)).epsilon(1e-9));
            CHECK(answer.similarity_refined != Approx(similarity(reported, answer.genome, 8)).epsilon(1e-6));
            CHECK(answer.lowest() == answer.similarity_worst);
            CHECK(answer.lowest() <=
                  std::min({answer.similarity, answer.similarity_refined, answer.similarity_stepped}));
        }
    }
}
