#include "domain/accuracy/reduced.hpp"

#include "domain/errors.hpp"

namespace rough {
namespace {

/// Rows of the first pass: fewer would not describe the curve, and rows are cheap next to the factor.
constexpr std::size_t first_rows = 64;

/// The exact pressure of an interpolated row, MPa: its distance from the row's pressure, at most, and itself, at least.
struct ExactPressure {
    double distance, lowest;
};

/// Interpolates a row at displacement x between two solved ones.
ExactPressure interpolate(LoadStep& step, double x, const LoadStep& a, const LoadStep& b) {
    const double h = b.displacement - a.displacement, t = (x - a.displacement) / h;
    const double chord = a.pressure + t * (b.pressure - a.pressure);
    const double tangents = std::max({a.pressure + a.tangent_stiffness * (x - a.displacement),
                                      b.pressure - b.tangent_stiffness * (b.displacement - x), 0.0});
    const double cubic = (1 + 2 * t) * (1 - t) * (1 - t) * a.pressure + t * t * (3 - 2 * t) * b.pressure +
                         h * t * (1 - t) * ((1 - t) * a.tangent_stiffness - t * b.tangent_stiffness);
    step.displacement = x;
    step.pressure = std::clamp(cubic, std::min(tangents, chord), chord);
    step.tangent_stiffness = (1 - t) * a.tangent_stiffness + t * b.tangent_stiffness;
    step.contact_fraction = (1 - t) * a.contact_fraction + t * b.contact_fraction;
    step.kkt_residual = std::max(a.kkt_residual, b.kkt_residual);
    return {std::max(chord - step.pressure, step.pressure - tangents), std::min(tangents, chord)};
}

/// Interpolates the rows `first` to end - 1 between the solved rows `start` and `end`. Returns the bound of
/// the relative error of their pressures and secants and those of row `end`.
double fill_gap(std::vector<LoadStep>& steps, const std::vector<double>& displacements, std::size_t first,
                std::size_t end, const LoadStep& start) {
    const LoadStep last = steps[end];
    const auto over = [](double error, double exact) { return error > 0 ? error / exact : 0; };
    // A convex cubic's secants lie between the two tangents, as the exact ones do.
    const double rise = 3 * (last.pressure - start.pressure) / (last.displacement - start.displacement);
    const bool convex = 2 * start.tangent_stiffness + last.tangent_stiffness <= rise &&
                        rise <= start.tangent_stiffness + 2 * last.tangent_stiffness;
    double worst = 0, previous_error = 0, previous = start.displacement;
    for (std::size_t j = first; j <= end; ++j) {
        const auto [error, pressure] =
            j < end ? interpolate(steps[j], displacements[j], start, last) : ExactPressure{0, 1};
        const double length = steps[j].displacement - previous;
        const double lowest = length * start.tangent_stiffness;
        double secant_error = error + previous_error;
        if (convex) secant_error = std::min(secant_error, length * last.tangent_stiffness - lowest);
        worst = std::max({worst, over(error, pressure), over(secant_error, lowest)});
        previous_error = error;
        previous = steps[j].displacement;
    }
    return worst;
}

} // namespace

LineOfMap line_of_map(const Profile& map) {
    if (!map.is_2d()) refuse("line of a map: the surface is a line; give a map");
    const auto [columns, rows] = map.shape();
    const Eigen::Map<const Eigen::MatrixXd> z(map.heights.data(), columns, rows);
    LineOfMap along_x{{z.rowwise().mean(), map.spacing}, true, {}},
        along_y{{z.colwise().mean().transpose(), map.row_spacing}, false, {}};
    Profile drawn_out = map;
    drawn_out.heights = along_x.line.heights.replicate(rows, 1);
    along_x.window = window_between(map, drawn_out);
    drawn_out.heights = along_y.line.heights.transpose().replicate(columns, 1).reshaped();
    along_y.window = window_between(map, drawn_out);
    return along_x.window.width() <= along_y.window.width() ? along_x : along_y;
}

LoadRows solve_rows(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                    const ContactOptions& options, double accuracy) {
    const std::size_t count = displacements.size();
    LoadRows rows;
    rows.steps.resize(count);
    std::vector<char> known;
    for (const double displacement : displacements) known.push_back(displacement <= 0);
    const std::size_t apart = accuracy > 0 ? std::max<std::size_t>(1, count / first_rows) : 1;
    std::vector<std::size_t> next;
    for (std::size_t j = count; j > 0 && !known[j - 1]; j -= std::min(j, apart)) next.push_back(j - 1);
    // The first row in contact is solved too. Rows between solved rows are then in contact at both ends.
    const auto first_row = static_cast<std::size_t>(std::count(known.begin(), known.end(), 1));
    if (!next.empty() && next.back() > first_row) next.push_back(first_row);
    std::reverse(next.begin(), next.end());
    while (!next.empty()) {
        std::vector<double> at;
        for (const std::size_t j : next) at.push_back(displacements[j]);
        const ContactCurve curve = solve_contact(profile, body, at, options);
        for (std::size_t k = 0; k < next.size(); ++k) {
            rows.steps[next[k]] = curve.steps[k];
            known[next[k]] = 1;
        }
        rows.solved += static_cast<int>(next.size());
        rows.solver = curve.solver;
        if (next.back() + 1 == count) rows.last_contact = curve.last_contact;

        next.clear();
        rows.error = rows.area_error = rows.tangent_error = 0;
        LoadStep start; // no contact at displacement 0
        for (std::size_t first = 0, end = 0; end < count; ++end) {
            if (!known[end]) continue;
            const double worst = first < end ? fill_gap(rows.steps, displacements, first, end, start) : 0;
            rows.error = std::max(rows.error, worst);
            if (worst > accuracy) {
                // A secant's bound falls in proportion to the distance of the solved rows.
                const auto pieces = static_cast<std::size_t>(
                    std::min(std::ceil(worst / accuracy) + 1, static_cast<double>(end - first + 1)));
                for (std::size_t piece = 1; piece < pieces; ++piece)
                    next.push_back(first + (end - first) * piece / pieces);
            }
            const LoadStep& solved = rows.steps[end];
            for (std::size_t j = first; j < end; ++j) {
                const double t = (displacements[j] - start.displacement) / (solved.displacement - start.displacement);
                const auto widen = [&](double& error, double from, double to) {
                    error = std::max(error, std::max(t, 1 - t) * (to / from - 1));
                };
                widen(rows.area_error, start.contact_fraction, solved.contact_fraction);
                widen(rows.tangent_error, start.tangent_stiffness, solved.tangent_stiffness);
            }
            start = solved;
            first = end + 1;
        }
        next.erase(std::unique(next.begin(), next.end()), next.end());
    }
    return rows;
}

} // namespace rough
