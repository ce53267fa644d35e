#pragma once

#include "domain/numerics/aligned.hpp"
#include "domain/numerics/team.hpp"

#include <array>
#include <complex>
#include <optional>

namespace rough {

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

/// A team, and memory for each of its threads.
template <typename Real>
class Workspace {
  public:
    /// `size` complex numbers for each thread.
    Workspace(Index size, Team& team) : team_(&team), size_((size + 7) / 8 * 8), numbers_(team.size() * size_) {}
    /// Runs job(first, count, memory) for ranges of `length` of n rows or columns.
    template <class Job>
    void each_range(Index n, Index length, const Job& job) {
        team_->each_range(
            n, [&](Index first, Index count, int worker) { job(first, count, numbers_.data() + worker * size_); },
            length);
    }

  private:
    Team* team_;
    Index size_;
    AlignedBuffer<std::complex<Real>> numbers_;
};

/// u = T p by FFT in double or single precision. T is a symmetric circulant, given by its eigenvalues, or a
/// symmetric Toeplitz matrix, given by its first column; on a map along both axes. The threads of a team
/// share blocks of rows and columns. One object serves one caller at a time, and the team must outlive it.
template <typename Real>
class BasicFourierOperator {
  public:
    /// N x N symmetric Toeplitz from its first column of N entries. If it is circulant, equal numbers have an
    /// eigenvalue. The mean of p is multiplied by it, because transforms lose small differences from a mean.
    static BasicFourierOperator toeplitz(const Eigen::VectorXd& first_column, Extent shape, Team& team = Team::alone());
    /// N x N symmetric circulant from its eigenvalues: N_y rows of S_k, k = 0..N_x/2.
    static BasicFourierOperator circulant(Extent shape, const Eigen::VectorXd& eigenvalues, Team& team = Team::alone());

    /// A copy of an operator of another precision.
    template <typename Other>
    explicit BasicFourierOperator(const BasicFourierOperator<Other>& other)
        : BasicFourierOperator(other.shape_, other.padded_, *other.team_) {
        of_mean_ = other.of_mean_;
        std::copy_n(other.spectrum_.data(), half_ * lines_, spectrum_.data());
    }

    Index nodes() const { return shape_.nodes(); } ///< N
    /// Write p (N entries) here, then call apply(). The first call allocates the memory.
    Real* input() {
        if (!real_) real_.emplace(shape_.rows == 1 ? padded_.columns : shape_.nodes());
        return real_->data();
    }
    /// Returns u (N entries), valid until the next write to input().
    const Real* apply() {
        apply(input(), input());
        return input();
    }
    /// Reads p from `from` and writes u to `to`, N entries each, which may be the same.
    void apply(const Real* from, Real* to);
    /// u for pressures at these nodes, 0 at all others.
    const Real* apply(const std::vector<int>& nodes, const Eigen::VectorXd& pressure);
    /// The last u again, as long as input() was not written to.
    const Real* applied() const { return real_->data(); }

  private:
    template <typename>
    friend class BasicFourierOperator;
    BasicFourierOperator(Extent shape, Extent padded, Team& team);
    Team* team_;
    Extent shape_, padded_;
    std::optional<double> of_mean_;           ///< eigenvalue of equal numbers
    Index half_, lines_;                      ///< numbers of a half-complex row; unmirrored eigenvalues per column
    std::optional<AlignedBuffer<Real>> real_; ///< input and output, if input() was called
    AlignedBuffer<Real> spectrum_;            ///< eigenvalues column after column
    Workspace<Real> work_;
};
/// In double precision.
using FourierOperator = BasicFourierOperator<double>;
/// In single precision, at about half the time, with relative errors of 1e-6.
using SingleFourierOperator = BasicFourierOperator<float>;

/// u = T p for a symmetric Toeplitz matrix without padding to twice its length. T is half the sum of a
/// circulant, c_j + c_(N-j), and a skew-circulant, c_j - c_(N-j). On a map it is a quarter of the sum of
/// four, along both axes. Half of each row's frequencies are computed. For a skew-circulant, a complex
/// transform of N/2 numbers (p_j - i p_(j+N/2)) exp(-i pi j/N) gives every second frequency. SplitOperator
/// shares neither transforms nor spectrum with FourierOperator.
class SplitOperator {
  public:
    /// From the first column of N entries.
    SplitOperator(const Eigen::VectorXd& first_column, Extent shape, Team& team = Team::alone());
    /// u = T p; p and u have N entries.
    Eigen::VectorXd apply(const Eigen::VectorXd& p);

  private:
    /// Transforms rows along x, which fill(j, row) writes.
    template <class Fill>
    void forward(bool skew_x, Index rows, Fill fill);
    /// Transforms them back; take(j, row) reads them.
    template <class Take>
    void backward(bool skew_x, Take take);

    Extent shape_;
    bool is_circulant_;          ///< without other parts
    Extent whole_;               ///< N of each axis; the next fast length if T is not circulant
    std::complex<double>* wave_; ///< transform, in memory of the caller's thread
    Workspace<double> work_;
    Eigen::ArrayXcd twist_x_, twist_y_; ///< exp(-i pi j/N)
    /// Eigenvalues of each part (circulant or skew along x, then along y), in columns of N_y/2 + 1. They are
    /// divided by the number of parts and the number of values. Empty for a missing part.
    std::array<std::array<Eigen::ArrayXd, 2>, 2> eigenvalues_;
};

} // namespace rough
