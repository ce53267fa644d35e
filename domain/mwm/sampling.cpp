#include "domain/mwm/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rough {

namespace {

/// cos and sin of from + step * j, j = 0..count-1, doubled by the addition theorem: each value is a product
/// of no more than 1 + log2(count) correctly rounded ones, so errors do not build up along x.
struct Turns {
    Eigen::ArrayXd cosines, sines;

    Turns(double from, double step, Index count) : cosines(count), sines(count) {
        cosines[0] = std::cos(from);
        sines[0] = std::sin(from);
        for (Index known = 1; known < count; known *= 2) {
            const Index next = std::min(known, count - known);
            const double turn = step * static_cast<double>(known), c = std::cos(turn), s = std::sin(turn);
            cosines.segment(known, next) = c * cosines.head(next) - s * sines.head(next);
            sines.segment(known, next) = s * cosines.head(next) + c * sines.head(next);
        }
    }
};

/// Calls use(start, count, c, s, fine): at node start + j, j < count, the wave's angle is that of (c, s) and
/// of fine's j-th turn together.
template <class Use>
void along_wave(double step, double phase, Index nodes, Use use) {
    constexpr Index block = 32;
    const Turns fine(0, step, std::min(block, nodes));
    const Turns starts(phase, step * block, (nodes + block - 1) / block);
    for (Index b = 0; b < starts.cosines.size(); ++b)
        use(b * block, std::min(block, nodes - b * block), starts.cosines[b], starts.sines[b], fine);
}

} // namespace

Profile sample(const Genome& genome, const Grid& grid) {
    Profile profile{Eigen::VectorXd::Zero(grid.nodes), grid.spacing()};
    for (const Wave& wave : waves(genome)) // Eq. 9
        along_wave(wave.wave_number * profile.spacing, wave.phase + wave.wave_number * grid.from, grid.nodes,
                   [&](Index start, Index count, double c, double s, const Turns& fine) {
                       profile.heights.segment(start, count).array() +=
                           wave.offset - (wave.amplitude * c) * fine.cosines.head(count) +
                           (wave.amplitude * s) * fine.sines.head(count);
                   });
    return profile;
}

bool is_flat(const Profile& sampled, const Genome& genome) {
    double amplitudes = 0;
    for (const Wave& wave : waves(genome))
        amplitudes += std::abs(wave.amplitude);
    return !(sampled.heights.maxCoeff() - sampled.heights.minCoeff() > 1e-12 * amplitudes);
}

Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid) {
    const auto all = waves(genome);
    Eigen::MatrixXd basis(grid.nodes, 2 * static_cast<Index>(all.size()));
    for (Index w = 0; w < static_cast<Index>(all.size()); ++w) {
        const double k = all[static_cast<std::size_t>(w)].wave_number;
        along_wave(k * grid.spacing(), k * grid.from, grid.nodes,
                   [&](Index start, Index count, double c, double s, const Turns& fine) {
                       basis.col(2 * w).segment(start, count).array() =
                           c * fine.cosines.head(count) - s * fine.sines.head(count);
                       basis.col(2 * w + 1).segment(start, count).array() =
                           s * fine.cosines.head(count) + c * fine.sines.head(count);
                   });
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
