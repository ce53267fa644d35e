#pragma once

#include "ga/ga.hpp"
#include "ga/refinement/refinement.hpp"

#include <stdexcept>

/// A small problem with every optional member: fit y(x) = a exp(-b x) + c to five points that a = 2, b = 1.5,
/// c = 0.5 go through. Outcome: relative residuals. Objectives: `fit` = 1 - max|r|, `low` and `high` over the
/// first and last two.
struct CurveFit {
    using Genome = std::vector<double>;
    using Outcome = Eigen::VectorXd;

    static constexpr std::array<double, 5> x = {0, 0.5, 1, 2, 4};

    Eigen::VectorXd residuals(const Genome& g) const {
        Eigen::VectorXd r(5);
        for (int k = 0; k < 5; ++k)
            r[k] = model(g, x[static_cast<std::size_t>(k)]) /
                       model({2, 1.5, 0.5}, x[static_cast<std::size_t>(k)]) -
                   1;
        return r;
    }
    Outcome evaluate(const Genome& g) const {
        if (g[1] < -20)
            throw std::domain_error("rate under -20");
        return residuals(g);
    }
    const std::vector<ga::Objective<Outcome>>& objectives() const {
        static const std::vector<ga::Objective<Outcome>> list = {
            {"fit", [](const Outcome& r) { return 1 - r.cwiseAbs().maxCoeff(); }},
            {"low", [](const Outcome& r) { return 1 - r.head(2).cwiseAbs().maxCoeff(); }},
            {"high", [](const Outcome& r) { return 1 - r.tail(2).cwiseAbs().maxCoeff(); }}};
        return list;
    }
    std::vector<double> genes(const Genome& g) const { return g; }
    Genome with_genes(const Genome&, const std::vector<double>& genes) const { return genes; }
    std::vector<ga::Variable> bounds(const Genome&) const { return {{0, 0, 5}, {1, 0, 5}, {2, 0, 5}}; }
    ga::Sensitivity sensitivity(const Genome& g, const std::string&) const {
        Eigen::MatrixXd jacobian(5, 3);
        for (int k = 0; k < 5; ++k) {
            const double at = x[static_cast<std::size_t>(k)], scale = 1 / model({2, 1.5, 0.5}, at);
            jacobian.row(k) << scale * std::exp(-g[1] * at), -scale * g[0] * at * std::exp(-g[1] * at), scale;
        }
        return {residuals(g), jacobian};
    }

    static double model(const Genome& g, double at) { return g[0] * std::exp(-g[1] * at) + g[2]; }

    /// n genomes spread over the box, the same for the same n.
    static ga::Population<Genome> start(std::size_t n) {
        std::vector<Genome> genomes;
        for (std::size_t i = 0; i < n; ++i) {
            ga::Stream stream(i);
            genomes.push_back({stream.uniform(0.5, 4), stream.uniform(0.2, 3), stream.uniform(0.1, 2)});
        }
        return ga::population(genomes);
    }
};

/// Genes within a tenth of their values, as the paper bounds its phases.
inline const ga::Variables<CurveFit::Genome> tenth{"tenth", [](const CurveFit::Genome& g) {
                                                       std::vector<ga::Variable> variables;
                                                       for (std::size_t i = 0; i < g.size(); ++i)
                                                           variables.push_back({i, 0.9 * g[i], 1.1 * g[i]});
                                                       return variables;
                                                   }};

inline const ga::Combine<CurveFit::Genome> mean{
    "mean",
    [](const ga::Individual<CurveFit::Genome>& a,
       const ga::Individual<CurveFit::Genome>& b) -> std::optional<CurveFit::Genome> {
        if (a.identity == b.identity)
            return std::nullopt;
        CurveFit::Genome child = a.genome;
        for (std::size_t i = 0; i < child.size(); ++i)
            child[i] = (a.genome[i] + b.genome[i]) / 2;
        return child;
    }};
