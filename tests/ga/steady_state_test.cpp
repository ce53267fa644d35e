#include "ga/pipeline/steady_state.hpp"
#include "tests/ga/problems.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

using Search = SteadyState<Reals>;

std::unique_ptr<Search> search_of(long evaluations, std::uint64_t seed = 3, std::size_t size = 10) {
    const RunOptions options{.seed = seed, .budget = {.evaluations = evaluations}};
    return std::make_unique<Search>(sample(size), tournament(2, 2) | cross(blend()) | mutate(0.3), plus(),
                                    Reals{}, options);
}

/// Asks for four workers that finish in an order drawn at random, one of them hardly ever; every 17th fails.
void run_scrambled(Search& search, std::uint64_t order) {
    Stream stream(order);
    std::vector<Search::Proposal> open;
    for (;;) {
        while (open.size() < 4) {
            auto question = search.ask();
            if (!question)
                break;
            open.push_back(std::move(*question));
        }
        if (open.empty())
            return;
        const std::size_t slow = stream.chance(0.02) || open.size() == 1 ? 0 : 1; // the oldest waits
        const std::size_t k = slow + stream.below(open.size() - slow);
        if (open[k].id % 17 == 16)
            search.fail(open[k].id, "broke");
        else
            search.tell(open[k].id, open[k].genome);
        open.erase(open.begin() + static_cast<long>(k));
    }
}

} // namespace

TEST_CASE("the log of a steady-state search with answers in any order replays to the same bits") {
    std::string first;
    for (const std::uint64_t order : {1u, 2u}) {
        const auto search = search_of(300);
        run_scrambled(*search, order);
        CHECK(search->result().counters.requested == 300);
        CHECK(search->result().counters.failures == 17);
        CHECK(search->result().population.size() == 10);
        CHECK(search->result().best->value() > -0.05);
        const auto again = search_of(300);
        again->replay(search->log());
        CHECK(bits_of(again->result()) == bits_of(search->result()));
        CHECK(bits_of(search->result()) != first); // the order decides
        first = bits_of(search->result());
        CHECK_THROWS_AS(search_of(300, 4, 3)->replay(search->log()), UsageError);
    }
}

TEST_CASE("a steady-state search asks on while its slowest evaluation is open") {
    const auto search = search_of(200);
    const auto slowest = *search->ask();
    for (auto question = search->ask(); question; question = search->ask())
        search->tell(question->id, question->genome);
    CHECK(search->result().counters.requested == 199);
    CHECK(search->open() == 1);
    search->tell(slowest.id, slowest.genome);
    CHECK(search->result().counters.requested == 200);
    CHECK_THROWS_WITH(search->tell(slowest.id, slowest.genome),
                      "question 0 is not open; answer one that ask returned");
    CHECK(!search->ask());
}

TEST_CASE("nothing is bred before anything is known") {
    const auto search = search_of(20, 3, 2);
    const auto first = *search->ask(), second = *search->ask();
    CHECK(!search->ask());
    search->tell(second.id, second.genome);
    CHECK(search->ask()->id == 2);
    search->fail(first.id, "broke");
    CHECK(search->result().population.size() == 2);
    CHECK(search->result().best->genome == second.genome);
}

TEST_CASE("a steady-state search on threads keeps to its budget and replays") {
    struct Uneven : Reals {
        Outcome evaluate(const Genome& x) const {
            if (x[0] > 0.3)
                std::this_thread::sleep_for(std::chrono::microseconds(300));
            return x;
        }
    };
    const RunOptions options{.budget = {.evaluations = 150}};
    const auto breed = Pipeline<Uneven>(tournament(2, 1) | mutate(0.3));
    SteadyState<Uneven> search(sample(8), breed, steady(), Uneven{}, options);
    run_steady(search, Uneven{}, 3);
    CHECK(search.result().counters.requested == 150);
    CHECK(search.open() == 0);
    SteadyState<Uneven> again(sample(8), breed, steady(), Uneven{}, options);
    again.replay(search.log());
    CHECK(again.result().best->genome == search.result().best->genome);
    CHECK(again.result().population.back().genome == search.result().population.back().genome);
}

TEST_CASE("stages that cannot work in a steady-state search are refused before it begins") {
    CHECK_THROWS_AS(SteadyState<Reals>(best(1), mutate(0.3), plus(), Reals{}), UsageError);
    CHECK_THROWS_AS(SteadyState<Reals>(sample(3), mutate(0.3), mutate(0.3), Reals{}), UsageError);
    SteadyState<Reals> idle(sample(1), tournament(2, 1), plus(), Reals{});
    const auto question = *idle.ask();
    idle.tell(question.id, question.genome);
    CHECK_THROWS_AS(idle.ask(), NothingLeft);
}
