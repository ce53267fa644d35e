#include "domain/contact/fourier.hpp"

#include <algorithm>
#include <map>
#include <mutex>

namespace rough {

FourierPlan fourier_plan(Index length) {
    static std::mutex lock;
    static std::map<Index, FourierPlan> plans;
    const std::lock_guard guard(lock);
    const auto known = plans.find(length);
    if (known != plans.end())
        return known->second;
    AlignedBuffer<double> real(length);
    AlignedBuffer<fftw_complex> transform(length / 2 + 1);
    const FourierPlan plan{
        fftw_plan_dft_r2c_1d(static_cast<int>(length), real.data(), transform.data(), FFTW_ESTIMATE),
        fftw_plan_dft_c2r_1d(static_cast<int>(length), transform.data(), real.data(), FFTW_ESTIMATE)};
    return plans.emplace(length, plan).first->second;
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

} // namespace rough
