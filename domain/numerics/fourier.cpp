#include "domain/numerics/fourier.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <numbers>

namespace rough {

namespace {

std::mutex& planner() {
    static std::mutex lock;
    return lock;
}

/// Plans are made under a lock: FFTW's planner is not thread-safe, its new-array execution is.
template <typename Key, typename Plan, typename Make>
Plan cached(const Key& key, std::map<Key, Plan>& plans, Make make) {
    const std::lock_guard guard(planner());
    const auto known = plans.find(key);
    return known != plans.end() ? known->second : plans.emplace(key, make()).first->second;
}

using ShapeKey = std::pair<Index, Index>;

/// Numbers of the half-complex transform.
Index half_of(Extent shape) { return (shape.columns / 2 + 1) * shape.rows; }

/// FFTW's sizes, rows first; a single row is a transform of one dimension.
struct Sizes {
    int n[2];
    int rank;
    explicit Sizes(Extent shape)
        : n{static_cast<int>(shape.rows), static_cast<int>(shape.columns)}, rank(shape.rows == 1 ? 1 : 2) {}
    const int* begin() const { return n + 2 - rank; }
};

/// FFTW's functions in one precision.
template <typename Real>
struct Call;
template <>
struct Call<double> {
    using Complex = fftw_complex;
    static constexpr auto plan_forward = fftw_plan_many_dft_r2c;
    static constexpr auto plan_backward = fftw_plan_many_dft_c2r;
    static constexpr auto plan_complex = fftw_plan_many_dft;
    static constexpr auto forward = fftw_execute_dft_r2c;
    static constexpr auto backward = fftw_execute_dft_c2r;
    static constexpr auto complex = fftw_execute_dft;
};
template <>
struct Call<float> {
    using Complex = fftwf_complex;
    static constexpr auto plan_forward = fftwf_plan_many_dft_r2c;
    static constexpr auto plan_backward = fftwf_plan_many_dft_c2r;
    static constexpr auto plan_complex = fftwf_plan_many_dft;
    static constexpr auto forward = fftwf_execute_dft_r2c;
    static constexpr auto backward = fftwf_execute_dft_c2r;
    static constexpr auto complex = fftwf_execute_dft;
};

template <typename Real>
typename Call<Real>::Complex* as_fftw(std::complex<Real>* numbers) {
    return reinterpret_cast<typename Call<Real>::Complex*>(numbers);
}

/// Columns that are transformed together: as many as fit the first cache, in whole lines of the rows.
constexpr Index column_block = 8;
/// From one of them to the next: a power of two would put them all in the same places of the cache.
constexpr Index column_stride(Index rows) { return rows + column_block; }

/// Of the first `rows` of padded rows; the others are zeros.
template <typename Real>
RowColumnPlan<Real> row_column_plan(Index rows, Extent padded) {
    static std::map<std::array<Index, 3>, RowColumnPlan<Real>> plans;
    return cached(std::array{rows, padded.columns, padded.rows}, plans, [&] {
        using Fftw = Call<Real>;
        const int n = static_cast<int>(padded.columns), m = static_cast<int>(padded.rows), half = n / 2 + 1,
                  many = static_cast<int>(rows), block = static_cast<int>(column_block),
                  stride = static_cast<int>(column_stride(padded.rows));
        AlignedBuffer<Real> real(rows * padded.columns);
        AlignedBuffer<std::complex<Real>> transform(rows * half),
            columns(column_block * column_stride(padded.rows));
        auto* wave = as_fftw(transform.data());
        auto* column = as_fftw(columns.data());
        const auto along_y = [&](int sign) {
            return m == 1 ? nullptr
                          : Fftw::plan_complex(1, &m, block, column, nullptr, 1, stride, column, nullptr, 1,
                                               stride, sign, FFTW_ESTIMATE);
        };
        return RowColumnPlan<Real>{Fftw::plan_forward(1, &n, many, real.data(), nullptr, 1, n, wave, nullptr,
                                                      1, half, FFTW_ESTIMATE),
                                   Fftw::plan_backward(1, &n, many, wave, nullptr, 1, half, real.data(),
                                                       nullptr, 1, n, FFTW_ESTIMATE),
                                   along_y(FFTW_FORWARD), along_y(FFTW_BACKWARD)};
    });
}

/// Complex transforms in place: of all rows, and of a block of columns laid one after another.
RowColumnPlan<double> complex_plan(Extent shape) {
    static std::map<ShapeKey, RowColumnPlan<double>> plans;
    return cached(ShapeKey(shape.columns, shape.rows), plans, [shape] {
        const int n = static_cast<int>(shape.columns), m = static_cast<int>(shape.rows),
                  block = static_cast<int>(column_block),
                  stride = static_cast<int>(column_stride(shape.rows));
        AlignedBuffer<fftw_complex> row(shape.columns), column(column_block * column_stride(shape.rows));
        const auto along_x = [&](int sign) {
            return fftw_plan_dft_1d(n, row.data(), row.data(), sign, FFTW_ESTIMATE);
        };
        const auto along_y = [&](int sign) {
            return m == 1 ? nullptr
                          : fftw_plan_many_dft(1, &m, block, column.data(), nullptr, 1, stride, column.data(),
                                               nullptr, 1, stride, sign, FFTW_ESTIMATE);
        };
        return RowColumnPlan<double>{along_x(FFTW_FORWARD), along_x(FFTW_BACKWARD), along_y(FFTW_FORWARD),
                                     along_y(FFTW_BACKWARD)};
    });
}

} // namespace

FourierPlan fourier_plan(Index length) { return fourier_plan(Extent{length}); }

FourierPlan fourier_plan(Extent shape) {
    static std::map<ShapeKey, FourierPlan> plans;
    return cached(ShapeKey(shape.columns, shape.rows), plans, [shape] {
        AlignedBuffer<double> real(shape.nodes());
        AlignedBuffer<fftw_complex> transform(half_of(shape));
        const Sizes n(shape);
        return FourierPlan{
            fftw_plan_dft_r2c(n.rank, n.begin(), real.data(), transform.data(), FFTW_ESTIMATE),
            fftw_plan_dft_c2r(n.rank, n.begin(), transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

FourierPlan complex_fourier_plan(Extent shape) {
    static std::map<ShapeKey, FourierPlan> plans;
    return cached(ShapeKey(shape.columns, shape.rows), plans, [shape] {
        AlignedBuffer<fftw_complex> work(shape.nodes());
        const Sizes n(shape);
        return FourierPlan{
            fftw_plan_dft(n.rank, n.begin(), work.data(), work.data(), FFTW_FORWARD, FFTW_ESTIMATE),
            fftw_plan_dft(n.rank, n.begin(), work.data(), work.data(), FFTW_BACKWARD, FFTW_ESTIMATE)};
    });
}

bool is_good_fourier_length(Index length) {
    for (const Index factor : {2, 3, 5, 7, 11, 13})
        while (length % factor == 0)
            length /= factor;
    return length == 1;
}

Index fast_fourier_length(Index length) {
    Index best = 2;
    while (best < length)
        best *= 2;
    for (Index five = 1; five < best; five *= 5)
        for (Index three = five; three < best; three *= 3) {
            Index candidate = 2 * three;
            while (candidate < length)
                candidate *= 2;
            best = std::min(best, candidate);
        }
    return best;
}

template <typename Real>
BasicFourierOperator<Real>::BasicFourierOperator(Extent shape, Extent padded)
    : shape_(shape), padded_(padded), half_(padded.columns / 2 + 1),
      plan_(row_column_plan<Real>(shape.rows, padded)), real_(shape.rows * padded.columns),
      spectrum_(half_ * padded.rows), transform_(half_ * shape.rows),
      columns_(padded.rows == 1 ? 0 : column_block * column_stride(padded.rows)) {}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::toeplitz(const Eigen::VectorXd& first_column,
                                                                Extent shape) {
    const auto padded = [](Index n) { return fast_fourier_length(std::max<Index>(2 * n - 1, 2)); };
    const Index columns = padded(shape.columns), rows = shape.rows == 1 ? 1 : padded(shape.rows);
    BasicFourierOperator op(shape, {columns, rows});
    AlignedBuffer<double> column(columns * rows);
    AlignedBuffer<fftw_complex> transform(op.half_ * rows);
    std::fill_n(column.data(), columns * rows, 0.0);
    for (Index j = 0; j < shape.rows; ++j)
        for (const Index row : {j, j == 0 ? 0 : rows - j}) {
            double* values = column.data() + row * columns;
            values[0] = first_column[j * shape.columns];
            for (Index i = 1; i < shape.columns; ++i)
                values[i] = values[columns - i] = first_column[j * shape.columns + i];
        }
    fftw_execute_dft_r2c(fourier_plan(op.padded_).forward, column.data(), transform.data());
    for (Index j = 0; j < rows; ++j)
        for (Index k = 0; k < op.half_; ++k)
            op.spectrum_[k * rows + j] =
                static_cast<Real>(transform[j * op.half_ + k][0] / static_cast<double>(op.padded_.nodes()));
    return op;
}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::circulant(Extent shape,
                                                                 const Eigen::VectorXd& eigenvalues) {
    BasicFourierOperator op(shape, shape);
    for (Index j = 0; j < shape.rows; ++j)
        for (Index k = 0; k < op.half_; ++k)
            op.spectrum_[k * shape.rows + j] =
                static_cast<Real>(eigenvalues[j * op.half_ + k] / static_cast<double>(shape.nodes()));
    return op;
}

template <typename Real>
void BasicFourierOperator<Real>::spread() {
    if (padded_.columns == shape_.columns)
        return;
    Real* real = real_.data();
    for (Index j = shape_.rows - 1; j >= 0; --j) {
        Real* row = real + j * padded_.columns;
        if (j > 0)
            std::copy_backward(real + j * shape_.columns, real + (j + 1) * shape_.columns,
                               row + shape_.columns);
        std::fill(row + shape_.columns, row + padded_.columns, Real(0));
    }
}

template <typename Real>
void BasicFourierOperator<Real>::gather() {
    Real* real = real_.data();
    if (padded_.columns != shape_.columns)
        for (Index j = 1; j < shape_.rows; ++j)
            std::copy_n(real + j * padded_.columns, shape_.columns, real + j * shape_.columns);
}

/// Entries of the half-complex transform by the operator's eigenvalues.
template <typename Real>
static void multiply(std::complex<Real>* numbers, const Real* eigenvalues, Index count) {
    for (Index k = 0; k < count; ++k)
        numbers[k] *= eigenvalues[k];
}

template <typename Real>
void BasicFourierOperator<Real>::multiply_columns() {
    const Index rows = padded_.rows, stride = column_stride(rows);
    std::complex<Real>* block = columns_.data();
    auto* planned = as_fftw(block);
    for (Index first = 0; first < half_; first += column_block) {
        const Index count = std::min(column_block, half_ - first);
        std::complex<Real>* corner = transform_.data() + first;
        for (Index j = 0; j < shape_.rows; ++j)
            for (Index c = 0; c < count; ++c)
                block[c * stride + j] = corner[j * half_ + c];
        for (Index c = 0; c < column_block; ++c)
            std::fill(block + c * stride + (c < count ? shape_.rows : 0), block + c * stride + rows,
                      std::complex<Real>());
        Call<Real>::complex(plan_.columns_forward, planned, planned);
        for (Index c = 0; c < count; ++c)
            multiply(block + c * stride, spectrum_.data() + (first + c) * rows, rows);
        Call<Real>::complex(plan_.columns_backward, planned, planned);
        for (Index j = 0; j < shape_.rows; ++j)
            for (Index c = 0; c < count; ++c)
                corner[j * half_ + c] = block[c * stride + j];
    }
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply() {
    Real* real = real_.data();
    spread();
    Call<Real>::forward(plan_.rows_forward, real, as_fftw(transform_.data()));
    if (padded_.rows == 1)
        multiply(transform_.data(), spectrum_.data(), half_);
    else
        multiply_columns();
    Call<Real>::backward(plan_.rows_backward, as_fftw(transform_.data()), real);
    gather();
    return real;
}

template class BasicFourierOperator<double>;
template class BasicFourierOperator<float>;

SplitOperator::SplitOperator(const Eigen::VectorXd& first_column, Extent shape)
    : shape_(shape == Extent{} ? Extent{first_column.size()} : shape), plan_(complex_plan(shape_)),
      work_(shape_.nodes()), columns_(shape_.rows == 1 ? 0 : column_block * column_stride(shape_.rows)),
      twist_x_(shape_.columns), twist_y_(shape_.rows) {
    for (auto* twist : {&twist_x_, &twist_y_})
        for (Index j = 0; j < twist->size(); ++j)
            (*twist)[j] = std::polar(1.0, -std::numbers::pi * static_cast<double>(j) /
                                              static_cast<double>(twist->size()));
    // c_0 may go to either part; of an area to the circulant one, so that a periodic one has no other.
    const bool line = shape_.rows == 1;
    const auto mirrored = [line](Index i, Index n, bool skew) -> std::pair<Index, double> {
        return i > 0 ? std::pair(n - i, skew ? -1.0 : 1.0) : std::pair(Index(0), line ? 0.0 : skew ? -1 : 1);
    };
    Eigen::Map<Eigen::ArrayXcd> work(reinterpret_cast<std::complex<double>*>(work_.data()), shape_.nodes());
    for (const bool skew_y : {false, true})
        for (const bool skew_x : {false, true}) {
            if (line && skew_y)
                continue;
            Part part{skew_x, skew_y, {}};
            for (Index j = 0; j < shape_.rows; ++j) {
                const auto [other_j, sign_j] =
                    line ? std::pair(Index(0), 0.0) : mirrored(j, shape_.rows, skew_y);
                const double* row = first_column.data() + j * shape_.columns;
                const double* other_row = first_column.data() + other_j * shape_.columns;
                for (Index i = 0; i < shape_.columns; ++i) {
                    const auto [other_i, sign_i] = mirrored(i, shape_.columns, skew_x);
                    double value = row[i] + sign_i * row[other_i];
                    if (sign_j != 0)
                        value += sign_j * (other_row[i] + sign_i * other_row[other_i]);
                    work[j * shape_.columns + i] = value;
                }
            }
            if ((work == 0).all())
                continue;
            twist(part, false);
            transform_rows(plan_.rows_forward);
            const double parts = (line ? 2 : 4) * static_cast<double>(shape_.nodes());
            part.eigenvalues.resize(shape_.nodes());
            each_column_block([&](std::complex<double>* column, Index first) {
                for (Index j = 0; j < shape_.rows; ++j)
                    part.eigenvalues[first * shape_.rows + j] = column[j].real() / parts;
            });
            parts_.push_back(std::move(part));
        }
}

void SplitOperator::transform_rows(fftw_plan plan) {
    for (Index j = 0; j < shape_.rows; ++j)
        fftw_execute_dft(plan, work_.data() + j * shape_.columns, work_.data() + j * shape_.columns);
}

template <class Visit>
void SplitOperator::each_column_block(Visit visit) {
    auto* work = reinterpret_cast<std::complex<double>*>(work_.data());
    if (shape_.rows == 1) {
        for (Index i = 0; i < shape_.columns; ++i)
            visit(work + i, i);
        return;
    }
    const Index rows = shape_.rows, stride = column_stride(rows);
    std::complex<double>* block = columns_.data();
    auto* planned = as_fftw(block);
    for (Index first = 0; first < shape_.columns; first += column_block) {
        const Index count = std::min(column_block, shape_.columns - first);
        std::fill(block + count * stride, block + column_block * stride, std::complex<double>());
        for (Index j = 0; j < rows; ++j)
            for (Index c = 0; c < count; ++c)
                block[c * stride + j] = work[j * shape_.columns + first + c];
        fftw_execute_dft(plan_.columns_forward, planned, planned);
        for (Index c = 0; c < count; ++c)
            visit(block + c * stride, first + c);
        fftw_execute_dft(plan_.columns_backward, planned, planned);
        for (Index j = 0; j < rows; ++j)
            for (Index c = 0; c < count; ++c)
                work[j * shape_.columns + first + c] = block[c * stride + j];
    }
}

void SplitOperator::twist(const Part& part, bool back) {
    Eigen::Map<Eigen::ArrayXXcd> work(reinterpret_cast<std::complex<double>*>(work_.data()), shape_.columns,
                                      shape_.rows);
    if (part.skew_x)
        for (Index j = 0; j < shape_.rows; ++j)
            work.col(j) *= back ? twist_x_.conjugate().eval() : twist_x_;
    if (part.skew_y)
        for (Index j = 0; j < shape_.rows; ++j)
            work.col(j) *= back ? std::conj(twist_y_[j]) : twist_y_[j];
}

Eigen::VectorXd SplitOperator::apply(const Eigen::VectorXd& p) {
    Eigen::Map<Eigen::ArrayXcd> work(reinterpret_cast<std::complex<double>*>(work_.data()), shape_.nodes());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(shape_.nodes());
    for (const Part& part : parts_) {
        work = p.array().cast<std::complex<double>>();
        twist(part, false);
        transform_rows(plan_.rows_forward);
        each_column_block([&](std::complex<double>* column, Index first) {
            multiply(column, part.eigenvalues.data() + first * shape_.rows, shape_.rows);
        });
        transform_rows(plan_.rows_backward);
        twist(part, true);
        u.array() += work.real();
    }
    return u;
}

} // namespace rough
