#include "apps/cluster/hands.hpp"

#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <stdexcept>

namespace app {

Hands::~Hands() {
    if (!thread_.joinable())
        return;
    drop();
    {
        const std::lock_guard lock(guard_);
        ends_ = true;
    }
    given_.notify_one();
    thread_.join();
}

void Hands::give(Chunk chunk) {
    {
        const std::lock_guard lock(guard_);
        last_ = chunk.id;
        chunks_.push_back(std::move(chunk));
        ++has_;
    }
    given_.notify_one();
    if (!thread_.joinable())
        thread_ = std::thread([this] { work(); });
}

std::optional<Done> Hands::done() {
    const std::lock_guard lock(guard_);
    if (finished_.empty())
        return std::nullopt;
    Done first = std::move(finished_.front());
    finished_.pop_front();
    --has_;
    return first;
}

std::size_t Hands::has() const {
    const std::lock_guard lock(guard_);
    return has_;
}

void Hands::drop() {
    const std::lock_guard lock(guard_);
    dropped_ = last_;
}

void Hands::wait(std::chrono::microseconds most) {
    std::unique_lock lock(guard_);
    done_.wait_for(lock, most, [&] { return !finished_.empty(); });
}

void Hands::work() {
    std::shared_ptr<const Assignment> known;
    Work work;
    for (;;) {
        std::unique_lock lock(guard_);
        given_.wait(lock, [&] { return ends_ || !chunks_.empty(); });
        if (chunks_.empty())
            return;
        const Chunk chunk = std::move(chunks_.front());
        chunks_.pop_front();
        lock.unlock();
        Done done{chunk.id};
        ga::Stopwatch clock;
        const auto unwanted = [&] { return chunk.id <= dropped_; };
        try {
            if (!unwanted() && chunk.of != known) {
                const auto kind = std::find_if(kinds().begin(), kinds().end(),
                                               [&](const Kind& one) { return chunk.of->kind == one.name; });
                work = kind->under(chunk.of->setting);
                known = chunk.of;
                clock = ga::Stopwatch(); // the first chunk's tasks cost no more than the others'
            }
            done.answers.resize(chunk.tasks.size());
            ga::parallel_for(chunk.tasks.size(), ga::thread_count(chunk.threads), [&](std::size_t i) {
                if (!unwanted())
                    done.answers[i] = work(chunk.tasks[i]);
            });
        } catch (const std::bad_alloc&) {
            done.error = "out of memory";
        } catch (const std::exception& error) {
            done.error = error.what();
        }
        done.seconds = clock.seconds();
        lock.lock();
        finished_.push_back(std::move(done));
        lock.unlock();
        done_.notify_one();
    }
}

} // namespace app
