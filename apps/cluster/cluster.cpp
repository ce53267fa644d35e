#include "apps/cluster/cluster.hpp"

#include "apps/prompt/terminal.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/vector_loops.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"
#include "ga/checkpoint/bounded_json.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>
#include <limits>
#include <mutex>
#include <thread>
#include <unistd.h>
#ifdef RUGOSA_MPI
#include <mpi.h>
#endif

namespace app::cluster {

namespace {

int rank_count = 1, this_rank = 0;

/// Kinds of messages.
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
    if (is_set(child_of_rank) ||
        !(is_set("OMPI_COMM_WORLD_SIZE") || is_set("PMIX_RANK") || is_set("PMI_RANK")))
        return;
    int level = 0; // one thread at a time calls MPI
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_size(MPI_COMM_WORLD, &rank_count);
    MPI_Comm_rank(MPI_COMM_WORLD, &this_rank);
    ::setenv(child_of_rank, "", 1);
}

/// Leaves MPI; a worker's exit code other than 0 ends all ranks.
void finalise(int code) {
    if (int begun = 0; MPI_Initialized(&begun) == MPI_SUCCESS && begun) {
        if (this_rank > 0 && code != 0)
            MPI_Abort(MPI_COMM_WORLD, code);
        MPI_Finalize();
    }
}

/// Sends to a rank that waits for a message.
void send(int to, Tag tag, const json& content) {
    std::string bytes;
    json::to_cbor(content, bytes);
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        rough::refuse("MPI: a message of ", bytes.size(),
                      " bytes is over 2 GiB; use fewer nodes or fewer threads");
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

/// Waits for a message of any rank. Sleeps meanwhile: MPI_Mprobe would keep a processor busy.
Message receive() {
    using std::chrono::microseconds;
    MPI_Message handle;
    MPI_Status status;
    int arrived = 0, size = 0;
    for (microseconds pause(20);; pause = std::min(pause * 5 / 4, microseconds(1000))) {
        MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &handle, &status);
        if (arrived)
            break;
        std::this_thread::sleep_for(pause);
    }
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    MPI_Mrecv(bytes.data(), size, MPI_BYTE, &handle, MPI_STATUS_IGNORE);
    auto content = ga::bounded_json(bytes, json::input_format_t::cbor); // throws if it was cut short
    expect_message(!content.is_discarded());
    return {status.MPI_SOURCE, status.MPI_TAG, std::move(content)};
}

#else

void initialise() {}
void finalise(int) {}
void send(int, Tag, const json&) {}
Message receive() { return {}; }

#endif

/// State of a rank between jobs.
struct Session {
    Kinds kinds;
    std::map<std::string, std::pair<json, Work>> prepared; ///< setting and work of the last job, by kind
    std::map<int, std::size_t> answered;                   ///< number of tasks by rank, on rank 0

    /// Prepares a job. Returns false if it was prepared before.
    bool prepare(const std::string& kind, const json& setting) {
        auto& [known, work] = prepared[kind];
        if (work && known == setting)
            return false;
        work = kinds.at(kind)(setting);
        known = setting;
        return true;
    }
    json answers_to(const json& tasks, const std::string& kind, int threads) {
        const Work& work = prepared.at(kind).second;
        std::vector<json> answers(tasks.size());
        ga::parallel_for(tasks.size(), ga::thread_count(threads),
                         [&](std::size_t i) { answers[i] = work(tasks[i]); });
        return answers;
    }
};

Session session;

void serve() {
    const Interrupt interrupt; // mpirun passes a signal on to all ranks; rank 0 decides
    for (Message message = receive(); message.tag != done; message = receive()) {
        const json& content = message.content;
        if (message.tag == job)
            session.prepare(content.at(0), content.at(1));
        else
            send(0, interrupt.asked() ? stopped : answers,
                 session.answers_to(content.at(2), content.at(0), content.at(1)));
    }
}

/// Tasks that a rank answers together.
struct Chunk {
    std::size_t first = 0;
    json tasks = json::array();
    ga::Stopwatch clock = {};
};

/// The tasks of a job on rank 0, cut into chunks by two threads: one computes, the other sends and receives.
class Queue {
  public:
    explicit Queue(const Job& job) : job_(job), threads_(ga::thread_count(job.threads)), end_(job.count) {}

    /// The next chunk; empty after the last task and after the job was stopped.
    Chunk next() {
        Chunk chunk;
        guarded([&] {
            chunk.first = next_;
            const std::size_t size = chunk_size();
            while (chunk.tasks.size() < size && next_ < end_ && !job_.stopped())
                if (auto task = job_.task(next_)) {
                    chunk.tasks.push_back(std::move(*task));
                    ++next_;
                } else {
                    end_ = next_;
                }
        });
        return chunk;
    }
    void take(int rank, const Chunk& chunk, const json& answers) {
        guarded([&] {
            const auto count = static_cast<double>(chunk.tasks.size());
            seconds_each_ = chunk.clock.seconds() * std::min<double>(threads_, count) / count;
            expect_message(answers.is_array() && answers.size() == chunk.tasks.size());
            session.answered[rank] += answers.size();
            try {
                for (std::size_t i = 0; i < chunk.tasks.size(); ++i)
                    job_.take(chunk.first + i, answers[i]);
            } catch (const json::exception&) {
                expect_message(false);
            }
        });
    }
    /// Runs `act` while the other thread does not; its exception ends the job.
    template <class Act>
    void guarded(Act act) {
        const std::lock_guard lock(guard_);
        if (!error_)
            try {
                act();
            } catch (...) {
                error_ = std::current_exception();
            }
    }
    const std::exception_ptr& error() const { return error_; }

  private:
    /// Number of tasks that take `chunk_seconds`; it falls towards the end.
    std::size_t chunk_size() const {
        const auto left = static_cast<double>(end_ - next_), ranks = static_cast<double>(rank_count);
        const double min = std::min<double>(threads_, std::ceil(left / ranks));
        return static_cast<std::size_t>(std::clamp(chunk_seconds * threads_ / seconds_each_, min,
                                                   std::max(min, std::ceil(left / (2 * ranks)))));
    }

    static constexpr double chunk_seconds = 0.05; // much longer than a message takes, much shorter than a run
    const Job& job_;
    const int threads_;
    std::mutex guard_;
    std::size_t next_ = 0, end_;          ///< tasks
    double seconds_each_ = chunk_seconds; ///< time of one thread for one task, as last measured
    std::exception_ptr error_;
};

/// Keeps every worker at work until the queue is empty, and waits for all answers.
void share(Queue& queue, const Job& of) {
    std::map<int, Chunk> sent; // chunk of each rank
    const auto give = [&](int rank) {
        Chunk chunk = queue.next();
        queue.guarded([&] {
            if (chunk.tasks.empty())
                return;
            send(rank, tasks, {of.kind, of.threads, chunk.tasks});
            sent[rank] = std::move(chunk);
        });
    };
    for (int rank = 1; rank < rank_count; ++rank)
        give(rank);
    while (!sent.empty()) {
        const Message message = receive();
        if (message.tag == stopped)
            ask_to_stop();
        const auto chunk = sent.extract(message.rank);
        expect_message(!chunk.empty());
        queue.take(message.rank, chunk.mapped(), message.content);
        give(message.rank);
    }
}

} // namespace

bool join(Kinds kinds) {
    initialise();
    session.kinds = std::move(kinds);
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    const rough::Build build = rough::build(); // and vectors: equal on all ranks for equal bits
    const json here{host, rough::line_of("rugosa ", RUGOSA_VERSION, ", ", build.compiler, " ", build.flags,
                                         ", ", build.vectors)};
    if (this_rank > 0) {
        send(0, hello, here);
        serve();
        return true;
    }
    std::string differing;
    for (int others = 1; others < rank_count; ++others)
        if (const Message other = receive(); other.content.at(1) != here[1])
            differing =
                rough::line_of("rank ", other.rank, ": ", other.content.dump(), " differs from ", here.dump(),
                               " of rank 0; run one program on all, with RUGOSA_VECTORS=avx2 on all if "
                               "their processors differ");
    if (!differing.empty())
        throw rough::InputError(differing);
    return false;
}

void leave(int code) {
    if (this_rank == 0 && !is_alone())
        for (int rank = 0; rank < rank_count; ++rank) {
            tell(rough::line_of("rank ", rank, ": ", session.answered[rank], " tasks"));
            if (rank > 0)
                send(rank, done, {});
        }
    finalise(code);
}

void expect_message(bool good) {
    if (!good)
        rough::refuse("MPI: a message has another form; run one program on all ranks");
}

bool is_alone() { return rank_count == 1; }

void hand_out(const Job& of) {
    if (session.prepare(of.kind, of.setting))
        for (int rank = 1; rank < rank_count; ++rank)
            send(rank, job, {of.kind, of.setting});
    Queue queue(of);
    auto sharing = std::async(std::launch::async, [&] { share(queue, of); });
    try {
        for (Chunk chunk = queue.next(); !chunk.tasks.empty(); chunk = queue.next())
            queue.take(0, chunk, session.answers_to(chunk.tasks, of.kind, of.threads));
    } catch (...) {
        queue.guarded([] { throw; });
    }
    sharing.get();
    if (queue.error())
        std::rethrow_exception(queue.error());
}

} // namespace app::cluster
