#include "domain/problem/prices.hpp"

#include "domain/problem/verification.hpp"

#include <array>
#include <cmath>

namespace rough {
namespace {

/// Processor time of one curve of 20 load steps, ms, at numbers of nodes that grow by a constant factor. It
/// grows with a power of the number of load steps. Measured and smoothed on a busy machine. Maps of 16 x 16
/// and above 256 x 256 nodes are extrapolated. benchmark_prices measures them again. On another
/// machine it gave, relative to 1,024 nodes or 64 x 64, the same entries within a factor of 1.4. Exceptions
/// are 8,192 nodes (1.8 times more) and 16 x 16 (2.3 times less). Derivatives cost 1.1 to 1.9 curves.
struct CurveTimes {
    double nodes;                ///< number of nodes of the first entry
    double factor;               ///< factor of nodes from one entry to the next
    std::array<double, 8> times; ///< ms
    double exponent;             ///< of the number of load steps
};
constexpr CurveTimes of_lines{128, 2, {0.092, 0.21, 0.48, 1.02, 3.0, 12, 50, 165}, 0.75};
constexpr CurveTimes of_maps{256, 4, {1.1, 3.1, 60, 180, 760, 3300, 14000, 60000}, 0.6};

constexpr double gradient_price = 1.4; ///< price of a derivative of a curve in such curves

/// The time of a model's curve, ms. Between entries and beyond them it is a power of the number of nodes.
double curve_time(const Model& model) {
    const CurveTimes& of = model.grid.is_2d() ? of_maps : of_lines;
    const double place = std::log(static_cast<double>(model.grid.shape().nodes()) / of.nodes) / std::log(of.factor);
    const auto left =
        static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, static_cast<double>(of.times.size() - 2)));
    const double share = place - static_cast<double>(left);
    const double steps =
        model.loading.pressures.empty() ? model.loading.steps : static_cast<double>(model.loading.pressures.size());
    return of.times[left] * std::pow(of.times[left + 1] / of.times[left], share) * std::pow(steps / 20, of.exponent);
}

} // namespace

double relative_price(const Model& model, const Model& unit) { return curve_time(model) / curve_time(unit); }

std::vector<ga::LevelPrice> level_prices(const Model& model, const Model& unit, int points, std::size_t draws,
                                         bool smooth_area) {
    const double search = relative_price(model, unit), made = search * static_cast<double>(1 + draws);
    // The price on a grid `times` finer in n load steps.
    const auto in_steps = [&](Index times, int n) {
        Model finer = refined(unit, times);
        finer.loading.steps = n;
        return relative_price(finer, unit);
    };
    const int own = unit.loading.steps, about = 2 * points;
    const Index finest = verified_refinement(unit.grid).nodes;
    double verified = 0; // on the search grid, half way to the finest one, and there
    for (Index times = 1; times <= finest; times *= 2) verified += in_steps(times, own) + in_steps(times, about);
    const double evaluation = smooth_area ? gradient_price : 1; // smooth fractions come with the derivatives
    return {{"search", evaluation * search, gradient_price * search},
            {"verified", verified, gradient_price * in_steps(finest, own + 2 * about)},
            {"made", evaluation * made, gradient_price * made}};
}

} // namespace rough
