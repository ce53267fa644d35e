#pragma once

#include "domain/problem/problem.hpp"
#include "domain/problem/verification.hpp"

#include <catch2/catch.hpp>

namespace rough::testing {

/// All values at which a misfit has a corner: contact sets, extreme nodes, the segment that serves a point,
/// the band.
inline std::vector<double> corners(const DesignSetup& setup, const Genome& genome, Index refine) {
    const Model model = refined(setup.model, refine);
    std::vector<double> marks;
    const DesignResponse response = respond(setup, genome, model);
    for (const Response& one : response.responses)
        for (Index j = 0; j < one.steps(); ++j)
            marks.push_back(one.contact_fraction[j]);
    for (std::size_t g = 0; g < setup.targets.size(); ++g) {
        const Target& target = setup.targets[g];
        const Curve& curve = response.curves[g];
        for (Index k = 0; k < target.points(); ++k) {
            marks.push_back(static_cast<double>(segment_at(curve, target.x[k]).left));
            if (target.has_band())
                marks.push_back((curve.at(target.x[k]) > target.upper[k]) -
                                (curve.at(target.x[k]) < target.lower[k]));
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

/// The corners of every curve that an objective uses.
inline std::vector<double> corners(const DesignSetup& setup, const Genome& genome,
                                   const std::string& objective) {
    std::vector<double> marks = corners(setup, genome, 1);
    std::vector<std::pair<DesignSetup, Index>> finer;
    if (objective == "verified" || objective == "more_steps")
        finer.emplace_back(in_finer_steps(setup), 1);
    if (objective == "verified")
        finer.insert(finer.end(), {{setup, 4}, {in_finer_steps(setup), 4}});
    for (const auto& [steps, refine] : finer)
        for (const double mark : corners(steps, genome, refine))
            marks.push_back(mark);
    return marks;
}

/// Checks the Jacobian of an objective against central differences. A gene is omitted if a corner lies
/// between the differences; more than half must remain.
inline void check_jacobian(const DesignSetup& setup, const Genome& start, const std::string& objective,
                           double tolerance = 1e-5) {
    const DesignProblem problem(setup);
    const Genome genome = problem.settled(start, problem.evaluate(start));
    const ga::Sensitivity all = problem.sensitivity(genome, objective);
    const double largest = all.jacobian.cwiseAbs().maxCoeff();
    const auto values = problem.genes(genome);
    const auto base = corners(setup, genome, objective);
    int kept = 0;
    for (std::size_t g = 0; g < values.size(); ++g) {
        const double h = 1e-7 * std::max(1.0, std::abs(values[g]));
        auto up = values, down = values;
        up[g] += h;
        down[g] -= h;
        const Genome above = problem.with_genes(genome, up), below = problem.with_genes(genome, down);
        if (corners(setup, above, objective) != base || corners(setup, below, objective) != base)
            continue;
        ++kept;
        const Eigen::VectorXd difference = (problem.sensitivity(above, objective).residuals -
                                            problem.sensitivity(below, objective).residuals) /
                                           (2 * h);
        INFO("objective " << objective << ", gene " << g);
        CHECK((difference - all.jacobian.col(static_cast<Index>(g))).cwiseAbs().maxCoeff() <
              tolerance * largest);
    }
    CHECK(kept > static_cast<int>(values.size()) / 2);
}

} // namespace rough::testing
