#include "ga/pipeline/ask_tell.hpp"
#include "ga/refinement/refinement.hpp"
#include "tests/ga/vectors.hpp"

#include <catch2/catch.hpp>

using namespace ga;

namespace {

/// Nothing is evaluated inside; what is outside is what Vectors says.
struct Outside : Vectors {
    Outcome evaluate(const Genome&) const { throw std::logic_error("evaluated inside"); }
};

std::string bits_of(const Result<std::vector<double>>& result) {
    std::string text = result.stopped;
    for (const auto& each : result.population) {
        text += std::to_string(each.identity) + ":";
        for (const double gene : each.genome)
            text += number(gene) + " ";
        text += number(each.value()) + "\n";
    }
    return text + std::to_string(result.counters.asked) + " " + std::to_string(result.counters.evaluations);
}

auto pipeline() {
    return sample(12) | score() |
           repeat(4, tournament(2) | cross(blend()) | mutate(0.3) | score() | elite(1)) |
           islands(3, {.rounds = 2, .migrants = 1}, mutate(0.3) | score()) | best(3) |
           refine(nlopt_method("LN_COBYLA", 5)) | best(2);
}

} // namespace

TEST_CASE("a pipeline driven from outside gives the bits of one that runs by itself, in whatever order it is "
          "told") {
    const auto inside = run<Vectors>(pipeline(), Vectors{}, {}, {.seed = 5});
    AskTell<Outside> search(pipeline(), Outside{}, {}, {.seed = 5});
    std::size_t told = 0;
    for (auto questions = search.ask(); !questions.empty(); questions = search.ask()) {
        CHECK(questions.front().id == told);
        std::reverse(questions.begin(), questions.end());
        if (questions.size() > 1) { // a part of the batch; the rest is asked for again
            const auto [id, genome] = questions.back();
            questions.pop_back();
            search.tell(id, genome);
            CHECK(search.ask().size() == questions.size());
            ++told;
        }
        for (const auto& [id, genome] : questions)
            search.tell(id, genome);
        told += questions.size();
    }
    CHECK(bits_of(search.result()) == bits_of(inside));
    CHECK(told == static_cast<std::size_t>(inside.counters.evaluations));
}

TEST_CASE("a run that is left half-way ends with what it has, or with nobody looking") {
    AskTell<Outside> search(pipeline(), Outside{});
    auto questions = search.ask();
    REQUIRE(questions.size() == 12);
    for (std::size_t i = 0; i < 5; ++i)
        search.tell(questions[i].id, questions[i].genome);
    search.fail(questions[5].id, "broke");
    const auto part = search.result();
    CHECK(part.stopped == "stop requested");
    CHECK(part.population.size() == 6);
    CHECK(part.counters.evaluations == 6);
    CHECK(part.counters.failures == 1);
    CHECK(search.ask().empty());
    search.tell(questions[7].id, questions[7].genome); // too late, and no matter

    const AskTell<Outside> never_asked(pipeline(), Outside{});
    std::atomic<bool> stop = true;
    AskTell<Outside> by_budget(pipeline(), Outside{}, {}, {.budget = {.stop = &stop}});
    CHECK(by_budget.result().stopped == "stop requested");
    AskTell<Outside> by_time(pipeline(), Outside{}, {}, {.budget = {.seconds = 0.01}});
    while (!by_time.ask().empty()) {
    }
    CHECK(by_time.result().stopped == "time budget spent");
}

TEST_CASE("what is wrong with a run that is driven from outside is thrown to who drives it") {
    CHECK_THROWS_WITH(AskTell<Outside>(score() | best(1), Outside{}),
                      "the population is empty; expected one individual at least, or sample before all");
    AskTell<Outside> failing(pipeline(), Outside{});
    for (const auto& question : failing.ask())
        failing.fail(question.id, "broke");
    CHECK_THROWS_AS(failing.ask(), NothingLeft);
    CHECK_THROWS_WITH(failing.result(), "every one of 12 evaluations failed; the first: broke");

    const Observer<std::vector<double>> breaks = [](const auto&) { throw std::runtime_error("seen enough"); };
    AskTell<Outside> watched(pipeline(), Outside{}, {}, {}, {breaks});
    CHECK_THROWS_WITH(watched.ask(), "seen enough");

    AskTell<Outside> search(pipeline(), Outside{});
    const auto questions = search.ask();
    search.tell(0, questions[0].genome);
    CHECK_THROWS_WITH(search.tell(0, questions[0].genome),
                      "question 0 is not open; expected one that ask gave");
    CHECK_THROWS_AS(search.tell(12, {}), UsageError);
}

TEST_CASE("who asks while the run is busy with its own work waits for the next questions") {
    std::atomic<bool> busy = false;
    const Observer<std::vector<double>> slow = [&](const auto&) {
        busy = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        busy = false;
    };
    AskTell<Outside> search(sample(3) | score() | mutate(1) | score(), Outside{}, {}, {}, {slow});
    std::size_t told = 0;
    for (auto questions = search.ask(); !questions.empty(); questions = search.ask()) {
        for (const auto& [id, genome] : questions)
            search.tell(id, genome);
        told += questions.size();
        while (told == 3 && !busy)
            std::this_thread::yield();
    }
    CHECK(told == 6);
    CHECK(search.result().stopped.empty());
}
