// Prints the cost of a genome's response at N = 512, medians over the paper's database on one core. It
// measures the 20-step curve with tangents, the curve with its full Jacobian in every gene, and warm-started
// NNLS.

#include "domain/mwm/response.hpp"

#include "domain/mwm/sobol.hpp"
#include "domain/numerics/statistics.hpp"
#include "tests/benchmarks/measure.hpp"

#include <cstdio>

using namespace rough;

namespace {

double milliseconds(auto&& work) { return 1e3 * testing::least_seconds(work, 5); }

} // namespace

int main() {
    const Model model;
    Model by_nnls = model;
    by_nnls.contact.solver = Solver::nnls;
    std::vector<double> profile, curve, jacobian, ratio, nnls, nnls_ratio;
    for (const Genome& genome : sobol_database({.shortest = model.grid.spacing()})) {
        profile.push_back(milliseconds([&] { sample(genome, model.grid); }));
        curve.push_back(milliseconds([&] { respond(genome, model); }));
        jacobian.push_back(milliseconds([&] {
            const auto gradient =
                respond_with_gradient(sample(genome, model.grid), model.body, model.loading, model.contact)
                    .gradient;
            pulled_back(gradient.pressure, genome, model.grid);
        }));
        nnls.push_back(milliseconds([&] { respond(genome, by_nnls); }));
        ratio.push_back(jacobian.back() / curve.back());
        nnls_ratio.push_back(nnls.back() / curve.back());
    }
    std::printf("profile                     %.4f ms\n", median(profile));
    std::printf("20-step curve with tangents %.4f ms\n", median(curve));
    std::printf("curve with full Jacobian    %.4f ms, %.3f times the curve\n", median(jacobian),
                median(ratio));
    std::printf("curve by NNLS               %.4f ms, %.2f times the curve\n", median(nnls),
                median(nnls_ratio));
}
