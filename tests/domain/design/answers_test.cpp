#include "domain/design/trust.hpp"
#include "tests/domain/design/setups.hpp"

#include <numbers>

using namespace rough;
using testing::drawn;

namespace {

/// Waves of frequency ratio 2, which fit the length: mirroring them changes the signs of their phases.
Genome waves_of(double first, double second, double scale = 0.01) {
    Genome genome = testing::two_waves(first, second, scale);
    genome.series[0].gamma = 2;
    return genome;
}

/// n periods of a cosine of amplitude 1.
Profile cosine(int n, double phase = 0) {
    Profile profile{Eigen::VectorXd(64), 0.1};
    for (Index i = 0; i < 64; ++i)
        profile.heights[i] = std::cos(2 * std::numbers::pi * n * (static_cast<double>(i) + 0.5) / 64 + phase);
    return profile;
}

Profile plus(Profile left, double factor, const Profile& right) {
    left.heights += factor * right.heights;
    return left;
}

} // namespace

TEST_CASE("the difference of profiles is 1 minus their correlation, mirrored or not") {
    const Profile skew = plus(cosine(1, 0.4), 0.7, cosine(2, 1.1));
    Profile mirrored = skew, larger = skew, lower = skew;
    mirrored.heights = skew.heights.reverse().eval();
    larger.heights *= 3;
    lower.heights.array() -= 5;
    for (const Profile& same : {skew, mirrored, larger, lower})
        CHECK(difference(skew, same) == Approx(0).margin(1e-14));
    CHECK(difference(mirrored, skew) == Approx(0).margin(1e-14));
    // Symmetric cosines: correlations by hand.
    CHECK(difference(cosine(1), cosine(2)) == Approx(1));
    CHECK(difference(cosine(1), cosine(1, std::numbers::pi)) == Approx(2));
    CHECK(difference(cosine(1), plus(cosine(1), 1, cosine(2))) == Approx(1 - 1 / std::sqrt(2.0)));
    Profile flat = cosine(1);
    flat.heights.setConstant(4);
    CHECK(difference(flat, flat) == 0);
}

TEST_CASE("alternatives differ, are as many as requested, and are verified on finer grids") {
    const DesignSetup setup = testing::like_itself(waves_of(0.3, 1));
    const DesignSetup reported = as_reported(setup);
    // The second is nearly the first, the third its mirror image, the last one higher.
    SearchOptions options{.pipeline = "score | best 6",
                          .starts = {waves_of(0.3, 1), waves_of(0.301, 1), waves_of(-0.3, -1), waves_of(0.3, 2.2),
                                     waves_of(0.3, 0.2), waves_of(0.3, 1, 0.011)},
                          .threads = 1};
    for (const std::size_t requested : {1u, 2u, 3u, 5u}) {
        options.alternatives = requested;
        const SearchResult found = search(setup, options);
        REQUIRE(found.alternatives.size() == std::min<std::size_t>(requested, 3));
        CHECK(found.alternatives[0].lowest() == found.best.lowest());
        CHECK(found.alternatives[0].difference == 1);
        std::vector<Profile> before;
        for (const Answer& answer : found.alternatives) {
            const Profile profile = sample(answer.genome, setup.model.grid);
            for (const Profile& other : before) CHECK(difference(profile, other) >= different);
            before.push_back(profile);
            CHECK(answer.similarity == Approx(similarity(reported, answer.genome, 1)).epsilon(1e-9));
            CHECK(answer.refined == Approx(similarity(reported, answer.genome, 4)).epsilon(1e-9));
            CHECK(answer.refined != Approx(similarity(reported, answer.genome, 8)).epsilon(1e-6));
            CHECK(answer.lowest() == answer.worst);
            CHECK(answer.lowest() <= answer.both);
        }
        if (requested > 1) CHECK(found.alternatives[1].difference == Approx(difference(before[0], before[1])));
    }
}

TEST_CASE("the default search of an area meets the drawn target on a grid four times finer", "[areas]") {
    DesignSetup setup = drawn(24, true);
    setup.required_similarity = 0.85;
    SearchOptions options{.alternatives = 1};
    const SearchResult found = search(setup, options);
    CHECK(found.best.worst > 0.85); // K differs by several per cent between the two grids
    options.threads = 1;
    CHECK(search(setup, options).best.lowest() == found.best.lowest());
    options.seconds = 1e6;
    const SearchResult timed = search(setup, options);
    CHECK(timed.best.lowest() == found.best.lowest());
    CHECK(timed.notes == found.notes);
    const Trust verified = trust_in(setup, found.best.genome, {.phase_draws = 2}, &found.best);
    CHECK(verified.checks.size() == 3); // without the datum
    CHECK(verified.checks[1].similarity == found.best.refined);
    CHECK(verified.kernels.size() == 1); // without the strip
}

TEST_CASE("an area's answer without time to verify it has a curve and a note", "[areas]") {
    const DesignSetup setup = drawn(24, true);
    for (const char* pipeline : {"", "shape 2 | score | best 1", "shape 1 | score verified"}) {
        const SearchResult found = search(setup, {.pipeline = pipeline, .seconds = 0, .alternatives = 2});
        const Answer& best = found.best;
        CHECK_FALSE(best.is_verified());
        CHECK(std::isnan(best.refined));
        CHECK(best.on_finer.empty());
        const DesignResponse own = response_of(setup, best);
        CHECK(best.similarity == similarity(setup, own));
        CHECK(best.similarity == Approx(similarity(setup, best.genome)).margin(1e-5));
        CHECK(own.responses[0].pressure.tail(1)[0] == Approx(1.6e-4));
        CHECK(std::any_of(found.notes.begin(), found.notes.end(),
                          [](const std::string& note) { return note.find("lack of time") != std::string::npos; }));
        const Trust verified = trust_in(setup, best.genome, {.phase_draws = 0}, &best, &own);
        CHECK(verified.left_out == std::vector<std::string>{"4 times the nodes", "16 times the load steps"});
        CHECK(std::all_of(verified.checks.begin(), verified.checks.end(),
                          [](const Check& check) { return std::isfinite(check.similarity); }));
        CHECK(verified.peak_pressure == verified.last.pressure.maxCoeff());
    }
}

TEST_CASE("an area's search that is stopped verifies nothing and counts no failure", "[areas]") {
    std::atomic<bool> stop = false;
    const SearchResult found = search(
        drawn(24, true), {.stop = &stop, .alternatives = 1},
        {[&](const ga::Event<Genome>& event) { stop = stop || event.path.find("/refine") != std::string::npos; }});
    CHECK(stop);
    CHECK_FALSE(found.best.is_verified());
    CHECK(found.best.on_finer.empty());
    CHECK(found.best.similarity > 0.9);
    CHECK(found.counters.failures == 0);
    CHECK(found.stopped == "stop requested");
}
