#include "domain/numerics/fft_library.hpp"

#include <numbers>

namespace rough {
namespace {

/// Rows or columns that are transformed together: as many columns as fit the first cache, in whole lines of the rows.
constexpr Index block = 8;
/// Distance of successive columns. A power of two would put all columns in the same places of the cache.
constexpr Index column_stride(Index rows) { return rows + block; }
/// Distance of successive rows of a transform. Blocks of columns begin and end at borders of cache lines, so
/// that threads do not share a line.
constexpr Index row_stride(Index columns) { return (columns + block - 1) / block * block; }

/// Rows by which the numbers of columns are fetched ahead, because another core may hold them.
constexpr Index ahead = 16;

/// Memory of this thread for one transform at a time, which its operators share.
char* shared_bytes(Index size) {
    thread_local Index held = 1;
    thread_local AlignedBuffer<char> memory(held);
    if (size > held) {
        held = 1; // frees the memory before more is taken
        memory = AlignedBuffer<char>(held);
        memory = AlignedBuffer<char>(size);
        held = size;
    }
    return memory.data();
}
template <typename Number>
Number* shared_memory(Index count) {
    return reinterpret_cast<Number*>(shared_bytes(count * static_cast<Index>(sizeof(Number))));
}

/// Plans of complex transforms of a block of columns.
template <typename Real>
PlanPair<Real> column_plans(Index rows) {
    return plans<Real>(false, {rows}, block, column_stride(rows));
}

/// Plans of a block of rows, and of those that are left after whole blocks.
template <typename Real>
struct RowPlans {
    PlanPair<Real> whole, rest;
    /// `rows` real or complex rows of n numbers, whose transforms are `apart` numbers apart.
    RowPlans(bool of_real, Index rows, Index n, Index apart)
        : whole(rows >= block ? plans<Real>(of_real, {n}, block, apart) : PlanPair<Real>()),
          rest(rows % block ? plans<Real>(of_real, {n}, rows % block, apart) : PlanPair<Real>()) {}
    const PlanPair<Real>& of(Index count) const { return count == block ? whole : rest; }
};

/// Numbers by eigenvalues.
template <typename Real>
void multiply(std::complex<Real>* numbers, const Real* eigenvalues, Index count) {
    for (Index k = 0; k < count; ++k) numbers[k] *= eigenvalues[k];
}

/// Multiplies by eigenvalues that are given for k = 0..n/2. That of a larger k is that of n - k, or of n-1-k if `skew`.
template <typename Real>
void multiply_mirrored(std::complex<Real>* numbers, const Real* eigenvalues, Index n, bool skew = false) {
    multiply(numbers, eigenvalues, n / 2 + 1);
    for (Index k = n / 2 + 1; k < n; ++k) numbers[k] *= eigenvalues[n - skew - k];
}

/// Takes columns to `scratch` and back, some at a time; padded with zeros to `padded` rows, and a whole block
/// of them. turn(scratch, first, count, stride) does what is to be done to `count` columns from `first` on.
/// Rows of `numbers` are row_stride(shape.columns) apart.
template <typename Real, class Turn>
void each_column(std::complex<Real>* numbers, Extent shape, Index padded, Workspace<Real>& work, Turn turn) {
    const Index stride = column_stride(padded), row = row_stride(shape.columns);
    work.each_range(shape.columns, block, [&](Index first, Index count, std::complex<Real>* columns) {
        std::complex<Real>* corner = numbers + first;
        for (Index j = 0; j < shape.rows; ++j) {
            __builtin_prefetch(corner + std::min(j + ahead, shape.rows - 1) * row);
            for (Index c = 0; c < count; ++c) columns[c * stride + j] = corner[j * row + c];
        }
        for (Index c = 0; c < block; ++c)
            std::fill(columns + c * stride + (c < count ? shape.rows : 0), columns + c * stride + padded,
                      std::complex<Real>());
        turn(columns, first, count, stride);
        for (Index j = 0; j < shape.rows; ++j) {
            __builtin_prefetch(corner + std::min(j + ahead, shape.rows - 1) * row);
            for (Index c = 0; c < count; ++c) corner[j * row + c] = columns[c * stride + j];
        }
    });
}

bool is_circulant(const Eigen::VectorXd& first_column, Extent shape) {
    const auto entry = [&](Index i, Index j) {
        return first_column[j % shape.rows * shape.columns + i % shape.columns];
    };
    for (Index j = 0; j < shape.rows; ++j)
        for (Index i = 0; i < shape.columns; ++i)
            if (entry(i, j) != entry(shape.columns - i, j) || entry(i, j) != entry(i, shape.rows - j)) return false;
    return true;
}

Eigen::ArrayXcd twists(Index count, Index n) {
    return Eigen::ArrayXcd::NullaryExpr(count, [n](Index j) {
        return std::polar(1.0, -std::numbers::pi * static_cast<double>(j) / static_cast<double>(n));
    });
}

} // namespace

Eigen::ArrayXXcd fourier_transform(const Eigen::ArrayXXd& numbers) {
    const Extent shape{numbers.rows(), numbers.cols()}, half{shape.columns / 2 + 1, shape.rows};
    AlignedBuffer<double> real(shape.nodes());
    AlignedBuffer<std::complex<double>> transform(half.nodes());
    std::copy_n(numbers.data(), shape.nodes(), real.data());
    FftLibrary<double>::execute(plans<double>(true, shape, 1, half.nodes()).forward, real.data(), transform.data());
    return Eigen::ArrayXXcd::Map(transform.data(), half.columns, half.rows);
}

Eigen::ArrayXXd inverse_fourier_transform(const Eigen::ArrayXXcd& half, Index columns) {
    const Extent shape{columns, half.cols()};
    AlignedBuffer<double> real(shape.nodes());
    AlignedBuffer<std::complex<double>> transform(half.size());
    std::copy_n(half.data(), half.size(), transform.data());
    FftLibrary<double>::execute(plans<double>(true, shape, 1, half.size()).backward, transform.data(), real.data());
    return Eigen::ArrayXXd::Map(real.data(), shape.columns, shape.rows);
}

Eigen::ArrayXXcd inverse_complex_transform(const Eigen::ArrayXXcd& transform) {
    AlignedBuffer<std::complex<double>> work(transform.size());
    std::copy_n(transform.data(), transform.size(), work.data());
    const Extent shape{transform.rows(), transform.cols()};
    FftLibrary<double>::execute(plans<double>(false, shape, 1, shape.nodes()).backward, work.data(), work.data());
    return Eigen::ArrayXXcd::Map(work.data(), transform.rows(), transform.cols());
}

bool is_good_fourier_length(Index length) {
    for (const Index factor : {2, 3, 5, 7, 11, 13})
        while (length % factor == 0) length /= factor;
    return length == 1;
}

Index fast_fourier_length(Index length) {
    Index best = 2;
    while (best < length) best *= 2;
    for (Index five = 1; five < best; five *= 5)
        for (Index three = five; three < best; three *= 3) {
            Index candidate = 2 * three;
            while (candidate < length) candidate *= 2;
            best = std::min(best, candidate);
        }
    return best;
}

/// The transform of an even array of `shape`, which is real and even itself: column after column, each of
/// rows/2 + 1 numbers. entry(i, j) is wanted for i <= columns/2 and j <= rows/2.
template <class Entry>
static AlignedBuffer<double> even_spectrum(Extent shape, Team& team, Entry entry) {
    const Index columns = shape.columns / 2 + 1, rows = shape.rows / 2 + 1;
    const auto mirrored = [](Index i, Index n) { return std::min(i, n - i); };
    // `lines` transforms of n even numbers each; put(line, k, value) takes them for k <= n/2.
    const auto transform = [&team](Index lines, Index n, auto number, auto put) {
        const Index half = n / 2 + 1;
        const RowPlans<double> row_plans(true, lines, n, half);
        Workspace<double>(2 * block * half, team)
            .each_range(lines, block, [&](Index first, Index count, std::complex<double>* out) {
                double* in = reinterpret_cast<double*>(out + block * half);
                for (Index c = 0; c < count; ++c)
                    for (Index k = 0; k < n; ++k) in[c * n + k] = number(first + c, k);
                FftLibrary<double>::execute(row_plans.of(count).forward, in, out);
                for (Index c = 0; c < count; ++c)
                    for (Index k = 0; k < half; ++k) put(first + c, k, out[c * half + k].real());
            });
    };
    AlignedBuffer<double> spectrum(columns * rows);
    transform(
        rows, shape.columns, [&](Index j, Index i) { return entry(mirrored(i, shape.columns), j); },
        [&](Index j, Index k, double value) { spectrum[k * rows + j] = value; });
    if (rows > 1)
        transform(
            columns, shape.rows, [&](Index k, Index j) { return spectrum[k * rows + mirrored(j, shape.rows)]; },
            [&](Index k, Index l, double value) { spectrum[k * rows + l] = value; });
    return spectrum;
}

template <typename Real>
BasicFourierOperator<Real>::BasicFourierOperator(Extent shape, Extent padded, Team& team)
    : team_(&team), shape_(shape), padded_(padded), half_(padded.columns / 2 + 1), lines_(padded.rows / 2 + 1),
      spectrum_(half_ * lines_),
      work_(shape.rows == 1 ? 0 : block * std::max(column_stride(padded.rows), half_), team) {}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::toeplitz(const Eigen::VectorXd& first_column, Extent shape,
                                                                Team& team) {
    const auto padded = [](Index n) { return fast_fourier_length(std::max<Index>(2 * n - 1, 2)); };
    BasicFourierOperator op(shape, {padded(shape.columns), shape.rows == 1 ? 1 : padded(shape.rows)}, team);
    if (is_circulant(first_column, shape)) op.of_mean_ = first_column.sum();
    AlignedBuffer<double> spectrum = even_spectrum(op.padded_, team, [&](Index i, Index j) {
        return i < shape.columns && j < shape.rows ? first_column[j * shape.columns + i] : 0;
    });
    const double scale = static_cast<double>(op.padded_.nodes());
    for (Index k = 0; k < op.half_ * op.lines_; ++k) op.spectrum_[k] = static_cast<Real>(spectrum[k] / scale);
    return op;
}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::circulant(Extent shape, const Eigen::VectorXd& eigenvalues,
                                                                 Team& team) {
    BasicFourierOperator op(shape, shape, team);
    for (Index j = 0; j < op.lines_; ++j)
        for (Index k = 0; k < op.half_; ++k)
            op.spectrum_[k * op.lines_ + j] =
                static_cast<Real>(eigenvalues[j * op.half_ + k] / static_cast<double>(shape.nodes()));
    return op;
}

template <typename Real>
void BasicFourierOperator<Real>::apply(const Real* from, Real* to) {
    const Index n = shape_.columns, longer = padded_.columns, rows = shape_.rows;
    const Index apart = row_stride(half_);
    const RowPlans<Real> row_plans(true, rows, longer, apart);
    auto* const transform = shared_memory<std::complex<Real>>(apart * rows);
    using Row = Eigen::Map<Eigen::ArrayX<Real>>;
    const double sum = of_mean_ ? team_->sum_of(nodes(), [=](Index i) { return double{from[i]}; }) : 0;
    const Real mean = static_cast<Real>(sum / static_cast<double>(nodes()));
    // A line is padded in place, rows of an area in a workspace.
    const auto each_rows = [&](auto job) {
        work_.each_range(rows, block, [&](Index first, Index count, std::complex<Real>* memory) {
            job(first * n, rows == 1 ? input() : reinterpret_cast<Real*>(memory), count, row_plans.of(count),
                transform + first * apart);
        });
    };
    each_rows([&](Index node, Real* row, Index count, const PlanPair<Real>& plan, auto* wave) {
        for (Index c = 0; c < count; ++c) {
            if (from != row) std::copy_n(from + node + c * n, n, row + c * longer);
            if (of_mean_) Row(row + c * longer, n) -= mean;
            std::fill(row + c * longer + n, row + (c + 1) * longer, Real(0));
        }
        FftLibrary<Real>::execute(plan.forward, row, wave);
    });
    if (padded_.rows == 1)
        multiply(transform, spectrum_.data(), half_);
    else {
        const PlanPair<Real> plan = column_plans<Real>(padded_.rows);
        each_column(transform, {half_, rows}, padded_.rows, work_,
                    [&](std::complex<Real>* columns, Index first, Index count, Index stride) {
                        FftLibrary<Real>::execute(plan.forward, columns, columns);
                        for (Index c = 0; c < count; ++c)
                            multiply_mirrored(columns + c * stride, spectrum_.data() + (first + c) * lines_,
                                              padded_.rows);
                        FftLibrary<Real>::execute(plan.backward, columns, columns);
                    });
    }
    each_rows([&](Index node, Real* row, Index count, const PlanPair<Real>& plan, auto* wave) {
        FftLibrary<Real>::execute(plan.backward, wave, row);
        for (Index c = 0; c < count; ++c) {
            if (of_mean_) Row(row + c * longer, n) += mean * static_cast<Real>(*of_mean_);
            if (to != row) std::copy_n(row + c * longer, n, to + node + c * n);
        }
    });
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply(const std::vector<int>& nodes, const Eigen::VectorXd& p) {
    std::fill_n(input(), this->nodes(), Real(0));
    for (std::size_t k = 0; k < nodes.size(); ++k) input()[nodes[k]] = static_cast<Real>(p[static_cast<Index>(k)]);
    return apply();
}

template class BasicFourierOperator<double>;
template class BasicFourierOperator<float>;

SplitOperator::SplitOperator(const Eigen::VectorXd& first_column, Extent shape, Team& team)
    : shape_(shape), is_circulant_(is_circulant(first_column, shape)),
      whole_(is_circulant_
                 ? shape
                 : Extent{fast_fourier_length(shape.columns), shape.rows == 1 ? 1 : fast_fourier_length(shape.rows)}),
      wave_(shared_memory<std::complex<double>>(row_stride(whole_.columns / 2 + 1) * whole_.rows)),
      work_(block * std::max(2 * column_stride(whole_.rows), whole_.columns / 2 + 1), team),
      twist_x_(twists(whole_.columns / 2, whole_.columns)), twist_y_(twists(whole_.rows, whole_.rows)) {
    const Index n = whole_.columns, lines = whole_.rows / 2 + 1;
    const bool line = shape.rows == 1;
    const PlanPair<double> plan = column_plans<double>(whole_.rows);
    // The first column beyond its end is 0, and c_n is c_0: all of it goes to the circulant.
    const auto add_row = [&](Index j, double sign, double* row) {
        j = j == whole_.rows ? 0 : j;
        if (j < shape.rows)
            Eigen::Map<Eigen::ArrayXd>(row, shape.columns) +=
                sign * first_column.segment(j * shape.columns, shape.columns).array();
    };
    for (const bool skew_x : {false, true})
        for (const bool skew_y : {false, true}) {
            if (((skew_x || skew_y) && is_circulant_) || (skew_y && line)) continue;
            forward(skew_x, whole_.rows, [&](Index j, double* row) {
                Eigen::Map<Eigen::ArrayXd> all(row, n);
                all.setZero();
                add_row(j, 1, row);
                if (!line) add_row(whole_.rows - j, skew_y ? -1 : 1, row);
                const double sign = skew_x ? -1 : 1, first = row[0];
                row[0] += sign * first;
                for (Index i = 1; 2 * i <= n; ++i) {
                    const double value = row[i] + sign * row[n - i];
                    row[i] = value;
                    row[n - i] = sign * value;
                }
            });
            const Index columns = n / 2 + !skew_x;
            Eigen::ArrayXd& eigenvalues = eigenvalues_[skew_x][skew_y];
            eigenvalues.resize(columns * lines);
            const double parts = (line ? 2 : 4) * static_cast<double>(whole_.nodes()) / (skew_x ? 2 : 1);
            if (line)
                eigenvalues = Eigen::Map<Eigen::ArrayXcd>(wave_, columns).real() / parts;
            else
                each_column(wave_, {columns, whole_.rows}, whole_.rows, work_,
                            [&](std::complex<double>* columns, Index first, Index count, Index stride) {
                                if (skew_y)
                                    for (Index c = 0; c < count; ++c)
                                        Eigen::Map<Eigen::ArrayXcd>(columns + c * stride, whole_.rows) *= twist_y_;
                                FftLibrary<double>::execute(plan.forward, columns, columns);
                                for (Index c = 0; c < count; ++c)
                                    for (Index l = 0; l < lines; ++l)
                                        eigenvalues[(first + c) * lines + l] = columns[c * stride + l].real() / parts;
                            });
        }
}

template <class Fill>
void SplitOperator::forward(bool skew_x, Index rows, Fill fill) {
    const Index n = whole_.columns, half = n / 2, apart = row_stride(half + !skew_x);
    const RowPlans<double> row_plans(!skew_x, rows, skew_x ? half : n, apart);
    work_.each_range(rows, block, [&](Index first, Index count, std::complex<double>* memory) {
        double* row = reinterpret_cast<double*>(memory);
        std::complex<double>* wave = wave_ + first * apart;
        for (Index c = 0; c < count; ++c) {
            double* numbers = row + (skew_x ? 0 : c * n);
            fill(first + c, numbers);
            for (Index j = 0; skew_x && j < half; ++j)
                wave[c * apart + j] = std::complex<double>(row[j], -row[half + j]) * twist_x_[j];
        }
        if (skew_x)
            FftLibrary<double>::execute(row_plans.of(count).forward, wave, wave);
        else
            FftLibrary<double>::execute(row_plans.of(count).forward, row, wave);
    });
}

template <class Take>
void SplitOperator::backward(bool skew_x, Take take) {
    const Index n = whole_.columns, half = n / 2, apart = row_stride(half + !skew_x);
    const RowPlans<double> row_plans(!skew_x, shape_.rows, skew_x ? half : n, apart);
    work_.each_range(shape_.rows, block, [&](Index first, Index count, std::complex<double>* memory) {
        double* row = reinterpret_cast<double*>(memory);
        std::complex<double>* wave = wave_ + first * apart;
        if (skew_x)
            FftLibrary<double>::execute(row_plans.of(count).backward, wave, wave);
        else
            FftLibrary<double>::execute(row_plans.of(count).backward, wave, row);
        for (Index c = 0; c < count; ++c) {
            for (Index j = 0; skew_x && j < half; ++j) {
                const std::complex<double> pair = wave[c * apart + j] * std::conj(twist_x_[j]);
                row[j] = pair.real();
                row[half + j] = -pair.imag();
            }
            take(first + c, row + (skew_x ? 0 : c * n));
        }
    });
}

Eigen::VectorXd SplitOperator::apply(const Eigen::VectorXd& p) {
    const Index n = shape_.columns, rows = whole_.rows;
    const PlanPair<double> plan = column_plans<double>(rows);
    const auto multiplied = [&](std::complex<double>* columns, const Eigen::ArrayXd& eigenvalues, Index first,
                                Index count, Index stride, bool skew) {
        FftLibrary<double>::execute(plan.forward, columns, columns);
        for (Index c = 0; c < count; ++c)
            multiply_mirrored(columns + c * stride, eigenvalues.data() + (first + c) * (rows / 2 + 1), rows, skew);
        FftLibrary<double>::execute(plan.backward, columns, columns);
    };
    wave_ = shared_memory<std::complex<double>>(row_stride(whole_.columns / 2 + 1) * shape_.rows);
    Eigen::VectorXd u(shape_.nodes());
    for (const bool skew_x : {false, true}) {
        const auto& even = eigenvalues_[skew_x][0]; // no structured binding: clang 14 cannot capture it
        const auto& skew = eigenvalues_[skew_x][1];
        if (even.size() == 0) continue;
        forward(skew_x, shape_.rows, [&](Index j, double* row) {
            std::copy_n(p.data() + j * n, n, row);
            std::fill(row + n, row + whole_.columns, 0.0);
        });
        const Index columns = whole_.columns / 2 + !skew_x;
        if (shape_.rows == 1)
            multiply(wave_, even.data(), columns);
        else
            each_column(wave_, {columns, shape_.rows}, rows, work_,
                        [&](std::complex<double>* block_of, Index first, Index count, Index stride) {
                            std::complex<double>* twisted = block_of + block * stride;
                            const auto turn = [&](auto job) {
                                for (Index c = 0; c < count; ++c)
                                    job(Eigen::Map<Eigen::ArrayXcd>(block_of + c * stride, rows),
                                        Eigen::Map<Eigen::ArrayXcd>(twisted + c * stride, rows));
                            };
                            if (skew.size() > 0) turn([&](auto column, auto other) { other = column * twist_y_; });
                            multiplied(block_of, even, first, count, stride, false);
                            if (skew.size() == 0) return;
                            multiplied(twisted, skew, first, count, stride, true);
                            turn([&](auto column, auto other) { column += other * twist_y_.conjugate(); });
                        });
        backward(skew_x, [&](Index j, const double* row) {
            if (skew_x)
                u.segment(j * n, n) += Eigen::Map<const Eigen::VectorXd>(row, n);
            else
                u.segment(j * n, n) = Eigen::Map<const Eigen::VectorXd>(row, n);
        });
    }
    return u;
}

} // namespace rough
