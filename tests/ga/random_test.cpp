#include "ga/base/random.hpp"
#include "ga/problem/fingerprint.hpp"
#include "ga/run/state.hpp"

#include <boost/random/bernoulli_distribution.hpp>
#include <boost/random/geometric_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <set>

using namespace ga;

namespace {

/// Kolmogorov and Smirnov's distance of n numbers from a distribution, in units of 1 / sqrt(n).
double distance_from(std::vector<double> numbers, double (*distribution)(double)) {
    std::sort(numbers.begin(), numbers.end());
    const auto n = static_cast<double>(numbers.size());
    double most = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double there = distribution(numbers[i]);
        most = std::max({most, there - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - there});
    }
    return most * std::sqrt(n);
}

} // namespace

TEST_CASE("streams are splitmix64, by its published numbers") {
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

TEST_CASE("the distributions are Boost.Random's, bit by bit and draw by draw") {
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

TEST_CASE("uniform and normal numbers have their distributions, whole numbers equal shares") {
    std::vector<double> uniform, shifted, normal;
    std::vector<long> counts(7);
    for (std::uint64_t key = 0; key < 20000; ++key) { // the first of many streams
        uniform.push_back(Stream(fold(1, key)).uniform());
        shifted.push_back((Stream(fold(2, key)).uniform(-3, 5) + 3) / 8);
        normal.push_back(Stream(fold(3, key)).normal());
        ++counts[Stream(fold(4, key)).below(7)];
    }
    const auto line = [](double x) { return x; };
    CHECK(distance_from(uniform, line) < 1.95); // 0.1 % of right ones are further
    CHECK(distance_from(shifted, line) < 1.95);
    CHECK(distance_from(normal, [](double x) { return std::erfc(-x / std::sqrt(2.0)) / 2; }) < 1.95);
    double chi_squared = 0;
    for (const long count : counts)
        chi_squared += std::pow(static_cast<double>(count) - 20000 / 7.0, 2) / (20000 / 7.0);
    CHECK(chi_squared < 22.5); // 6 degrees of freedom, 0.1 %
    CHECK(Stream(5).below(1) == 0);
}

TEST_CASE("a chance picks each of a row independently with its probability") {
    for (const double p : {0.0, 0.003, 0.2, 0.9, 1.0}) {
        const Chance chance(p);
        CHECK(chance.probability() == p);
        const std::size_t n = 50000;
        std::vector<bool> picked(n);
        Stream stream(9);
        chance.each(n, stream, [&](std::size_t i) { picked.at(i) = true; });
        double count = 0, both = 0;
        for (std::size_t i = 0; i < n; ++i) {
            count += picked[i] ? 1 : 0;
            both += i > 0 && picked[i] && picked[i - 1] ? 1 : 0;
        }
        const auto size = static_cast<double>(n);
        CHECK(std::abs(count - p * size) <= 4 * std::sqrt(p * (1 - p) * size));
        CHECK(std::abs(both - p * p * (size - 1)) <= 10 * std::sqrt(p * p * (1 - p) * size) + p * p);
    }
    Stream stream(1);
    std::vector<std::size_t> first;
    for (int i = 0; i < 4000; ++i)
        Chance(0.3).each(1, stream, [&](std::size_t at) { first.push_back(at); });
    CHECK(std::abs(static_cast<double>(first.size()) - 1200) < 4 * std::sqrt(4000 * 0.3 * 0.7));
}

TEST_CASE("every bit of a genome, its order and its length decide both halves of its fingerprint") {
    std::string bytes(41, 'a');
    const Fingerprint whole = fingerprint(std::string_view(bytes));
    double high = 0, low = 0;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        const char before = bytes[bit / 8];
        bytes[bit / 8] = static_cast<char>(before ^ (1 << bit % 8));
        const Fingerprint other = fingerprint(std::string_view(bytes));
        bytes[bit / 8] = before;
        high += std::popcount(whole.high ^ other.high);
        low += std::popcount(whole.low ^ other.low);
    }
    const double flips = 8 * static_cast<double>(bytes.size());
    CHECK(std::abs(high / flips - 32) < 1); // the mean of 328 binomials of 64 bits, deviation 0.22
    CHECK(std::abs(low / flips - 32) < 1);
    std::set<std::pair<std::uint64_t, std::uint64_t>> all;
    for (std::size_t length = 0; length < 70; ++length) {
        const Fingerprint print = fingerprint(std::string_view(std::string(length, '\0')));
        all.insert({print.high, print.low});
    }
    CHECK(all.size() == 70);
    CHECK(fingerprint(std::string_view("abc")) == // as checkpoints hold it
          Fingerprint{0x1a7a74f2493112f3u, 0x81be01565d047e5au});
    CHECK(fingerprint(std::string_view("0123456789abcdefg")) ==
          Fingerprint{0xd104d0a51fdea976u, 0xea75ae4e6fd17c8eu});
    CHECK(!(fingerprint(std::vector<double>{1, 2, 3}) == fingerprint(std::vector<double>{2, 1, 3})));
    CHECK(!(fingerprint(std::vector<double>{1, 2, 3}) == fingerprint(std::vector<double>{1, 2, 4})));
    CHECK(!(fingerprint(std::vector<bool>{true, false}) == fingerprint(std::vector<bool>{false, true})));
}
