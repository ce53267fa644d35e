#include "domain/mwm/sampling.hpp"

#include "domain/numerics/aligned.hpp"
#include "domain/numerics/vector_loops.hpp"

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

constexpr Index block = 32;

/// The angles phase + step * j of a wave at every node, each the sum of two.
struct AlongWave {
    Turns starts, fine;
    WaveAngles angles;

    AlongWave(double step, double phase, Index nodes)
        : starts(phase, step * block, (nodes + block - 1) / block),
          fine(0, step, std::min(block, nodes)), angles{nodes,
                                                        block,
                                                        starts.cosines.data(),
                                                        starts.sines.data(),
                                                        fine.cosines.data(),
                                                        fine.sines.data()} {}
};

/// wave_basis with as many further columns of zeros as fill whole blocks of eight.
Eigen::MatrixXd filled_wave_basis(const std::vector<Wave>& all, const Grid& grid) {
    const Index columns = 2 * static_cast<Index>(all.size());
    const Index filled = (columns + panel_width - 1) / panel_width * panel_width;
    Eigen::MatrixXd basis(grid.nodes, filled);
    basis.rightCols(filled - columns).setZero();
    for (Index w = 0; w < static_cast<Index>(all.size()); ++w) {
        const double k = all[static_cast<std::size_t>(w)].wave_number;
        const AlongWave along(k * grid.spacing(), k * grid.from, grid.nodes);
        vector_loops().wave(along.angles, basis.col(2 * w).data(), basis.col(2 * w + 1).data());
    }
    return basis;
}

/// rows * columns, of which there are a multiple of eight.
Eigen::MatrixXd product(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& columns) {
    const Index depth = rows.cols();
    Eigen::MatrixXd result(rows.rows(), columns.cols());
    AlignedBuffer<double> panel(panel_width * depth);
    double square[panel_width * panel_width];
    for (Index first = 0; first < rows.rows(); first += panel_width) {
        const Index count = std::min(panel_width, rows.rows() - first);
        std::fill_n(panel.data(), panel_width * depth, 0.0);
        for (Index i = 0; i < depth; ++i)
            for (Index r = 0; r < count; ++r)
                panel[panel_width * i + r] = rows(first + r, i);
        for (Index column = 0; column < columns.cols(); column += panel_width) {
            vector_loops().multiply(panel.data(), depth, columns.col(column).data(), columns.rows(), square);
            for (Index c = 0; c < panel_width; ++c)
                for (Index r = 0; r < count; ++r)
                    result(first + r, column + c) = square[panel_width * c + r];
        }
    }
    return result;
}

} // namespace

Profile sample(const Genome& genome, const Grid& grid) {
    Profile profile{Eigen::VectorXd::Zero(grid.nodes), grid.spacing()};
    for (const Wave& wave : waves(genome)) { // Eq. 9
        const AlongWave along(wave.wave_number * profile.spacing, wave.phase + wave.wave_number * grid.from,
                              grid.nodes);
        vector_loops().add_wave(along.angles, wave.offset, wave.amplitude, profile.heights.data());
    }
    return profile;
}

double jump_at_ends(const Genome& genome, double length) {
    const Profile ends = sample(genome, {2, length});
    return ends.heights[1] - ends.heights[0];
}

bool is_flat(const Profile& sampled, const Genome& genome) {
    double amplitudes = 0;
    for (const Wave& wave : waves(genome))
        amplitudes += std::abs(wave.amplitude);
    return !(sampled.heights.maxCoeff() - sampled.heights.minCoeff() > 1e-12 * amplitudes);
}

Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid) {
    const auto all = waves(genome);
    return filled_wave_basis(all, grid).leftCols(2 * static_cast<Index>(all.size()));
}

Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid) {
    // With S = sum_i g_i exp(i k x_i) and T = sum_i g_i x_i exp(i k x_i), for the functional g:
    //   cosine part  sum_i g_i cos(k x_i + theta) = Re(S e^{i theta}),  d/d phi_m = Im(S e^{i phi_m}) G,
    //   d/dk = G R Im(T e^{i theta}).
    const Eigen::MatrixXd basis = filled_wave_basis(waves(genome), grid);
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(
        grid.nodes, grid.from, grid.from + grid.spacing() * static_cast<double>(grid.nodes - 1));
    const Eigen::MatrixXd S = product(height_gradient, basis);
    const Eigen::MatrixXd T = product(height_gradient * x.asDiagonal(), basis);

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
