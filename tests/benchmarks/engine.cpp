// Prints measurements of the engine:
// - the overhead per evaluation (ns) for 20 real genes, population 100, 1000 generations, one thread and a
//   trivial fitness; `as sga` and `as de` have the operators and numbers of libpagmo's algorithms
// - the overhead of libpagmo, if this was built with libpagmo
// - the best value after 100,000 evaluations of Rastrigin's function of 20 genes, over 20 seeds
// - the speed-up on two threads, for a fitness that takes 1 ms or 1 us

#include "ga/adaptation/adaptation.hpp"
#include "ga/ga.hpp"
#include "tests/benchmarks/measure.hpp"

#include <cstdio>

#ifdef RUGOSA_PAGMO
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#endif

namespace {

using namespace ga;

double seconds_of(auto&& work) {
    const Stopwatch clock;
    work();
    return clock.seconds();
}

/// Processor time of this thread, s.
double work_of(auto&& work) {
    const double before = rough::testing::processor_seconds();
    work();
    return rough::testing::processor_seconds() - before;
}

/// Real vectors of 20 genes in [-5.12, 5.12]; the smaller f, the better.
template <double (*f)(const std::vector<double>&)>
struct Real {
    using Genome = std::vector<double>;
    using Outcome = double;

    double evaluate(const Genome& x) const { return f(x); }
    const std::vector<Objective<double>>& objectives() const { return list; }
    const std::vector<Variable>& bounds(const Genome&) const { return box; }
    Genome sample(Stream& stream) const {
        Genome x(box.size());
        for (double& gene : x) gene = stream.uniform(-5.12, 5.12);
        return x;
    }

    std::vector<Objective<double>> list = {{"negative", [](const double& value) { return -value; }}};
    std::vector<Variable> box = [] {
        std::vector<Variable> box;
        for (std::size_t i = 0; i < 20; ++i) box.push_back({i, -5.12, 5.12});
        return box;
    }();
};

double first(const std::vector<double>& x) { return x[0]; }
double rastrigin(const std::vector<double>& x) {
    double sum = 0;
    for (const double xi : x) sum += xi * xi - 10 * std::cos(2 * std::numbers::pi * xi) + 10;
    return sum;
}
long rounds_of_a_millisecond = 0;

/// Work of about a millisecond, the same whatever else the machine does.
double slow(const std::vector<double>& x) {
    std::uint64_t state = 1;
    for (long i = 0; i < rounds_of_a_millisecond; ++i) state = mix(state);
    return x[0] + (state == 0 ? 1 : 0);
}

void calibrate() {
    rounds_of_a_millisecond = 1000000;
    double least = HUGE_VAL;
    [[maybe_unused]] volatile double kept = 0; // or the compiler leaves out the work it is to time
    for (int i = 0; i < 9; ++i) least = std::min(least, seconds_of([&] { kept = slow({0}); }));
    rounds_of_a_millisecond = static_cast<long>(1000 / least);
}

/// The overhead of a pipeline of 1000 generations of a hundred, median of nine.
double overhead(const char* name, const Pipeline<Real<first>>& pipeline) {
    const Real<first> problem;
    std::vector<double> nanoseconds;
    for (int i = 0; i < 9; ++i) {
        long asked = 0;
        const double seconds = work_of([&] {
            asked = run(pipeline, problem, Population<std::vector<double>>(), {.threads = 1}).counters.requested;
        });
        nanoseconds.push_back(1e9 * seconds / static_cast<double>(asked));
    }
    std::sort(nanoseconds.begin(), nanoseconds.end());
    std::printf("%-11s %.0f ns per evaluation (median of 9, best %.0f)\n", name, nanoseconds[4], nanoseconds[0]);
    return nanoseconds[4];
}

void reach() {
    const Real<rastrigin> problem;
    const auto pipeline =
        sample(100) | score() |
        repeat(999, tournament(2) | cross(sbx(2), 0.9) | mutate(1.0 / 20, polynomial(20)) | score() | plus());
    std::vector<double> best;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        best.push_back(-run(pipeline, problem, Population<std::vector<double>>(),
                            {.seed = seed, .budget = {.evaluations = 100000}})
                            .best->value());
    std::sort(best.begin(), best.end());
    std::printf("rastrigin   median %.1e, worst %.1e over 20 seeds of 100000 evaluations\n", (best[9] + best[10]) / 2,
                best[19]);
}

#ifdef RUGOSA_PAGMO
/// The function in libpagmo's form.
template <double (*f)(const std::vector<double>&)>
struct Theirs {
    std::vector<double> fitness(const std::vector<double>& x) const { return {f(x)}; }
    std::pair<std::vector<double>, std::vector<double>> get_bounds() const {
        return {std::vector<double>(20, -5.12), std::vector<double>(20, 5.12)};
    }
};

/// The best of 1000 generations of a hundred.
template <double (*f)(const std::vector<double>&)>
double theirs(const std::string& name, unsigned seed) {
    const unsigned generations = 1000;
    pagmo::population population{Theirs<f>{}, 100, seed};
    const pagmo::algorithm method =
        name == "sga"
            ? pagmo::algorithm(pagmo::sga(generations, 0.9, 2, 0.05, 20, 2, "sbx", "polynomial", "tournament", seed))
            : pagmo::algorithm(pagmo::de(generations, 0.8, 0.9, 2, 0, 0, seed));
    return method.evolve(population).champion_f()[0];
}

/// Prints the overhead of libpagmo's algorithm and the ratio of our overhead, in ns, to it.
void pagmo_beside(const std::string& name, double ours) {
    std::vector<double> nanoseconds, best;
    for (unsigned i = 0; i < 9; ++i) nanoseconds.push_back(work_of([&] { theirs<first>(name, i + 1); }) * 1e9 / 1e5);
    std::sort(nanoseconds.begin(), nanoseconds.end());
    for (unsigned seed = 1; seed <= 20; ++seed) best.push_back(theirs<rastrigin>(name, seed));
    std::sort(best.begin(), best.end());
    std::printf("pagmo %-5s %.0f ns per evaluation (median of 9, best %.0f), ours over theirs %.2f; rastrigin "
                "median %.1e, worst %.1e\n",
                name.c_str(), nanoseconds[4], nanoseconds[0], ours / nanoseconds[4], (best[9] + best[10]) / 2,
                best[19]);
}
#endif

/// Prints the lowest times of a pipeline on one and on two threads, with evaluations of this length.
void speed_up(const char* length, double milliseconds, const Pipeline<Real<slow>>& pipeline) {
    calibrate();
    rounds_of_a_millisecond = static_cast<long>(static_cast<double>(rounds_of_a_millisecond) * milliseconds);
    const Real<slow> problem;
    double seconds[2] = {HUGE_VAL, HUGE_VAL};
    for (int round = 0; round < 5; ++round)
        for (const int threads : {1, 2})
            seconds[threads - 1] = std::min(
                seconds[threads - 1],
                seconds_of([&] { run(pipeline, problem, Population<std::vector<double>>(), {.threads = threads}); }));
    std::printf("speed-up    %.2f on two threads (evaluations of %s: %.3f s, %.3f s; %u cores)\n",
                seconds[0] / seconds[1], length, seconds[0], seconds[1], std::thread::hardware_concurrency());
}

} // namespace

int main() {
    overhead("overhead", sample(100) | score() |
                             repeat(1000, tournament(2) | cross(one_point()) | mutate(1.0 / 20, gaussian(0.1)) |
                                              score() | elite(1)));
    [[maybe_unused]] const double as_sga =
        overhead("as sga", sample(100) | score() |
                               repeat(1000, tournament(2) | cross(sbx(2), 0.9) | mutate(0.05, polynomial(20)) |
                                                score() | plus()));
    [[maybe_unused]] const double as_de =
        overhead("as de", sample(100) | score() |
                              repeat(1000, DifferentialEvolution{{}, "rand", 0.8, 0.9, "exp"} | score() | duel()));
    reach();
#ifdef RUGOSA_PAGMO
    pagmo_beside("sga", as_sga);
    pagmo_beside("de", as_de);
#endif
    speed_up("1 ms", 1, sample(400) | score());
    speed_up("1 us", 1e-3,
             sample(100) | score() |
                 repeat(2000, tournament(2) | cross(sbx(2), 0.9) | mutate(0.05, polynomial(20)) | score() | elite(1)));
}
