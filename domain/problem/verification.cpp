#include "domain/problem/verification.hpp"

#include "domain/errors.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

namespace rough {

namespace {

constexpr int map_steps = 4; ///< factor on the load steps of a map
/// The largest error of an interpolated load step, relative to a secant in finer load steps.
constexpr double interpolation_accuracy = 2e-3;

/// Fills in the steps that are not solved. The pressure is a cubic through pressures and tangents of the
/// solved steps next to them; all other columns are linear.
Response interpolated(Response response, const std::vector<char>& solved) {
    for (Index j = 0; j < response.steps(); ++j) {
        if (solved[static_cast<std::size_t>(j)]) continue;
        const Index a = j - (j + 1) % map_steps, b = a + map_steps;
        const auto& D = response.displacement;
        const double h = D[b] - D[a], t = (D[j] - D[a]) / h;
        for (auto* column : {&response.pressure, &response.contact_fraction, &response.kkt_residual})
            (*column)[j] = (1 - t) * (*column)[a] + t * (*column)[b];
        const double secant = (response.pressure[b] - response.pressure[a]) / h;
        const double before = response.tangent_stiffness[a] - secant, after = response.tangent_stiffness[b] - secant;
        response.pressure[j] += h * t * (1 - t) * ((1 - t) * before - t * after);
        response.tangent_stiffness[j] = (1 - t) * response.tangent_stiffness[a] + t * response.tangent_stiffness[b];
    }
    return response;
}

/// The finer load steps to solve on a finer grid, given a solution of all of them on this one. These are
/// every fourth step, and the steps between if interpolation is not accurate there.
std::vector<char> steps_to_solve(const Response& all) {
    const Index count = all.steps();
    std::vector<char> solved(static_cast<std::size_t>(count), 1);
    for (Index j = map_steps; j < count; ++j) solved[static_cast<std::size_t>(j)] = (j + 1) % map_steps == 0;
    const Response read = interpolated(all, solved);
    for (Index a = map_steps - 1; a + map_steps < count; a += map_steps) {
        const double error = (read.pressure - all.pressure).segment(a + 1, map_steps).cwiseAbs().maxCoeff();
        const double step = (all.pressure[a + map_steps] - all.pressure[a]) / map_steps;
        if (2 * error > interpolation_accuracy * step) std::fill_n(solved.begin() + a + 1, map_steps, char{1});
    }
    return solved;
}

/// The set-up with the targets that its measured surface has by this response.
DesignSetup with_measured(DesignSetup setup, const Response& response) {
    for (Target& target : setup.targets) {
        const Curve curve = curve_of(target.quantity, response);
        for (Index k = 0; k < target.points(); ++k) {
            const double y = curve.at(std::min(target.x[k], curve.to)), moved = y / target.y[k];
            target.y[k] = y;
            if (target.has_band()) target.lower[k] *= moved, target.upper[k] *= moved;
        }
    }
    return setup;
}

/// The values of each target's curve at its points, relative to the target.
std::vector<Eigen::VectorXd> relative_values(const DesignSetup& setup, const DesignResponse& response) {
    std::vector<Eigen::VectorXd> all;
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        const Target& target = setup.targets[t];
        all.emplace_back(
            target.x.unaryExpr([&](double x) { return response.curves[t].at(x); }).cwiseQuotient(target.y));
    }
    return all;
}

/// Each entry's largest value of itself and its neighbours.
Eigen::VectorXd with_neighbours(const Eigen::VectorXd& values) {
    Eigen::VectorXd largest = values;
    const Index n = values.size() - 1;
    largest.head(n) = largest.head(n).cwiseMax(values.tail(n));
    largest.tail(n) = largest.tail(n).cwiseMax(values.head(n));
    return largest;
}

} // namespace

DesignSetup corrected_targets(DesignSetup setup, const std::vector<Eigen::VectorXd>& here,
                              const std::vector<Eigen::VectorXd>& finest) {
    constexpr double most = 2; // larger factors do not correct
    for (std::size_t t = 0; t < setup.targets.size(); ++t) {
        Target& target = setup.targets[t];
        for (Index k = 0; k < target.points(); ++k) {
            const auto value = [&](const auto& misfits) {
                return std::max(1 + misfits[t][k] / target.weight, 1 / most);
            };
            const double factor = std::clamp(value(here) / value(finest), 1 / most, most);
            target.y[k] *= factor;
            if (target.has_band()) target.lower[k] *= factor, target.upper[k] *= factor;
        }
    }
    return setup;
}

Refinement verified_refinement(const Grid& grid) {
    constexpr Index large = 512;
    if (!grid.is_2d()) return {4, 16};
    return {std::max(grid.nodes, grid.rows) >= large ? 2 : 4, map_steps};
}

DesignSetup in_finer_steps(DesignSetup setup, int times) {
    setup.model.loading.steps *= times;
    return setup.measured ? with_measured(setup, respond(*setup.measured, setup.model)) : setup;
}

const Verifier::Finer& Verifier::finer_setups() const {
    std::call_once(is_finer_known_, [&] {
        finer_ = {setup_, setup_};
        finer_.all.model.loading.steps *= by_.steps;
        finer_.half.model.loading.steps *= by_.steps / 2;
        if (setup_.measured) {
            const Response response = respond(*setup_.measured, finer_.all.model);
            finer_.all = with_measured(std::move(finer_.all), response);
            finer_.half = with_measured(std::move(finer_.half), every(2, response));
        }
    });
    return finer_;
}

std::vector<Response> Verifier::on_fine_map(const Genome& genome,
                                            const std::vector<std::vector<char>>& to_solve) const {
    const Model model = finest();
    const Profile map = sample(at_scale_one(genome, finer()), model.grid);
    std::vector<Response> responses;
    for (const Loading& loading : loadings_of(finer(), finer().model.loading)) {
        const std::vector<double> displacements =
            step_displacements(map, model.body, up_to_full_contact(loading, map, model), model.contact);
        std::vector<LoadStep> steps(displacements.size());
        std::vector<std::size_t> solved;
        for (std::size_t j = 0; j < steps.size(); ++j) {
            steps[j].displacement = displacements[j];
            if (to_solve[responses.size()][j]) solved.push_back(j);
        }
        // The number of runs does not depend on the number of threads, so the results do not either.
        constexpr std::size_t runs = 2;
        ga::parallel_for(runs, threads_, [&](std::size_t run) {
            const std::size_t from = run * solved.size() / runs, to = (run + 1) * solved.size() / runs;
            std::vector<double> at;
            for (std::size_t k = from; k < to; ++k) at.push_back(displacements[solved[k]]);
            const ContactCurve curve = solve_contact(map, model.body, at, model.contact);
            for (std::size_t k = from; k < to; ++k) steps[solved[k]] = curve.steps[k - from];
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
    using Values = std::vector<Eigen::VectorXd>; // of each target
    // The misfits in all steps, then in the set-up's, which are among them.
    const auto misfits_in = [&](const std::vector<Response>& fine, std::size_t own_steps, std::size_t all_steps) {
        std::vector<Response> found;
        for (const Response& response : fine) found.push_back(every(by_.steps, response));
        result.misfits[all_steps] = misfits_of(finer(), design_response(finer(), fine));
        result.misfits[own_steps] = misfits_of(setup_, design_response(setup_, found));
        return found;
    };
    const auto values_in = [](const DesignSetup& setup, std::vector<Response> responses) {
        return relative_values(setup, design_response(setup, std::move(responses)));
    };
    const std::vector<Response> coarse = responses_of(finer(), genome, finer().model);
    std::vector<std::vector<char>> to_solve;
    const Values on_grid = values_in(finer(), coarse);
    Values interpolation;
    if (is_map) {
        std::vector<Response> read;
        for (const Response& response : coarse) {
            to_solve.push_back(steps_to_solve(response));
            read.push_back(interpolated(response, to_solve.back()));
        }
        interpolation = values_in(finer(), std::move(read));
    }
    result.on_grid = misfits_in(coarse, 0, 2);
    const std::vector<Response> fine = is_map ? on_fine_map(genome, to_solve) : responses_of(finer(), genome, finest());
    result.on_finer = misfits_in(fine, 1, 3);
    std::vector<Response> half;
    for (const Response& response : fine) half.push_back(every(2, response));
    const Values finest = values_in(finer(), fine), in_half = values_in(finer_setups().half, std::move(half));
    for (std::size_t t = 0; t < finest.size(); ++t) {
        const Target& target = finer().targets[t];
        Eigen::VectorXd error =
            with_neighbours((in_half[t] - finest[t]).cwiseAbs()) +
            with_neighbours((on_grid[t] - finest[t]).cwiseAbs()) / static_cast<double>(by_.nodes - 1);
        if (is_map) error += (interpolation[t] - on_grid[t]).cwiseAbs();
        const auto moved_by = [&](double side) {
            return misfit(target, (finest[t] + side * error).cwiseProduct(target.y).eval());
        };
        const Eigen::VectorXd down = moved_by(-1), up = moved_by(1);
        result.largest.emplace_back((up.cwiseAbs().array() > down.cwiseAbs().array()).select(up, down));
    }
}

Verification Verifier::of(const Genome& genome) const {
    const ga::Stopwatch clock;
    Verification result;
    try {
        verify(genome, result);
    } catch (const NotConverged&) {
        if (!is_stopped(setup_.model.contact)) throw;
    }
    const auto likeness = [&](std::size_t which) {
        return result.misfits[which].empty() ? std::numeric_limits<double>::quiet_NaN()
                                             : min_similarity(result.misfits[which]);
    };
    result.similarity = likeness(0);
    result.refined = likeness(1);
    result.more_steps = likeness(2);
    result.both = likeness(3);
    result.worst = result.misfits[3].empty() ? result.both : min_similarity(result.largest);
    result.seconds = clock.seconds();
    if (!std::isnan(result.worst)) known_.keep(key_of(setup_, genome), result);
    return result;
}

} // namespace rough
