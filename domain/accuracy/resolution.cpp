#include "domain/accuracy/resolution.hpp"

#include "domain/contact/interface.hpp"
#include "domain/errors.hpp"
#include "domain/profile/preparation.hpp"
#include "domain/response/curve.hpp"

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

namespace rough {
namespace {

using Heights = Eigen::ArrayXXd;

/// Elements for each element of a measured surface. On cells it is odd, so that nodes stay nodes.
Index finer_times(const Profile& scan, bool periodic) { return scan.is_2d() && !periodic ? 5 : 4; }
/// Margin of a band as a share of its largest relative width at the row and its neighbours. Counted nodes
/// scatter, so the curves of the band may agree by chance.
constexpr double margin_share = 0.25;

/// A crest has a kink between two nodes if their second differences sum to this many times those of the next
/// two nodes. Cosines of 8 nodes have 2.4.
constexpr double kink_share = 3;

/// Writes the heights between nodes: essentially non-oscillating parabolas (ENO) with subcell resolution of
/// kinks (Harten 1989, J. Comput. Phys. 83, 148).
/// A kink is the crest at which the parabolas of both flanks meet; the node nearest to it has its height.
template <class Measured, class Fine>
void interpolate_kinked(const Measured& z, Index times, bool periodic, Fine&& fine) {
    const Index nodes = z.size();
    const auto at = [&](Index i) { return z[(i + nodes) % nodes]; };
    const auto bend = [&](Index i) { // second difference; 0 beyond the ends
        return periodic || (i > 0 && i < nodes - 1) ? at(i - 1) - 2 * at(i) + at(i + 1) : 0;
    };
    for (Index i = 0; i + 1 < nodes; ++i) {
        const double a = at(i), b = at(i + 1), bend_a = bend(i), bend_b = bend(i + 1), before = bend(i - 1),
                     after = bend(i + 2);
        const bool inside = periodic || (i > 0 && i + 2 < nodes);
        const auto from_left = [&](double t) { return a + t * (a - at(i - 1)) + before * t * (t + 1) / 2; };
        const auto from_right = [&](double t) { return b + (1 - t) * (b - at(i + 2)) + after * (1 - t) * (2 - t) / 2; };
        const bool kinked = inside && -(bend_a + bend_b) > kink_share * (std::abs(before) + std::abs(after)) &&
                            from_left(1) > b && from_right(0) > a;
        const double curvature = bend_a * bend_b > 0 ? (std::abs(bend_a) < std::abs(bend_b) ? bend_a : bend_b) : 0;
        double crest = 0; // place at which the flanks meet
        if (kinked)
            for (double step = 0.5; step > 1e-6; step /= 2)
                if (from_left(crest + step) < from_right(crest + step)) crest += step;
        for (Index k = 1; k < times; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(times), chord = a + t * (b - a);
            const bool nearest = 2 * std::abs(t - crest) * static_cast<double>(times) <= 1;
            fine[i * times + k] = !kinked   ? chord - curvature * t * (1 - t) / 2
                                  : nearest ? from_left(crest)
                                            : std::max(chord, std::min(from_left(t), from_right(t)));
        }
    }
}

/// Every column of the heights with `times` elements for each of its elements.
Heights finer_columns(const Heights& heights, Index times, Interpolation by, bool periodic, bool cells) {
    const Index nodes = heights.rows(), open = times * (nodes - 1) + 1, edge = cells ? times / 2 : 0;
    Heights fine(periodic ? times * nodes : open + 2 * edge, heights.cols());
    for (Index column = 0; column < heights.cols(); ++column) {
        const auto z = heights.col(column);
        auto all = fine.col(column);
        const auto continue_straight = [&](double before, double after) { // adds the outer half cells
            for (Index i = 1; i <= edge; ++i) {
                all[edge - i] = z[0] - before * static_cast<double>(i) / static_cast<double>(times);
                all[edge + open - 1 + i] = z[nodes - 1] + after * static_cast<double>(i) / static_cast<double>(times);
            }
        };
        auto at = all.segment(edge, fine.rows() - 2 * edge);
        for (Index i = 0; i < at.size(); ++i) {
            const double share = static_cast<double>(i % times) / static_cast<double>(times);
            at[i] = z[i / times] + share * (z[(i / times + 1) % nodes] - z[i / times]);
        }
        if (by == Interpolation::linear || nodes < 3) {
            continue_straight(nodes > 1 ? z[1] - z[0] : 0, nodes > 1 ? z[nodes - 1] - z[nodes - 2] : 0);
            continue;
        }
        const double first = 2 * z[1] - 1.5 * z[0] - 0.5 * z[2],
                     last = 1.5 * z[nodes - 1] - 2 * z[nodes - 2] + 0.5 * z[nodes - 3];
        continue_straight(first, last);
        if (by == Interpolation::kinked) {
            interpolate_kinked(z, times, periodic, at);
            continue;
        }
        const boost::math::interpolators::cardinal_cubic_b_spline<double> spline(z.data(), z.data() + nodes, 0., 1.,
                                                                                 first, last);
        for (Index i = 0; i < open; ++i)
            if (i % times != 0) at[i] = spline(static_cast<double>(i) / static_cast<double>(times));
    }
    return fine;
}

bool is_omitted(const Profile& scan, bool periodic, Resolution resolution) {
    const Index times = finer_times(scan, periodic);
    const bool is_too_large =
        scan.is_2d() ? times * times * scan.nodes() > 2'000'000 : times * scan.nodes() > 10'000'000;
    return resolution == Resolution::off || (resolution == Resolution::automatic && is_too_large);
}

/// Height of the highest node above the reference that displacements of all grids share: height 0, or for a
/// periodic body the mean plane.
double top(const Profile& surface, const Body& body) {
    return surface.heights.maxCoeff() - (body.kernel == Kernel::periodic ? surface.heights.mean() : 0);
}

/// Values of an interpolated surface at the measured pressures, interpolated between its load steps.
Eigen::VectorXd at_measured_pressures(const Response& finer, const Eigen::VectorXd& values, const Response& measured) {
    Eigen::VectorXd read = values;
    for (Index j = 0; read.size() > 1 && j < read.size(); ++j) {
        const auto [left, weight] = segment_at({finer.pressure, {}}, measured.pressure[j]);
        if (std::abs(weight) <= 2) // infinite between loads that a hardness makes equal
            read[j] = values[left] + weight * (values[left + 1] - values[left]);
    }
    return read;
}

} // namespace

Profile finer(const Profile& surface, Index times, Interpolation by, bool periodic) {
    const auto [columns, rows] = surface.shape();
    const bool cells = surface.is_2d() && !periodic;
    if (cells && times % 2 == 0) refuse("finer: ", times, " elements for each cell of a map; use an odd number");
    Heights fine =
        finer_columns(Eigen::Map<const Heights>(surface.heights.data(), columns, rows), times, by, periodic, cells);
    if (surface.is_2d()) fine = finer_columns(fine.transpose(), times, by, periodic, cells).transpose().eval();
    const double share = 1 / static_cast<double>(times);
    return {fine.reshaped(), surface.spacing * share, fine.cols(), surface.row_spacing * share};
}

const std::vector<std::string>& resolution_names() {
    static const std::vector<std::string> names{"auto", "on", "off"};
    return names;
}

std::vector<Response> finer_responses(const Profile& scan, const Model& model, const Response& measured,
                                      Resolution resolution) {
    std::vector<Response> responses;
    const Body& body = model.body;
    const bool periodic = body.kernel == Kernel::periodic;
    if (is_omitted(scan, periodic, resolution)) return responses;
    ContactOptions options = model.contact;
    options.solver = Solver::automatic;
    options.tolerance = std::max(options.tolerance, 1e-4); // far below the interpolation's uncertainty
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline, Interpolation::kinked}) {
        const Profile surface = finer(scan, finer_times(scan, periodic), by, periodic);
        std::vector<double> displacements;
        for (const double displacement : measured.displacement)
            displacements.push_back(displacement + top(surface, body) - top(scan, body));
        // Load control would take six times longer.
        const ContactCurve curve = solve_contact(surface, body, displacements, options);
        responses.push_back(response_of(curve.steps, curve.solver, displacement_range(surface, body.kernel),
                                        full_contact_stiffness(surface, body, options.threads)));
    }
    return responses;
}

ResolutionBand resolution_band(const Profile& scan, const Model& model, const Response& measured,
                               Resolution resolution) {
    const bool periodic = model.body.kernel == Kernel::periodic;
    if (is_omitted(scan, periodic, resolution))
        return {.omitted = resolution == Resolution::off ? "" : "too many nodes; --resolution on computes it"};
    const Index rows = measured.steps();
    Eigen::MatrixXd fraction(rows, 5), stiffness(rows, 5);
    fraction.col(0) = measured.contact_fraction;
    stiffness.col(0) = measured.tangent_stiffness;
    Index column = 0;
    try {
        for (const Response& finer : finer_responses(scan, model, measured, resolution)) {
            fraction.col(++column) = at_measured_pressures(finer, finer.contact_fraction, measured);
            stiffness.col(column) = at_measured_pressures(finer, finer.tangent_stiffness, measured);
        }
    } catch (const std::exception& error) { // costs the band, not the curve
        if (is_stopped(model.contact)) throw;
        return {.omitted = error.what()};
    }
    for (Eigen::MatrixXd* values : {&fraction, &stiffness}) // the spline's curve at spacing 0 (Richardson 1911)
        values->col(4) =
            values->col(2) + (values->col(2) - values->col(0)) / static_cast<double>(finer_times(scan, periodic) - 1);
    const auto margin = [&](const Eigen::MatrixXd& values) -> Eigen::ArrayXd {
        const Eigen::ArrayXd width =
            (values.rowwise().maxCoeff() - values.rowwise().minCoeff()).cwiseQuotient(values.col(0));
        Eigen::ArrayXd widest = width; // largest width at the row and its neighbours
        widest.head(rows - 1) = widest.head(rows - 1).max(width.tail(rows - 1));
        widest.tail(rows - 1) = widest.tail(rows - 1).max(width.head(rows - 1));
        return margin_share * widest * values.col(0).array();
    };
    const Eigen::ArrayXd of_fraction = margin(fraction), of_stiffness = margin(stiffness);
    return {(fraction.rowwise().minCoeff().array() - of_fraction).max(0.),
            (fraction.rowwise().maxCoeff().array() + of_fraction).min(1.),
            (stiffness.rowwise().minCoeff().array() - of_stiffness).max(0.),
            stiffness.rowwise().maxCoeff().array() + of_stiffness};
}

ElasticEnd elastic_end(const Profile& surface, const Model& model, const Response& response, double limit) {
    ContactOptions options = model.contact;
    options.states = true;
    const Body& body = model.body;
    const auto largest_at = [&](Index step) {
        if (const double known = response.largest_pressure[step]; known > 0) return known;
        return solve_contact(surface, body, {response.displacement[step]}, options).states.front().pressure.maxCoeff();
    };
    const Index last = response.steps() - 1;
    const double largest = largest_at(last);
    Index below = -1, beyond = largest > limit ? last : last + 1;
    while (beyond <= last && beyond - below > 1) {
        const Index middle = below + (beyond - below) / 2;
        (largest_at(middle) > limit ? beyond : below) = middle;
    }
    return {beyond, largest};
}

OutlierCost outlier_cost(const Profile& surface, const std::vector<Index>& outliers, const Model& model,
                         const Response& response) {
    const Profile clean = without(surface, outliers);
    // A periodic body may be in full contact with the clean surface before the last of these pressures.
    for (Index rows = response.steps(); rows > 0; rows /= 2) try {
            Model at = model;
            at.loading.pressures = {response.pressure.begin(), response.pressure.begin() + rows};
            const Response found = respond(clean, at);
            Index row = 0;
            const Eigen::ArrayXd factors =
                found.contact_fraction.array() / response.contact_fraction.head(rows).array();
            const double factor = factors.maxCoeff(&row);
            return {factor, found.tangent_stiffness[row] / response.tangent_stiffness[row], response.pressure[row]};
        } catch (const InputError&) {
        }
    return {};
}

std::string describe_fill_effect(const Profile& surface, const std::vector<Index>& filled, const Model& model) {
    const auto in_words = [](double pressure, double of_filled, double of_lowest) {
        return line_with_digits(4, "filled points: at ", pressure, " MPa the contact is ", 100 * of_filled, " %, and ",
                                100 * of_lowest, " % with the holes as lowest points");
    };
    Model few = model;
    if (few.loading.pressures.empty()) few.loading.steps = 2;
    const Response of_filled = respond(surface, few);
    Profile lowest = surface;
    lowest.heights(filled).setConstant(surface.heights.minCoeff());
    for (Index step = of_filled.steps(); step-- > 0;) try {
            few.loading.pressures = {of_filled.pressure[step]};
            return in_words(of_filled.pressure[step], of_filled.contact_fraction[step],
                            respond(lowest, few).contact_fraction[0]);
        } catch (const InputError&) { // beyond the full contact of the other surface
        }
    return in_words(0, 0, 0);
}

} // namespace rough
