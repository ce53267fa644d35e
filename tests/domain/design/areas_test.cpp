#include "domain/design/search.hpp"
#include "domain/design/trust.hpp"
#include "tests/domain/design/setups.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

using namespace rough;
using testing::drawn;

TEST_CASE("the default search of an area meets the drawn target on a grid four times finer", "[areas]") {
    const DesignSetup setup = drawn(24, true);
    SearchOptions options{.alternatives = 1};
    const SearchResult found = search(setup, options);
    CHECK(found.best.similarity_worst > 0.85); // K differs by several per cent between the two grids
    CHECK(found.best.similarity_worst == found.best.verification.worst());
    options.threads = 1;
    CHECK(search(setup, options).best.lowest() == found.best.lowest());
    options.seconds = 1e6;
    const SearchResult timed = search(setup, options);
    CHECK(timed.best.lowest() == found.best.lowest());
    CHECK(timed.notes == found.notes);
    const Trust verified = trust_in(setup, found.best.genome, {.phase_draws = 2}, &found.best);
    CHECK(verified.checks.size() == 4); // without the datum
    CHECK(verified.checks[2].similarity == found.best.similarity_refined);
    CHECK(verified.checks[1].similarity ==
          Approx(similarity(setup, respond(setup, found.best.genome, refined(setup.model, 2)))));
    CHECK(verified.kernels.size() == 1); // without the strip
}

TEST_CASE("an area's answer without time to verify it has a curve and a note", "[areas]") {
    const DesignSetup setup = drawn(24, true);
    for (const char* pipeline : {"", "shape 2 | score | best 1", "shape 1 | score verified"}) {
        const SearchResult found = search(setup, {.pipeline = pipeline, .seconds = 0, .alternatives = 2});
        const Answer& best = found.best;
        CHECK_FALSE(best.is_verified());
        CHECK(std::isnan(best.similarity_refined));
        CHECK(best.verification.on_finer.empty());
        CHECK_FALSE(found.setup.model.contact.stop);
        const DesignResponse own = response_of(found.setup, best);
        CHECK(best.similarity == similarity(found.setup, own));
        CHECK(best.similarity == Approx(similarity(found.setup, best.genome)).margin(1e-5));
        CHECK(own.responses[0].pressure.tail(1)[0] == Approx(1.6e-4));
        CHECK(std::any_of(found.notes.begin(), found.notes.end(),
                          [](const std::string& note) { return note.find("no time") != std::string::npos; }));
        const Trust verified = trust_in(found.setup, best.genome, {.phase_draws = 0}, &best, &own);
        CHECK(verified.left_out == std::vector<std::string>{"4 times the nodes", "4 times the load steps"});
        CHECK(std::all_of(verified.checks.begin(), verified.checks.end(),
                          [](const Check& check) { return std::isfinite(check.similarity); }));
        CHECK(verified.peak_pressure == verified.last.pressure.maxCoeff());
    }
}

TEST_CASE("an area's search that is stopped verifies nothing and counts no failure", "[areas]") {
    std::atomic<bool> stop = false;
    const SearchResult found =
        search(drawn(24, true), {.stop = &stop, .alternatives = 1}, {[&](const ga::Event<Genome>& event) {
                   stop = stop || (event.path.rfind("maps/refine", 0) == 0); // on the search grid
               }});
    CHECK(stop);
    CHECK_FALSE(found.best.is_verified());
    CHECK(found.best.verification.on_finer.empty());
    CHECK(found.best.similarity > 0.9);
    CHECK(found.counters.failures == 0);
    CHECK(found.stopped == "stop requested");
}
