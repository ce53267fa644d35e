#include "domain/numerics/fourier.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <numbers>

namespace rough {

namespace {

std::mutex planner; ///< FFTW's planner is not thread-safe; executing a plan on new arrays is

template <typename Key, typename Plan, typename Make>
Plan cached(const Key& key, std::map<Key, Plan>& plans, Make make) {
    const std::lock_guard guard(planner);
    const auto known = plans.find(key);
    return known != plans.end() ? known->second : plans.emplace(key, make()).first->second;
}

using ShapeKey = std::pair<Index, Index>;

/// FFTW's functions in one precision, whose names begin with `prefix`.
template <typename Real>
struct Call;
#define RUGOSA_FFTW(Real, prefix)                                                                            \
    template <>                                                                                              \
    struct Call<Real> {                                                                                      \
        using Complex = prefix##_complex;                                                                    \
        static constexpr auto plan_forward = prefix##_plan_many_dft_r2c;                                     \
        static constexpr auto plan_backward = prefix##_plan_many_dft_c2r;                                    \
        static constexpr auto plan_complex = prefix##_plan_many_dft;                                         \
        static constexpr auto forward = prefix##_execute_dft_r2c;                                            \
        static constexpr auto backward = prefix##_execute_dft_c2r;                                           \
        static constexpr auto complex = prefix##_execute_dft;                                                \
    }
RUGOSA_FFTW(double, fftw);
RUGOSA_FFTW(float, fftwf);

template <typename Real>
typename Call<Real>::Complex* as_fftw(std::complex<Real>* numbers) {
    return reinterpret_cast<typename Call<Real>::Complex*>(numbers);
}

/// Columns that are transformed together: as many as fit the first cache, in whole lines of the rows.
constexpr Index column_block = 8;
/// From one of them to the next: a power of two would put them all in the same places of the cache.
constexpr Index column_stride(Index rows) { return rows + column_block; }

/// Plans of complex transforms of a block of columns, laid one after another; null if there is one row only.
template <typename Real>
PlanPair<Real> column_plans(Index rows) {
    static std::map<Index, PlanPair<Real>> plans;
    if (rows == 1)
        return {};
    return cached(rows, plans, [rows] {
        const int m = static_cast<int>(rows), block = static_cast<int>(column_block),
                  stride = static_cast<int>(column_stride(rows));
        AlignedBuffer<std::complex<Real>> columns(column_block * column_stride(rows));
        auto* column = as_fftw(columns.data());
        const auto along_y = [&](int sign) {
            return Call<Real>::plan_complex(1, &m, block, column, nullptr, 1, stride, column, nullptr, 1,
                                            stride, sign, FFTW_ESTIMATE);
        };
        return PlanPair<Real>{along_y(FFTW_FORWARD), along_y(FFTW_BACKWARD)};
    });
}

/// Plans of real transforms of all rows at once, each of `columns` numbers.
template <typename Real>
PlanPair<Real> row_plans(Index rows, Index columns) {
    static std::map<ShapeKey, PlanPair<Real>> plans;
    return cached(ShapeKey(columns, rows), plans, [&] {
        using Fftw = Call<Real>;
        const int n = static_cast<int>(columns), half = n / 2 + 1, many = static_cast<int>(rows);
        AlignedBuffer<Real> real(rows * columns);
        AlignedBuffer<std::complex<Real>> transform(rows * half);
        auto* wave = as_fftw(transform.data());
        return PlanPair<Real>{Fftw::plan_forward(1, &n, many, real.data(), nullptr, 1, n, wave, nullptr, 1,
                                                 half, FFTW_ESTIMATE),
                              Fftw::plan_backward(1, &n, many, wave, nullptr, 1, half, real.data(), nullptr,
                                                  1, n, FFTW_ESTIMATE)};
    });
}

} // namespace

FourierPlan fourier_plan(Extent shape) {
    static std::map<ShapeKey, FourierPlan> plans;
    return cached(ShapeKey(shape.columns, shape.rows), plans, [shape] {
        AlignedBuffer<double> real(shape.nodes());
        AlignedBuffer<fftw_complex> transform((shape.columns / 2 + 1) * shape.rows);
        const int n[] = {static_cast<int>(shape.rows), static_cast<int>(shape.columns)},
                  line = shape.rows == 1 ? 1 : 0; // a single row is a transform of one dimension
        return FourierPlan{
            fftw_plan_dft_r2c(2 - line, n + line, real.data(), transform.data(), FFTW_ESTIMATE),
            fftw_plan_dft_c2r(2 - line, n + line, transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

FourierPlan complex_fourier_plan(Extent shape) {
    static std::map<ShapeKey, FourierPlan> plans;
    return cached(ShapeKey(shape.columns, shape.rows), plans, [shape] {
        AlignedBuffer<fftw_complex> work(shape.nodes());
        const int n[] = {static_cast<int>(shape.rows), static_cast<int>(shape.columns)},
                  line = shape.rows == 1 ? 1 : 0;
        const auto plan = [&](int sign) {
            return fftw_plan_dft(2 - line, n + line, work.data(), work.data(), sign, FFTW_ESTIMATE);
        };
        return FourierPlan{plan(FFTW_FORWARD), plan(FFTW_BACKWARD)};
    });
}

Eigen::ArrayXXcd fourier_transform(const Eigen::ArrayXXd& numbers) {
    const Extent shape{numbers.rows(), numbers.cols()}, half{shape.columns / 2 + 1, shape.rows};
    AlignedBuffer<double> real(shape.nodes());
    AlignedBuffer<std::complex<double>> transform(half.nodes());
    std::copy_n(numbers.data(), shape.nodes(), real.data());
    fftw_execute_dft_r2c(fourier_plan(shape).forward, real.data(), as_fftw(transform.data()));
    return Eigen::ArrayXXcd::Map(transform.data(), half.columns, half.rows);
}

Eigen::ArrayXXd inverse_fourier_transform(const Eigen::ArrayXXcd& half, Index columns) {
    const Extent shape{columns, half.cols()};
    AlignedBuffer<double> real(shape.nodes());
    AlignedBuffer<std::complex<double>> transform(half.size());
    std::copy_n(half.data(), half.size(), transform.data());
    fftw_execute_dft_c2r(fourier_plan(shape).backward, as_fftw(transform.data()), real.data());
    return Eigen::ArrayXXd::Map(real.data(), shape.columns, shape.rows);
}

Eigen::ArrayXXcd inverse_complex_transform(const Eigen::ArrayXXcd& transform) {
    AlignedBuffer<std::complex<double>> work(transform.size());
    std::copy_n(transform.data(), transform.size(), work.data());
    fftw_execute_dft(complex_fourier_plan({transform.rows(), transform.cols()}).backward,
                     as_fftw(work.data()), as_fftw(work.data()));
    return Eigen::ArrayXXcd::Map(work.data(), transform.rows(), transform.cols());
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
      rows_(row_plans<Real>(shape.rows, padded.columns)), real_(shape.rows * padded.columns),
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

/// Entries of the half-complex transform by the operator's eigenvalues.
template <typename Real>
static void multiply(std::complex<Real>* numbers, const Real* eigenvalues, Index count) {
    for (Index k = 0; k < count; ++k)
        numbers[k] *= eigenvalues[k];
}

/// Transforms `shape` numbers along y, padded with zeros to `padded` rows: some columns at a time in `block`.
/// Calls visit(column, number) for each transformed column, then transforms it back.
template <typename Real, class Visit>
static void each_column(std::complex<Real>* numbers, Extent shape, Index padded, std::complex<Real>* block,
                        Visit visit) {
    const PlanPair<Real> plan = column_plans<Real>(padded);
    const Index stride = column_stride(padded);
    auto* planned = as_fftw(block);
    for (Index first = 0; first < shape.columns; first += column_block) {
        const Index count = std::min(column_block, shape.columns - first);
        std::complex<Real>* corner = numbers + first;
        for (Index j = 0; j < shape.rows; ++j)
            for (Index c = 0; c < count; ++c)
                block[c * stride + j] = corner[j * shape.columns + c];
        for (Index c = 0; c < column_block; ++c)
            std::fill(block + c * stride + (c < count ? shape.rows : 0), block + c * stride + padded,
                      std::complex<Real>());
        Call<Real>::complex(plan.forward, planned, planned);
        for (Index c = 0; c < count; ++c)
            visit(block + c * stride, first + c);
        Call<Real>::complex(plan.backward, planned, planned);
        for (Index j = 0; j < shape.rows; ++j)
            for (Index c = 0; c < count; ++c)
                corner[j * shape.columns + c] = block[c * stride + j];
    }
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply() {
    Real* real = real_.data();
    const bool pads = padded_.columns != shape_.columns;
    for (Index j = pads ? shape_.rows - 1 : -1; j >= 0; --j) { // from N entries to the padded rows
        Real* row = real + j * padded_.columns;
        if (j > 0)
            std::copy_backward(real + j * shape_.columns, real + (j + 1) * shape_.columns,
                               row + shape_.columns);
        std::fill(row + shape_.columns, row + padded_.columns, Real(0));
    }
    Call<Real>::forward(rows_.forward, real, as_fftw(transform_.data()));
    const Index rows = padded_.rows;
    if (rows == 1)
        multiply(transform_.data(), spectrum_.data(), half_);
    else
        each_column(transform_.data(), {half_, shape_.rows}, rows, columns_.data(),
                    [&](std::complex<Real>* column, Index k) {
                        multiply(column, spectrum_.data() + k * rows, rows);
                    });
    Call<Real>::backward(rows_.backward, as_fftw(transform_.data()), real);
    for (Index j = 1; pads && j < shape_.rows; ++j) // and back
        std::copy_n(real + j * padded_.columns, shape_.columns, real + j * shape_.columns);
    return real;
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply(const std::vector<int>& nodes, const Eigen::VectorXd& p) {
    std::fill_n(input(), this->nodes(), Real(0));
    for (std::size_t k = 0; k < nodes.size(); ++k)
        input()[nodes[k]] = static_cast<Real>(p[static_cast<Index>(k)]);
    return apply();
}

template class BasicFourierOperator<double>;
template class BasicFourierOperator<float>;

SplitOperator::SplitOperator(const Eigen::VectorXd& first_column, Extent shape)
    : shape_(shape), rows_(complex_fourier_plan({shape.columns})), work_(shape.nodes()),
      columns_(shape.rows == 1 ? 0 : column_block * column_stride(shape.rows)), twist_x_(shape.columns),
      twist_y_(shape.rows) {
    for (auto* twist : {&twist_x_, &twist_y_})
        for (Index j = 0; j < twist->size(); ++j)
            (*twist)[j] = std::polar(1.0, -std::numbers::pi * static_cast<double>(j) /
                                              static_cast<double>(twist->size()));
    // c_0 may go to either part; that of an area goes to the circulant one, so that a periodic area has no
    // other part.
    const bool line = shape_.rows == 1;
    const auto mirrored = [line](Index i, Index n, bool skew) -> std::pair<Index, double> {
        return i > 0 ? std::pair(n - i, skew ? -1.0 : 1.0) : std::pair(Index(0), line ? 0.0 : skew ? -1 : 1);
    };
    Eigen::Map<Eigen::ArrayXcd> work(work_.data(), shape_.nodes());
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
            part.eigenvalues.resize(shape_.nodes());
            const double parts = (line ? 2 : 4) * static_cast<double>(shape_.nodes());
            transform(part, [&](std::complex<double>* column, Index k) {
                for (Index j = 0; j < shape_.rows; ++j)
                    part.eigenvalues[k * shape_.rows + j] = column[j].real() / parts;
            });
            parts_.push_back(std::move(part));
        }
}

template <class Visit>
void SplitOperator::transform(const Part& part, Visit visit) {
    const auto transform_rows = [&](fftw_plan plan) {
        for (Index j = 0; j < shape_.rows; ++j) {
            fftw_complex* row = as_fftw(work_.data() + j * shape_.columns);
            fftw_execute_dft(plan, row, row);
        }
    };
    twist(part, false);
    transform_rows(rows_.forward);
    if (shape_.rows > 1)
        each_column(work_.data(), shape_, shape_.rows, columns_.data(), visit);
    else
        for (Index i = 0; i < shape_.columns; ++i)
            visit(work_.data() + i, i);
    transform_rows(rows_.backward);
    twist(part, true);
}

void SplitOperator::twist(const Part& part, bool back) {
    Eigen::Map<Eigen::ArrayXXcd> work(work_.data(), shape_.columns, shape_.rows);
    if (part.skew_x)
        for (Index j = 0; j < shape_.rows; ++j)
            work.col(j) *= back ? twist_x_.conjugate().eval() : twist_x_;
    if (part.skew_y)
        for (Index j = 0; j < shape_.rows; ++j)
            work.col(j) *= back ? std::conj(twist_y_[j]) : twist_y_[j];
}

Eigen::VectorXd SplitOperator::apply(const Eigen::VectorXd& p) {
    Eigen::Map<Eigen::ArrayXcd> work(work_.data(), shape_.nodes());
    Eigen::VectorXd u = Eigen::VectorXd::Zero(shape_.nodes());
    for (const Part& part : parts_) {
        work = p.array().cast<std::complex<double>>();
        transform(part, [&](std::complex<double>* column, Index k) {
            multiply(column, part.eigenvalues.data() + k * shape_.rows, shape_.rows);
        });
        u.array() += work.real();
    }
    return u;
}

} // namespace rough
