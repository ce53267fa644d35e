#include "tests/ga/problems.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace ga;

namespace {

/// Notes the most threads that the process had during an evaluation.
struct Watched : Reals {
    std::atomic<long>* most;

    Outcome evaluate(const Genome& x) const {
        std::ifstream status("/proc/self/status");
        for (std::string word; status >> word;)
            if (word == "Threads:") {
                long threads = 0;
                status >> threads;
                if (threads > *most)
                    *most = threads;
            }
        return x;
    }
};

} // namespace

TEST_CASE("nested islands keep to a bounded number of threads and give the same bits on any") {
    std::vector<std::vector<double>> first;
    for (const int threads : {1, 3}) {
        std::atomic<long> most = 0;
        const Watched problem{{}, &most};
        const auto nest = islands(20, {.rounds = 2}, islands(20, {.rounds = 1}, mutate(0.5) | score()));
        const auto result = run<Watched>(sample(400) | score() | nest, problem, {}, {.threads = threads});
        CHECK(result.population.size() == 400);
        CHECK(most <= 64 + 64 + 8);
        std::vector<std::vector<double>> genomes;
        for (const auto& each : result.population)
            genomes.push_back(each.genome);
        CHECK((first.empty() || genomes == first));
        first = genomes;
    }
}
