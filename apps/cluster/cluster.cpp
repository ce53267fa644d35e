#include "apps/cluster/cluster.hpp"

#include "apps/prompt/terminal.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/vector_loops.hpp"
#include "ga/base/json.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <future>
#include <limits>
#include <unistd.h>
#ifdef RUGOSA_MPI
#include <mpi.h>
#endif

namespace app::cluster {
namespace {

int rank_count = 1, this_rank = 0;

const rough::InputError other_form("MPI: a message has another form; run one program on all ranks");

enum Tag : int {
    hello,   ///< to rank 0: host and program
    job,     ///< kind and setting of tasks that follow
    tasks,   ///< kind, threads, tasks
    answers, ///< to rank 0: one answer per task
    stopped, ///< like `answers`, but the rank was asked to stop
    done     ///< there is no more work
};

struct Message {
    int rank = 0; ///< the sender
    int tag = done;
    json content = {};
};

#ifdef RUGOSA_MPI

/// Initialises MPI if a launcher (mpirun, srun) started this process, and not a rank.
void initialise() {
    constexpr const char* child_of_rank = "RUGOSA_RANK";
    const auto is_set = [](const char* name) { return std::getenv(name) != nullptr; };
    if (is_set(child_of_rank) || !(is_set("OMPI_COMM_WORLD_SIZE") || is_set("PMIX_RANK") || is_set("PMI_RANK"))) return;
    int level = 0; // one thread at a time calls MPI
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
    MPI_Comm_rank(MPI_COMM_WORLD, &this_rank);
    ::setenv(child_of_rank, "", 1);
}

/// Leaves MPI; a worker's exit code other than 0 ends all ranks.
void finalise(int code) {
    if (int begun = 0; MPI_Initialized(&begun) == MPI_SUCCESS && begun) {
        if (this_rank > 0 && code != 0) MPI_Abort(MPI_COMM_WORLD, code);
        MPI_Finalize();
    }
}

/// Sends to a rank that waits for a message.
void send(int to, Tag tag, const json& content) {
    std::string bytes;
    json::to_cbor(content, bytes);
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        rough::refuse("MPI: a message of ", bytes.size(), " bytes is over 2 GiB; use fewer nodes or fewer threads");
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

/// Waits for a message of another rank, or for the answers `here` of rank 0; then it returns no content.
/// Sleeps meanwhile: MPI_Mprobe would keep a processor busy.
Message receive(const std::future<json>* here = nullptr) {
    using std::chrono::microseconds;
    MPI_Message handle;
    MPI_Status status;
    int arrived = 0, size = 0;
    for (microseconds pause(20);; pause = std::min(pause * 5 / 4, microseconds(1000))) {
        MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &handle, &status);
        if (arrived) break;
        if (!here)
            std::this_thread::sleep_for(pause);
        else if (here->wait_for(pause) == std::future_status::ready)
            return {.rank = 0, .tag = answers};
    }
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    MPI_Mrecv(bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    auto content = ga::bounded_json(bytes, json::input_format_t::cbor); // no value if it was cut short
    expect_message(!content.is_discarded());
    return {status.MPI_SOURCE, status.MPI_TAG, std::move(content)};
}

#else

void initialise() {}
void finalise(int) {}
void send(int, Tag, const json&) {}
Message receive(const std::future<json>* = nullptr) { return {}; }

#endif

/// State of a rank between jobs.
struct Session {
    Kinds kinds;
    std::map<std::string, std::pair<json, Work>> prepared; ///< setting and work of the last job, by kind
    std::map<int, std::size_t> answered;                   ///< number of tasks by rank, on rank 0

    /// Prepares a job. Returns false if it was prepared before.
    bool prepare(const std::string& kind, const json& setting) {
        auto& [known, work] = prepared[kind];
        if (work && known == setting) return false;
        work = kinds.at(kind)(setting);
        known = setting;
        return true;
    }
    json answers_to(const json& tasks, const std::string& kind, int threads) {
        const Work& work = prepared.at(kind).second;
        std::vector<json> answers(tasks.size());
        ga::parallel_for(tasks.size(), ga::thread_count(threads), [&](std::size_t i) { answers[i] = work(tasks[i]); });
        return answers;
    }
} session;

void serve() {
    const Interrupt interrupt; // mpirun passes a signal on to all ranks; rank 0 decides
    for (Message message = receive(); message.tag != done; message = receive()) {
        const json& content = message.content;
        if (message.tag == job)
            session.prepare(content.at(0), content.at(1));
        else
            send(0, interrupt.requested() ? stopped : answers,
                 session.answers_to(content.at(2), content.at(0), content.at(1)));
    }
}

} // namespace

bool join(Kinds kinds) {
    initialise();
    session.kinds = std::move(kinds);
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    const rough::Build build = rough::build(); // and vectors: equal on all ranks for equal bits
    const json here{
        host, rough::line_of("rugosa ", RUGOSA_VERSION, ", ", build.compiler, " ", build.flags, ", ", build.vectors)};
    if (this_rank > 0) {
        send(0, hello, here);
        serve();
        return true;
    }
    std::string differing;
    for (int others = 1; others < rank_count; ++others)
        if (const Message other = receive(); other.content.at(1) != here[1])
            differing = rough::line_of("rank ", other.rank, ": ", other.content.dump(), " differs from ", here.dump(),
                                       " of rank 0; run one program on all, with RUGOSA_VECTORS=avx2 on all if "
                                       "their processors differ");
    if (!differing.empty()) throw rough::InputError(differing);
    return false;
}

void leave(int code) {
    if (this_rank == 0 && !is_alone())
        for (int rank = 0; rank < rank_count; ++rank) {
            tell(rough::line_of("rank ", rank, ": ", session.answered[rank], " tasks"));
            if (rank > 0) send(rank, done, {});
        }
    finalise(code);
}

bool is_alone() { return rank_count == 1; }
void expect_message(bool good) {
    if (!good) throw other_form;
}

void hand_out(const Job& of) {
    if (session.prepare(of.kind, of.setting))
        for (int rank = 1; rank < rank_count; ++rank) send(rank, job, {of.kind, of.setting});
    /// Tasks that a rank answers together.
    struct Chunk {
        std::size_t first = 0, size = 0;
        ga::Stopwatch clock = {};
    };
    constexpr double chunk_seconds = 0.05; // much longer than a message takes, much shorter than a run
    const double threads = ga::thread_count(of.threads), ranks = rank_count;
    double seconds_each = chunk_seconds; // time of one thread for one task, as last measured
    std::size_t next = 0, end = of.count;
    std::map<int, Chunk> given; // the unanswered chunk of each rank
    std::future<json> here;     // the answers of rank 0
    std::exception_ptr error;   // ends the job after all given chunks are answered
    const auto guarded = [&](auto act) {
        if (!error) try {
                act();
            } catch (const json::exception&) {
                error = std::make_exception_ptr(other_form);
            } catch (...) {
                error = std::current_exception();
            }
    };
    const auto give = [&](int rank) {
        const Chunk chunk{next};
        const auto left = static_cast<double>(end - next);
        const double min = std::min(threads, std::ceil(left / ranks)),
                     max = std::max(min, std::ceil(left / (2 * ranks)));
        const auto size = static_cast<std::size_t>(std::clamp(chunk_seconds * threads / seconds_each, min, max));
        json given_tasks = json::array();
        while (given_tasks.size() < size && next < end && !of.stopped())
            if (auto task = of.task(next)) {
                given_tasks.push_back(std::move(*task));
                ++next;
            } else {
                end = next;
            }
        if (given_tasks.empty()) return;
        if (rank > 0)
            send(rank, tasks, {of.kind, of.threads, given_tasks});
        else
            here = std::async(std::launch::async,
                              [&of, given_tasks] { return session.answers_to(given_tasks, of.kind, of.threads); });
        given[rank] = {chunk.first, given_tasks.size(), chunk.clock};
    };
    for (int rank = 0; rank < rank_count; ++rank) guarded([&] { give(rank); });
    while (!given.empty()) {
        const Message message = receive(given.contains(0) ? &here : nullptr);
        if (message.tag == stopped) ask_to_stop();
        expect_message(given.contains(message.rank));
        const Chunk chunk = given.extract(message.rank).mapped();
        guarded([&] {
            const json answers = message.rank == 0 ? here.get() : message.content;
            expect_message(answers.is_array() && answers.size() == chunk.size);
            const auto count = static_cast<double>(chunk.size);
            seconds_each = chunk.clock.seconds() * std::min(threads, count) / count;
            session.answered[message.rank] += chunk.size;
            for (std::size_t i = 0; i < chunk.size; ++i) of.take(chunk.first + i, answers[i]);
            give(message.rank);
        });
    }
    if (error) std::rethrow_exception(error);
}

} // namespace app::cluster
