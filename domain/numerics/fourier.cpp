#include "domain/numerics/fourier.hpp"

#include <algorithm>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>
#include <type_traits>

namespace rough {

namespace {

std::mutex& planner() {
    static std::mutex lock;
    return lock;
}

/// Plans are made under a lock: FFTW's planner is not thread-safe, its new-array execution is.
template <typename Plan, typename Make>
Plan cached(Extent shape, std::map<std::pair<Index, Index>, Plan>& plans, Make make) {
    const std::lock_guard guard(planner());
    const std::pair key(shape.columns, shape.rows);
    const auto known = plans.find(key);
    return known != plans.end() ? known->second : plans.emplace(key, make()).first->second;
}

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

using SinglePlan = Fftw<float>::Plan;

SinglePlan single_fourier_plan(Extent shape) {
    static std::map<std::pair<Index, Index>, SinglePlan> plans;
    return cached(shape, plans, [shape] {
        AlignedBuffer<float> real(shape.nodes());
        AlignedBuffer<fftwf_complex> transform(half_of(shape));
        const Sizes n(shape);
        return SinglePlan{
            fftwf_plan_dft_r2c(n.rank, n.begin(), real.data(), transform.data(), FFTW_ESTIMATE),
            fftwf_plan_dft_c2r(n.rank, n.begin(), transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

template <typename Real>
typename Fftw<Real>::Plan plan_of(Extent shape) {
    if constexpr (std::is_same_v<Real, float>)
        return single_fourier_plan(shape);
    else
        return fourier_plan(shape);
}

void execute_forward(const FourierPlan& plan, double* real, fftw_complex* transform) {
    fftw_execute_dft_r2c(plan.forward, real, transform);
}
void execute_forward(const SinglePlan& plan, float* real, fftwf_complex* transform) {
    fftwf_execute_dft_r2c(plan.forward, real, transform);
}
void execute_backward(const FourierPlan& plan, fftw_complex* transform, double* real) {
    fftw_execute_dft_c2r(plan.backward, transform, real);
}
void execute_backward(const SinglePlan& plan, fftwf_complex* transform, float* real) {
    fftwf_execute_dft_c2r(plan.backward, transform, real);
}

} // namespace

FourierPlan fourier_plan(Index length) { return fourier_plan(Extent{length}); }

FourierPlan fourier_plan(Extent shape) {
    static std::map<std::pair<Index, Index>, FourierPlan> plans;
    return cached(shape, plans, [shape] {
        AlignedBuffer<double> real(shape.nodes());
        AlignedBuffer<fftw_complex> transform(half_of(shape));
        const Sizes n(shape);
        return FourierPlan{
            fftw_plan_dft_r2c(n.rank, n.begin(), real.data(), transform.data(), FFTW_ESTIMATE),
            fftw_plan_dft_c2r(n.rank, n.begin(), transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

FourierPlan complex_fourier_plan(Extent shape) {
    static std::map<std::pair<Index, Index>, FourierPlan> plans;
    return cached(shape, plans, [shape] {
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
    : shape_(shape), padded_(padded), plan_(plan_of<Real>(padded)), half_(half_of(padded)),
      real_(padded.nodes()), spectrum_(half_), transform_(half_) {}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::toeplitz(const Eigen::VectorXd& first_column,
                                                                Extent shape) {
    const auto padded = [](Index n) { return fast_fourier_length(std::max<Index>(2 * n - 1, 2)); };
    const Index columns = padded(shape.columns), rows = shape.rows == 1 ? 1 : padded(shape.rows);
    BasicFourierOperator op(shape, {columns, rows});
    AlignedBuffer<double> column(columns * rows);
    AlignedBuffer<fftw_complex> transform(op.half_);
    std::fill_n(column.data(), columns * rows, 0.0);
    for (Index j = 0; j < shape.rows; ++j)
        for (const Index row : {j, j == 0 ? 0 : rows - j}) {
            double* values = column.data() + row * columns;
            values[0] = first_column[j * shape.columns];
            for (Index i = 1; i < shape.columns; ++i)
                values[i] = values[columns - i] = first_column[j * shape.columns + i];
        }
    execute_forward(fourier_plan(op.padded_), column.data(), transform.data());
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = static_cast<Real>(transform[k][0] / static_cast<double>(op.padded_.nodes()));
    return op;
}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::circulant(Extent shape,
                                                                 const Eigen::VectorXd& eigenvalues) {
    BasicFourierOperator op(shape, shape);
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = static_cast<Real>(eigenvalues[k] / static_cast<double>(shape.nodes()));
    return op;
}

template <typename Real>
void BasicFourierOperator<Real>::spread() {
    Real* real = real_.data();
    for (Index j = shape_.rows - 1; j >= 0; --j) {
        Real* row = real + j * padded_.columns;
        if (j > 0)
            std::copy_backward(real + j * shape_.columns, real + (j + 1) * shape_.columns,
                               row + shape_.columns);
        std::fill(row + shape_.columns, row + padded_.columns, Real(0));
    }
    std::fill(real + shape_.rows * padded_.columns, real + padded_.nodes(), Real(0));
}

template <typename Real>
void BasicFourierOperator<Real>::gather() {
    Real* real = real_.data();
    for (Index j = 1; j < shape_.rows; ++j)
        std::copy_n(real + j * padded_.columns, shape_.columns, real + j * shape_.columns);
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply() {
    Real* real = real_.data();
    spread();
    execute_forward(plan_, real, transform_.data());
    auto* transform = transform_.data();
    const Real* spectrum = spectrum_.data();
    for (Index k = 0; k < half_; ++k) {
        transform[k][0] *= spectrum[k];
        transform[k][1] *= spectrum[k];
    }
    execute_backward(plan_, transform, real);
    gather();
    return real;
}

template class BasicFourierOperator<double>;
template class BasicFourierOperator<float>;

SplitOperator::SplitOperator(const Eigen::VectorXd& first_column, Extent shape)
    : shape_(shape == Extent{} ? Extent{first_column.size()} : shape), plan_(complex_fourier_plan(shape_)),
      work_(shape_.nodes()), twist_x_(shape_.columns), twist_y_(shape_.rows) {
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
            fftw_execute_dft(plan_.forward, work_.data(), work_.data());
            part.eigenvalues = work.real() / ((line ? 2 : 4) * static_cast<double>(shape_.nodes()));
            parts_.push_back(std::move(part));
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
        fftw_execute_dft(plan_.forward, work_.data(), work_.data());
        work *= part.eigenvalues;
        fftw_execute_dft(plan_.backward, work_.data(), work_.data());
        twist(part, true);
        u.array() += work.real();
    }
    return u;
}

} // namespace rough
