#pragma once

#include "ga/ga.hpp"

/// n real genes in [-1, 1]; fitness is minus the sum of squares, and `first` minus the square of the first
/// gene.
struct Vectors {
    using Genome = std::vector<double>;
    using Outcome = std::vector<double>;

    std::size_t n = 6;

    Outcome evaluate(const Genome& x) const { return x; }
    const std::vector<ga::Objective<Outcome>>& objectives() const {
        static const std::vector<ga::Objective<Outcome>> list = {
            {"squares",
             [](const Outcome& x) {
                 double sum = 0;
                 for (const double each : x)
                     sum += each * each;
                 return -sum;
             }},
            {"first", [](const Outcome& x) { return -x[0] * x[0]; }}};
        return list;
    }
    std::vector<ga::Variable> bounds(const Genome&) const {
        std::vector<ga::Variable> box;
        for (std::size_t i = 0; i < n; ++i)
            box.push_back({i, -1, 1});
        return box;
    }
    Genome sample(ga::Stream& stream) const {
        Genome x(n);
        for (double& gene : x)
            gene = stream.uniform(-1, 1);
        return x;
    }
};

/// Individuals whose fitness is given: genome {f} scored as f.
struct Given {
    using Genome = std::vector<double>;
    using Outcome = double;
    double evaluate(const Genome& g) const { return g[0]; }
    const std::vector<ga::Objective<double>>& objectives() const {
        static const std::vector<ga::Objective<double>> list = {
            {"value", [](const double& value) { return value; }}};
        return list;
    }
    static ga::Population<Genome> of(const std::vector<double>& values) {
        std::vector<Genome> genomes;
        for (const double value : values)
            genomes.push_back({value});
        return ga::population(genomes);
    }
};
