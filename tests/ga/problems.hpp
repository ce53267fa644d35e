#pragma once

#include "ga/checkpoint/checkpoint.hpp"
#include "ga/text/compiled_once.hpp"
#include "ga/text/whole_vocabulary.hpp"

/// @file
/// The problems that the tests share. The engine is compiled once for each, in problems.cpp and
/// text_test.cpp, so tests write pipelines as text.

using Vector = std::vector<double>;

/// Functions with a known minimum of 0.
namespace functions {

inline double sphere(const Vector& x) { return std::inner_product(x.begin(), x.end(), x.begin(), 0.0); }
/// Condition 1e6, rotated by mirroring at a diagonal plane.
inline double ellipsoid(const Vector& x) {
    double mean = 0, sum = 0;
    for (const double each : x) mean += each / static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += std::pow(1e6, static_cast<double>(i) / static_cast<double>(x.size() - 1)) * std::pow(x[i] - 2 * mean, 2);
    return sum;
}
inline double rosenbrock(const Vector& x) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        sum += 100 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1 - x[i], 2);
    return sum;
}
inline double rastrigin(const Vector& x) {
    double sum = 0;
    for (const double each : x) sum += each * each + 10 * (1 - std::cos(2 * std::numbers::pi * each));
    return sum;
}

} // namespace functions

/// n real genes between `lower` and `upper`, and any function of them. By default the outcome is the genome;
/// the objectives are minus the sum of its squares, and minus the square of its first gene.
struct Reals {
    using Genome = Vector;
    using Outcome = Vector;
    using Objectives = std::vector<ga::Objective<Outcome>>;

    std::size_t n = 6;
    std::function<Outcome(const Genome&)> f = [](const Genome& x) { return x; };
    double lower = -1, upper = 1;
    Objectives list = {{"squares", [](const Outcome& x) { return -functions::sphere(x); }},
                       {"first", [](const Outcome& x) { return -x[0] * x[0]; }}};
    std::vector<ga::Descriptor<Genome>> features = {};
    std::function<Vector(const Outcome&)> excess = [](const Outcome&) { return Vector(); }; ///< violations
    std::function<Vector(const Genome&)> slope = [](const Genome&) { return Vector(); };
    std::function<std::vector<ga::Variable>(const Genome&)> box = {}; ///< in place of n, lower and upper
    double noise = 0;                                                 ///< standard deviation of each replicate
    std::function<Genome(const Genome&)> mend = [](const Genome& x) { return x; };

    Outcome evaluate(const Genome& x) const { return noise == 0 ? f(x) : evaluate(x, 0); }
    Outcome evaluate(const Genome& x, std::uint64_t replicate) const {
        Outcome outcome = f(x);
        ga::Stream stream(ga::fold(ga::fold(7, ga::fingerprint(x).low), replicate));
        for (double& each : outcome) each += noise * stream.normal();
        return outcome;
    }
    const Objectives& objectives() const { return list; }
    std::vector<ga::Variable> bounds(const Genome& x) const {
        if (box) return box(x);
        std::vector<ga::Variable> all;
        for (std::size_t i = 0; i < n; ++i) all.push_back({i, lower, upper});
        return all;
    }
    Genome sample(ga::Stream& stream) const {
        Genome x(n);
        for (double& gene : x) gene = stream.uniform(std::max(lower, -5.0), std::min(upper, 5.0));
        return x;
    }
    Vector violation(const Outcome& outcome) const { return excess(outcome); }
    Genome repair(const Genome& x) const { return mend(x); }
    Vector gradient(const Genome& x, const std::string&) const { return slope(x); }
    const std::vector<ga::Descriptor<Genome>>& descriptors() const { return features; }
};

/// The minimum of a function of n genes.
inline Reals minimum(std::size_t n, std::function<double(const Vector&)> f, double lower = -5, double upper = 5) {
    return {n,
            [f](const Vector& x) { return Vector{f(x)}; },
            lower,
            upper,
            {{"f", [](const Vector& y) { return y[0]; }, true}}};
}
/// Its maximum.
inline Reals maximum(std::size_t n, std::function<double(const Vector&)> f, double lower = -5, double upper = 5) {
    Reals problem = minimum(n, std::move(f), lower, upper);
    problem.list[0].minimise = false;
    return problem;
}
/// Genomes of one gene whose fitness is the gene, called `value`.
inline Reals given() {
    Reals problem;
    problem.n = 1;
    problem.list = {{"value", [](const Vector& x) { return x[0]; }}};
    return problem;
}
/// Individuals of these genes.
inline ga::Population<Vector> individuals(const Vector& genes) {
    std::vector<Vector> genomes;
    for (const double gene : genes) genomes.push_back({gene});
    return ga::population(genomes);
}
/// Their values, in order.
inline Vector values_of(const ga::Population<Vector>& population) {
    Vector values;
    for (const auto& each : population) values.push_back(each.value());
    return values;
}

/// The largest distance of the draws' distribution from the expected one (Kolmogorov and Smirnov). One
/// correct sample in a thousand exceeds 1.95.
template <class Distribution>
double distance(Vector draws, const Distribution& distribution) {
    std::sort(draws.begin(), draws.end());
    const auto n = static_cast<double>(draws.size());
    double largest = 0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const double expected = distribution(draws[i]), i_th = static_cast<double>(i);
        largest = std::max({largest, expected - i_th / n, (i_th + 1) / n - expected});
    }
    return largest * std::sqrt(n);
}

/// Residuals with derivatives of a fit of y(x) = a exp(-b x) + c. The five points have a = 2, b = 1.5, c =
/// 0.5. Outcome: relative residuals r. Objectives: `fit` = 1 - max|r|, `low` and `high` of the first and last
/// two. Each member function calls its hook, which may count, alter or throw.
struct CurveFit {
    using Genome = Vector;
    using Outcome = Eigen::VectorXd;
    using Objectives = std::vector<ga::Objective<Outcome>>;

    static constexpr std::array<double, 5> x = {0, 0.5, 1, 2, 4};
    Objectives list = {{"fit", [](const Outcome& r) { return 1 - r.cwiseAbs().maxCoeff(); }},
                       {"low", [](const Outcome& r) { return 1 - r.head(2).cwiseAbs().maxCoeff(); }},
                       {"high", [](const Outcome& r) { return 1 - r.tail(2).cwiseAbs().maxCoeff(); }}};
    std::function<void(const Genome&)> on_evaluation = [](const Genome&) {};
    std::function<void(const Genome&, ga::Sensitivity&)> on_sensitivity = [](const Genome&, ga::Sensitivity&) {};
    std::function<void()> on_conversion = [] {};

    Outcome residuals(const Genome& g) const {
        Outcome r(5);
        for (int k = 0; k < 5; ++k)
            r[k] = model(g, x[static_cast<std::size_t>(k)]) / model({2, 1.5, 0.5}, x[static_cast<std::size_t>(k)]) - 1;
        return r;
    }
    Outcome evaluate(const Genome& g) const {
        on_evaluation(g);
        if (g[1] < -20) throw std::domain_error("rate under -20");
        return residuals(g);
    }
    const Objectives& objectives() const { return list; }
    std::vector<double> genes(const Genome& g) const { return g; }
    Genome with_genes(const Genome&, const std::vector<double>& genes) const {
        on_conversion();
        return genes;
    }
    std::vector<ga::Variable> bounds(const Genome&) const { return {{0, 0, 5}, {1, 0, 5}, {2, 0, 5}}; }
    ga::Sensitivity sensitivity(const Genome& g, const std::string&) const {
        Eigen::MatrixXd jacobian(5, 3);
        for (int k = 0; k < 5; ++k) {
            const double at = x[static_cast<std::size_t>(k)], scale = 1 / model({2, 1.5, 0.5}, at);
            jacobian.row(k) << scale * std::exp(-g[1] * at), -scale * g[0] * at * std::exp(-g[1] * at), scale;
        }
        ga::Sensitivity found{residuals(g), jacobian};
        on_sensitivity(g, found);
        return found;
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

/// A usual generation of a genetic algorithm on real genes.
inline const std::string generation = "{ tournament 2 | cross blend | mutate 0.2 | score | elite 1 }";

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

GA_PIPELINES_ELSEWHERE(Reals)
GA_PIPELINES_ELSEWHERE(CurveFit)
extern template class ga::Checkpoints<Reals>;

/// Every operator of the engine, and for `pair` the combinations `mean` (of different parents) and `none`.
const ga::Registry<Reals>& registry();
/// Besides, `genes=tenth` (within a tenth of their values, as the paper bounds its phases) and `turn genes`.
const ga::Registry<CurveFit>& curve_registry();

/// Pipelines from text.
ga::Pipeline<Reals> reals(const std::string& pipeline);
ga::Pipeline<CurveFit> curves(const std::string& pipeline);

using Observers = std::vector<ga::Observer<Vector>>;
/// Runs a pipeline written as text.
ga::Result<Vector> run(const std::string& pipeline, const Reals& problem, const ga::Population<Vector>& start = {},
                       const ga::RunOptions& options = {}, const Observers& observers = {},
                       ga::Checkpointer<Reals>* keeper = nullptr);
ga::Result<Vector> run(const std::string& pipeline, const CurveFit& problem, const ga::Population<Vector>& start,
                       const ga::RunOptions& options = {}, const Observers& observers = {});

/// Stops a run every `step` evaluations and resumes it, on 1 to 3 threads, until it ends. `prepare` may keep
/// values in the checkpoints of each piece.
ga::Result<Vector> in_pieces(const std::string& pipeline, const Reals& problem, long step,
                             const ga::RunOptions& options = {}, const Observers& observers = {},
                             const std::function<void(ga::Checkpoints<Reals>&)>& prepare = {});

/// A result to the last bit: individuals with parents, genes and fitness, the best, counters and notes.
std::string bits_of(const ga::Result<Vector>& result);
