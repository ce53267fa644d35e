#include "domain/design/shape_to_waves.hpp"

#include "domain/errors.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace rough {

Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest, double damping) {
    Genome genome{1, series};
    for (Series& one : genome.series) {
        one.A = 1;
        one.chromosomes.clear();
        for (int n = 1; n <= last_chromosome(one.lambda, one.gamma, shortest); ++n)
            one.chromosomes.push_back({n, {0, 0}});
        if (one.chromosomes.empty())
            throw InputError("series: its longest wave is " + std::to_string(one.lambda) +
                             " mm, expected at least the shortest allowed, " + std::to_string(shortest) +
                             " mm");
    }
    const Grid grid{profile.nodes(), profile.spacing * static_cast<double>(profile.nodes()), true};
    Eigen::MatrixXd basis(profile.nodes(), 1);
    basis.setOnes();
    const Eigen::MatrixXd waves = wave_basis(genome, grid);
    basis.conservativeResize(Eigen::NoChange, 1 + waves.cols());
    basis.rightCols(waves.cols()) = waves;
    Eigen::MatrixXd normal = basis.transpose() * basis;
    normal.diagonal().tail(waves.cols()).array() += damping * static_cast<double>(profile.nodes());
    const Eigen::VectorXd weights = normal.ldlt().solve(basis.transpose() * profile.heights);

    Index column = 1;
    for (Series& one : genome.series) {
        std::vector<std::pair<double, double>> wanted; // -R cos(k x + theta) = c cos(k x) + s sin(k x)
        for (std::size_t i = 0; i < one.chromosomes.size(); ++i, column += 2)
            wanted.emplace_back(std::hypot(weights[column], weights[column + 1]),
                                std::atan2(weights[column + 1], -weights[column]));
        double A = 1e-300;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            A = std::max(A, wanted[i].first / (2 * 0.9 * amplitude(one, one.chromosomes[i].n, 2)));
        one.A = A;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const double half = std::acos(
                std::min(1.0, wanted[i].first / (2 * amplitude(one, one.chromosomes[i].n, 2)))); // R = 2 cos
            one.chromosomes[i].phases = {wanted[i].second + half, wanted[i].second - half};
        }
    }
    return genome;
}

} // namespace rough
