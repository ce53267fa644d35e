#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

#include <boost/random/bernoulli_distribution.hpp>
#include <boost/random/geometric_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>

using namespace ga;

TEST_CASE("a stream draws the published numbers of splitmix64, and keeps its keys") {
    Stream stream(0);
    CHECK(stream() == 0xe220a8397b1dcdafu);
    CHECK(stream() == 0x6e789e6aa1b965f4u);
    CHECK(stream() == 0x06c45d188009454fu);
    CHECK(fold(1, 2) != fold(2, 1));
    CHECK(fold(1, "ab") != fold(1, "ba"));
    StagePosition<int> place("variant", 7); // the numbers of a place are those of earlier versions
    CHECK(place.stream(3)() == 0xf2bae56345f5ccb3u);
    const StagePosition<int>::Scope scope(place, Name(std::string("score")), 1);
    CHECK(place.stream(0)() == 0x5534ab290120db41u);
}

TEST_CASE("the distributions equal those of Boost.Random bit by bit") {
    namespace boosts = boost::random;
    Stream keys(3);
    const auto agree = [&](std::uint64_t key, std::size_t n, double p) {
        Stream ours(key), theirs(key);
        bool same = ours.uniform() == boosts::uniform_01<double>()(theirs);
        same &= ours.below(n) == boosts::uniform_int_distribution<std::size_t>(0, n - 1)(theirs);
        same &= ours.chance(p) == boosts::bernoulli_distribution<double>(p)(theirs);
        if (p > 1e-15 && p < 1) {
            const boosts::geometric_distribution<std::int64_t> gap(p);
            Chance(p).each(1 + n % 300, ours, [&, next = gap(theirs)](std::size_t i) mutable {
                same &= i == static_cast<std::size_t>(next);
                next += 1 + gap(theirs);
            });
        }
        return same && ours() == theirs();
    };
    bool all = true;
    for (int i = 0; i < 20000; ++i) {
        const std::size_t n = std::max<std::size_t>(1, keys() >> (i % 64));
        all &= agree(keys(), n, std::ldexp(keys.uniform(), -(i % 40)));
        all &= agree(keys(), std::size_t{1} << (i % 64), i % 2);
        all &= agree(0 - golden_step - static_cast<std::uint64_t>(i), 1 + n / 2, 0.5);
    }
    CHECK(all);
}

TEST_CASE("a thread without a job takes part in the loop that another job runs") {
    std::atomic<int> waiting = 0;
    std::atomic<bool> met = false;
    parallel_for(2, 2, [&](std::size_t outer) {
        if (outer == 0) return;
        parallel_for(2, 2, [&](std::size_t) {
            ++waiting;
            for (int i = 0; i < 10000 && waiting < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            if (waiting == 2)
                met = true;
            else
                waiting = 0;
        });
    });
    CHECK(met);
}

TEST_CASE("parallel work finishes, then throws its first exception in order") {
    for (const int threads : {1, 4}) {
        std::atomic<int> done = 0;
        CHECK_THROWS_WITH(parallel_for(20, threads,
                                       [&](std::size_t i) {
                                           ++done;
                                           if (i % 5 != 3) return;
                                           std::this_thread::sleep_for(std::chrono::milliseconds(20 - i));
                                           throw std::runtime_error(std::to_string(i));
                                       }),
                          "3");
        CHECK(done == 20);
    }
    CHECK_THROWS_WITH(parallel_for(2, 2,
                                   [](std::size_t i) {
                                       parallel_for(6, 2, [i](std::size_t j) {
                                           if (j > 3) throw std::runtime_error(std::to_string(10 * i + j));
                                       });
                                   }),
                      "4");
    CHECK_THROWS_WITH(thread_count(100000), Catch::Contains("out of range (0 to 1024)"));
    const int usual = omp_get_max_threads();
    omp_set_num_threads(7);
    CHECK((thread_count(0) == 7 && thread_count(1) == 1 && thread_count(3) == 3));
    omp_set_num_threads(usual);
}
