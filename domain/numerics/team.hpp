#pragma once

#include "domain/numerics/grid.hpp"

#include <omp.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace rough {

/// OpenMP's threads for the loops of one curve. Blocks and ranges do not depend on the number of threads, so
/// results do not either. One caller at a time.
class Team {
  public:
    /// Up to `threads` threads with the caller's; only the caller's inside a parallel loop, or if the system
    /// does not give that many.
    explicit Team(int threads);
    /// A team of only the caller's thread.
    static Team& alone();

    int size() const { return size_; } ///< threads, the caller's included

    /// Runs job(block, worker) for all blocks in any order; 0 <= worker < size(). A job must not throw.
    template <class Job>
    void each_block(Index blocks, const Job& job) {
#pragma omp parallel for schedule(dynamic) num_threads(size_) if (size_ > 1 && blocks > 1)
        for (Index block = 0; block < blocks; ++block) job(block, omp_get_thread_num());
    }

    /// Numbers that one thread takes at a time.
    static constexpr Index usual_length = 16384;

    /// Runs job(first, count, worker) for ranges of `length` of n things.
    template <class Job>
    void each_range(Index n, const Job& job, Index length = usual_length) {
        each_block((n + length - 1) / length,
                   [&](Index block, int worker) { job(block * length, std::min(length, n - block * length), worker); });
    }

    /// Runs job(i) for i = 0 .. n-1.
    template <class Job>
    void each(Index n, const Job& job) {
        each_range(n, [&](Index first, Index count, int) {
            for (Index i = first; i < first + count; ++i) job(i);
        });
    }

    /// part(first, count) of the ranges of n numbers, joined by combine(a, b) from the first to the last.
    template <class Part, class Combine>
    double over_ranges(Index n, const Part& part, const Combine& combine) {
        if (n <= usual_length) return n > 0 ? part(Index(0), n) : 0;
        std::vector<double> parts(static_cast<std::size_t>((n + usual_length - 1) / usual_length));
        each_range(n, [&](Index first, Index count, int) {
            parts[static_cast<std::size_t>(first / usual_length)] = part(first, count);
        });
        double all = parts.front();
        for (std::size_t k = 1; k < parts.size(); ++k) all = combine(all, parts[k]);
        return all;
    }
    /// The sum of part(first, count) over the ranges.
    template <class Part>
    double sum(Index n, const Part& part) {
        return over_ranges(n, part, [](double a, double b) { return a + b; });
    }
    /// The sum of value(i), i = 0 .. n-1, range by range.
    template <class Value>
    double sum_of(Index n, const Value& value) {
        return sum(n, [&](Index first, Index count) {
            double all = 0;
            for (Index i = first; i < first + count; ++i) all += value(i);
            return all;
        });
    }
    /// The largest part(first, count) of the ranges, NaN if the last one's is.
    template <class Part>
    double largest(Index n, const Part& part) {
        return over_ranges(n, part, [](double a, double b) { return a > b ? a : b; });
    }

    /// The largest of 0 and value(i), i = 0 .. n-1; NaN counts as smaller.
    template <class Value>
    double largest_of(Index n, const Value& value) {
        return largest(n, [&](Index first, Index count) {
            double max = 0;
            for (Index i = first; i < first + count; ++i) max = std::max(max, value(i));
            return max;
        });
    }

    /// to = from, without new memory if the sizes are equal.
    template <class From, class To>
    void copy(const From& from, To& to) {
        to.resize(from.size());
        each_range(from.size(),
                   [&](Index first, Index count, int) { std::copy_n(from.data() + first, count, to.data() + first); });
    }
    /// The numbers i < n for which holds(i), increasing.
    template <class Holds>
    std::vector<int> where(Index n, const Holds& holds) {
        std::vector<std::vector<int>> parts(static_cast<std::size_t>((n + usual_length - 1) / usual_length));
        each_range(n, [&](Index first, Index count, int) {
            std::vector<int>& part = parts[static_cast<std::size_t>(first / usual_length)];
            for (Index i = first; i < first + count; ++i)
                if (holds(i)) part.push_back(static_cast<int>(i));
        });
        std::vector<int> numbers;
        for (const std::vector<int>& part : parts) numbers.insert(numbers.end(), part.begin(), part.end());
        return numbers;
    }

  private:
    int size_;
};

} // namespace rough
