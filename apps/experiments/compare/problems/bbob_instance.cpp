#include "apps/experiments/compare/problems/bbob_instance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace app::bbob {

namespace {

constexpr double next_to_nothing = 1e-99; // in the place of 0, whose logarithm is none
constexpr long modulus = 2147483647;

} // namespace

std::vector<double> uniform(std::size_t n, long seed) {
    long state = std::max(1L, std::labs(seed));
    const auto step = [&] { return state = 16807 * state % modulus; };
    std::array<long, 32> table{};
    for (int i = 0; i < 8; ++i)
        step();
    for (std::size_t i = table.size(); i-- > 0;)
        table[i] = step();
    std::vector<double> numbers(n);
    long out = table[0];
    for (double& number : numbers) {
        long& slot = table[static_cast<std::size_t>(out / 67108865)];
        out = slot;
        slot = step();
        number = std::max(next_to_nothing, static_cast<double>(out) / static_cast<double>(modulus));
    }
    return numbers;
}

std::vector<double> gauss(std::size_t n, long seed) {
    const std::vector<double> u = uniform(2 * n, seed);
    std::vector<double> numbers(n);
    for (std::size_t i = 0; i < n; ++i) {
        numbers[i] = std::sqrt(-2 * std::log(u[i])) * std::cos(2 * std::numbers::pi * u[n + i]);
        if (numbers[i] == 0)
            numbers[i] = next_to_nothing;
    }
    return numbers;
}

Eigen::MatrixXd rotation(int dimension, long seed) {
    const std::vector<double> drawn = gauss(static_cast<std::size_t>(dimension * dimension), seed);
    Eigen::MatrixXd columns = Eigen::Map<const Eigen::MatrixXd>(drawn.data(), dimension, dimension);
    for (int i = 0; i < dimension; ++i) {
        for (int j = 0; j < i; ++j)
            columns.col(i) -= columns.col(i).dot(columns.col(j)) * columns.col(j);
        columns.col(i).normalize();
    }
    return columns;
}

Eigen::VectorXd place_of_optimum(int dimension, long seed) {
    const std::vector<double> u = uniform(static_cast<std::size_t>(dimension), seed);
    Eigen::VectorXd place(dimension);
    for (int i = 0; i < dimension; ++i) {
        place[i] = 8 * std::floor(1e4 * u[static_cast<std::size_t>(i)]) / 1e4 - 4;
        if (place[i] == 0)
            place[i] = -1e-5;
    }
    return place;
}

long seed_of(int function, int instance) {
    return (function == 4 ? 3 : function == 18 ? 17 : function) + 10000L * instance;
}

double value_of_optimum(int function, int instance) {
    const long seed = seed_of(function, instance);
    const double ratio = gauss(1, seed)[0] / gauss(1, seed + 1)[0];
    return std::clamp(std::floor(100 * 100 * ratio + 0.5) / 100, -1000.0, 1000.0);
}

} // namespace app::bbob
