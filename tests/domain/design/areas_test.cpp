#include "domain/design/pipelines.hpp"
#include "domain/design/search.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/trust.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

using namespace rough;

namespace {

DesignSetup drawn_area(Index side) {
    DesignSetup setup;
    setup.model.grid.nodes = setup.model.grid.rows = side;
    setup.model.grid.width = setup.model.grid.length;
    setup.targets = {read_target(RUGOSA_TEST_DATA "/target_paper.csv")};
    setup.max_pressure = 1.6e-4;
    return completed(setup);
}

} // namespace

TEST_CASE("the default search meets the drawn target on a small area and on one four times finer",
          "[areas]") {
    const DesignSetup setup = drawn_area(24);
    SearchOptions options;
    options.alternatives = 1;
    const SearchResult found = search(setup, options);
    // K differs by several per cent between the two grids.
    CHECK(found.best.similarity_worst > 0.85);
    CHECK(found.best.similarity_worst == found.best.verification.worst());
    options.threads = 1;
    CHECK(search(setup, options).best.lowest() == found.best.lowest());
    TrustOptions trust;
    trust.phase_draws = 2;
    const Trust verified = trust_in(setup, found.best.genome, trust, &found.best);
    CHECK(verified.checks.size() == 4); // no datum
    CHECK(verified.checks[2].similarity == found.best.similarity_refined);
    CHECK(verified.checks[1].similarity ==
          Approx(similarity(setup, respond(setup, found.best.genome, refined(setup.model, 2)))));
    CHECK(verified.kernels.size() == 1); // no strip
}

TEST_CASE("an area's search without time for verifying says that, with the answer's own curve all the same",
          "[areas]") {
    DesignSetup setup = drawn_area(24);
    for (const char* pipeline : {"", "shape 2 | score | best 1", "shape 1 | score verified"}) {
        SearchOptions options;
        options.pipeline = pipeline;
        options.alternatives = 2;
        options.seconds = 0;
        const SearchResult found = search(setup, options);
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
        TrustOptions trust;
        trust.phase_draws = 0;
        const Trust verified = trust_in(found.setup, best.genome, trust, &best, &own);
        CHECK(verified.left_out == std::vector<std::string>{"4 times the nodes", "4 times the load steps"});
        CHECK(std::all_of(verified.checks.begin(), verified.checks.end(),
                          [](const Check& check) { return std::isfinite(check.similarity); }));
        CHECK(verified.peak_pressure == verified.last.pressure.maxCoeff());
    }
}

TEST_CASE("an area's search that is asked to stop verifies nothing more, and takes no failure from it",
          "[areas]") {
    const DesignSetup setup = drawn_area(24);
    std::atomic<bool> stop = false;
    SearchOptions options;
    options.alternatives = 1;
    options.stop = &stop;
    long asked = 0;
    const SearchResult found =
        search(setup, options, {[&](const ga::Event<Genome>& event) {
                   stop = stop || (event.path.rfind("maps/refine", 0) == 0); // on the area's own grid
                   asked = event.counters.asked;
               }});
    CHECK(stop);
    CHECK_FALSE(found.best.is_verified());
    CHECK(found.best.verification.on_finer.empty());
    CHECK(found.best.similarity > 0.9);
    CHECK(found.counters.failures == 0);
    CHECK(found.stopped == "stop requested");
}

TEST_CASE("time that suffices changes nothing of an area's answer", "[areas]") {
    const DesignSetup setup = drawn_area(20);
    SearchOptions options;
    options.alternatives = 1;
    const SearchResult endless = search(setup, options);
    options.seconds = 1e6;
    const SearchResult timed = search(setup, options);
    CHECK(timed.best.lowest() == endless.best.lowest());
    CHECK(timed.best.is_verified());
    CHECK(timed.notes == endless.notes);
}
