#pragma once

#include "domain/numerics/aligned.hpp"

#include <fftw3.h>

#include <complex>
#include <type_traits>
#include <vector>

namespace rough {

/// FFTW's plan in one precision.
template <typename Real>
using Plan = std::conditional_t<std::is_same_v<Real, float>, fftwf_plan, fftw_plan>;

/// A transform and its inverse, planned once (FFTW_ESTIMATE, under a lock) and safe to execute from any
/// thread.
template <typename Real>
struct PlanPair {
    Plan<Real> forward;  ///< unnormalised
    Plan<Real> backward; ///< its inverse, times the number of values
};
/// In double precision.
using FourierPlan = PlanPair<double>;
/// The plan for real to half-complex transforms of a grid's rows x columns numbers. The half-complex rows are
/// columns/2 + 1 long; one row is a line.
FourierPlan fourier_plan(Extent shape);
/// The plan for complex transforms of a grid in place.
FourierPlan complex_fourier_plan(Extent shape);

/// The half-complex transform of N_x x N_y numbers: N_x/2 + 1 x N_y, unnormalised.
Eigen::ArrayXXcd fourier_transform(const Eigen::ArrayXXd& numbers);
/// Its inverse times N_x N_y; `columns` is N_x.
Eigen::ArrayXXd inverse_fourier_transform(const Eigen::ArrayXXcd& half, Index columns);
/// The inverse of the complex transform times the number of values.
Eigen::ArrayXXcd inverse_complex_transform(const Eigen::ArrayXXcd& transform);

/// Whether no prime factor is above 13. With a larger one, transforms need up to ten times as long.
bool is_good_fourier_length(Index length);

/// Smallest even 2^a 3^b 5^c that is no smaller than `length`.
Index fast_fourier_length(Index length);

/// u = T p by FFT in double or single precision, for a symmetric circulant (from its eigenvalues) or Toeplitz
/// matrix (from its first column, padded with zeros). On an area the matrix is circulant or Toeplitz along
/// both axes and symmetric in each. There columns are transformed, multiplied and transformed back a few at a
/// time, while they are in the cache, and rows of zeros are skipped. One object serves one thread at a time.
template <typename Real>
class BasicFourierOperator {
  public:
    /// N x N symmetric Toeplitz from its first column of N entries.
    static BasicFourierOperator toeplitz(const Eigen::VectorXd& first_column, Extent shape);
    /// N x N symmetric circulant from its eigenvalues: N_y rows of S_k, k = 0..N_x/2.
    static BasicFourierOperator circulant(Extent shape, const Eigen::VectorXd& eigenvalues);

    Index nodes() const { return shape_.nodes(); } ///< N
    /// Write p (N entries) here, then call apply().
    Real* input() { return real_.data(); }
    /// Returns u (N entries), valid until the next write to input().
    const Real* apply();
    /// u for pressures at these nodes, 0 at all others.
    const Real* apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure);
    /// The last u again, as long as input() was not written to.
    const Real* applied() const { return real_.data(); }

  private:
    BasicFourierOperator(Extent shape, Extent padded);
    Extent shape_, padded_;
    Index half_; ///< numbers of a half-complex row
    PlanPair<Real> rows_;
    AlignedBuffer<Real> real_, spectrum_; ///< eigenvalues column after column
    AlignedBuffer<std::complex<Real>> transform_, columns_;
};
/// In double precision.
using FourierOperator = BasicFourierOperator<double>;
/// In single precision, at about half the time: for corrections, of which a part in a million does not
/// matter.
using SingleFourierOperator = BasicFourierOperator<float>;

/// u = T p for a symmetric Toeplitz matrix without padding. T is half the sum of a circulant, c_j + c_(N-j),
/// and a skew-circulant, c_j - c_(N-j); on an area a quarter of the sum of four, along both axes. It shares
/// neither transforms nor spectrum with FourierOperator.
class SplitOperator {
  public:
    /// From the first column of N entries.
    SplitOperator(const Eigen::VectorXd& first_column, Extent shape);
    /// u = T p; p and u have N entries.
    Eigen::VectorXd apply(const Eigen::VectorXd& p);

  private:
    /// One part of the sum: circulant or skew-circulant along x and along y.
    struct Part {
        bool skew_x, skew_y;
        Eigen::ArrayXd eigenvalues; ///< divided by 2 N, for an area by 4 N; column after column
    };
    void twist(const Part& part, bool back);
    /// Transforms work_, visits each column with its number, and transforms back.
    template <class Visit>
    void transform(const Part& part, Visit visit);

    Extent shape_;
    FourierPlan rows_;
    AlignedBuffer<std::complex<double>> work_, columns_;
    Eigen::ArrayXcd twist_x_, twist_y_; ///< exp(-i pi j/N)
    std::vector<Part> parts_;           ///< the parts that are not zero
};

} // namespace rough
