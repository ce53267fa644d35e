#include "apps/cluster/ranks.hpp"

#ifdef RUGOSA_MPI

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <list>
#include <mpi.h>
#include <mutex>
#include <set>
#include <thread>

namespace app::ranks {

namespace {

struct OnItsWay {
    Message message;
    MPI_Request request = MPI_REQUEST_NULL;

    bool done() {
        int is_done = 0;
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        return is_done != 0;
    }
};

int ranks = 1, own_rank = 0;
std::timed_mutex guard; // of all below and of MPI, which takes one thread at a time
std::list<OnItsWay> outgoing, incoming;
Traffic counted;

void count_in(std::size_t bytes) {
    ++counted.messages;
    counted.bytes += bytes;
}

bool tidy() {
    outgoing.remove_if([](OnItsWay& one) { return one.done(); });
    return outgoing.empty();
}

/// What programs that a rank starts find in their environment: they are no ranks.
constexpr const char* child_of_rank = "RUGOSA_RANK";

bool is_given(const char* name) { return std::getenv(name) != nullptr; }
bool by_mpirun() { return is_given("OMPI_COMM_WORLD_SIZE"); } // Open MPI's
bool launched() {
    return !is_given(child_of_rank) && (by_mpirun() || is_given("PMIX_RANK") || is_given("PMI_RANK"));
}

/// Ends this process after so many seconds, should MPI not let it end before: it waits for ranks that are
/// gone.
void end_within(double seconds, int code) {
    std::thread([=] {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        std::_Exit(code);
    }).detach();
}

} // namespace

void join() {
    if (!launched())
        return;
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN); // who is gone is found out by silence
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &own_rank);
    ::setenv(child_of_rank, "", 1);
}

int count() { return ranks; }
int own() { return own_rank; }

void send(int to, int word, std::string bytes) {
    const std::lock_guard lock(guard);
    count_in(bytes.size());
    OnItsWay& one = outgoing.emplace_back();
    one.message = {to, word, std::move(bytes)};
    MPI_Isend(one.message.bytes.data(), static_cast<int>(one.message.bytes.size()), MPI_BYTE, to, word,
              MPI_COMM_WORLD, &one.request);
}

std::vector<Message> arrived() {
    const std::lock_guard lock(guard);
    for (;;) {
        int is_there = 0, size = 0;
        MPI_Message handle;
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status);
        if (!is_there)
            break;
        MPI_Get_count(&status, MPI_BYTE, &size);
        count_in(static_cast<std::size_t>(size));
        OnItsWay& one = incoming.emplace_back();
        one.message = {status.MPI_SOURCE, status.MPI_TAG, std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Imrecv(one.message.bytes.data(), size, MPI_BYTE, &handle, &one.request);
    }
    std::vector<Message> whole;
    std::set<int> behind; // another of the same rank that is not whole yet
    for (auto one = incoming.begin(); one != incoming.end();)
        if (behind.count(one->message.rank) == 0 && one->done()) {
            whole.push_back(std::move(one->message));
            one = incoming.erase(one);
        } else {
            behind.insert(one->message.rank);
            ++one;
        }
    tidy();
    return whole;
}

bool responds(double seconds) {
    constexpr int looks = 10; // the time of one may be a suspension's
    for (int look = 0; look < looks; ++look)
        if (const std::unique_lock lock(guard, std::chrono::duration<double>(seconds / looks)); lock)
            return true;
    return false;
}

Traffic traffic() {
    const std::lock_guard lock(guard);
    return counted;
}

void leave(double seconds, int code) {
    if (int begun = 0; MPI_Initialized(&begun) != MPI_SUCCESS || !begun)
        return;
    end_within(seconds, code);
    const auto all_sent = [] {
        const std::lock_guard lock(guard);
        return tidy();
    };
    while (!all_sent())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    MPI_Finalize();
}

void end_all(double seconds, int code) {
    // mpirun ends the others when one ends without MPI_Finalize; Open MPI 4.1's misreads the message of
    // MPI_Abort now and then. Other launchers may have been told not to (srun --kill-on-bad-exit=0).
    if (ranks > 1 && !by_mpirun()) {
        end_within(seconds, code);
        MPI_Abort(MPI_COMM_WORLD, code);
    }
    std::_Exit(code);
}

} // namespace app::ranks

#else

#include <cstdlib>

namespace app::ranks {

void join() {}
int count() { return 1; }
int own() { return 0; }
void send(int, int, std::string) {}
std::vector<Message> arrived() { return {}; }
bool responds(double) { return true; }
Traffic traffic() { return {}; }
void leave(double, int) {}
void end_all(double, int code) { std::_Exit(code); }

} // namespace app::ranks

#endif
