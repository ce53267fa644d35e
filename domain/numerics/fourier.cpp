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
Plan cached(Index length, std::map<Index, Plan>& plans, Make make) {
    const std::lock_guard guard(planner());
    const auto known = plans.find(length);
    return known != plans.end() ? known->second : plans.emplace(length, make()).first->second;
}

using SinglePlan = Fftw<float>::Plan;

SinglePlan single_fourier_plan(Index length) {
    static std::map<Index, SinglePlan> plans;
    return cached(length, plans, [length] {
        AlignedBuffer<float> real(length);
        AlignedBuffer<fftwf_complex> transform(length / 2 + 1);
        return SinglePlan{
            fftwf_plan_dft_r2c_1d(static_cast<int>(length), real.data(), transform.data(), FFTW_ESTIMATE),
            fftwf_plan_dft_c2r_1d(static_cast<int>(length), transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

template <typename Real>
typename Fftw<Real>::Plan plan_of(Index length) {
    if constexpr (std::is_same_v<Real, float>)
        return single_fourier_plan(length);
    else
        return fourier_plan(length);
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

FourierPlan fourier_plan(Index length) {
    static std::map<Index, FourierPlan> plans;
    return cached(length, plans, [length] {
        AlignedBuffer<double> real(length);
        AlignedBuffer<fftw_complex> transform(length / 2 + 1);
        return FourierPlan{
            fftw_plan_dft_r2c_1d(static_cast<int>(length), real.data(), transform.data(), FFTW_ESTIMATE),
            fftw_plan_dft_c2r_1d(static_cast<int>(length), transform.data(), real.data(), FFTW_ESTIMATE)};
    });
}

FourierPlan complex_fourier_plan(Index length) {
    static std::map<Index, FourierPlan> plans;
    return cached(length, plans, [length] {
        AlignedBuffer<fftw_complex> work(length);
        const int n = static_cast<int>(length);
        return FourierPlan{fftw_plan_dft_1d(n, work.data(), work.data(), FFTW_FORWARD, FFTW_ESTIMATE),
                           fftw_plan_dft_1d(n, work.data(), work.data(), FFTW_BACKWARD, FFTW_ESTIMATE)};
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
BasicFourierOperator<Real>::BasicFourierOperator(Index nodes, Index length)
    : nodes_(nodes), length_(length), plan_(plan_of<Real>(length)), half_(length / 2 + 1), real_(length),
      spectrum_(half_), transform_(half_) {}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::toeplitz(const Eigen::VectorXd& first_column) {
    const Index n = first_column.size(), length = fast_fourier_length(std::max<Index>(2 * n - 1, 2));
    BasicFourierOperator op(n, length);
    AlignedBuffer<double> column(length);
    AlignedBuffer<fftw_complex> transform(op.half_);
    std::fill_n(column.data(), length, 0.0);
    column[0] = first_column[0];
    for (Index i = 1; i < n; ++i)
        column[i] = column[length - i] = first_column[i];
    execute_forward(fourier_plan(length), column.data(), transform.data());
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = static_cast<Real>(transform[k][0] / static_cast<double>(length));
    return op;
}

template <typename Real>
BasicFourierOperator<Real> BasicFourierOperator<Real>::circulant(Index nodes,
                                                                 const Eigen::VectorXd& eigenvalues) {
    BasicFourierOperator op(nodes, nodes);
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = static_cast<Real>(eigenvalues[k] / static_cast<double>(nodes));
    return op;
}

template <typename Real>
const Real* BasicFourierOperator<Real>::apply() {
    Real* real = real_.data();
    std::fill(real + nodes_, real + length_, Real(0));
    execute_forward(plan_, real, transform_.data());
    auto* transform = transform_.data();
    const Real* spectrum = spectrum_.data();
    for (Index k = 0; k < half_; ++k) {
        transform[k][0] *= spectrum[k];
        transform[k][1] *= spectrum[k];
    }
    execute_backward(plan_, transform, real);
    return real;
}

template class BasicFourierOperator<double>;
template class BasicFourierOperator<float>;

SplitOperator::SplitOperator(const Eigen::VectorXd& first_column)
    : nodes_(first_column.size()), plan_(complex_fourier_plan(nodes_)), work_(nodes_), twist_(nodes_),
      circulant_(nodes_), skew_(nodes_) {
    for (Index j = 0; j < nodes_; ++j)
        twist_[j] = std::polar(1.0, -std::numbers::pi * static_cast<double>(j) / static_cast<double>(nodes_));
    Eigen::Map<Eigen::ArrayXcd> work(reinterpret_cast<std::complex<double>*>(work_.data()), nodes_);
    for (const bool skew : {false, true}) {
        work[0] = first_column[0];
        for (Index j = 1; j < nodes_; ++j)
            work[j] = first_column[j] + (skew ? -first_column[nodes_ - j] : first_column[nodes_ - j]);
        if (skew)
            work *= twist_;
        fftw_execute_dft(plan_.forward, work_.data(), work_.data());
        (skew ? skew_ : circulant_) = work.real() / (2 * static_cast<double>(nodes_));
    }
}

Eigen::VectorXd SplitOperator::apply(const Eigen::VectorXd& p) {
    Eigen::Map<Eigen::ArrayXcd> work(reinterpret_cast<std::complex<double>*>(work_.data()), nodes_);
    work = p.array().cast<std::complex<double>>();
    fftw_execute_dft(plan_.forward, work_.data(), work_.data());
    work *= circulant_;
    fftw_execute_dft(plan_.backward, work_.data(), work_.data());
    Eigen::VectorXd u = work.real();
    work = p.array() * twist_;
    fftw_execute_dft(plan_.forward, work_.data(), work_.data());
    work *= skew_;
    fftw_execute_dft(plan_.backward, work_.data(), work_.data());
    u.array() += (work * twist_.conjugate()).real();
    return u;
}

} // namespace rough
