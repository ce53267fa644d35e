// A new evaluator: worker processes that take genomes through pipes, each the next when it is free.

#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

#include <poll.h>
#include <sys/wait.h>

using namespace ga;

namespace {

/// For genomes and outcomes of n doubles each. A worker that dies takes its genome with it, no more.
class ProcessPool : public Evaluator<Reals> {
  public:
    ProcessPool(const Reals& problem, int workers) {
        for (int w = 0; w < workers; ++w) {
            int in[2], out[2];
            REQUIRE((::pipe(in) == 0 && ::pipe(out) == 0));
            if (const pid_t child = ::fork(); child != 0) {
                ::close(in[0]), ::close(out[1]);
                workers_.push_back({child, in[1], out[0], nullptr});
                continue;
            }
            for (const Worker& other : workers_)
                ::close(other.in), ::close(other.out);
            ::close(in[1]), ::close(out[0]);
            Vector x(problem.n);
            while (::read(in[0], x.data(), 8 * x.size()) == static_cast<ssize_t>(8 * x.size())) {
                if (x[0] > 0.98)
                    ::_exit(1); // the genome that kills its worker
                const Vector outcome = problem.evaluate(x);
                if (::write(out[1], outcome.data(), 8 * outcome.size()) < 0)
                    break;
            }
            ::_exit(0);
        }
    }
    ~ProcessPool() override {
        for (const Worker& worker : workers_)
            ::close(worker.in), ::close(worker.out);
        for (const Worker& worker : workers_)
            ::waitpid(worker.process, nullptr, 0);
    }

    void outcomes(const Reals& problem, std::span<EvaluationCall<Reals>> calls, const Watch& watch) override {
        std::size_t next = 0, open = 0;
        do {
            for (Worker& worker : workers_)
                if (!worker.dead && !worker.call && next < calls.size() && !watch.expired()) {
                    worker.call = &calls[next++];
                    ++open;
                    if (::write(worker.in, worker.call->genome->data(), 8 * problem.n) < 0)
                        worker.dead = true;
                }
            std::vector<pollfd> waiting;
            for (const Worker& worker : workers_)
                waiting.push_back({worker.call ? worker.out : -1, POLLIN, 0});
            if (open == 0 || ::poll(waiting.data(), waiting.size(), 10000) <= 0)
                break;
            for (std::size_t w = 0; w < workers_.size(); ++w)
                if (waiting[w].revents != 0) {
                    Vector outcome(problem.n);
                    const ssize_t size = ::read(workers_[w].out, outcome.data(), 8 * outcome.size());
                    workers_[w].dead = size != static_cast<ssize_t>(8 * outcome.size());
                    EvaluationCall<Reals>& call = *std::exchange(workers_[w].call, nullptr);
                    if (workers_[w].dead)
                        *call.answer = reason("its worker died");
                    else
                        *call.answer = std::move(outcome);
                    --open;
                }
        } while (open > 0 || next < calls.size());
        for (; next < calls.size() && !watch.expired(); ++next)
            *calls[next].answer = reason("no worker is left");
    }

  private:
    struct Worker {
        pid_t process;
        int in, out;
        EvaluationCall<Reals>* call;
        bool dead = false;
    };
    std::vector<Worker> workers_;
};

} // namespace

TEST_CASE("a pool of processes gives the same bits as threads") {
    const auto pipeline = reals("sample 20 | score | repeat 5 { tournament 2 | cross blend 0.1 | "
                                "mutate 0.2 gaussian 0.01 | score | elite 1 }");
    const Reals problem;
    const auto here = run(pipeline, problem, {});
    ProcessPool pool(problem, 3);
    const auto there = run_by(pool, pipeline, problem, {});
    CHECK(there.best->genome == here.best->genome);
    CHECK(there.counters.evaluations == here.counters.evaluations);
}

TEST_CASE("a worker that dies fails only its genome") {
    ProcessPool pool(Reals{}, 4);
    std::vector<Vector> genomes(30, Vector(6, 0.5));
    for (std::size_t i = 0; i < genomes.size(); ++i)
        genomes[i][1] = 0.01 * static_cast<double>(i);
    genomes[7][0] = 0.99;
    const auto result = run_by(pool, reals("score"), Reals{}, population(genomes));
    CHECK(result.counters.failures == 1);
    CHECK(result.population[7].fitness.reason() == "its worker died");
}
