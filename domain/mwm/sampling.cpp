#include "domain/mwm/sampling.hpp"

#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// Fills cos(k i delta + phase) and sin(...) for i = 0..N-1. Two short tables and the addition theorem in
/// place of a cosine a node; each value is a product of two correctly rounded tables, so errors do not build
/// up along x.
template <class Cosines, class Sines>
void fill_wave(double step, double phase, Cosines&& cosines, Sines&& sines) {
    constexpr Index block = 32;
    const Index nodes = cosines.size();
    Eigen::Array<double, block, 1> fine_cos, fine_sin;
    for (Index j = 0; j < block; ++j) {
        fine_cos[j] = std::cos(step * static_cast<double>(j));
        fine_sin[j] = std::sin(step * static_cast<double>(j));
    }
    for (Index start = 0; start < nodes; start += block) {
        const Index count = std::min(block, nodes - start);
        const double angle = step * static_cast<double>(start) + phase;
        const double c = std::cos(angle), s = std::sin(angle);
        cosines.segment(start, count) = c * fine_cos.head(count) - s * fine_sin.head(count);
        sines.segment(start, count) = s * fine_cos.head(count) + c * fine_sin.head(count);
    }
}

} // namespace

Grid refined(const Grid& grid, Index refine) {
    Grid finer = grid;
    finer.nodes = grid.wraps ? grid.nodes * refine : (grid.nodes - 1) * refine + 1;
    return finer;
}

Profile sample(const Genome& genome, const Grid& grid) {
    Profile profile{Eigen::VectorXd::Zero(grid.nodes), grid.spacing()};
    Eigen::ArrayXd cosines(grid.nodes), sines(grid.nodes);
    for (const Wave& wave : waves(genome)) {
        fill_wave(wave.wave_number * profile.spacing, wave.phase + wave.wave_number * grid.from, cosines,
                  sines);
        profile.heights.array() += wave.offset - wave.amplitude * cosines; // Eq. 9
    }
    return profile;
}

Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid) {
    const auto all = waves(genome);
    Eigen::MatrixXd basis(grid.nodes, 2 * static_cast<Index>(all.size()));
    for (Index c = 0; c < static_cast<Index>(all.size()); ++c) {
        const double k = all[static_cast<std::size_t>(c)].wave_number;
        fill_wave(k * grid.spacing(), k * grid.from, basis.col(2 * c).array(), basis.col(2 * c + 1).array());
    }
    return basis;
}

Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid) {
    // With S = sum_i g_i exp(i k x_i) and T = sum_i g_i x_i exp(i k x_i), for the functional g:
    //   cosine part  sum_i g_i cos(k x_i + theta) = Re(S e^{i theta}),  d/d phi_m = Im(S e^{i phi_m}) G,
    //   d/dk = G R Im(T e^{i theta}).
    const Eigen::MatrixXd basis = wave_basis(genome, grid);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(
        grid.nodes, grid.from, grid.from + grid.spacing() * static_cast<double>(grid.nodes - 1));
    const Eigen::MatrixXd S = height_gradient * basis;
    const Eigen::MatrixXd T = height_gradient * x.asDiagonal() * basis;

    const Index rows = height_gradient.rows();
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, static_cast<Index>(genes(genome).size()));
    Index gene = 0, column = 0;
    for (const auto& series : genome.series) {
        auto dA = result.col(gene), dH = result.col(gene + 1), dgamma = result.col(gene + 2),
             dlambda = result.col(gene + 3);
        gene += 4;
        for (const auto& chromosome : series.chromosomes) {
            const Wave w = wave(series, chromosome);
            const double s = genome.scale, order = chromosome.n - 1, lambda = series.lambda,
                         gamma = series.gamma;
            const auto Sc = S.col(column), Ss = S.col(column + 1), Tc = T.col(column), Ts = T.col(column + 1);
            column += 2;
            const double c0 = std::cos(w.phase), s0 = std::sin(w.phase);
            const Eigen::VectorXd height = -s * w.amplitude * (c0 * Sc - s0 * Ss);
            const Eigen::VectorXd dk = s * w.amplitude * (s0 * Tc + c0 * Ts);
            dA += height / series.A;
            dH -= height * (std::log(2 * std::numbers::pi / lambda) + order * std::log(gamma));
            dgamma += height * (0.5 / (gamma * std::log(gamma)) - order * series.H / gamma) +
                      dk * (order * w.wave_number / gamma);
            dlambda += height * (series.H / lambda) - dk * (w.wave_number / lambda);
            const double G = s * amplitude(series, chromosome.n, chromosome.phases.size());
            for (double phase : chromosome.phases)
                result.col(gene++) = G * (std::sin(phase) * Sc + std::cos(phase) * Ss);
        }
    }
    return result;
}

} // namespace rough
