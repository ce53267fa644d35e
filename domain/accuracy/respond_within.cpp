#include "domain/accuracy/respond_within.hpp"

#include "domain/errors.hpp"
#include "domain/numerics/fourier.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/profile/roughness.hpp"
#include "ga/base/stopwatch.hpp"

namespace rough {
namespace {

/// Shares of the requested accuracy; the remaining share is left to the grid.
constexpr double step_share = 0.25, solver_share = 0.05;
/// Range of the solvers' tolerances.
constexpr double min_tolerance = 1e-10, max_tolerance = 0.01;
/// Widest window of omitted waves, as a share of load step times accuracy. A secant's bound is then
/// about a fifth of the accuracy.
constexpr double window_share = 1.0 / 16;
/// Elements of the coarsest grid per shortest wave; fewer do not show the profile.
constexpr double first_elements_per_wave = 4.5;
constexpr Index min_elements = 48;
/// Grids are sqrt(2) apart; a line is drawn through the last four.
constexpr double grid_ratio = 1.4142135623730951;
constexpr std::size_t grids_in_line = 4, min_grids_in_line = 3;
/// Largest share of the resolved grid's elements at which a coarser grid still saves time.
constexpr double finest_share = 0.6;
/// The estimate falls as N^-2. Coarser grids are given up if it would meet the accuracy only beyond
/// `patience` times the finest grid's elements. Estimates are erratic, so this is above 1.
constexpr double estimate_order = 2, patience = 1.3;
/// Largest share of the whole curve's cost on the resolved grid at which a part of it is solved there.
constexpr double max_cost_share = 0.8;
/// Usual largest number of nodes in contact on a resolved grid that are not on a far finer one, or of missing
/// ones. A solution with an error of displacements above `exact_share` has no more wrong.
constexpr double miscounted = 4, exact_share = 1e-9;

/// The elements around a resolved grid's nodes make up a body. This is a grid of `elements` equal ones over
/// the same body, nodes in their middle. Coarse nodes from end to end would make the body longer by half an
/// element at each end, which is an error of first order.
Grid cells(const Grid& resolved, Index elements) {
    if (resolved.periodic) return {elements, resolved.length, true, resolved.from};
    const double overhang = 0.5 * resolved.spacing();
    const double spacing = (resolved.length + 2 * overhang) / static_cast<double>(elements);
    return {elements, spacing * static_cast<double>(elements - 1), false, resolved.from - overhang + 0.5 * spacing};
}

/// Largest relative error of a quantity that grows from row to row. The error of each displacement is at most
/// its `share`, that of the contact fraction at most `wrong`.
double largest_change(const Response& rows, const Eigen::VectorXd& values, const Eigen::VectorXd& share, double wrong) {
    const Eigen::VectorXd lengths = differences(rows.displacement), changes = differences(values),
                          joined = differences(rows.contact_fraction);
    const Index last = rows.steps() - 1;
    double worst = 0;
    for (Index j = 0; j <= last; ++j)
        for (const Index k : {std::min(std::max<Index>(j, 1), last), std::min(j + 1, last)}) { // around the row
            const double part =
                share[j] * rows.displacement[j] / lengths[k] + (wrong < joined[k] ? wrong / joined[k] : wrong > 0);
            worst = std::max(worst, part * changes[k] / values[j]);
        }
    return worst;
}

/// The model, with a solver's tolerance that takes no more than its share of the accuracy.
Model tolerant(Model model) {
    if (!(model.accuracy >= 0) || model.accuracy > 1)
        refuse_value("accuracy", model.accuracy, " is out of range (more than 0, at most 1)");
    if (model.accuracy == 0) return model;
    if (model.body.yields() || !model.body.layering.layers.empty())
        refuse_value("accuracy", "its bounds do not hold with a hardness or layers; omit one of the two");
    const auto steps =
        static_cast<double>(std::max(model.loading.pressures.size(), static_cast<std::size_t>(model.loading.steps)));
    model.contact.tolerance = std::min(
        model.contact.tolerance, std::clamp(solver_share * model.accuracy / (2 * steps), min_tolerance, max_tolerance));
    return model;
}

Response response_of(const LoadRows& rows) { return response_of(rows.steps, rows.solver, 0); }

/// The coarser grids solved so far.
struct Ladder {
    std::vector<Index> elements;
    std::vector<Response> responses;

    Index line() const { return static_cast<Index>(std::min(elements.size(), grids_in_line)); }
    std::vector<Index> last() const { return {elements.end() - line(), elements.end()}; }
    /// The first `count` rows of a quantity, one column for each of the last grids.
    Eigen::MatrixXd last(Eigen::VectorXd Response::*quantity, Index count) const {
        Eigen::MatrixXd table(count, line());
        for (Index grid = 0; grid < line(); ++grid)
            table.col(grid) = (responses.end()[grid - line()].*quantity).head(count);
        return table;
    }
};

/// The curve of one surface, sampled on the resolved grid as `whole`, which must outlive it.
class AccuracySolver {
  public:
    AccuracySolver(const Profile& whole, const Model& resolved)
        : model_(tolerant(resolved)), accuracy_(model_.accuracy), whole_(whole) {
        if (model_.loading.pressures.empty())
            rows_ = step_displacements(whole_, model_.body, model_.loading, model_.contact);
        else { // finding their displacements solves them
            static_cast<ContactCurve&>(step_curve_) =
                solve_load_steps(whole_, model_.body, model_.loading, model_.contact);
            rows_ = column(step_curve_.steps, &LoadStep::displacement);
        }
        step_curve_.solved = static_cast<int>(step_curve_.steps.size());
        count_ = static_cast<Index>(rows_.size());
        response_.range = displacement_range(whole_, resolved.body.kernel);
        response_.full_stiffness = full_contact_stiffness(whole_, resolved.body, model_.contact.threads);
        account_.accuracy = accuracy_;
        account_.resolved_nodes = whole_.nodes();
        account_.rows = static_cast<int>(count_);
        account_.tolerance = model_.contact.tolerance;
    }

    /// Widest window of omitted waves that is worth a try, mm.
    double widest_window() const { return window_share * accuracy_ * rows_.front(); }

    /// Answers from coarser grids. The first rows, with slight contact, come from the resolved grid: coarse
    /// grids are least accurate there, and fine ones cheap. False if that does not pay.
    bool by_coarser_grids(const SumOfWaves& surface) {
        if (!step_curve_.steps.empty()) return false;
        const Window& window = surface.window;
        const double waves =
            model_.grid.length / std::ranges::min(surface.used, {}, &PlacedWave::wave_length_mm).wave_length_mm;
        const double first = std::max<double>(min_elements, first_elements_per_wave * waves);
        const double finest = finest_share * resolved_nodes();
        if (first * std::pow(grid_ratio, min_grids_in_line - 2) >= finest) // no room for a line
            return false;
        const double highest = (window.width() > 0 ? surface.on(model_.grid) : whole_).heights.maxCoeff();
        Ladder ladder;
        for (double next = first; next < grid_ratio * finest; next *= grid_ratio) {
            const Index elements = fast_fourier_length(std::lround(std::min(next, finest)));
            const std::optional<LoadRows> rows = rows_on(cells(model_.grid, elements), surface, highest);
            if (!rows) continue;
            const Response response = response_of(*rows);
            account_.grids.push_back(elements);
            ladder.elements.push_back(elements);
            ladder.responses.push_back(response);
            if (ladder.elements.size() < min_grids_in_line) continue;
            const Extrapolation found =
                extrapolate(ladder.last(), ladder.last(&Response::pressure, count_), whole_.nodes());
            const Sources sources{found.doubt, dropped_doubt(window, *rows, found.pressure),
                                  solver_doubt(response, count_, response.kkt_residual)};
            const ErrorScale scale = error_scale(found.pressure);
            const Index known = rows_to_know(sources.together(), scale, accuracy_ - rows->error);
            const auto cost_on = [&](double nodes, Index count) {
                const double touching = count == 0 ? 0 : response.contact_fraction[count - 1];
                return predicted_cost(nodes, touching * nodes, static_cast<double>(count));
            };
            const bool last = next >= finest || hopeless(relative(found.doubt, scale), elements, finest);
            const double cost_without = last ? max_cost_share * cost_on(resolved_nodes(), count_)
                                             : cost_on(std::min(next * grid_ratio, finest), count_);
            if (known < count_ && cost_on(resolved_nodes(), known) <= cost_without &&
                answer_with(ladder, found, sources, *rows, known))
                return true;
            if (last) return false;
        }
        return false;
    }

    /// Answers from the resolved grid, on which `wrong` nodes may be miscounted by an exact solution.
    void by_resolved_grid(double wrong) {
        const LoadRows rows = step_curve_.steps.empty() ? resolved(rows_) : step_curve_;
        response_ = response_of(rows.steps, rows.solver, response_.range, response_.full_stiffness);
        last_contact_ = rows.last_contact;
        account_.grids.push_back(whole_.nodes());
        account_.solver = rows.solver;
        account_.solved_rows = rows.solved;
        account_.resolved_rows = static_cast<int>(count_);
        account_.step_error = rows.error;
        account_.held_nodes = response_.held_nodes;
        const Eigen::VectorXd share = displacement_errors(response_, model_.loading);
        account_.solver_error =
            relative(solver_doubt(response_, count_, share), error_scale(response_.pressure, 0)).maxCoeff();
        account_.grid_error = account_.dropped_error = 0; // no coarser grid is used
        take_counting_errors(share, share.maxCoeff() > exact_share ? miscounted : wrong);
        account_.area_error += rows.area_error;
        account_.tangent_error += rows.tangent_error;
        if (!is_direct(rows.solver)) // H w = 1 is solved to the tolerance
            account_.tangent_error += model_.contact.tolerance;
        account_.estimated_error = account_.step_error + account_.solver_error;
    }

    ReportedResponse answer() {
        response_.displacement = Eigen::Map<const Eigen::VectorXd>(rows_.data(), count_);
        account_.seconds = clock_.seconds();
        return {std::move(response_), std::move(account_), std::move(last_contact_)};
    }

  private:
    /// Sources of a curve's errors.
    struct Sources {
        Doubt grid, dropped, solver;
        Doubt together() const { return grid + dropped + solver; }
    };

    double resolved_nodes() const { return static_cast<double>(whole_.nodes()); }

    LoadRows resolved(const std::vector<double>& rows) const {
        return solve_rows(whole_, model_.body, rows, model_.contact, whole_.is_2d() ? 0 : step_share * accuracy_);
    }

    /// Sets the errors of contact fractions and tangents. The error of each displacement is at most its
    /// `share`, and at most `wrong` nodes are miscounted.
    void take_counting_errors(const Eigen::VectorXd& share, double wrong) {
        const Eigen::VectorXd& fraction = response_.contact_fraction;
        wrong /= resolved_nodes();
        account_.area_error = largest_change(response_, fraction, share, 0) + wrong / fraction.minCoeff();
        account_.tangent_error = largest_change(response_, response_.tangent_stiffness, share, wrong);
    }

    /// Whether half the rows would need more elements than there may be.
    bool hopeless(Eigen::VectorXd errors, Index elements, double finest) const {
        std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
        const double times = std::pow(errors[errors.size() / 2] / accuracy_, 1 / estimate_order);
        return times * static_cast<double>(elements) > patience * finest;
    }

    /// Takes the curve from the grids and its first `known` rows from the resolved grid. False if it is then
    /// not within the accuracy.
    bool answer_with(const Ladder& ladder, const Extrapolation& found, const Sources& sources, const LoadRows& rows,
                     Index known) {
        const LoadRows first = resolved({rows_.begin(), rows_.begin() + known});
        const auto joined = [&, known_rows = response_of(first)](Eigen::VectorXd values, auto quantity) {
            values.head(known) = known_rows.*quantity;
            return values;
        };
        const double offset = known == 0 ? 0 : first.steps.back().pressure - found.pressure[known - 1];
        response_.pressure = joined(found.pressure.array() + offset, &Response::pressure);
        const ErrorScale scale = error_scale(response_.pressure);
        const auto error = [&](const Doubt& doubt, double moved) {
            return relative(doubt.known_up_to(known, moved), scale).maxCoeff();
        };
        account_.grid_error = error(sources.grid, offset);
        account_.dropped_error = error(sources.dropped, 0);
        account_.solver_error = error(sources.solver, 0);
        account_.step_error = std::max(rows.error, first.error);
        const auto read = [&](auto quantity) {
            return extrapolate(ladder.last(), ladder.last(quantity, count_), whole_.nodes(), 1);
        };
        const Extrapolation area = read(&Response::contact_fraction);
        const Extrapolation tangent = read(&Response::tangent_stiffness);
        response_.contact_fraction = joined(area.pressure.cwiseMin(1), &Response::contact_fraction);
        response_.tangent_stiffness = joined(tangent.pressure, &Response::tangent_stiffness);
        response_.displacement = Eigen::Map<const Eigen::VectorXd>(rows_.data(), count_);
        take_counting_errors(Eigen::VectorXd::Zero(count_), miscounted);
        const auto widen = [&](double& worst, const Extrapolation& of, double between) {
            const Eigen::ArrayXd doubt = of.doubt.pressure.tail(count_ - known).array();
            const Eigen::ArrayXd lowest = of.pressure.tail(count_ - known).array() - doubt;
            worst = std::max(worst, (doubt / lowest.max(0)).maxCoeff()) + between;
        };
        widen(account_.area_error, area, std::max(rows.area_error, first.area_error));
        widen(account_.tangent_error, tangent, std::max(rows.tangent_error, first.tangent_error));
        account_.estimated_error = error(sources.together(), offset) + account_.step_error;
        if (!(account_.estimated_error <= accuracy_)) return false;
        response_.kkt_residual = joined(ladder.responses.back().kkt_residual.head(count_), &Response::kkt_residual);
        account_.solver = response_.solver = rows.solver;
        account_.solved_rows = rows.solved;
        account_.resolved_rows = static_cast<int>(known);
        if (const Index light = light_rows(response_.pressure); light > known)
            account_.light_rows = static_cast<int>(light);
        account_.read_grids = static_cast<int>(ladder.line());
        return true;
    }

    /// The rows on a grid, in the middle of the window, at displacements from the resolved profile's highest
    /// node. An open window needs one more row, beyond the last. Nothing if the grid's profile is in full
    /// contact before the last row.
    std::optional<LoadRows> rows_on(const Grid& grid, const SumOfWaves& surface, double highest) const {
        const Window& window = surface.window;
        const Profile profile = surface.on(grid);
        std::vector<double> at = rows_;
        if (window.width() > 0 && !grid.periodic) at.push_back(rows_.back() + window.width());
        const double shift = highest - profile.heights.maxCoeff() + 0.5 * (window.lowest + window.highest);
        for (double& displacement : at) displacement -= shift;
        if (grid.periodic && at.back() >= displacement_range(profile, Kernel::periodic)) return std::nullopt;
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
        if (window.width() == 0) return {Eigen::VectorXd::Zero(count_), Eigen::VectorXd::Zero(count_)};
        const double half = 0.5 * window.width();
        const Bounds bounds = pressure_bounds(rows.steps, count_, {-half, half});
        const Eigen::VectorXd correction = pressure - response_of(rows).pressure.head(count_);
        return doubt_of(pressure, bounds.lower + correction, bounds.upper + correction);
    }

    ga::Stopwatch clock_;
    Model model_;
    double accuracy_;
    const Profile& whole_;
    LoadRows step_curve_; ///< the load steps at given pressures
    std::vector<double> rows_;
    Index count_;
    Response response_;
    AccuracyReport account_;
    std::vector<int> last_contact_;
};

/// The curve of the line that replaces a periodic map: at the map's displacements, or at the line's if
/// pressures were requested. Nothing if the line cannot be pressed as far as the map. The errors follow from
/// pressure_bounds(). They are proven for the continuum, not for sampled maps (README.md).
std::optional<ReportedResponse> respond_by_line(const Profile& map, const Model& model) {
    const Loading& loading = model.loading;
    const bool by_reach = loading.pressures.empty() && !loading.to_pressure;
    const LineOfMap of = line_of_map(map);
    ReportedResponse result;
    AccuracyReport& account = result.account;
    const Eigen::VectorXd& pressure = result.response.pressure;
    try {
        const auto displacements = step_displacements(by_reach ? map : of.line, model.body, loading, model.contact);
        ContactCurve curve = solve_contact(of.line, model.body, displacements, model.contact);
        result.response = response_of(curve.steps, curve.solver, displacement_range(map, model.body.kernel), HUGE_VAL);
        result.last_contact = std::move(curve.last_contact);
        const Bounds bounds = pressure_bounds(of.line, of.window, model.body, displacements, model.contact);
        const Doubt solved =
            solver_doubt(result.response, pressure.size(), displacement_errors(result.response, loading));
        // The bounds have the solver's error, too.
        const Eigen::VectorXd errors =
            relative(doubt_of(pressure, bounds.lower, bounds.upper) + solved + solved, error_scale(pressure));
        account.estimated_error = errors.allFinite() ? errors.maxCoeff() : HUGE_VAL;
    } catch (const InputError&) { // flat, or in full contact before the map is
        return std::nullopt;
    }
    account.accuracy = model.accuracy;
    account.by_line = true;
    account.resolved_nodes = map.nodes();
    account.grids = {of.line.nodes()};
    account.rows = account.solved_rows = static_cast<int>(pressure.size());
    account.light_rows = static_cast<int>(light_rows(pressure));
    account.window = of.window;
    account.solver = result.response.solver;
    account.tolerance = model.contact.tolerance;
    account.line_error = account.dropped_error = account.estimated_error;
    account.area_error = account.tangent_error = account.window.width() > 0 ? std::nan("") : 0;
    return result;
}

} // namespace

ReportedResponse respond_within(const Profile& whole, const SumOfWaves& surface,
                                const std::function<SumOfWaves(double widest)>& without_short_waves,
                                const Model& model) {
    AccuracySolver solver(whole, model);
    const bool exact = model.accuracy == 0;
    SumOfWaves answering = exact ? surface : without_short_waves(solver.widest_window());
    bool answered = !exact && solver.by_coarser_grids(answering);
    if (!answered && !answering.dropped.empty()) {
        answering = surface;
        answered = solver.by_coarser_grids(answering);
    }
    if (!answered) solver.by_resolved_grid(exact ? 0 : miscounted);
    ReportedResponse result = solver.answer();
    result.account.used = answering.used;
    result.account.dropped = answering.dropped;
    result.account.window = answering.window;
    return result;
}

ReportedResponse respond_within(const Profile& scan, const Model& given) {
    const ga::Stopwatch clock;
    const Model model = tolerant(given);
    const bool periodic_map = scan.is_2d() && model.accuracy > 0 && model.body.kernel == Kernel::periodic;
    const auto by_line = periodic_map ? respond_by_line(scan, model) : std::nullopt;
    ReportedResponse result;
    if (by_line && by_line->account.line_error <= model.accuracy) {
        result = *by_line;
    } else {
        AccuracySolver solver(scan, given);
        solver.by_resolved_grid(0);
        result = solver.answer();
        if (by_line && model.loading.pressures.empty() && !model.loading.to_pressure)
            result.account.line_error = relative_error(by_line->response.pressure, result.response.pressure);
    }
    if (periodic_map) result.account.aspect_ratio = texture(scan, true).Str;
    result.account.seconds = clock.seconds();
    return result;
}

} // namespace rough
