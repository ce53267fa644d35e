#pragma once

#include "domain/numerics/grid.hpp"

#ifdef RUGOSA_KISSFFT
#include <kissfft/kissfft.hh>
#else
#include <fftw3.h>
#endif

#include <algorithm>
#include <complex>
#include <vector>

namespace rough {

/// The library of Fourier transforms in one precision: FFTW, or kissfft with -DRUGOSA_FFT=kissfft. Transforms
/// are unnormalised. A plan transforms `count` arrays of one shape and is never freed. An array of one row
/// has one dimension. Complex arrays begin `apart` numbers after each other and are transformed in place.
/// Real arrays follow each other without gaps. Their transforms have rows of columns/2 + 1 numbers and begin
/// `apart` numbers after each other. Planning is not thread-safe; executing is.
template <typename Real>
struct FftLibrary;

#ifndef RUGOSA_KISSFFT

#define RUGOSA_FFTW(Real, prefix)                                                                            \
    template <>                                                                                              \
    struct FftLibrary<Real> {                                                                                \
        using Complex = std::complex<Real>;                                                                  \
        using Plan = prefix##_plan;                                                                          \
        static prefix##_complex* as_fftw(Complex* numbers) {                                                 \
            return reinterpret_cast<prefix##_complex*>(numbers);                                             \
        }                                                                                                    \
        struct Size {                                                                                        \
            int n[2], rank;                                                                                  \
            explicit Size(Extent shape)                                                                      \
                : n{static_cast<int>(shape.rows), static_cast<int>(shape.columns)},                          \
                  rank(shape.rows == 1 ? 1 : 2) {}                                                           \
            const int* sides() const { return n + 2 - rank; }                                                \
            int real() const { return n[0] * n[1]; }                                                         \
        };                                                                                                   \
        static Plan complex_plan(Extent shape, Index count, Index apart, Complex* at, bool inverse) {        \
            const Size size(shape);                                                                          \
            const int gap = static_cast<int>(apart);                                                         \
            return prefix##_plan_many_dft(size.rank, size.sides(), static_cast<int>(count), as_fftw(at),     \
                                          nullptr, 1, gap, as_fftw(at), nullptr, 1, gap,                     \
                                          inverse ? FFTW_BACKWARD : FFTW_FORWARD, FFTW_ESTIMATE);            \
        }                                                                                                    \
        static Plan forward_plan(Extent shape, Index count, Index apart, Real* in, Complex* out) {           \
            const Size size(shape);                                                                          \
            return prefix##_plan_many_dft_r2c(size.rank, size.sides(), static_cast<int>(count), in, nullptr, \
                                              1, size.real(), as_fftw(out), nullptr, 1,                      \
                                              static_cast<int>(apart), FFTW_ESTIMATE);                       \
        }                                                                                                    \
        static Plan backward_plan(Extent shape, Index count, Index apart, Complex* in, Real* out) {          \
            const Size size(shape);                                                                          \
            return prefix##_plan_many_dft_c2r(size.rank, size.sides(), static_cast<int>(count), as_fftw(in), \
                                              nullptr, 1, static_cast<int>(apart), out, nullptr, 1,          \
                                              size.real(), FFTW_ESTIMATE);                                   \
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
        std::size_t half() const { return columns / 2 + 1; }
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

    static Plan complex_plan(Extent shape, Index count, Index apart, Complex*, bool inverse) {
        return new Transform(shape, count, apart, inverse);
    }
    static Plan forward_plan(Extent shape, Index count, Index apart, Real*, Complex*) {
        return new Transform(shape, count, apart, false);
    }
    static Plan backward_plan(Extent shape, Index count, Index apart, Complex*, Real*) {
        return new Transform(shape, count, apart, true);
    }
    static void execute(Plan plan, Complex* in, Complex* out) {
        std::vector<Complex> row(plan->columns);
        for (std::size_t k = 0; k < plan->count; ++k, in += plan->apart, out += plan->apart) {
            for (std::size_t j = 0; j < plan->rows; ++j) {
                plan->along_row.transform(in + j * plan->columns, row.data());
                std::ranges::copy(row, out + j * plan->columns);
            }
            plan->columns_of(out, plan->columns);
        }
    }
    static void execute(Plan plan, Real* in, Complex* out) {
        const std::size_t half = plan->half();
        std::vector<Complex> row(plan->columns), transformed(plan->columns);
        for (std::size_t k = 0; k < plan->count; ++k, out += plan->apart) {
            for (std::size_t j = 0; j < plan->rows; ++j, in += plan->columns) {
                std::copy_n(in, plan->columns, row.begin());
                plan->along_row.transform(row.data(), transformed.data());
                std::copy_n(transformed.begin(), half, out + j * half);
            }
            plan->columns_of(out, half);
        }
    }
    static void execute(Plan plan, Complex* in, Real* out) {
        const std::size_t half = plan->half(), n = plan->columns;
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

} // namespace rough
