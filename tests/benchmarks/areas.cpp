#include "domain/contact/solve.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/domain/contact/maps.hpp"

#include <cstdio>
#include <cstdlib>
#include <sys/resource.h>

using namespace rough;
using rough::testing::processor_seconds;

namespace {

/// Largest memory of the process so far, GB.
double most_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1e6;
}

} // namespace

/// benchmark_areas [largest side [side up to which Polonsky-Keer runs]]: prints the products with H of 10
/// load steps to 17 % contact. The map is periodic and self-affine (H = 0.8, waves from L/4 to 8 nodes).
int main(int count, char** words) {
    const Index largest = count > 1 ? std::atol(words[1]) : 1024,
                rival = count > 2 ? std::atol(words[2]) : 512;
    std::printf("%5s %-14s %9s %10s %9s %9s %10s\n", "side", "solver", "contact", "products", "a step",
                "seconds", "memory GB");
    for (Index n = 128; n <= largest; n *= 2) {
        constexpr double slope = 0.1, contact = 0.17;
        constexpr int steps = 10;
        const Profile map = maps::self_affine(n, 0.8, 1, slope);
        std::vector<double> pressures; // erf(sqrt 2 p/(E* h')) and a little more
        for (int j = 1; j <= steps; ++j)
            pressures.push_back(contact * slope / 2.35 * j / steps);
        Body body;
        body.kernel = Kernel::periodic;
        for (const Solver solver : {Solver::active_set, Solver::polonsky_keer}) {
            if (solver == Solver::polonsky_keer && n > rival)
                continue;
            ContactOptions options;
            options.solver = solver;
            const double start = processor_seconds();
            const ContactCurve curve = solve_contact_at_pressures(map, body, pressures, options);
            // Polonsky-Keer's iterations apply H twice
            const long products = (solver == Solver::polonsky_keer ? 2 : 1) * curve.iterations;
            std::printf("%5ld %-14s %8.1f%% %10ld %9.1f %9.2f %10.2f\n", static_cast<long>(n),
                        solver == Solver::active_set ? "active-set" : "polonsky-keer",
                        100 * curve.steps.back().contact_fraction, products,
                        static_cast<double>(products) / steps, processor_seconds() - start, most_memory());
            std::fflush(stdout);
        }
    }
}
