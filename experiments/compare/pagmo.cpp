#include "experiments/compare/race.hpp"
#include "ga/text/nearest.hpp"

#ifdef RUGOSA_PAGMO
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/moead.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#endif

namespace app {

void expect_pagmos(const RealInstance& instance, const std::string& variant) {
    const std::vector<std::string>& names = pagmo_variants(instance.objectives > 1);
    if (names.empty())
        throw ga::UsageError("\"" + variant +
                             "\" needs a build with libpagmo; install Debian's libpagmo-dev and build again");
    if (instance.constrained)
        throw ga::UsageError("\"" + variant + "\" cannot search under constraints; give a pipeline");
    if (std::ranges::find(names, variant) == names.end())
        throw ga::UsageError("\"" + variant + "\" is not an algorithm of libpagmo for " +
                             std::to_string(instance.objectives) + " objectives" + ga::suggestion(variant, names));
}

#ifndef RUGOSA_PAGMO

const std::vector<std::string>& pagmo_variants(bool) {
    static const std::vector<std::string> none;
    return none;
}

Reached raced_by_pagmo(const RealInstance& instance, const std::string& variant, const std::vector<double>&,
                       const Attempt&) {
    expect_pagmos(instance, variant);
    return {};
}

#else

namespace {

/// Thrown through the algorithm when the run is over.
struct Ended {};

struct Run {
    const RealInstance& instance;
    Nearness nearness;
    Tally tally;
    long budget, made = 0;
};

/// An instance as a user-defined problem of libpagmo, which copies it.
struct Measured {
    Run* run = nullptr;

    pagmo::vector_double fitness(const pagmo::vector_double& x) const {
        if (run->made >= run->budget || run->tally.ended()) throw Ended();
        const Evaluation value = run->instance.evaluate(x);
        run->tally.note(++run->made, run->nearness.after(value));
        return value.objectives;
    }
    std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
        if (!run) return {{0}, {1}};
        std::pair<pagmo::vector_double, pagmo::vector_double> bounds;
        for (const ga::Variable& gene : run->instance.box) {
            bounds.first.push_back(gene.lower);
            bounds.second.push_back(gene.upper);
        }
        return bounds;
    }
    pagmo::vector_double::size_type get_nobj() const { return run ? run->instance.objectives : 1; }
    template <class Archive>
    void serialize(Archive&, unsigned) {}
};

/// CMA-ES that stays between the bounds like rugosa's variants; `pagmo:cmaes` may leave them.
const std::string bounded_cmaes = "pagmo:cmaes-bounded";
bool is_cmaes(const std::string& variant) { return variant == "pagmo:cmaes" || variant == bounded_cmaes; }

pagmo::algorithm algorithm_of(const std::string& variant, unsigned seed) {
    constexpr unsigned on = std::numeric_limits<int>::max(); // generations: the budget ends it
    constexpr double tolerance = 1e-12;
    if (is_cmaes(variant))
        return pagmo::algorithm(
            pagmo::cmaes(on, -1, -1, -1, -1, 0.5, tolerance, tolerance, false, variant == bounded_cmaes, seed));
    if (variant == "pagmo:de") return pagmo::algorithm(pagmo::de(on, 0.8, 0.9, 2, tolerance, tolerance, seed));
    if (variant == "pagmo:sade") return pagmo::algorithm(pagmo::sade(on, 2, 1, tolerance, tolerance, false, seed));
    return pagmo::algorithm(pagmo::sga(on, 0.9, 1, 0.02, 1, 2, "exponential", "polynomial", "tournament", seed));
}

} // namespace

const std::vector<std::string>& pagmo_variants(bool several) {
    static const std::vector<std::string> all{"pagmo:cmaes", bounded_cmaes, "pagmo:de", "pagmo:sade", "pagmo:sga"},
        of_several{"pagmo:nsga2", "pagmo:moead"};
    return several ? of_several : all;
}

Reached raced_by_pagmo(const RealInstance& instance, const std::string& variant, const std::vector<double>& targets,
                       const Attempt& attempt) {
    Run run{instance, Nearness(instance), Tally(targets, attempt), attempt.budget};
    const double hansens = 4 + std::floor(3 * std::log(static_cast<double>(instance.genes)));
    const auto size = is_cmaes(variant)        ? static_cast<std::size_t>(std::max(5.0, hansens))
                      : variant == "pagmo:sga" ? std::size_t{40}
                                               : std::size_t{20};
    try {
        if (instance.objectives > 1) {
            constexpr unsigned individuals = 100;
            const auto seed = static_cast<unsigned>(attempt.seed);
            const auto generations = static_cast<unsigned>(std::max(2L, attempt.budget / individuals) - 1);
            const pagmo::algorithm algorithm =
                variant == "pagmo:nsga2" ? pagmo::algorithm(pagmo::nsga2(generations, 0.95, 10, 0.01, 50, seed))
                                         : pagmo::algorithm(pagmo::moead(generations, "low discrepancy", "tchebycheff",
                                                                         20, 1, 0.5, 20, 0.9, 2, true, seed));
            const auto last =
                algorithm.evolve(pagmo::population(pagmo::problem(Measured{&run}), individuals, seed)).get_f();
            Reached reached = run.tally.reached();
            reached.hypervolume = hypervolume(instance, last);
            return reached;
        }
        for (std::uint64_t start = 0;; ++start) {
            const auto seed = static_cast<unsigned>(ga::fold(attempt.seed, start));
            algorithm_of(variant, seed).evolve(pagmo::population(pagmo::problem(Measured{&run}), size, seed));
        }
    } catch (const Ended&) {
        return run.tally.reached();
    }
}

#endif

} // namespace app
