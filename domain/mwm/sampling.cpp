#include "domain/mwm/sampling.hpp"

#include "domain/numerics/aligned.hpp"
#include "domain/numerics/vector_loops.hpp"

#include <complex>
#include <numbers>

namespace rough {
namespace {

/// cos and sin of from + step * j, j = 0..count-1, by doubling with the addition theorem. Each value is a
/// product of at most 1 + log2(count) correctly rounded ones, so errors do not accumulate along x.
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
        : starts(phase, step * block, (nodes + block - 1) / block), fine(0, step, std::min(block, nodes)) {
        angles = {nodes, block, starts.cosines.data(), starts.sines.data(), fine.cosines.data(), fine.sines.data()};
    }
};

void add_wave(const Wave& wave, const Grid& grid, Eigen::VectorXd& heights) {
    const AlongWave along(wave.wave_number * grid.spacing(), wave.phase + wave.wave_number * grid.from, grid.nodes);
    vector_loops().add_wave(along.angles, wave.offset, wave.amplitude, heights.data());
}

/// wave_basis, extended by columns of zeros to whole blocks of eight.
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

/// rows * columns; the number of columns is a multiple of eight.
Eigen::MatrixXd product(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& columns) {
    const Index depth = rows.cols();
    Eigen::MatrixXd result(rows.rows(), columns.cols());
    AlignedBuffer<double> panel(panel_width * depth);
    double square[panel_width * panel_width];
    for (Index first = 0; first < rows.rows(); first += panel_width) {
        const Index count = std::min(panel_width, rows.rows() - first);
        std::fill_n(panel.data(), panel_width * depth, 0.0);
        for (Index i = 0; i < depth; ++i)
            for (Index r = 0; r < count; ++r) panel[panel_width * i + r] = rows(first + r, i);
        for (Index column = 0; column < columns.cols(); column += panel_width) {
            vector_loops().multiply(panel.data(), depth, columns.col(column).data(), columns.rows(), square);
            for (Index c = 0; c < panel_width; ++c)
                for (Index r = 0; r < count; ++r) result(first + r, column + c) = square[panel_width * c + r];
        }
    }
    return result;
}

/// cos(k x_i) and sin(k x_i), or along y, one column per plane wave.
struct Axis {
    Eigen::MatrixXd cosines, sines;

    Axis(const std::vector<PlaneWave>& all, double PlaneWave::*k, Index nodes, double spacing, double from)
        : cosines(nodes, static_cast<Index>(all.size())), sines(cosines.rows(), cosines.cols()) {
        for (Index w = 0; w < cosines.cols(); ++w) {
            const double turn = all[static_cast<std::size_t>(w)].*k;
            const Turns along(turn * from, turn * spacing, nodes);
            cosines.col(w) = along.cosines;
            sines.col(w) = along.sines;
        }
    }
};

Axis x_axis(const std::vector<PlaneWave>& all, const Grid& grid) {
    return {all, &PlaneWave::k_x, grid.nodes, grid.spacing(), grid.first_x()};
}
Axis y_axis(const std::vector<PlaneWave>& all, const Grid& grid) {
    return {all, &PlaneWave::k_y, grid.rows, grid.row_spacing(), grid.first_y()};
}

/// The waves' sum plus `offset` (mm).
Eigen::MatrixXd sampled_from(double offset, const std::vector<PlaneWave>& all, const Grid& grid) {
    const Axis x = x_axis(all, grid), y = y_axis(all, grid);
    Eigen::VectorXd c(x.cosines.cols()), s(x.cosines.cols());
    for (Index w = 0; w < c.size(); ++w) {
        const PlaneWave& wave = all[static_cast<std::size_t>(w)];
        c[w] = wave.amplitude * std::cos(wave.phase);
        s[w] = wave.amplitude * std::sin(wave.phase);
    }
    // cos(X + Y + phi) = cos(X + phi) cos Y - sin(X + phi) sin Y: two products of matrices
    Eigen::MatrixXd heights = Eigen::MatrixXd::Constant(grid.nodes, grid.rows, offset);
    heights.noalias() -= (x.cosines * c.asDiagonal() - x.sines * s.asDiagonal()).eval() * y.cosines.transpose();
    heights.noalias() += (x.sines * c.asDiagonal() + x.cosines * s.asDiagonal()).eval() * y.sines.transpose();
    return heights;
}

/// Sums of one functional over a map. S = sum g exp(i(k_x x + k_y y)); T_x and T_y have g x and g y in place of g.
struct PlaneSums {
    Eigen::VectorXcd S, Tx, Ty;
};

PlaneSums plane_sums(const Eigen::Map<const Eigen::MatrixXd>& g, const Axis& x, const Axis& y,
                     const Eigen::VectorXd& at_x, const Eigen::VectorXd& at_y) {
    const std::complex<double> i(0, 1);
    const auto contracted = [&](const Eigen::MatrixXd& cosine_part, const Eigen::MatrixXd& sine_part,
                                const Eigen::VectorXd& weight) -> Eigen::VectorXcd {
        const Eigen::MatrixXd c = weight.asDiagonal() * x.cosines, s = weight.asDiagonal() * x.sines;
        const auto dot = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) -> Eigen::VectorXd {
            return (a.array() * b.array()).colwise().sum().transpose();
        };
        return (dot(c, cosine_part) - dot(s, sine_part)).cast<std::complex<double>>() +
               i * (dot(s, cosine_part) + dot(c, sine_part)).cast<std::complex<double>>();
    };
    const Eigen::MatrixXd gc = g * y.cosines, gs = g * y.sines;
    const Eigen::MatrixXd yc = g * (at_y.asDiagonal() * y.cosines), ys = g * (at_y.asDiagonal() * y.sines);
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(at_x.size());
    return {contracted(gc, gs, one), contracted(gc, gs, at_x), contracted(yc, ys, one)};
}

/// Adds the derivatives by one wave of a series, chromosome n, to those by its A, H, gamma and lambda (four
/// columns). `height` is by the relative height of the wave, `dk` by its wavenumber.
template <class Values, class Columns>
void add_by_series(const Series& series, int n, const Values& height, const Values& dk, Columns by) {
    const double order = n - 1, k = wave_number(series, n);
    by.col(0) += height / series.A;
    by.col(1) -= height * (std::log(2 * std::numbers::pi / series.lambda) + order * std::log(series.gamma));
    by.col(2) += height * (0.5 / (series.gamma * std::log(series.gamma)) - order * series.H / series.gamma) +
                 dk * (order * k / series.gamma);
    by.col(3) += height * (series.H / series.lambda) - dk * (k / series.lambda);
}

Eigen::MatrixXd pulled_back_area(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid) {
    const auto all = plane_waves(genome, grid);
    const Axis x = x_axis(all, grid), y = y_axis(all, grid);
    const auto nodes_at = [](double first, double spacing, Index count) {
        return Eigen::VectorXd::LinSpaced(count, first, first + spacing * static_cast<double>(count - 1)).eval();
    };
    const Eigen::VectorXd at_x = nodes_at(grid.first_x(), grid.spacing(), grid.nodes),
                          at_y = nodes_at(grid.first_y(), grid.row_spacing(), grid.rows);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(height_gradient.rows(), static_cast<Index>(genes(genome).size()));
    for (Index row = 0; row < height_gradient.rows(); ++row) {
        const Eigen::VectorXd functional = height_gradient.row(row);
        const PlaneSums sums =
            plane_sums(Eigen::Map<const Eigen::MatrixXd>(functional.data(), grid.nodes, grid.rows), x, y, at_x, at_y);
        Index gene = 0;
        std::size_t w = 0;
        for (const Series& series : genome.series) {
            auto of_series = result.row(row).segment(gene, 4);
            gene += 4;
            for (const Chromosome& chromosome : series.chromosomes)
                for (std::size_t m = 0; m < chromosome.phases.size(); ++m, ++w) {
                    const PlaneWave& wave = all[w];
                    const auto at = static_cast<Index>(w);
                    const std::complex<double> turn = std::polar(1.0, wave.phase);
                    using Value = Eigen::Array<double, 1, 1>;
                    const Value height(-wave.amplitude * (sums.S[at] * turn).real());
                    const double norm = std::hypot(wave.k_x, wave.k_y);
                    const Value dk(wave.fitted
                                       ? 0
                                       : wave.amplitude *
                                             ((wave.k_x * sums.Tx[at] + wave.k_y * sums.Ty[at]) / norm * turn).imag());
                    add_by_series(series, chromosome.n, height, dk, of_series.array());
                    result(row, gene++) = wave.amplitude * (sums.S[at] * turn).imag();
                }
        }
    }
    return result;
}

} // namespace

std::vector<PlaneWave> plane_waves(const Genome& genome, const Grid& grid) {
    constexpr double turn = 2 * std::numbers::pi;
    std::vector<PlaneWave> all;
    for (const Series& series : genome.series)
        for (const Chromosome& chromosome : series.chromosomes) {
            const double k = wave_number(series, chromosome.n);
            const std::size_t ridges = chromosome.phases.size();
            const double G = genome.scale * amplitude(series, chromosome.n, ridges);
            for (std::size_t m = 0; m < ridges; ++m) {
                const double theta = std::numbers::pi * static_cast<double>(m) / static_cast<double>(ridges);
                PlaneWave wave{G, k * std::cos(theta), k * std::sin(theta), chromosome.phases[m]};
                if (2 * m == ridges) wave.k_x = 0;
                if (grid.periodic) {
                    const double x = wave.k_x * grid.length / turn, y = wave.k_y * grid.width / turn;
                    double i = std::round(x), j = std::round(y);
                    if (i == 0 && j == 0) // the nearest other than zero, along one of the axes
                        (std::abs(x) * grid.width >= std::abs(y)* grid.length ? i = std::copysign(1, x) : j = 1);
                    const double fit_x = turn * i / grid.length, fit_y = turn * j / grid.width;
                    wave.moved = std::hypot(fit_x - wave.k_x, fit_y - wave.k_y) / k;
                    wave.fitted = true;
                    wave.k_x = fit_x;
                    wave.k_y = fit_y;
                }
                all.push_back(wave);
            }
        }
    return all;
}

Eigen::VectorXd sampled(const std::vector<PlaneWave>& waves, const Grid& grid) {
    if (grid.is_2d()) return sampled_from(0, waves, grid).reshaped();
    Eigen::VectorXd heights = Eigen::VectorXd::Zero(grid.nodes);
    for (const PlaneWave& wave : waves) add_wave({wave.amplitude, wave.k_x, wave.phase, 0}, grid, heights);
    return heights;
}

Profile sample(const Genome& genome, const Grid& grid) {
    if (grid.is_2d()) {
        const auto all = plane_waves(genome, grid);
        double offset = 0;
        for (const PlaneWave& wave : all) offset += wave.amplitude * std::cos(wave.phase);
        return {sampled_from(offset, all, grid).reshaped(), grid.spacing(), grid.rows, grid.row_spacing()};
    }
    Profile profile{Eigen::VectorXd::Zero(grid.nodes), grid.spacing()};
    for (const Wave& wave : waves(genome)) // Eq. 9
        add_wave(wave, grid, profile.heights);
    return profile;
}

double jump_at_ends(const Genome& genome, double length) {
    const Profile ends = sample(genome, {2, length});
    return ends.heights[1] - ends.heights[0];
}

bool is_flat(const Profile& sampled, const Genome& genome) {
    double amplitudes = 0;
    for (const Wave& wave : waves(genome)) amplitudes += std::abs(wave.amplitude);
    return !(sampled.heights.maxCoeff() - sampled.heights.minCoeff() > 1e-12 * amplitudes);
}

Eigen::MatrixXd wave_basis(const Genome& genome, const Grid& grid) {
    const auto all = waves(genome);
    return filled_wave_basis(all, grid).leftCols(2 * static_cast<Index>(all.size()));
}

Eigen::MatrixXd pulled_back(const Eigen::MatrixXd& height_gradient, const Genome& genome, const Grid& grid) {
    if (grid.is_2d()) return pulled_back_area(height_gradient, genome, grid);
    // For the functional g, with S = sum_i g_i exp(i k x_i) and T = sum_i g_i x_i exp(i k x_i):
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
        auto of_series = result.middleCols(gene, 4);
        gene += 4;
        for (const auto& chromosome : series.chromosomes) {
            const Wave w = wave(series, chromosome);
            const double s = genome.scale;
            const auto Sc = S.col(column), Ss = S.col(column + 1), Tc = T.col(column), Ts = T.col(column + 1);
            column += 2;
            const double c0 = std::cos(w.phase), s0 = std::sin(w.phase);
            const Eigen::VectorXd height = -s * w.amplitude * (c0 * Sc - s0 * Ss);
            const Eigen::VectorXd dk = s * w.amplitude * (s0 * Tc + c0 * Ts);
            add_by_series(series, chromosome.n, height, dk, of_series);
            const double G = s * amplitude(series, chromosome.n, chromosome.phases.size());
            for (double phase : chromosome.phases)
                result.col(gene++) = G * (std::sin(phase) * Sc + std::cos(phase) * Ss);
        }
    }
    return result;
}

} // namespace rough
