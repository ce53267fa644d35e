#include "domain/accuracy/respond_within.hpp"

#include "domain/accuracy/error_bounds.hpp"
#include "domain/accuracy/extrapolation.hpp"
#include "domain/accuracy/line_of_map.hpp"
#include "domain/accuracy/load_rows.hpp"
#include "domain/accuracy/respond.hpp"
#include "domain/contact/full_contact.hpp"
#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/profile/roughness.hpp"
#include "ga/base/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

namespace rough {

namespace {

// Shares of the accuracy asked for; the grid may take what the others leave.
constexpr double step_share = 0.25, solver_share = 0.05;
/// What solvers take.
constexpr double least_tolerance = 1e-10, most_tolerance = 0.01;
/// Widest window of dropped chromosomes, in load steps and units of the accuracy: it makes a secant's bound a
/// fifth of the accuracy or so.
constexpr double window_share = 1.0 / 16;
/// Elements of the coarsest grid to the finest feature: fewer do not see the profile.
constexpr double first_elements_per_feature = 4.5;
constexpr Index fewest_elements = 48;
/// Grids are sqrt(2) apart; a line is drawn through the last four.
constexpr double grid_ratio = 1.4142135623730951;
constexpr std::size_t grids_in_line = 4, fewest_in_line = 3;
/// Beyond this part of the resolved grid's elements, grids no longer pay.
constexpr double finest_part = 0.6;
/// Coarser grids are given up when the estimate, falling as N^-2, would meet the accuracy only at so many
/// times the finest grid's elements; estimates are erratic.
constexpr double estimate_order = 2, patience = 1.3;
/// The resolved grid's part of an answer may cost so much of the whole curve there.
constexpr double worth_while = 0.8;

/// Something with a height everywhere, to be sampled on any grid.
struct Surface {
    std::function<Profile(const Grid&)> sampled; ///< heights, mm
    double finest_feature = 0; ///< mm: on grids much coarser the surface is not to be recognised
};

Surface surface_of(const Genome& genome) {
    return {[genome](const Grid& grid) { return sample(genome, grid); }, shortest_wave(genome)};
}

/// The elements around a resolved grid's nodes make up a body; `elements` equal ones over the same body,
/// their nodes in the middle. A coarse grid of nodes from end to end would be a longer body than a fine one,
/// since half an element hangs over at either end, and err by that to first order.
Grid cells(const Grid& resolved, Index elements) {
    if (resolved.periodic)
        return {elements, resolved.length, true, resolved.from};
    const double overhang = 0.5 * resolved.spacing();
    const double spacing = (resolved.length + 2 * overhang) / static_cast<double>(elements);
    return {elements, spacing * static_cast<double>(elements - 1), false,
            resolved.from - overhang + 0.5 * spacing};
}

template <typename Member>
Eigen::VectorXd column(const std::vector<LoadStep>& steps, Index count, Member member) {
    Eigen::VectorXd values(count);
    for (Index j = 0; j < count; ++j)
        values[j] = static_cast<double>(steps[static_cast<std::size_t>(j)].*member);
    return values;
}

/// By the lemma of README.md, pressures that leave gaps and penetrations of at most r Delta belong to
/// displacements at most r Delta away.
Doubt solver_doubt(const std::vector<LoadStep>& steps, Index count) {
    Eigen::VectorXd off(count);
    for (Index j = 0; j < count; ++j) {
        const auto at = static_cast<std::size_t>(j);
        const LoadStep& beyond = steps[std::min(at + 1, steps.size() - 1)];
        off[j] = steps[at].kkt_residual * steps[at].displacement * beyond.tangent_stiffness;
    }
    return doubt_of(off, Eigen::VectorXd::Zero(count), 2 * off);
}

/// What a curve costs on so many nodes, of which a part touches at its last step.
double cost(double nodes, double fraction, double rows) {
    return predicted_cost(nodes, fraction * nodes, rows);
}

/// The set-up with a solver's tolerance that takes no more than its share of an accuracy, 0: none.
Model tolerant(Model model, double accuracy) {
    if (accuracy > 0 && (model.body.yields() || !model.body.layering.layers.empty()))
        throw InputError(
            "accuracy: given with a hardness or layers, expected one of them: the bounds that an "
            "accuracy rests on do not hold where pressures are held, or under layers");
    const auto steps = static_cast<double>(
        std::max(model.loading.pressures.size(), static_cast<std::size_t>(model.loading.steps)));
    if (accuracy > 0)
        model.contact.tolerance =
            std::min(model.contact.tolerance,
                     std::clamp(solver_share * accuracy / (2 * steps), least_tolerance, most_tolerance));
    return model;
}

/// What the grids solved so far say, one column a grid.
struct Ladder {
    std::vector<Index> elements;
    Eigen::MatrixXd pressure, fraction, tangent;

    void add(Index grid, const std::vector<LoadStep>& steps, Index count) {
        elements.push_back(grid);
        for (auto [table, values] :
             {std::pair{&pressure, column(steps, count, &LoadStep::pressure)},
              std::pair{&fraction, column(steps, count, &LoadStep::contact_fraction)},
              std::pair{&tangent, column(steps, count, &LoadStep::tangent_stiffness)}}) {
            table->conservativeResize(count, table->cols() + 1);
            table->rightCols(1) = values;
        }
    }
    Index line() const { return static_cast<Index>(std::min(elements.size(), grids_in_line)); }
    std::vector<Index> last() const { return {elements.end() - line(), elements.end()}; }
};

/// One question: a surface, its resolved profile, and the rows asked for.
class Question {
  public:
    Question(Surface surface, const Model& resolved, double accuracy)
        : surface_(std::move(surface)), model_(tolerant(completed(resolved), accuracy)), accuracy_(accuracy),
          whole_(surface_.sampled(model_.grid)), highest_(whole_.heights.maxCoeff()), pressed_(pressed()),
          rows_(displacements()), count_(static_cast<Index>(rows_.size())) {
        response_.range = displacement_range(whole_, resolved.body.kernel);
        response_.full_stiffness = full_contact_stiffness(whole_, resolved.body);
        response_.displacement = Eigen::Map<const Eigen::VectorXd>(rows_.data(), count_);
        account_.accuracy = accuracy;
        account_.resolved_nodes = whole_.nodes();
        account_.rows = static_cast<int>(count_);
        account_.tolerance = model_.contact.tolerance;
    }

    const Profile& whole() const { return whole_; }
    /// Widest window of dropped chromosomes that is worth a try, mm.
    double widest_window() const { return window_share * accuracy_ * rows_.front(); }

    /// Answers from coarser grids of the surface, which may lack short waves, and from the resolved grid for
    /// the first rows, where contact is slight: these are the hardest for coarse grids and the cheapest for
    /// fine ones. False if that is not worth it.
    bool by_coarser_grids(const Surface& surface, const Window& window) {
        if (!pressed_.steps.empty())
            return false;
        const double features = model_.grid.length / surface.finest_feature;
        const double first = std::max<double>(fewest_elements, first_elements_per_feature * features);
        const double finest = finest_part * resolved_nodes();
        if (first * std::pow(grid_ratio, fewest_in_line - 2) >= finest) // no room for a line
            return false;
        const double highest =
            window.width() > 0 ? surface.sampled(model_.grid).heights.maxCoeff() : highest_;
        Ladder ladder;
        for (double next = first; next < grid_ratio * finest; next *= grid_ratio) {
            const Index elements = fast_fourier_length(std::lround(std::min(next, finest)));
            const std::optional<LoadRows> rows =
                rows_on(cells(model_.grid, elements), surface, highest, window);
            if (!rows)
                continue;
            account_.grids.push_back(elements);
            ladder.add(elements, rows->steps, count_);
            if (ladder.elements.size() < fewest_in_line)
                continue;
            const Extrapolation found =
                extrapolate(ladder.last(), ladder.pressure.rightCols(ladder.line()), whole_.nodes());
            const Sources sources{found.doubt, dropped_doubt(window, *rows, found.pressure),
                                  solver_doubt(rows->steps, count_)};
            const ErrorScale scale = error_scale(found.pressure);
            const double allowed = accuracy_ - rows->error;
            const Index known = rows_to_know(sources.together(), scale, allowed);
            const auto touching = [&](Index row) {
                return row == 0 ? 0 : ladder.fraction(row - 1, ladder.fraction.cols() - 1);
            };
            const double costs = cost(resolved_nodes(), touching(known), static_cast<double>(known));
            const double finer = std::min(next * grid_ratio, finest);
            const bool last = next >= finest || hopeless(relative(found.doubt, scale), elements, finest);
            const double stays =
                last ? worth_while * cost(resolved_nodes(), touching(count_), static_cast<double>(count_))
                     : cost(finer, touching(count_), static_cast<double>(count_));
            if (known < count_ && costs <= stays && answer_with(ladder, found, sources, *rows, known))
                return true;
            if (last)
                return false;
        }
        return false;
    }

    void by_resolved_grid() {
        const LoadRows rows = pressed_.steps.empty() ? resolved(rows_) : pressed_;
        last_contact_ = rows.last_contact;
        account_.grids.push_back(whole_.nodes());
        account_.solver = response_.solver = rows.solver;
        account_.solved_rows = rows.solved;
        account_.resolved_rows = static_cast<int>(count_);
        account_.step_error = rows.error;
        account_.area_error = rows.area_error;
        account_.held_nodes = response_.held_nodes = rows.steps.back().held_nodes;
        response_.pressure = column(rows.steps, count_, &LoadStep::pressure);
        response_.contact_fraction = column(rows.steps, count_, &LoadStep::contact_fraction);
        response_.tangent_stiffness = column(rows.steps, count_, &LoadStep::tangent_stiffness);
        response_.kkt_residual = column(rows.steps, count_, &LoadStep::kkt_residual);
        account_.solver_error =
            relative(solver_doubt(rows.steps, count_), error_scale(response_.pressure, 0)).maxCoeff();
        account_.estimated_error = account_.step_error + account_.solver_error;
    }

    AccountedResponse answer() {
        return {std::move(response_), std::move(account_), std::move(last_contact_)};
    }

  private:
    /// What an answer's errors come from.
    struct Sources {
        Doubt grid, dropped, solver;
        Doubt together() const { return grid + dropped + solver; }
    };

    /// Estimated, of the contact fractions read off the grids from row `known` on: Extrapolation's doubt.
    double area_error(const Ladder& ladder, Index known) const {
        const Extrapolation area =
            extrapolate(ladder.last(), ladder.fraction.rightCols(ladder.line()), whole_.nodes());
        const Eigen::VectorXd least = area.pressure.cwiseMax(1 / resolved_nodes());
        return area.doubt.pressure.cwiseQuotient(least).tail(count_ - known).maxCoeff();
    }

    double resolved_nodes() const { return static_cast<double>(whole_.nodes()); }

    /// The load steps at given pressures: to find their displacements is to solve them.
    LoadRows pressed() const {
        const std::vector<double>& pressures = model_.loading.pressures;
        if (pressures.empty())
            return {};
        ContactCurve curve = press(whole_, model_.body, model_.loading, model_.contact);
        return {std::move(curve.steps),       0, 0, static_cast<int>(pressures.size()), curve.solver,
                std::move(curve.last_contact)};
    }
    std::vector<double> displacements() const {
        if (pressed_.steps.empty())
            return step_displacements(whole_, model_.body, model_.loading, model_.contact);
        std::vector<double> found;
        for (const LoadStep& step : pressed_.steps)
            found.push_back(step.displacement);
        return found;
    }
    LoadRows resolved(const std::vector<double>& rows) const {
        return solve_rows(whole_, model_.body, rows, model_.contact,
                          whole_.is_2d() ? 0 : step_share * accuracy_);
    }

    /// Whether half the rows would need more elements than there may be.
    bool hopeless(Eigen::VectorXd errors, Index elements, double finest) const {
        std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
        const double times = std::pow(errors[errors.size() / 2] / accuracy_, 1 / estimate_order);
        return times * static_cast<double>(elements) > patience * finest;
    }

    /// Takes the answer from the grids, its first rows from the resolved one; false if it is not within the
    /// accuracy then.
    bool answer_with(const Ladder& ladder, const Extrapolation& found, const Sources& sources,
                     const LoadRows& rows, Index known) {
        const LoadRows first = resolved({rows_.begin(), rows_.begin() + known});
        const auto joined = [&](Eigen::VectorXd values, auto member) {
            values.head(known) = column(first.steps, known, member);
            return values;
        };
        const double offset = known == 0 ? 0 : first.steps.back().pressure - found.pressure[known - 1];
        response_.pressure = joined(found.pressure.array() + offset, &LoadStep::pressure);
        const ErrorScale scale = error_scale(response_.pressure);
        const auto error = [&](const Doubt& doubt, double moved) {
            return relative(doubt.known_up_to(known, moved), scale).maxCoeff();
        };
        account_.grid_error = error(sources.grid, offset);
        account_.dropped_error = error(sources.dropped, 0);
        account_.solver_error = error(sources.solver, 0);
        account_.step_error = std::max(rows.error, first.error);
        account_.area_error = area_error(ladder, known) + std::max(rows.area_error, first.area_error);
        account_.estimated_error = error(sources.together(), offset) + account_.step_error;
        if (!(account_.estimated_error <= accuracy_))
            return false;
        const auto read = [&](const Eigen::MatrixXd& values) -> Eigen::VectorXd {
            return extrapolated(ladder.last(), values.rightCols(ladder.line()), whole_.nodes(), 1)
                .cwiseMax(0);
        };
        response_.contact_fraction = joined(read(ladder.fraction).cwiseMin(1), &LoadStep::contact_fraction);
        response_.tangent_stiffness = joined(read(ladder.tangent), &LoadStep::tangent_stiffness);
        response_.kkt_residual =
            joined(column(rows.steps, count_, &LoadStep::kkt_residual), &LoadStep::kkt_residual);
        account_.solver = response_.solver = rows.solver;
        account_.solved_rows = rows.solved;
        account_.resolved_rows = static_cast<int>(known);
        if (const Index light = light_rows(response_.pressure); light > known)
            account_.light_rows = static_cast<int>(light);
        account_.read_grids = static_cast<int>(ladder.line());
        return true;
    }

    /// The rows on a grid, at displacements from the resolved profile's highest node, in the middle of the
    /// window, and one more beyond the last where the window asks for it. Nothing where the grid's own
    /// profile is in full contact before the last row.
    std::optional<LoadRows> rows_on(const Grid& grid, const Surface& surface, double highest,
                                    const Window& window) const {
        const Profile profile = surface.sampled(grid);
        std::vector<double> at = rows_;
        if (window.width() > 0 && !grid.periodic)
            at.push_back(rows_.back() + window.width());
        const double shift = highest - profile.heights.maxCoeff() + 0.5 * (window.lowest + window.highest);
        for (double& displacement : at)
            displacement -= shift;
        if (grid.periodic && at.back() >= displacement_range(profile, Kernel::periodic))
            return std::nullopt;
        LoadRows rows = solve_rows(profile, model_.body, at, model_.contact, step_share * accuracy_);
        // P is a mean over L, not over the body's length.
        const double factor = grid.length / model_.grid.length;
        for (LoadStep& step : rows.steps) {
            step.pressure *= factor;
            step.tangent_stiffness *= factor;
        }
        return rows;
    }

    Doubt dropped_doubt(const Window& window, const LoadRows& rows, const Eigen::VectorXd& pressure) const {
        if (window.width() == 0)
            return {Eigen::VectorXd::Zero(count_), Eigen::VectorXd::Zero(count_)};
        const double half = 0.5 * window.width();
        const Bounds bounds = pressure_bounds(rows.steps, count_, {-half, half});
        const Eigen::VectorXd correction = pressure - column(rows.steps, count_, &LoadStep::pressure);
        return doubt_of(pressure, bounds.lower + correction, bounds.upper + correction);
    }

    Surface surface_;
    Model model_;
    double accuracy_;
    Profile whole_;
    double highest_;
    LoadRows pressed_;
    std::vector<double> rows_;
    Index count_;
    Response response_;
    Account account_;
    std::vector<int> last_contact_;
};

void expect_accuracy(double accuracy) {
    if (!(accuracy > 0) || accuracy > 1)
        throw InputError("accuracy: " + std::to_string(accuracy) +
                         " given, expected more than 0 and at most 1");
}

template <typename Ask>
AccountedResponse timed(Ask ask) {
    const ga::Stopwatch clock;
    AccountedResponse result = ask();
    result.account.seconds = clock.seconds();
    return result;
}

AccountedResponse by_own_nodes(const Profile& scan, const Model& model, double accuracy) {
    return timed([&] {
        Question question({[&](const Grid&) { return scan; }, 0}, model, accuracy);
        question.by_resolved_grid();
        return question.answer();
    });
}

/// The line, if its bound is within the accuracy, or the map itself with how far the line is off.
AccountedResponse map_within(const Profile& map, const Model& asked, double accuracy) {
    const Model model = tolerant(completed(asked), accuracy);
    std::optional<ByLine> by_line;
    double aspect_ratio = std::nan("");
    if (model.body.kernel == Kernel::periodic) {
        aspect_ratio = texture(map, true).Str;
        by_line = respond_by_line(map, model);
    }
    AccountedResponse result;
    Account& account = result.account;
    if (by_line && by_line->bound <= accuracy) {
        account.accuracy = accuracy;
        account.by_line = true;
        account.resolved_nodes = map.nodes();
        account.grids = {by_line->of.line.nodes()};
        account.rows = account.solved_rows = static_cast<int>(by_line->response.steps());
        account.light_rows = static_cast<int>(light_rows(by_line->response.pressure));
        account.window = by_line->of.window;
        account.solver = by_line->response.solver;
        account.tolerance = model.contact.tolerance;
        account.line_error = account.dropped_error = account.estimated_error = by_line->bound;
        account.area_error = account.window.width() > 0 ? std::nan("") : 0;
        result.response = std::move(by_line->response);
        result.last_contact = std::move(by_line->last_contact);
    } else {
        result = by_own_nodes(map, model, accuracy);
        if (by_line && model.loading.pressures.empty() && model.loading.to_pressure == 0)
            account.line_error = relative_error(by_line->response.pressure, result.response.pressure);
    }
    account.aspect_ratio = aspect_ratio;
    return result;
}

} // namespace

Grid resolved_grid(const Genome& genome, double length, bool periodic) {
    const double elements =
        std::clamp(std::ceil(64 * length / shortest_wave(genome) - 1e-9), 4096.0, 1048576.0);
    return {static_cast<Index>(elements) + (periodic ? 0 : 1), length, periodic};
}

AccountedResponse respond_within(const Genome& genome, const Model& resolved, double accuracy) {
    expect_accuracy(accuracy);
    return timed([&] {
        Question question(surface_of(genome), resolved, accuracy);
        expect_waves(genome, question.whole());
        Selection selection =
            without_short_waves(genome, resolved.grid, question.whole(), question.widest_window());
        if (!question.by_coarser_grids(surface_of(selection.genome), selection.window)) {
            const bool all = selection.dropped.empty();
            selection = everything(genome);
            if (all || !question.by_coarser_grids(surface_of(genome), {}))
                question.by_resolved_grid();
        }
        AccountedResponse result = question.answer();
        result.account.used = selection.used;
        result.account.dropped = selection.dropped;
        result.account.window = selection.window;
        return result;
    });
}

AccountedResponse respond_within(const Profile& scan, const Model& resolved, double accuracy) {
    expect_accuracy(accuracy);
    if (scan.is_2d())
        return timed([&] { return map_within(scan, resolved, accuracy); });
    return by_own_nodes(scan, resolved, accuracy);
}

AccountedResponse respond_accounted(const Genome& genome, const Model& model) {
    return model.accuracy > 0 ? respond_within(genome, model, model.accuracy)
                              : respond_exactly(genome, model);
}

AccountedResponse respond_accounted(const Source& source, const Model& model) {
    if (source.genome)
        return respond_accounted(*source.genome, model);
    const Profile profile = source.on(model.grid);
    return model.accuracy > 0 ? respond_within(profile, model, model.accuracy)
                              : respond_exactly(profile, model);
}

AccountedResponse respond_exactly(const Genome& genome, const Model& model) {
    return timed([&] {
        Question question(surface_of(genome), model, 0);
        expect_waves(genome, question.whole());
        question.by_resolved_grid();
        AccountedResponse result = question.answer();
        result.account.used = places(genome);
        return result;
    });
}

AccountedResponse respond_exactly(const Profile& scan, const Model& model) {
    return by_own_nodes(scan, model, 0);
}

} // namespace rough
