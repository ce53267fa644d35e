#include "apps/experiments/paper/chromosome_example.hpp"

#include "domain/mwm/waves.hpp"
#include "ga/base/random.hpp"

#include <Eigen/QR>

#include <cmath>
#include <numbers>

namespace app {

ChromosomeExample chromosome_example(int n, std::uint64_t seed) {
    const rough::Series series{1e-2, 0.8, 1.5, 0.1, {}};
    constexpr std::size_t ridges = 8;
    const double k = rough::wave_number(series, n), G = rough::amplitude(series, n, ridges);
    ga::Stream random(ga::fold(ga::fold(seed, "chromosomes"), static_cast<std::uint64_t>(n)));

    ChromosomeExample example{
        n, rough::wave_length(series, n), Eigen::VectorXd::LinSpaced(201, 0, 0.1), {}, {}, 0};
    example.sum.setZero(example.x.size());
    for (std::size_t m = 0; m < ridges; ++m) {
        const double phase = random.uniform(0, 2 * std::numbers::pi);
        example.ridges.push_back(G * (std::cos(phase) - (k * example.x.array() + phase).cos())); // Eq. 1
        example.sum += example.ridges.back();
    }
    Eigen::MatrixXd cosine(example.x.size(), 3);
    cosine << Eigen::VectorXd::Ones(example.x.size()), (k * example.x.array()).cos().matrix(),
        (k * example.x.array()).sin().matrix();
    const Eigen::VectorXd best = cosine * cosine.colPivHouseholderQr().solve(example.sum);
    example.misfit =
        (example.sum - best).cwiseAbs().maxCoeff() / (example.sum.maxCoeff() - example.sum.minCoeff());
    return example;
}

} // namespace app
