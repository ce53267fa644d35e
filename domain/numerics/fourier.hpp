#pragma once

#include "domain/numerics/aligned.hpp"

#include <fftw3.h>

#include <complex>
#include <type_traits>
#include <vector>

namespace rough {

/// Real transforms of one length, planned once (FFTW_ESTIMATE, under a lock) and safe to execute from any
/// thread.
struct FourierPlan {
    fftw_plan forward;  ///< real to half-complex, unnormalised
    fftw_plan backward; ///< its inverse, times the length
};
/// The plan for real transforms of `length` numbers.
FourierPlan fourier_plan(Index length);
/// The plan for real transforms of an area's rows x columns numbers; the half-complex rows are columns/2 + 1
/// long. A single row is a line.
FourierPlan fourier_plan(Extent shape);
/// The same for complex transforms in place.
FourierPlan complex_fourier_plan(Extent shape);

/// Whether no prime factor is above 13: with a large one transforms take up to ten times as long.
bool is_good_fourier_length(Index length);

/// Smallest even 2^a 3^b 5^c that is no smaller than `length`.
Index fast_fourier_length(Index length);

/// FFTW's plan in one precision.
template <typename Real>
using Plan = std::conditional_t<std::is_same_v<Real, float>, fftwf_plan, fftw_plan>;

/// Transforms of rows, then of columns: all rows at once, real to half-complex and back, and some columns of
/// what that gives, laid one after another; of a line there are none. Unnormalised, as fourier_plan's.
template <typename Real>
struct RowColumnPlan {
    Plan<Real> rows_forward;     ///< real to half-complex
    Plan<Real> rows_backward;    ///< its inverse, times the length
    Plan<Real> columns_forward;  ///< complex, in place
    Plan<Real> columns_backward; ///< its inverse, times the length
};

/// u = T p for a symmetric circulant (its eigenvalues given) or Toeplitz matrix (its first column given,
/// padded with zeros), by FFT in double or single precision; on an area circulant or Toeplitz along both axes
/// and symmetric in each: there columns are transformed, multiplied and transformed back a few at a time,
/// while they are in the cache, and rows of zeros not at all. One object serves one thread at a time.
template <typename Real>
class BasicFourierOperator {
  public:
    /// N x N symmetric Toeplitz from its first column of N entries.
    static BasicFourierOperator toeplitz(const Eigen::VectorXd& first_column) {
        return toeplitz(first_column, {first_column.size()});
    }
    /// The same of an area.
    static BasicFourierOperator toeplitz(const Eigen::VectorXd& first_column, Extent shape);
    /// eigenvalues S_k, k = 0..N/2, of an N x N symmetric circulant
    static BasicFourierOperator circulant(Index nodes, const Eigen::VectorXd& eigenvalues) {
        return circulant(Extent{nodes}, eigenvalues);
    }
    /// Of an area: N_y rows of N_x/2 + 1 eigenvalues.
    static BasicFourierOperator circulant(Extent shape, const Eigen::VectorXd& eigenvalues);

    Index nodes() const { return shape_.nodes(); } ///< N
    /// Write p (N entries) here, then call apply().
    Real* input() { return real_.data(); }
    /// Returns u (N entries), valid until the next write to input().
    const Real* apply();
    /// The last u again, as long as input() was not written to.
    const Real* applied() const { return real_.data(); }

  private:
    BasicFourierOperator(Extent shape, Extent padded);
    void spread();           ///< from N entries to the padded rows
    void gather();           ///< back
    void multiply_columns(); ///< along y, by the eigenvalues
    Extent shape_, padded_;
    Index half_; ///< numbers of a half-complex row
    RowColumnPlan<Real> plan_;
    AlignedBuffer<Real> real_, spectrum_; ///< eigenvalues column after column
    AlignedBuffer<std::complex<Real>> transform_, columns_;
};
/// In double precision.
using FourierOperator = BasicFourierOperator<double>;
/// In single precision, at about half the time: for corrections, of which a part in a million does not
/// matter.
using SingleFourierOperator = BasicFourierOperator<float>;

/// u = T p for a symmetric Toeplitz matrix without padding: T is half the sum of a circulant, c_j + c_(N-j),
/// and a skew-circulant, c_j - c_(N-j); on an area so along both axes, a quarter of the sum of four. Shares
/// no transform and no spectrum with FourierOperator.
class SplitOperator {
  public:
    /// From the first column of N entries; a line, if no shape is given.
    explicit SplitOperator(const Eigen::VectorXd& first_column, Extent shape = {});
    /// u = T p; p and u have N entries.
    Eigen::VectorXd apply(const Eigen::VectorXd& p);

  private:
    /// One of the sum: skew-circulant along x, along y, or not.
    struct Part {
        bool skew_x, skew_y;
        Eigen::ArrayXd eigenvalues; ///< over 2 N, of an area over 4 N; column after column
    };
    void twist(const Part& part, bool back);
    void transform_rows(fftw_plan plan);
    /// Transforms along y, a few columns at a time; visits each with its number, and transforms it back.
    template <class Visit>
    void each_column_block(Visit visit);

    Extent shape_;
    RowColumnPlan<double> plan_;
    AlignedBuffer<fftw_complex> work_;
    AlignedBuffer<std::complex<double>> columns_;
    Eigen::ArrayXcd twist_x_, twist_y_; ///< exp(-i pi j/N)
    std::vector<Part> parts_;           ///< those that are not zero
};

} // namespace rough
