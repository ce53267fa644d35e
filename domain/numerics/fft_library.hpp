#pragma once

#include "domain/numerics/fourier.hpp"

#include <fftw3.h>

#include <map>
#include <mutex>

namespace rough {

/// FFTW in one precision. Transforms are unnormalised. Plans transform `count` arrays of one shape, and back, and are
/// never freed. An array of one row has one dimension. Complex arrays begin `apart` numbers after each other and are
/// transformed in place. Real arrays follow each other without gaps. Their transforms have rows of columns/2 + 1
/// numbers and begin `apart` numbers after each other. Planning is not thread-safe; executing is.
template <typename Real>
struct FftLibrary;

/// A transform and its inverse.
template <typename Real>
struct PlanPair {
    typename FftLibrary<Real>::Plan forward;  ///< from numbers to waves
    typename FftLibrary<Real>::Plan backward; ///< from waves to numbers
};

#define RUGOSA_FFTW(Real, prefix)                                                                                      \
    template <>                                                                                                        \
    struct FftLibrary<Real> {                                                                                          \
        using Complex = std::complex<Real>;                                                                            \
        using Plan = prefix##_plan;                                                                                    \
        static prefix##_complex* as_fftw(Complex* numbers) { return reinterpret_cast<prefix##_complex*>(numbers); }    \
        static PlanPair<Real> plans(bool of_real, Extent shape, Index count, Index apart) {                            \
            AlignedBuffer<Real> real(of_real ? count* shape.nodes() : 1);                                              \
            AlignedBuffer<Complex> numbers(count* apart);                                                              \
            auto* const wave = as_fftw(numbers.data());                                                                \
            const int n[] = {static_cast<int>(shape.rows), static_cast<int>(shape.columns)},                           \
                      rank = shape.rows == 1 ? 1 : 2, nodes = n[0] * n[1], many = static_cast<int>(count),             \
                      gap = static_cast<int>(apart);                                                                   \
            const int* const sides = n + 2 - rank;                                                                     \
            if (of_real)                                                                                               \
                return {prefix##_plan_many_dft_r2c(rank, sides, many, real.data(), nullptr, 1, nodes, wave, nullptr,   \
                                                   1, gap, FFTW_ESTIMATE),                                             \
                        prefix##_plan_many_dft_c2r(rank, sides, many, wave, nullptr, 1, gap, real.data(), nullptr, 1,  \
                                                   nodes, FFTW_ESTIMATE)};                                             \
            const auto plan = [&](int sign) {                                                                          \
                return prefix##_plan_many_dft(rank, sides, many, wave, nullptr, 1, gap, wave, nullptr, 1, gap, sign,   \
                                              FFTW_ESTIMATE);                                                          \
            };                                                                                                         \
            return {plan(FFTW_FORWARD), plan(FFTW_BACKWARD)};                                                          \
        }                                                                                                              \
        static void execute(Plan plan, Complex* in, Complex* out) {                                                    \
            prefix##_execute_dft(plan, as_fftw(in), as_fftw(out));                                                     \
        }                                                                                                              \
        static void execute(Plan plan, Real* in, Complex* out) { prefix##_execute_dft_r2c(plan, in, as_fftw(out)); }   \
        static void execute(Plan plan, Complex* in, Real* out) { prefix##_execute_dft_c2r(plan, as_fftw(in), out); }   \
    }
/// @cond
RUGOSA_FFTW(double, fftw);
RUGOSA_FFTW(float, fftwf);
/// @endcond
#undef RUGOSA_FFTW

inline std::mutex planner; ///< planning is not thread-safe; executing a plan on new arrays is

/// The plans of `count` real or complex transforms of a shape (FftLibrary), made once.
template <typename Real>
PlanPair<Real> plans(bool of_real, Extent shape, Index count, Index apart) {
    static std::map<std::array<Index, 5>, PlanPair<Real>> all;
    const std::array<Index, 5> key{of_real, shape.columns, shape.rows, count, apart};
    const std::lock_guard guard(planner);
    const auto known = all.find(key);
    return known != all.end() ? known->second : all[key] = FftLibrary<Real>::plans(of_real, shape, count, apart);
}

} // namespace rough
