#include "domain/contact/solvers/problem.hpp"
#include "tests/benchmarks/measure.hpp"
#include "tests/domain/contact/scenes.hpp"

#include <cstdio>

using namespace rough;
using rough::testing::median;
using rough::testing::processor_seconds;

namespace {

double seconds(const std::function<void()>& work) {
    const double start = processor_seconds();
    work();
    return processor_seconds() - start;
}

/// Median time of one zero-padded FFT apply.
double apply_seconds(const Profile& profile) {
    ContactProblem problem = make_problem(profile, Body{}, scenes::load_steps(profile, 1));
    FourierOperator op = fourier_operator(problem);
    std::vector<double> times;
    const int inner = std::max(1, static_cast<int>(200000 / profile.nodes()));
    for (int k = 0; k < 21; ++k)
        times.push_back(seconds([&] {
                            for (int i = 0; i < inner; ++i) {
                                std::copy_n(problem.gap.data(), problem.nodes(), op.input());
                                op.apply();
                            }
                        }) /
                        inner);
    return median(times);
}

} // namespace

int main() {
    for (const Index nodes : {4096, 16384, 65536}) {
        const auto profiles = scenes::database(nodes);
        const double apply = apply_seconds(profiles[0]);
        std::printf("N = %ld: one apply %.3g us\n", static_cast<long>(nodes), apply * 1e6);
        std::vector<double> times, iterations;
        for (std::size_t k = 0; k < profiles.size(); k += 2) {
            const auto steps = scenes::load_steps(profiles[k], 20);
            ContactCurve curve;
            times.push_back(seconds(
                [&] { curve = solve_contact(profiles[k], Body{}, steps, {.solver = Solver::active_set}); }));
            iterations.push_back(static_cast<double>(curve.iterations));
        }
        std::printf("  active set: %.4g s per curve, %.4g applies per step, %g iterations per step\n",
                    median(times), median(times) / apply / 20, median(iterations) / 20);
    }
}
