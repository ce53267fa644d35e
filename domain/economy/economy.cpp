#include "domain/economy/economy.hpp"

#include "domain/contact/fourier.hpp"
#include "domain/economy/accuracy.hpp"
#include "domain/economy/extrapolation.hpp"
#include "domain/economy/load_rows.hpp"
#include "domain/errors.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

namespace rough {

namespace {

// Shares of the accuracy asked for; the grid may take what the others leave.
constexpr double step_share = 0.25, solver_share = 0.05;
/// Widest window of dropped chromosomes, in load steps and units of the accuracy: it makes a secant's bound a
/// fifth of the accuracy or so.
constexpr double window_share = 1.0 / 16;
/// Elements of the coarsest grid to the shortest wave: fewer do not see the profile.
constexpr double first_elements_per_wave = 6;
constexpr Index fewest_elements = 48;
/// Grids are sqrt(2) apart; a line is drawn through the last four.
constexpr double grid_ratio = 1.4142135623730951;
constexpr std::size_t grids_in_line = 4, fewest_in_line = 3;
/// Beyond this part of the resolved grid's elements, grids no longer pay.
constexpr double finest_part = 0.6;
/// Coarser grids are given up when the estimate, falling as N^-2, would meet the accuracy only at so many
/// times the finest grid's elements; estimates are erratic.
constexpr double estimate_order = 2, patience = 1.5;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The body that the resolved nodes' elements make up: it has the same ends on every grid.
struct Extent {
    double from, length; ///< mm
};
Extent extent(const Grid& resolved) {
    const double overhang = resolved.wraps ? 0 : resolved.spacing();
    return {-overhang / 2, resolved.length + overhang};
}

/// `count` equal elements over the extent, their nodes in the middle.
Grid cells(const Extent& extent, Index count, bool wraps) {
    const double spacing = extent.length / static_cast<double>(count);
    return {count, wraps ? extent.length : extent.length - spacing, wraps,
            extent.from + (wraps ? 0 : spacing / 2)};
}

ChromosomePlace place(const Genome& genome, std::size_t s, std::size_t c) {
    const Series& series = genome.series[s];
    const Chromosome& chromosome = series.chromosomes[c];
    return {s, chromosome.n, wave_length(series, chromosome.n),
            std::abs(genome.scale * wave(series, chromosome).amplitude)};
}

std::vector<ChromosomePlace> places(const Genome& genome) {
    std::vector<ChromosomePlace> all;
    for (std::size_t s = 0; s < genome.series.size(); ++s)
        for (std::size_t c = 0; c < genome.series[s].chromosomes.size(); ++c)
            all.push_back(place(genome, s, c));
    return all;
}

double shortest_wave(const Genome& genome) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const ChromosomePlace& one : places(genome))
        shortest = std::min(shortest, one.wave_length_mm);
    return shortest;
}

Genome without_waves_under(const Genome& genome, double wave_length_mm) {
    return filtered(genome, [&](std::size_t s, std::size_t c) {
        return place(genome, s, c).wave_length_mm >= wave_length_mm;
    });
}

/// Which chromosomes to model.
struct Selection {
    Genome genome;
    std::vector<ChromosomePlace> used, dropped;
    Window window;
};

Selection everything(const Genome& genome) { return {genome, places(genome), {}, {}}; }

/// Leaves out the shortest waves as long as the window stays within `widest` (mm): they are what asks for
/// fine grids.
Selection without_short_waves(const Genome& genome, const Grid& grid, const Profile& whole, double widest) {
    std::vector<ChromosomePlace> order = places(genome);
    std::sort(order.begin(), order.end(),
              [](const auto& a, const auto& b) { return a.wave_length_mm < b.wave_length_mm; });
    Selection best = everything(genome);
    double amplitude = 0;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        amplitude += order[k].amplitude_mm;
        // The window is at least about one amplitude wide; waves of equal length go together.
        if (amplitude > 2 * widest)
            break;
        const double least = order[k + 1].wave_length_mm;
        if (least == order[k].wave_length_mm)
            continue;
        const Genome reduced = without_waves_under(genome, least);
        const Genome left_out = filtered(
            genome, [&](std::size_t s, std::size_t c) { return place(genome, s, c).wave_length_mm < least; });
        Profile profile = whole;
        profile.heights -= sample(left_out, grid).heights;
        const Window window = window_between(whole, profile);
        if (window.width() <= widest)
            best = {reduced,
                    {order.begin() + static_cast<std::ptrdiff_t>(k) + 1, order.end()},
                    {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k) + 1},
                    window};
    }
    return best;
}

/// The bound of relative errors of rows whose exact pressures lie within bounds.
double bounded_error(const Eigen::VectorXd& pressure, const Bounds& bounds) {
    const ErrorScale scale = error_scale(pressure);
    const Eigen::VectorXd below = pressure - bounds.lower, above = bounds.upper - pressure;
    double worst = 0;
    for (Index j = 0; j < pressure.size(); ++j) {
        worst = std::max(worst, std::max(below[j], above[j]) / scale.pressure[j]);
        const double rise = above[j] + (j ? below[j - 1] : 0), fall = below[j] + (j ? above[j - 1] : 0);
        worst = std::max(worst, std::max(rise, fall) / scale.difference[j]);
    }
    return worst;
}

/// By the lemma of README.md, pressures that leave gaps and penetrations of at most r Delta belong to
/// displacements at most r Delta away.
double solver_error(const std::vector<LoadStep>& steps, Index count) {
    Bounds bounds{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    Eigen::VectorXd pressure(count);
    for (Index j = 0; j < count; ++j) {
        const auto at = static_cast<std::size_t>(j);
        const LoadStep& beyond = steps[std::min(at + 1, steps.size() - 1)];
        const double off = steps[at].kkt_residual * steps[at].displacement * beyond.tangent_stiffness;
        pressure[j] = steps[at].pressure;
        bounds.lower[j] = pressure[j] - off;
        bounds.upper[j] = pressure[j] + off;
    }
    return bounded_error(pressure, bounds);
}

template <typename Member>
Eigen::VectorXd column(const std::vector<LoadStep>& steps, Index count, Member member) {
    Eigen::VectorXd values(count);
    for (Index j = 0; j < count; ++j)
        values[j] = static_cast<double>(steps[static_cast<std::size_t>(j)].*member);
    return values;
}

/// One question: a genome, its resolved profile, and the rows asked for.
class Question {
  public:
    Question(const Genome& genome, const Model& resolved, double accuracy)
        : genome_(genome), model_(resolved), accuracy_(accuracy), whole_(sample(genome, resolved.grid)),
          highest_(whole_.heights.maxCoeff()), range_(displacement_range(whole_, resolved.body.kernel)),
          rows_(step_displacements(whole_, resolved.body, resolved.loading, resolved.contact)),
          count_(static_cast<Index>(rows_.size())) {
        if (is_flat(whole_, genome))
            throw InputError("profile: all heights are equal at its " + std::to_string(whole_.nodes()) +
                             " nodes, expected waves that the grid can show");
        if (accuracy > 0)
            model_.contact.tolerance = solver_share * accuracy / (2.0 * resolved.loading.steps);
        account_.accuracy = accuracy;
        account_.resolved_nodes = resolved.grid.nodes;
        account_.rows = resolved.loading.steps;
        account_.tolerance = model_.contact.tolerance;
    }

    EconomicResponse answer() {
        const Selection selection =
            without_short_waves(genome_, model_.grid, whole_, window_share * accuracy_ * rows_.front());
        if (by_coarser_grids(selection) ||
            (!selection.dropped.empty() && by_coarser_grids(everything(genome_))))
            return {response_, account_};
        return resolved();
    }

    EconomicResponse resolved() {
        const LoadRows rows = solve_rows(whole_, model_.body, rows_, model_.contact, step_share * accuracy_);
        account_.grids.push_back(model_.grid.nodes);
        account_.extrapolated = false;
        account_.used = places(genome_);
        account_.dropped.clear();
        account_.window = {};
        account_.grid_error = account_.dropped_error = 0;
        take(rows);
        response_.pressure = column(rows.steps, count_, &LoadStep::pressure);
        response_.contact_fraction = column(rows.steps, count_, &LoadStep::contact_fraction);
        response_.tangent_stiffness = column(rows.steps, count_, &LoadStep::tangent_stiffness);
        return {response_, account_};
    }

  private:
    /// What the last grid's rows tell of the answer whatever way it was found.
    void take(const LoadRows& rows) {
        account_.solver = rows.solver;
        account_.solved_rows = rows.solved;
        account_.step_error = rows.error;
        account_.solver_error = solver_error(rows.steps, count_);
        response_.range = range_;
        response_.displacement = Eigen::Map<const Eigen::VectorXd>(rows_.data(), count_);
        response_.kkt_residual = column(rows.steps, count_, &LoadStep::kkt_residual);
        response_.solver = rows.solver;
    }

    /// The rows on a grid of so many elements, at displacements from the resolved profile's highest node,
    /// and one more beyond the last where the window asks for it. Nothing where the grid's own profile is in
    /// full contact before the last row.
    std::optional<LoadRows> rows_on(const Selection& selection, Index elements) {
        const Grid grid = cells(extent(model_.grid), elements, model_.grid.wraps);
        const Profile profile = sample(selection.genome, grid);
        const double highest = selected_highest(selection);
        const double shift =
            highest - profile.heights.maxCoeff() + 0.5 * (selection.window.lowest + selection.window.highest);
        std::vector<double> at = rows_;
        if (selection.window.width() > 0 && model_.body.kernel != Kernel::periodic)
            at.push_back(rows_.back() + selection.window.width());
        for (double& displacement : at)
            displacement -= shift;
        if (grid.wraps && at.back() >= displacement_range(profile, Kernel::periodic))
            return std::nullopt;
        LoadRows rows = solve_rows(profile, model_.body, at, model_.contact, step_share * accuracy_);
        // P is a mean over L, not over the extent.
        const double factor =
            grid.wraps ? 1 : profile.spacing * static_cast<double>(elements - 1) / model_.grid.length;
        for (LoadStep& step : rows.steps) {
            step.pressure *= factor;
            step.tangent_stiffness *= factor;
        }
        return rows;
    }

    /// The highest node of the selected chromosomes on the resolved grid, mm.
    double selected_highest(const Selection& selection) const {
        return selection.dropped.empty() ? highest_
                                         : sample(selection.genome, model_.grid).heights.maxCoeff();
    }

    double dropped_error(const Selection& selection, const LoadRows& rows, const Eigen::VectorXd& pressure) {
        if (selection.dropped.empty())
            return 0;
        const double half = 0.5 * selection.window.width();
        Bounds bounds = pressure_bounds(rows.steps, count_, {-half, half});
        const Eigen::VectorXd own = column(rows.steps, count_, &LoadStep::pressure);
        bounds.lower += pressure - own;
        bounds.upper += pressure - own;
        return bounded_error(pressure, bounds);
    }

    bool by_coarser_grids(const Selection& selection) {
        const auto resolved = static_cast<double>(whole_.nodes());
        const double from =
            std::max(static_cast<double>(fewest_elements),
                     first_elements_per_wave * model_.grid.length / shortest_wave(selection.genome));
        std::vector<Index> grids;
        Eigen::MatrixXd pressures, fractions, tangents;
        for (int k = 0;; ++k) {
            const Index elements =
                fast_fourier_length(static_cast<Index>(std::lround(from * std::pow(grid_ratio, k))));
            if (static_cast<double>(elements) > finest_part * resolved)
                return false;
            const std::optional<LoadRows> solved = rows_on(selection, elements);
            if (!solved)
                continue;
            const LoadRows& rows = *solved;
            account_.grids.push_back(elements);
            grids.push_back(elements);
            for (auto [table, member] : {std::pair{&pressures, &LoadStep::pressure},
                                         std::pair{&fractions, &LoadStep::contact_fraction},
                                         std::pair{&tangents, &LoadStep::tangent_stiffness}}) {
                table->conservativeResize(count_, table->cols() + 1);
                table->rightCols(1) = column(rows.steps, count_, member);
            }
            if (grids.size() < fewest_in_line)
                continue;
            const auto in_line = static_cast<Index>(std::min(grids.size(), grids_in_line));
            const std::vector<Index> line(grids.end() - in_line, grids.end());
            const Extrapolation found = extrapolate(line, pressures.rightCols(in_line), whole_.nodes());
            account_.grid_error = found.error;
            account_.dropped_error = dropped_error(selection, rows, found.pressure);
            take(rows);
            if (account_.estimated_error() <= accuracy_) {
                response_.pressure = found.pressure;
                response_.contact_fraction =
                    extrapolated(line, fractions.rightCols(in_line), whole_.nodes(), 1)
                        .cwiseMax(0)
                        .cwiseMin(1);
                response_.tangent_stiffness =
                    extrapolated(line, tangents.rightCols(in_line), whole_.nodes(), 1).cwiseMax(0);
                account_.extrapolated = true;
                account_.used = selection.used;
                account_.dropped = selection.dropped;
                account_.window = selection.window;
                return true;
            }
            const double others = account_.estimated_error() - found.error;
            if (others >= accuracy_)
                return false;
            const double needed = static_cast<double>(elements) *
                                  std::pow(found.error / (accuracy_ - others), 1 / estimate_order);
            if (needed > patience * finest_part * resolved)
                return false;
        }
    }

    const Genome& genome_;
    Model model_;
    double accuracy_;
    Profile whole_;
    double highest_, range_;
    std::vector<double> rows_;
    Index count_;
    Response response_;
    Account account_;
};

} // namespace

Grid resolved_grid(const Genome& genome, double length, bool wraps) {
    const double elements =
        std::clamp(std::ceil(64 * length / shortest_wave(genome) - 1e-9), 4096.0, 1048576.0);
    return {static_cast<Index>(elements) + (wraps ? 0 : 1), length, wraps};
}

EconomicResponse respond_within(const Genome& genome, const Model& resolved, double accuracy) {
    if (!(accuracy > 0) || accuracy > 1)
        throw InputError("accuracy: " + std::to_string(accuracy) +
                         " given, expected more than 0 and at most 1");
    const double start = seconds_now();
    EconomicResponse result = Question(genome, resolved, accuracy).answer();
    result.account.seconds = seconds_now() - start;
    return result;
}

EconomicResponse respond_exactly(const Genome& genome, const Model& model) {
    const double start = seconds_now();
    EconomicResponse result = Question(genome, model, 0).resolved();
    result.account.seconds = seconds_now() - start;
    return result;
}

} // namespace rough
