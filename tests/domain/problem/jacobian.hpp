#pragma once

#include "domain/problem/drawn_start.hpp"
#include "domain/problem/problem.hpp"
#include "tests/domain/derivatives.hpp"
#include "tests/domain/design/setups.hpp"
#include "tests/domain/problem/about_points.hpp"

namespace rough::testing {

/// A design for the paper's target on a grid of `nodes`, with amplitude free or by Eq. 11.
inline DesignSetup drawn_setup(Index nodes, bool eq_11 = false, Kernel kernel = Kernel::free) {
    DesignSetup setup = drawn(nodes, false, kernel);
    if (!eq_11) setup.max_pressure.reset();
    return setup;
}

/// A random genome of two series in the amplitude that fits the first target.
inline Genome fitted_genome(std::mt19937_64& random, const DesignSetup& setup, std::size_t ridges = 1) {
    return with_fitting_amplitude(
        setup, random_genome(random, 2, ridges, setup.model.grid.length, setup.limits.shortest_wave));
}

/// The value of an objective for a genome.
inline double fitness(const DesignProblem& problem, const Genome& genome, const std::string& name) {
    for (const auto& objective : problem.objectives())
        if (objective.name == name) return objective.fitness(problem.evaluate(genome, objective.level));
    FAIL("no objective " << name);
    return 0;
}

/// The similarity on a grid with `refine` elements for each one, in load steps `times` as close about the points of the
/// first target, which is against pressure.
inline double similarity_about_points(const DesignSetup& setup, const Genome& genome, Index refine, int times) {
    Model model = refined(setup.model, refine);
    const DesignResponse own = respond(setup, genome, model);
    if (times == 1) return similarity(setup, own);
    model.loading.shares = shares_about(own.responses[0], setup.targets[0].x, times);
    return similarity(setup, respond(setup, genome, model));
}

/// A verification's four similarities by one solution each.
inline std::array<double, 4> separate_similarities(const DesignSetup& setup, const Genome& genome) {
    const auto alone = [&](Index refine, int times) { return similarity_about_points(setup, genome, refine, times); };
    const auto [nodes, steps] = verified_refinement(setup.model.grid);
    return {alone(1, 1), alone(nodes, 1), alone(1, steps), alone(nodes, steps)};
}

/// All values at which a misfit has a corner: contact sets, extreme nodes, the segment of each point, the
/// band.
inline std::vector<double> corners(const DesignSetup& setup, const Genome& genome) {
    const Model& model = setup.model;
    std::vector<double> marks;
    const DesignResponse response = respond(setup, genome, model);
    for (const Response& one : response.responses)
        for (Index j = 0; j < one.steps(); ++j) marks.push_back(one.contact_fraction[j]);
    for (std::size_t g = 0; g < setup.targets.size(); ++g) {
        const Target& target = setup.targets[g];
        const Curve& curve = response.curves[g];
        for (Index k = 0; k < target.points(); ++k) {
            marks.push_back(static_cast<double>(segment_at(curve, target.x[k]).left));
            if (target.has_band())
                marks.push_back((curve.at(target.x[k]) > target.upper[k]) - (curve.at(target.x[k]) < target.lower[k]));
        }
    }
    Index highest, lowest;
    const Profile profile = sample(genome, model.grid);
    profile.heights.maxCoeff(&highest);
    profile.heights.minCoeff(&lowest);
    marks.push_back(static_cast<double>(highest));
    marks.push_back(static_cast<double>(lowest));
    return marks;
}

/// Checks the Jacobian of an objective against central differences. A gene is omitted if a corner lies
/// between the differences; more than half must remain.
inline void check_jacobian(const DesignSetup& setup, const Genome& start, const std::string& objective,
                           double tolerance = 1e-5) {
    const DesignProblem problem(setup);
    const Genome genome = problem.final_genome(start, problem.evaluate(start));
    const ga::Sensitivity all = problem.sensitivity(genome, objective);
    const double largest = all.jacobian.cwiseAbs().maxCoeff();
    const auto values = problem.genes(genome);
    const auto base = corners(setup, genome);
    int kept = 0;
    for (std::size_t g = 0; g < values.size(); ++g) {
        const double h = 1e-7 * std::max(1.0, std::abs(values[g]));
        const Genome above = problem.with_genes(genome, moved(values, g, h)),
                     below = problem.with_genes(genome, moved(values, g, -h));
        if (corners(setup, above) != base || corners(setup, below) != base) continue;
        ++kept;
        const Eigen::VectorXd difference =
            (problem.sensitivity(above, objective).residuals - problem.sensitivity(below, objective).residuals) /
            (2 * h);
        INFO("objective " << objective << ", gene " << g);
        CHECK((difference - all.jacobian.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() < tolerance * largest);
    }
    CHECK(kept > static_cast<int>(values.size()) / 2);
}

} // namespace rough::testing
