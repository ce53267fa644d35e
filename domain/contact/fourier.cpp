#include "domain/contact/fourier.hpp"

#include <algorithm>
#include <complex>
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
template <typename Make>
FourierPlan cached(Index length, std::map<Index, FourierPlan>& plans, Make make) {
    const std::lock_guard guard(planner());
    const auto known = plans.find(length);
    return known != plans.end() ? known->second : plans.emplace(length, make()).first->second;
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

FourierOperator::FourierOperator(Index nodes, Index length)
    : nodes_(nodes), length_(length), plan_(fourier_plan(length)), half_(length / 2 + 1), real_(length),
      spectrum_(half_), transform_(half_) {}

FourierOperator FourierOperator::toeplitz(const Eigen::VectorXd& first_column) {
    const Index n = first_column.size(), length = fast_fourier_length(std::max<Index>(2 * n - 1, 2));
    FourierOperator op(n, length);
    double* real = op.real_.data();
    std::fill_n(real, length, 0.0);
    real[0] = first_column[0];
    for (Index i = 1; i < n; ++i)
        real[i] = real[length - i] = first_column[i];
    fftw_execute_dft_r2c(op.plan_.forward, real, op.transform_.data());
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = op.transform_[k][0] / static_cast<double>(length);
    return op;
}

FourierOperator FourierOperator::circulant(Index nodes, const Eigen::VectorXd& eigenvalues) {
    FourierOperator op(nodes, nodes);
    for (Index k = 0; k < op.half_; ++k)
        op.spectrum_[k] = eigenvalues[k] / static_cast<double>(nodes);
    return op;
}

const double* FourierOperator::apply() {
    double* real = real_.data();
    std::fill(real + nodes_, real + length_, 0.0);
    fftw_execute_dft_r2c(plan_.forward, real, transform_.data());
    fftw_complex* transform = transform_.data();
    const double* spectrum = spectrum_.data();
    for (Index k = 0; k < half_; ++k) {
        transform[k][0] *= spectrum[k];
        transform[k][1] *= spectrum[k];
    }
    fftw_execute_dft_c2r(plan_.backward, transform, real);
    return real;
}

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
