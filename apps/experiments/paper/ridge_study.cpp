#include "apps/experiments/paper/ridge_study.hpp"

#include "domain/mwm/waves.hpp"
#include "ga/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace app {

namespace {

constexpr double rounding = 1e-12; ///< of M: where |g1| = R exactly, the last bit must not decide

bool holds(double g1, double radicand, double ridges) {
    return std::abs(g1) <= std::sqrt(std::max(radicand, 0.0)) + rounding * ridges;
}

/// g3 = sum over pairs m < l of cos(phi_m - phi_l), as running sums of cosines and sines.
double pair_sum(const std::vector<double>& phases) {
    double g3 = 0, cosines = 0, sines = 0;
    for (double phase : phases) {
        const double c = std::cos(phase), s = std::sin(phase);
        g3 += cosines * c + sines * s;
        cosines += c;
        sines += s;
    }
    return g3;
}

} // namespace

std::vector<RidgeCount> ridge_study(const std::vector<int>& ridge_counts, int sets, std::uint64_t seed) {
    std::vector<RidgeCount> counts;
    for (int M : ridge_counts) {
        ga::Stream random(ga::fold(ga::fold(seed, "ridges"), static_cast<std::uint64_t>(M)));
        const double ridges = M;
        int printed = 0, missing = 0, right = 0;
        for (int set = 0; set < sets; ++set) {
            std::vector<double> phases(static_cast<std::size_t>(M));
            for (double& phase : phases)
                phase = random.uniform(0, 2 * std::numbers::pi);
            const rough::Ridge ridge = rough::collapsed(phases);
            const double g3 = pair_sum(phases);
            const double last = std::cos(phases[phases.size() - 2] - phases.back());
            printed += holds(ridge.g1, ridges + 2 * g3, ridges); // Eq. 10
            missing += holds(ridge.g1, ridges + 2 * (g3 - last), ridges);
            const double by_arccos = std::acos(std::clamp(ridge.g1 / ridge.R, -1.0, 1.0)); // Eq. 8
            right += std::abs(std::remainder(by_arccos - ridge.theta, 2 * std::numbers::pi)) < 1e-6;
        }
        const auto share = [&](int count) { return static_cast<double>(count) / sets; };
        counts.push_back({M, share(printed), share(missing), share(right)});
    }
    return counts;
}

} // namespace app
