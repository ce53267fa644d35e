#pragma once

#include "domain/numerics/fourier.hpp"

#ifdef RUGOSA_KISSFFT
#include <kissfft/kissfft.hh>
#else
#include <fftw3.h>
#endif
#include <map>
#include <mutex>

namespace rough {

/// The library of Fourier transforms in one precision: FFTW, or kissfft with -DRUGOSA_FFT=kissfft. Transforms
/// are unnormalised. Plans transform `count` arrays of one shape, and back, and are never freed. An array of
/// one row has one dimension. Complex arrays begin `apart` numbers after each other and are transformed in
/// place. Real arrays follow each other without gaps. Their transforms have rows of columns/2 + 1 numbers and
/// begin `apart` numbers after each other. Planning is not thread-safe; executing is.
template <typename Real>
struct FftLibrary;

/// A transform and its inverse.
template <typename Real>
struct PlanPair {
    typename FftLibrary<Real>::Plan forward;  ///< from numbers to waves
    typename FftLibrary<Real>::Plan backward; ///< from waves to numbers
};

#ifndef RUGOSA_KISSFFT

#define RUGOSA_FFTW(Real, prefix)                                                                            \
    template <>                                                                                              \
    struct FftLibrary<Real> {                                                                                \
        using Complex = std::complex<Real>;                                                                  \
        using Plan = prefix##_plan;                                                                          \
        static prefix##_complex* as_fftw(Complex* numbers) {                                                 \
            return reinterpret_cast<prefix##_complex*>(numbers);                                             \
        }                                                                                                    \
        static PlanPair<Real> plans(bool of_real, Extent shape, Index count, Index apart) {                  \
            AlignedBuffer<Real> real(of_real ? count* shape.nodes() : 1);                                    \
            AlignedBuffer<Complex> numbers(count* apart);                                                    \
            auto* const wave = as_fftw(numbers.data());                                                      \
            const int n[] = {static_cast<int>(shape.rows), static_cast<int>(shape.columns)},                 \
                      rank = shape.rows == 1 ? 1 : 2, nodes = n[0] * n[1], many = static_cast<int>(count),   \
                      gap = static_cast<int>(apart);                                                         \
            const int* const sides = n + 2 - rank;                                                           \
            if (of_real)                                                                                     \
                return {prefix##_plan_many_dft_r2c(rank, sides, many, real.data(), nullptr, 1, nodes, wave,  \
                                                   nullptr, 1, gap, FFTW_ESTIMATE),                          \
                        prefix##_plan_many_dft_c2r(rank, sides, many, wave, nullptr, 1, gap, real.data(),    \
                                                   nullptr, 1, nodes, FFTW_ESTIMATE)};                       \
            const auto plan = [&](int sign) {                                                                \
                return prefix##_plan_many_dft(rank, sides, many, wave, nullptr, 1, gap, wave, nullptr, 1,    \
                                              gap, sign, FFTW_ESTIMATE);                                     \
            };                                                                                               \
            return {plan(FFTW_FORWARD), plan(FFTW_BACKWARD)};                                                \
        }                                                                                                    \
        static void execute(Plan plan, Complex* in, Complex* out) {                                          \
            prefix##_execute_dft(plan, as_fftw(in), as_fftw(out));                                           \
        }                                                                                                    \
        static void execute(Plan plan, Real* in, Complex* out) {                                             \
            prefix##_execute_dft_r2c(plan, in, as_fftw(out));                                                \
        }                                                                                                    \
        static void execute(Plan plan, Complex* in, Real* out) {                                             \
            prefix##_execute_dft_c2r(plan, as_fftw(in), out);                                                \
        }                                                                                                    \
    }
/// @cond
RUGOSA_FFTW(double, fftw);
RUGOSA_FFTW(float, fftwf);
/// @endcond
#undef RUGOSA_FFTW

#else

template <typename Real>
struct FftLibrary {
    using Complex = std::complex<Real>;
    struct Transform {
        std::size_t rows, columns, count, apart;
        kissfft<Real> along_row, along_column;

        Transform(Extent shape, Index number, Index gap, bool inverse)
            : rows(static_cast<std::size_t>(shape.rows)), columns(static_cast<std::size_t>(shape.columns)),
              count(static_cast<std::size_t>(number)), apart(static_cast<std::size_t>(gap)),
              along_row(columns, inverse), along_column(rows, inverse) {}
        /// Transforms rows of `width` numbers along the columns.
        void columns_of(Complex* numbers, std::size_t width) const {
            std::vector<Complex> column(rows);
            for (std::size_t i = 0; i < width && rows > 1; ++i) {
                along_column.transform(numbers + i, column.data(), 0, 1, width);
                for (std::size_t j = 0; j < rows; ++j)
                    numbers[j * width + i] = column[j];
            }
        }
    };
    using Plan = const Transform*;

    static PlanPair<Real> plans(bool, Extent shape, Index count, Index apart) {
        return {new Transform(shape, count, apart, false), new Transform(shape, count, apart, true)};
    }
    /// Transforms real or complex numbers.
    template <class Number>
    static void execute(Plan plan, Number* in, Complex* out) {
        const bool of_real = std::is_same_v<Number, Real>;
        const std::size_t n = plan->columns, width = of_real ? n / 2 + 1 : n;
        std::vector<Complex> row(n), transformed(n);
        for (std::size_t k = 0; k < plan->count; ++k, out += plan->apart) {
            for (std::size_t j = 0; j < plan->rows; ++j) {
                std::copy_n(in + j * n, n, row.begin());
                plan->along_row.transform(row.data(), transformed.data());
                std::copy_n(transformed.begin(), width, out + j * width);
            }
            plan->columns_of(out, width);
            in += of_real ? n * plan->rows : plan->apart;
        }
    }
    static void execute(Plan plan, Complex* in, Real* out) {
        const std::size_t n = plan->columns, half = n / 2 + 1;
        std::vector<Complex> row(n), transformed(n);
        for (std::size_t k = 0; k < plan->count; ++k, in += plan->apart) {
            plan->columns_of(in, half);
            for (std::size_t j = 0; j < plan->rows; ++j, out += n) {
                for (std::size_t i = 0; i < n; ++i)
                    row[i] = i < half ? in[j * half + i] : std::conj(in[j * half + n - i]);
                plan->along_row.transform(row.data(), transformed.data());
                std::ranges::transform(transformed, out, [](const Complex& number) { return number.real(); });
            }
        }
    }
};

#endif

inline std::mutex planner; ///< planning is not thread-safe; executing a plan on new arrays is

/// The plans of `count` real or complex transforms of a shape (FftLibrary), made once.
template <typename Real>
PlanPair<Real> plans(bool of_real, Extent shape, Index count, Index apart) {
    static std::map<std::array<Index, 5>, PlanPair<Real>> all;
    const std::array<Index, 5> key{of_real, shape.columns, shape.rows, count, apart};
    const std::lock_guard guard(planner);
    const auto known = all.find(key);
    return known != all.end() ? known->second
                              : all[key] = FftLibrary<Real>::plans(of_real, shape, count, apart);
}

} // namespace rough
