#pragma once

#include "ga/ga.hpp"
#include "ga/niches/descriptors.hpp"

#include <numbers>

/// n real genes in [lower, upper], without bounds where these are infinite; a function of them to minimise.
struct Function {
    using Genome = std::vector<double>;
    using Outcome = double;

    std::size_t n = 10;
    std::function<double(const Genome&)> f;
    double lower = -5, upper = 5;
    std::vector<ga::Objective<double>> list = {{"f", [](const double& y) { return y; }, true}};
    std::vector<ga::Descriptor<Genome>> features = {};

    double evaluate(const Genome& x) const { return f(x); }
    const std::vector<ga::Objective<double>>& objectives() const { return list; }
    std::vector<ga::Variable> bounds(const Genome&) const {
        std::vector<ga::Variable> box;
        for (std::size_t i = 0; i < n; ++i)
            box.push_back({i, lower, upper});
        return box;
    }
    Genome sample(ga::Stream& stream) const {
        Genome x(n);
        for (double& gene : x)
            gene = stream.uniform(-5, 5);
        return x;
    }
    const std::vector<ga::Descriptor<Genome>>& descriptors() const { return features; }
};

/// Functions with known minima of 0.
namespace functions {

inline double sphere(const std::vector<double>& x) {
    double sum = 0;
    for (const double each : x)
        sum += each * each;
    return sum;
}
/// Condition 1e6, rotated by mirroring at a diagonal plane.
inline double ellipsoid(const std::vector<double>& x) {
    double mean = 0, sum = 0;
    for (const double each : x)
        mean += each / static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += std::pow(1e6, static_cast<double>(i) / static_cast<double>(x.size() - 1)) *
               std::pow(x[i] - 2 * mean, 2);
    return sum;
}
inline double rosenbrock(const std::vector<double>& x) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
    return sum;
}
inline double rastrigin(const std::vector<double>& x) {
    double sum = 0;
    for (const double each : x)
        sum += each * each + 10 * (1 - std::cos(2 * std::numbers::pi * each));
    return sum;
}

} // namespace functions
