#include "domain/problem/verification.hpp"

#include "domain/errors.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

namespace rough {

namespace {

/// The largest error of an interpolated load step, relative to a secant in finer load steps.
constexpr double interpolation_accuracy = 2e-3;

/// Fills in the steps that are not solved. The pressure is a cubic through pressures and tangents of the
/// solved steps next to them; all other columns are linear.
Response interpolated(Response response, const std::vector<char>& solved) {
    for (Index j = 0; j < response.steps(); ++j) {
        if (solved[static_cast<std::size_t>(j)])
            continue;
        const Index a = j - (j + 1) % verified_refinement, b = a + verified_refinement;
        const auto& D = response.displacement;
        const double h = D[b] - D[a], t = (D[j] - D[a]) / h;
        for (auto* column : {&response.pressure, &response.contact_fraction, &response.kkt_residual})
            (*column)[j] = (1 - t) * (*column)[a] + t * (*column)[b];
        const double secant = (response.pressure[b] - response.pressure[a]) / h;
        const double before = response.tangent_stiffness[a] - secant,
                     after = response.tangent_stiffness[b] - secant;
        response.pressure[j] += h * t * (1 - t) * ((1 - t) * before - t * after);
        response.tangent_stiffness[j] =
            (1 - t) * response.tangent_stiffness[a] + t * response.tangent_stiffness[b];
    }
    return response;
}

/// The finer load steps to solve on a finer grid, given a solution of all of them on this one. These are
/// every fourth step, and the steps between if interpolation is not accurate there.
std::vector<char> steps_to_solve(const Response& all) {
    const Index count = all.steps();
    std::vector<char> solved(static_cast<std::size_t>(count), 1);
    for (Index j = verified_refinement; j < count; ++j)
        solved[static_cast<std::size_t>(j)] = (j + 1) % verified_refinement == 0;
    const Response read = interpolated(all, solved);
    for (Index a = verified_refinement - 1; a + verified_refinement < count; a += verified_refinement) {
        const double error =
            (read.pressure - all.pressure).segment(a + 1, verified_refinement).cwiseAbs().maxCoeff();
        const double step = (all.pressure[a + verified_refinement] - all.pressure[a]) / verified_refinement;
        if (2 * error > interpolation_accuracy * step)
            std::fill_n(solved.begin() + a + 1, verified_refinement, char{1});
    }
    return solved;
}

} // namespace

DesignSetup in_finer_steps(DesignSetup setup, int times) {
    setup.model.loading.steps *= times;
    if (!setup.measured)
        return setup;
    const Response response = respond(*setup.measured, setup.model);
    for (Target& target : setup.targets) {
        const Curve curve = curve_of(target.quantity, response);
        for (Index k = 0; k < target.points(); ++k) {
            const double y = curve.at(std::min(target.x[k], curve.to)), moved = y / target.y[k];
            target.y[k] = y;
            if (target.has_band())
                target.lower[k] *= moved, target.upper[k] *= moved;
        }
    }
    return setup;
}

double Verification::worst() const {
    return std::isnan(similarity + refined + more_steps + both)
               ? std::numeric_limits<double>::quiet_NaN()
               : std::min({similarity, refined, more_steps, both});
}

const DesignSetup& Verifier::finer() const {
    std::call_once(is_finer_known_, [&] { finer_ = in_finer_steps(setup_); });
    return finer_;
}

std::vector<Response> Verifier::on_fine_map(const Genome& genome,
                                            const std::vector<std::vector<char>>& to_solve) const {
    const Model model = refined(finer().model, verified_refinement);
    const Profile map = sample(at_scale_one(genome, finer()), model.grid);
    std::vector<Response> responses;
    for (const Loading& loading : loadings_of(finer(), finer().model.loading)) {
        const std::vector<double> displacements =
            step_displacements(map, model.body, up_to_full_contact(loading, map, model), model.contact);
        std::vector<LoadStep> steps(displacements.size());
        std::vector<std::size_t> solved;
        for (std::size_t j = 0; j < steps.size(); ++j) {
            steps[j].displacement = displacements[j];
            if (to_solve[responses.size()][j])
                solved.push_back(j);
        }
        // The number of runs does not depend on the number of threads, so the results do not either.
        constexpr std::size_t runs = 2;
        ga::parallel_for(runs, threads_, [&](std::size_t run) {
            const std::size_t from = run * solved.size() / runs, to = (run + 1) * solved.size() / runs;
            std::vector<double> at;
            for (std::size_t k = from; k < to; ++k)
                at.push_back(displacements[solved[k]]);
            const ContactCurve curve = solve_contact(map, model.body, at, model.contact);
            for (std::size_t k = from; k < to; ++k)
                steps[solved[k]] = curve.steps[k - from];
        });
        responses.push_back(
            interpolated(response_of(steps, model.contact.solver, displacement_range(map, model.body.kernel),
                                     full_contact_stiffness(map, model.body)),
                         to_solve[responses.size()]));
    }
    return responses;
}

void Verifier::verify(const Genome& genome, Verification& result) const {
    const bool is_map = setup_.model.grid.is_2d();
    // The misfits in all steps, then in every fourth, which are the set-up's.
    const auto misfits_in = [&](std::vector<Response> fine, std::size_t own_steps, std::size_t all_steps) {
        std::vector<Response> found;
        for (const Response& response : fine)
            found.push_back(every(verified_refinement, response));
        result.misfits[all_steps] = misfits_of(finer(), design_response(finer(), std::move(fine)));
        result.misfits[own_steps] = misfits_of(setup_, design_response(setup_, found));
        return found;
    };
    std::vector<Response> fine = responses_of(finer(), genome, refined(finer().model, 1));
    std::vector<std::vector<char>> to_solve;
    if (is_map) {
        std::vector<Response> read;
        for (const Response& response : fine) {
            to_solve.push_back(steps_to_solve(response));
            read.push_back(interpolated(response, to_solve.back()));
        }
        const auto by_interpolation = misfits_of(finer(), design_response(finer(), std::move(read))),
                   exact = misfits_of(finer(), design_response(finer(), fine));
        for (std::size_t t = 0; t < exact.size(); ++t)
            result.interpolation_error =
                std::max(result.interpolation_error, (by_interpolation[t] - exact[t]).cwiseAbs().maxCoeff());
    }
    result.on_grid = misfits_in(std::move(fine), 0, 2);
    result.on_finer =
        misfits_in(is_map ? on_fine_map(genome, to_solve)
                          : responses_of(finer(), genome, refined(finer().model, verified_refinement)),
                   1, 3);
}

Verification Verifier::of(const Genome& genome) const {
    const ga::Stopwatch clock;
    Verification result;
    try {
        verify(genome, result);
    } catch (const NotConverged&) {
        if (!is_stopped(setup_.model.contact))
            throw;
    }
    const auto likeness = [&](std::size_t which) {
        return result.misfits[which].empty() ? std::numeric_limits<double>::quiet_NaN()
                                             : min_similarity(result.misfits[which]);
    };
    result.similarity = likeness(0);
    result.refined = likeness(1);
    result.more_steps = likeness(2);
    result.both = likeness(3) - result.interpolation_error;
    result.seconds = clock.seconds();
    if (!std::isnan(result.worst()))
        known_.keep(key_of(setup_, genome), result);
    return result;
}

} // namespace rough
