#include "ga/variation/sample.hpp"

#include <boost/random/sobol.hpp>

namespace ga {
namespace {

/// A 64-bit word as a number in [0, 1).
double share_of(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

} // namespace

std::vector<Point> sobol_points(std::size_t n, std::size_t dimensions, Stream& stream) {
    constexpr std::size_t max = boost::random::default_sobol_table::max_dimension;
    if (dimensions > max)
        throw UsageError("sample sobol: " + std::to_string(dimensions) + " genes exceed " + std::to_string(max) +
                         "; use latin");
    std::vector<Point> points(n, Point(dimensions));
    if (dimensions == 0) return points;
    std::vector<std::uint64_t> shift(dimensions);
    std::ranges::generate(shift, std::ref(stream));
    boost::random::sobol sequence(dimensions);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < dimensions; ++k) // Boost omits the first point, 0 (Owen 2020: do not)
            points[i][k] = share_of((i > 0 ? sequence() : 0) ^ shift[k]);
    return points;
}

std::vector<Point> latin_points(std::size_t n, std::size_t dimensions, Stream& stream) {
    std::vector<Point> points(n, Point(dimensions));
    for (std::size_t k = 0; k < dimensions; ++k) {
        const Permutation strata = Permutation::random(n, stream);
        for (std::size_t i = 0; i < n; ++i)
            points[i][k] = (strata.order[i] + share_of(stream())) / static_cast<double>(n);
    }
    return points;
}

} // namespace ga
