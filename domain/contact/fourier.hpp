#pragma once

#include "domain/contact/aligned.hpp"

#include <fftw3.h>

namespace rough {

/// Real transforms of one length, planned once (FFTW_ESTIMATE, under a lock) and safe to execute from any
/// thread.
struct FourierPlan {
    fftw_plan forward;  ///< real to half-complex, unnormalised
    fftw_plan backward; ///< its inverse, times the length
};
/// The plan for real transforms of `length` numbers.
FourierPlan fourier_plan(Index length);
/// the same for complex transforms in place
FourierPlan complex_fourier_plan(Index length);

/// Smallest even 2^a 3^b 5^c that is no smaller than `length`.
Index fast_fourier_length(Index length);

/// u = T p for a symmetric circulant (its eigenvalues given) or Toeplitz matrix (its first column given,
/// padded with zeros), by FFT. One object serves one thread at a time.
class FourierOperator {
  public:
    /// N x N symmetric Toeplitz from its first column of N entries.
    static FourierOperator toeplitz(const Eigen::VectorXd& first_column);
    /// eigenvalues S_k, k = 0..N/2, of an N x N symmetric circulant
    static FourierOperator circulant(Index nodes, const Eigen::VectorXd& eigenvalues);

    Index nodes() const { return nodes_; } ///< N
    /// Write p (N entries) here, then call apply().
    double* input() { return real_.data(); }
    /// Returns u (N entries), valid until the next write to input().
    const double* apply();

  private:
    FourierOperator(Index nodes, Index length);
    Index nodes_, length_;
    FourierPlan plan_;
    Index half_; ///< length/2 + 1
    AlignedBuffer<double> real_, spectrum_;
    AlignedBuffer<fftw_complex> transform_;
};

/// u = T p for a symmetric Toeplitz matrix without padding: T is half the sum of a circulant, c_j + c_(N-j),
/// and a skew-circulant, c_j - c_(N-j). Shares no transform and no spectrum with FourierOperator.
class SplitOperator {
  public:
    /// From the first column of N entries.
    explicit SplitOperator(const Eigen::VectorXd& first_column);
    /// u = T p; p and u have N entries.
    Eigen::VectorXd apply(const Eigen::VectorXd& p);

  private:
    Index nodes_;
    FourierPlan plan_;
    AlignedBuffer<fftw_complex> work_;
    Eigen::ArrayXcd twist_;           ///< exp(-i pi j/N)
    Eigen::ArrayXd circulant_, skew_; ///< eigenvalues over 2 N
};

} // namespace rough
