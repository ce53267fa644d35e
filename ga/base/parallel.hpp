#pragma once

#include "ga/base/errors.hpp"

#include <omp.h>

#include <cstddef>
#include <exception>
#include <latch>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace ga {

/// Throws std::system_error if the system cannot start this number of threads, because OpenMP would end the
/// program. A number that was started before is not tested again.
inline void expect_threads(int threads) {
    static std::mutex guard;
    static int given = 1;
    const std::lock_guard lock(guard);
    if (threads <= given) return;
    std::latch all(threads);
    std::vector<std::jthread> started;
    try {
        while (std::ssize(started) < threads) started.emplace_back([&] { all.arrive_and_wait(); });
    } catch (const std::system_error&) {
        all.count_down(threads - std::ssize(started));
        throw;
    }
    given = threads;
}

/// Runs job(i) for i = 0 .. n-1 on up to `threads` threads, in any order. A free thread takes the next `chunk` jobs. In
/// a job of another loop, the free threads of that loop take part. An exception does not stop the other jobs. The
/// exception of the smallest i is thrown again at the end.
template <class Job>
void parallel_for(std::size_t n, int threads, Job job, std::size_t chunk = 1) {
    std::exception_ptr error;
    std::size_t failed = n;
    const auto guarded = [&](std::size_t i) {
        try {
            job(i);
        } catch (...) {
#pragma omp critical(ga_parallel_for)
            if (i < failed) {
                failed = i;
                error = std::current_exception();
            }
        }
    };
    if (threads <= 1 || n <= 1) {
        for (std::size_t i = 0; i < n; ++i) guarded(i);
    } else if (omp_in_parallel()) {
#pragma omp taskloop grainsize(chunk)
        for (std::size_t i = 0; i < n; ++i) guarded(i);
    } else {
        expect_threads(threads);
#pragma omp parallel for schedule(dynamic, chunk) num_threads(threads)
        for (std::size_t i = 0; i < n; ++i) guarded(i);
    }
    if (error) std::rethrow_exception(error);
}

/// The requested number of threads, or OpenMP's default for 0. Throws UsageError if the number exceeds 1024.
inline int thread_count(int requested) {
    constexpr int max_threads = 1024;
    if (requested > max_threads)
        throw UsageError("threads: " + std::to_string(requested) + " is out of range (0 to " +
                         std::to_string(max_threads) + ")");
    return requested > 0 ? requested : omp_get_max_threads();
}

} // namespace ga
