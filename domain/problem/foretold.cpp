#include "domain/problem/foretold.hpp"

#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/response/curve.hpp"

#include <algorithm>

namespace rough {

namespace {

/// The coarse grid has an eighth of the nodes, but no fewer than these: on fewer, the paper's waves are lost.
/// To pay it must do with a fourth.
constexpr Index part = 8, fewest = 256, least_part = 4;

} // namespace

std::vector<double> foretold_secants(const Profile& profile, const Model& model,
                                     const std::vector<double>& displacements) {
    const Kernel kernel = model.body.kernel;
    const Index stride = std::min(part, profile.nodes() / fewest);
    if (stride < least_part || kernel != Kernel::free)
        return {};
    Profile coarse{Eigen::VectorXd(profile.nodes() / stride), static_cast<double>(stride) * profile.spacing};
    for (Index i = 0; i < coarse.nodes(); ++i)
        coarse.heights[i] = profile.heights[stride * i + stride / 2];
    if (!(coarse.heights.maxCoeff() > coarse.heights.minCoeff()))
        return {};
    // Its nodes miss summits and valleys, so a step is where it is in the range of heights.
    const double squeeze = displacement_range(coarse, kernel) / displacement_range(profile, kernel);
    const double shorter = profile_length(coarse, kernel) / profile_length(profile, kernel);
    const std::size_t count = displacements.size();
    std::vector<std::size_t> solved;
    std::vector<double> at;
    for (std::size_t j = count % 2 == 0 ? 1 : 0; j < count; j += 2) {
        solved.push_back(j);
        at.push_back(displacements[j] * squeeze);
    }
    ContactOptions options = model.contact;
    options.solver = Solver::nested;
    Curve secant{Eigen::VectorXd(static_cast<Index>(at.size())),
                 Eigen::VectorXd(static_cast<Index>(at.size())), 0,
                 static_cast<double>(count)}; // against the step's number
    try {
        const ContactCurve curve = solve_contact(coarse, model.body, at, options);
        double pressure = 0, displacement = 0, step = 0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            const double next = static_cast<double>(solved[k] + 1);
            secant.x[static_cast<Index>(k)] = 0.5 * (step + next);
            secant.y[static_cast<Index>(k)] =
                shorter * (curve.steps[k].pressure - pressure) / (at[k] - displacement);
            pressure = curve.steps[k].pressure;
            displacement = at[k];
            step = next;
        }
    } catch (const NotConverged&) {
        return {};
    } catch (const InputError&) { // a datum too near for its longer elements
        return {};
    }
    std::vector<double> secants;
    for (std::size_t j = 0; j < count; ++j)
        secants.push_back(secant.at(static_cast<double>(j) + 0.5));
    return secants;
}

} // namespace rough
