#include "domain/contact/solve.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/domain/contact/maps.hpp"

#include <chrono>
#include <cstdio>
#include <sys/resource.h>

using namespace rough;
using rough::testing::processor_seconds;

namespace {

constexpr double slope = 0.1; ///< rms

/// Largest memory of the process so far, GB.
double most_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1e6;
}

/// Presses a self-affine map (H = 0.8, waves from L/4 to 8 nodes, slope 0.1) and prints the products with H.
void press(Index side, Kernel kernel, const std::vector<double>& pressures, Solver solver, int threads = 1) {
    const Profile map = maps::self_affine(side, 0.8, 1, slope);
    Body body;
    body.kernel = kernel;
    ContactOptions options;
    options.solver = solver;
    options.threads = threads;
    const double start = processor_seconds();
    const auto clock = std::chrono::steady_clock::now();
    const ContactCurve curve = solve_contact_at_pressures(map, body, pressures, options);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - clock;
    // Polonsky-Keer's iterations apply H twice
    const long products = (solver == Solver::polonsky_keer ? 2 : 1) * curve.iterations;
    std::printf("%5ld %-14s %7d %8.2f%% %10ld %9.1f %9.2f %9.2f %10.2f\n", static_cast<long>(side),
                name_of(solver).c_str(), threads, 100 * curve.steps.back().contact_fraction, products,
                static_cast<double>(products) / static_cast<double>(pressures.size()), processor_seconds() - start,
                wall.count(), most_memory());
    std::fflush(stdout);
}

} // namespace

/// benchmark_areas [largest side [side up to which Polonsky-Keer runs]]: periodic maps, 10 load steps to 17 %
/// contact. benchmark_areas loads [side]: each of seven loads alone on a free map. Then ten equal steps to
/// 11 % contact on one and on two threads. benchmark_areas full [side]: each of four loads alone, near full
/// contact of a periodic map.
int main(int count, char** words) {
    std::printf("%5s %-14s %7s %9s %10s %9s %9s %9s %10s\n", "side", "solver", "threads", "contact", "products",
                "a step", "cpu, s", "wall, s", "memory GB");
    const auto steps_to = [](double pressure) {
        std::vector<double> pressures;
        for (int j = 1; j <= 10; ++j) pressures.push_back(pressure * j / 10);
        return pressures;
    };
    if (count > 1 && std::string(words[1]) == "loads") {
        const Index side = count > 2 ? std::atol(words[2]) : 1024;
        for (const double units : {0.00058, 0.0046, 0.049, 0.29, 1.1, 2.1, 2.9}) // p/(E* slope)
            press(side, Kernel::free, {units * slope}, Solver::automatic);
        for (const int threads : {1, 2}) press(side, Kernel::free, steps_to(0.054 * slope), Solver::automatic, threads);
        return 0;
    }
    if (count > 1 && std::string(words[1]) == "full") {
        const Index side = count > 2 ? std::atol(words[2]) : 256;
        Body body;
        body.kernel = Kernel::periodic;
        const double full = full_contact_load(maps::self_affine(side, 0.8, 1, slope), body);
        for (const double share : {0.45, 0.7, 0.87, 0.95})
            press(side, Kernel::periodic, {share * full}, Solver::active_set);
        return 0;
    }
    const Index largest = count > 1 ? std::atol(words[1]) : 1024, rival = count > 2 ? std::atol(words[2]) : 512;
    for (Index n = 128; n <= largest; n *= 2)
        for (const Solver solver : {Solver::active_set, Solver::polonsky_keer})
            if (solver == Solver::active_set || n <= rival) // 17 %: erf(sqrt 2 p/(E* h')) and a little more
                press(n, Kernel::periodic, steps_to(0.17 * slope / 2.35), solver);
}
