#include "domain/design/shape_to_waves.hpp"

#include "domain/errors.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace rough {

namespace {

/// 1 to n_f, each with so many phases of 0.
std::vector<Chromosome> all_chromosomes(const Series& law, double shortest, std::size_t phases) {
    std::vector<Chromosome> all;
    for (int n = 1; n <= last_chromosome(law.lambda, law.gamma, shortest); ++n)
        all.push_back({n, std::vector<double>(phases, 0.0)});
    if (all.empty())
        throw InputError("series: its longest wave is " + std::to_string(law.lambda) +
                         " mm, expected at least the shortest allowed, " + std::to_string(shortest) + " mm");
    return all;
}

/// Least squares, the columns but the first, which is 1, held down.
Eigen::VectorXd fitted(const Eigen::MatrixXd& basis, const Eigen::VectorXd& heights, double damping) {
    Eigen::MatrixXd normal = basis.transpose() * basis;
    normal.diagonal().tail(basis.cols() - 1).array() += damping * static_cast<double>(heights.size());
    return normal.ldlt().solve(basis.transpose() * heights);
}

/// R and theta of -R cos(k x + theta) = c cos(k x) + s sin(k x).
struct Wanted {
    double R, theta;
    Wanted(double c, double s) : R(std::hypot(c, s)), theta(std::atan2(s, -c)) {}
};

/// Of the wave's R the share that A = 1 gives at most, a tenth left over.
double least_A(const Wanted& wanted, double amplitude) { return wanted.R / (2 * 0.9 * amplitude); }

/// Between the two phases and theta: R = 2 G cos.
double half_between(const Wanted& wanted, double amplitude) {
    return std::acos(std::min(1.0, wanted.R / (2 * amplitude)));
}

} // namespace

Genome shaped_as(const Profile& profile, const std::vector<Series>& series, double shortest, double damping) {
    Genome genome{1, series};
    for (Series& one : genome.series) {
        one.A = 1;
        one.chromosomes = all_chromosomes(one, shortest, 2);
    }
    const Grid grid{profile.nodes(), profile.spacing * static_cast<double>(profile.nodes()), true};
    Eigen::MatrixXd basis(profile.nodes(), 1);
    basis.setOnes();
    const Eigen::MatrixXd waves = wave_basis(genome, grid);
    basis.conservativeResize(Eigen::NoChange, 1 + waves.cols());
    basis.rightCols(waves.cols()) = waves;
    const Eigen::VectorXd weights = fitted(basis, profile.heights, damping);

    Index column = 1;
    for (Series& one : genome.series) {
        std::vector<Wanted> wanted;
        double A = 1e-300;
        for (const Chromosome& each : one.chromosomes) {
            wanted.emplace_back(weights[column], weights[column + 1]);
            column += 2;
            A = std::max(A, least_A(wanted.back(), amplitude(one, each.n, 2)));
        }
        one.A = A;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            const double half = half_between(wanted[i], amplitude(one, one.chromosomes[i].n, 2));
            one.chromosomes[i].phases = {wanted[i].theta + half, wanted[i].theta - half};
        }
    }
    return genome;
}

Genome shaped_as(const Profile& map, const Series& law, int ridges, const Grid& grid, double shortest,
                 double damping) {
    const auto count = static_cast<std::size_t>(ridges);
    Series one = law;
    one.A = 1;
    one.chromosomes = all_chromosomes(one, shortest, count);
    const std::vector<PlaneWave> waves = plane_waves({1, {one}}, grid);
    const Index columns = map.shape().columns;
    Eigen::MatrixXd basis(map.nodes(), 1 + 2 * static_cast<Index>(waves.size()));
    basis.col(0).setOnes();
    for (std::size_t w = 0; w < waves.size(); ++w) {
        const Eigen::ArrayXd angle = Eigen::ArrayXd::NullaryExpr(map.nodes(), [&](Index i) {
            return waves[w].k_x * map.spacing * static_cast<double>(i % columns) +
                   waves[w].k_y * map.row_spacing * static_cast<double>(i / columns);
        });
        basis.col(1 + 2 * static_cast<Index>(w)) = angle.cos();
        basis.col(2 + 2 * static_cast<Index>(w)) = angle.sin();
    }
    const Eigen::VectorXd weights = fitted(basis, map.heights, damping);
    std::vector<Wanted> wanted;
    double A = 1e-300;
    for (std::size_t w = 0; w < waves.size(); ++w) {
        wanted.emplace_back(weights[1 + 2 * static_cast<Index>(w)], weights[2 + 2 * static_cast<Index>(w)]);
        A = std::max(A, least_A(wanted[w], waves[w].amplitude));
    }
    one.A = A;
    Series twin = one;
    for (std::size_t w = 0; w < waves.size(); ++w) {
        const double half = half_between(wanted[w], A * waves[w].amplitude);
        one.chromosomes[w / count].phases[w % count] = wanted[w].theta + half;
        twin.chromosomes[w / count].phases[w % count] = wanted[w].theta - half;
    }
    return {1, {std::move(one), std::move(twin)}};
}

} // namespace rough
