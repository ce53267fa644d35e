#include "domain/problem/verification.hpp"

#include "domain/errors.hpp"
#include "ga/base/parallel.hpp"
#include "ga/base/stopwatch.hpp"

namespace rough {
namespace {

/// The displacement at a pressure, mm, by the cubic through the pressures and tangents of the load steps about it.
double displacement_at(const Response& response, double pressure) {
    const auto& P = response.pressure;
    const auto& D = response.displacement;
    const Index b = std::min(std::lower_bound(P.begin(), P.end(), pressure) - P.begin(), response.steps() - 1),
                a = b - 1;
    const auto before = [&](const Eigen::VectorXd& column) { return b > 0 ? column[a] : 0; }; // unloaded
    const double from = before(P), h = D[b] - before(D), rise = P[b] - from;
    const double first = before(response.tangent_stiffness) * h - rise, last = response.tangent_stiffness[b] * h - rise;
    double low = 0, high = 1;
    for (int i = 0; i < 40; ++i) {
        const double t = (low + high) / 2;
        (from + t * rise + t * (1 - t) * ((1 - t) * first - t * last) < pressure ? low : high) = t;
    }
    return D[b] - (1 - high) * h;
}

/// This many load steps, `width` of the last displacement apart, about each point of the targets, as shares of the
/// last displacement in rising order. Those closer than half a width to another or to a step of `own` are left out.
std::vector<double> shares_at(const DesignSetup& setup, const Loading& loading, const Response& own, double width,
                              int count = 2) {
    const double last = own.displacement.tail(1)[0], scale = eq_11(setup, own);
    std::vector<double> shares(own.displacement.begin(), own.displacement.end());
    for (double& share : shares) share /= last;
    std::vector<double> wanted;
    for (const Target& target : setup.targets) {
        if (target.against_pressure() ? loading.to_displacement.has_value() : loading.to_pressure.has_value()) continue;
        for (const double x : target.x) {
            const double at = target.against_pressure() ? displacement_at(own, x / scale) : x / scale;
            const double middle = std::clamp(at / last, width, 1 - width / 2);
            for (int i = 0; i < count; ++i) wanted.push_back(middle + (i - (count - 1) / 2.) * width);
        }
    }
    std::ranges::sort(wanted);
    for (const double share : wanted)
        if (share > 0 && share <= 1 &&
            std::ranges::none_of(shares, [&](double one) { return std::abs(one - share) < width / 2 * (1 - 1e-9); }))
            shares.push_back(share);
    shares.erase(shares.begin(), shares.begin() + own.steps());
    return shares;
}

/// How far a curve may lie below (column 0, at most 0) and above (column 1) its value at each point of a target,
/// relative to the target. If a few nodes begin to touch in the load step there, stiffness may be that of either
/// tangent, and contact area may differ by half its change. If n nodes do so in any order, n/2 of them touch in the
/// middle. The standard deviation is sqrt(n)/2, and three of these are 3/sqrt(n) of that range. `nodes` is the number
/// of all nodes.
Eigen::MatrixX2d range_in_step(const Target& target, const Response& response, const Curve& curve, Index nodes) {
    const auto& P = response.pressure;
    const auto& at = target.against_pressure() ? P : response.displacement;
    Eigen::MatrixX2d range = Eigen::MatrixX2d::Zero(target.points(), 2);
    if (target.quantity == Quantity::load_at_displacement) return range;
    for (Index k = 0; k < target.points(); ++k) {
        const Index b = std::clamp(std::lower_bound(at.begin(), at.end(), target.x[k]) - at.begin(), Index{1},
                                   response.steps() - 1);
        const double change = std::abs(response.contact_fraction[b] - response.contact_fraction[b - 1]),
                     share = 3 / std::sqrt(std::max(9., change * static_cast<double>(nodes)));
        if (is_contact_fraction(target.quantity)) {
            const double half = share * change / 2;
            range.row(k) << -half / target.y[k], half / target.y[k];
            continue;
        }
        const double secant = (P[b] - P[b - 1]) / (response.displacement[b] - response.displacement[b - 1]),
                     value = curve.at(target.x[k]);
        // 1/K_i = 1/K - 1/K_full: a relative change of K changes K_i by K_i/K times as much.
        const double by =
            share * (target.quantity == Quantity::interface_stiffness ? value / secant : 1) * value / target.y[k];
        const auto tangents = response.tangent_stiffness.segment(b - 1, 2);
        range(k, 0) = by * std::min(tangents.minCoeff() / secant - 1, 0.);
        range(k, 1) = by * std::max(tangents.maxCoeff() / secant - 1, 0.);
    }
    return range;
}

/// The set-up with the targets that its measured surface has by this response.
DesignSetup with_measured(DesignSetup setup, const Response& response) {
    for (Target& target : setup.targets) {
        const Curve curve = curve_of(target.quantity, response);
        for (Index k = 0; k < target.points(); ++k) {
            const double y = curve.at(std::min(target.x[k], curve.to)), moved = y / target.y[k];
            target.y[k] = y;
            if (!target.has_band()) continue;
            target.lower[k] = std::min(target.lower[k] * moved, y); // rounding may move an end across the value
            target.upper[k] = std::max(target.upper[k] * moved, y);
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

/// The error that is left on the finest of three grids, of which each halves the spacing, at each point of a target. If
/// a halving leaves the share q of an error and the last one changed a value by d, it is d q/(1 - q). If the first two
/// grids are one, q = 1/2 is assumed (Roache, J. Fluids Eng. 116, 1994, 405).
Eigen::VectorXd error_left(const Eigen::VectorXd& coarse, const Eigen::VectorXd& between,
                           const Eigen::VectorXd& finest) {
    constexpr double lowest = 1. / 4, highest = 2. / 3; // order 2; rough surfaces may not have reached order 1
    const Eigen::VectorXd last = with_neighbours((between - finest).cwiseAbs()),
                          before = with_neighbours((coarse - between).cwiseAbs());
    const bool is_measured = coarse != between;
    return last.binaryExpr(before, [&](double d, double earlier) {
        const double q = is_measured ? std::clamp(d / std::max(earlier, 1e-300), lowest, highest) : 1. / 2;
        return d * q / (1 - q);
    });
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
    if (!grid.is_2d()) return {4, 64};
    return {std::max(grid.nodes, grid.rows) >= large ? 2 : 4, 16};
}

DesignSetup in_finer_steps(DesignSetup setup, int times) {
    setup.model.loading.steps *= times;
    return setup.measured ? with_measured(setup, respond(*setup.measured, setup.model)) : setup;
}

double Verifier::width() const { return 1. / (setup_.model.loading.steps * by_.steps); }

const DesignSetup& Verifier::finer() const {
    const std::lock_guard lock(finer_guard_);
    if (finer_) return *finer_;
    if (!setup_.measured) return finer_.emplace(setup_);
    DesignSetup as_given = setup_;
    as_given.max_pressure.reset();
    Model model = setup_.model;
    const Response own = respond(*setup_.measured, model);
    model.loading.shares = shares_at(as_given, model.loading, own, width());
    return finer_.emplace(with_measured(setup_, merged(own, respond(*setup_.measured, model))));
}

Verifier::Responses Verifier::responses_on(const Model& model, const Genome& genome) const {
    const Profile surface = sample(at_scale_one(genome, setup_), model.grid);
    const double range = displacement_range(surface, model.body.kernel),
                 full = full_contact_stiffness(surface, model.body);
    // The number of runs does not depend on the number of threads, so the results do not either.
    const std::size_t runs = model.grid.is_2d() ? 2 : 1;
    const auto solved = [&](const std::vector<double>& at) {
        std::vector<ContactCurve> parts(runs);
        ga::parallel_for(runs, threads_, [&](std::size_t run) {
            const auto place = [&](std::size_t k) {
                return at.begin() + static_cast<std::ptrdiff_t>(k * at.size() / runs);
            };
            parts[run] = solve_contact(surface, model.body, {place(run), place(run + 1)}, model.contact);
        });
        for (std::size_t run = 1; run < runs; ++run)
            parts[0].steps.insert(parts[0].steps.end(), parts[run].steps.begin(), parts[run].steps.end());
        return response_of(parts[0].steps, parts[0].solver, range, full);
    };
    Responses all;
    for (const Loading& given : loadings_of(setup_, model.loading)) {
        const Loading loading = up_to_full_contact(given, surface, model);
        const Response own = solved(step_displacements(surface, model.body, loading, model.contact));
        std::vector<double> between = shares_at(setup_, loading, own, width());
        for (double& share : between) share *= own.displacement.tail(1)[0];
        all.all.push_back(between.empty() ? own : merged(own, solved(between)));
        all.own.push_back(own);
    }
    return all;
}

Rows Verifier::misfit_rows(const Genome& genome) const {
    // Closer steps have hardly a node that begins to touch between them, and so no useful derivative.
    const double apart = 1. / (16 * setup_.model.loading.steps);
    const Verification found = of(genome);
    if (std::isnan(found.worst)) throw ga::Stopped{"stop requested"};
    const Model model = refined(setup_.model, by_.nodes);
    std::vector<Loading> loadings = loadings_of(setup_, model.loading);
    for (std::size_t l = 0; l < loadings.size(); ++l) {
        std::vector<double>& shares = loadings[l].shares;
        shares = shares_at(setup_, loadings[l], found.on_finer[l], apart, 4);
        for (int j = 1; j <= model.loading.steps; ++j) shares.push_back(static_cast<double>(j) / model.loading.steps);
        std::ranges::sort(shares);
    }
    Rows rows = rough::misfit_rows(finer(), sample(genome, model.grid), loadings, model,
                                   [&](const Eigen::MatrixXd& all) { return pulled_back(all, genome, model.grid); });
    for (Index at = 0; const Eigen::VectorXd& misfits : found.largest) {
        rows.misfits.residuals.segment(at, misfits.size()) = misfits;
        at += misfits.size();
    }
    return rows;
}

void Verifier::verify(const Genome& genome, Verification& result) const {
    std::vector<Eigen::VectorXd> own_steps;
    const auto responses = [&](Index nodes, std::size_t which, std::vector<Response>& shown) {
        Responses solved = responses_on(refined(setup_.model, nodes), genome);
        DesignResponse all = design_response(finer(), solved.all);
        result.misfits[which + 2] = misfits_of(finer(), all);
        result.misfits[which] = misfits_of(setup_, design_response(setup_, solved.own));
        own_steps = relative_values(finer(), design_response(finer(), solved.own));
        shown = std::move(solved.own);
        return all;
    };
    const std::vector<Eigen::VectorXd> on_grid = relative_values(finer(), responses(1, 0, result.on_grid));
    std::vector<Eigen::VectorXd> between = on_grid; // on the grid between
    if (by_.nodes > 2)
        between = relative_values(
            finer(), design_response(finer(), responses_on(refined(setup_.model, by_.nodes / 2), genome).all));
    const DesignResponse fine = responses(by_.nodes, 1, result.on_finer);
    const std::vector<Eigen::VectorXd> finest = relative_values(finer(), fine);
    for (std::size_t t = 0; t < finest.size(); ++t) {
        const Target& target = finer().targets[t];
        const Response& response = fine.responses[target.against_pressure() ? 0 : fine.responses.size() - 1];
        const Eigen::VectorXd error = with_neighbours((own_steps[t] - finest[t]).cwiseAbs()) / (by_.steps - 1) +
                                      error_left(on_grid[t], between[t], finest[t]);
        const Eigen::MatrixX2d range =
            range_in_step(target, response, fine.curves[t], refined(setup_.model.grid, by_.nodes).shape().nodes());
        const auto moved_by = [&](const Eigen::VectorXd& by) {
            return misfit(target, (finest[t] + by).cwiseProduct(target.y).eval());
        };
        const Eigen::VectorXd down = moved_by(range.col(0) - error), up = moved_by(range.col(1) + error);
        result.largest.emplace_back((up.cwiseAbs().array() > down.cwiseAbs().array()).select(up, down));
    }
}

Verification Verifier::of(const Genome& genome) const {
    if (auto before = known(genome)) return *before;
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
