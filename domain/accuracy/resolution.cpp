#include "domain/accuracy/resolution.hpp"

#include "domain/contact/full_contact.hpp"
#include "domain/contact/pressure_and_gap.hpp"
#include "domain/errors.hpp"
#include "domain/profile/finer.hpp"
#include "domain/response/curve.hpp"

#include <algorithm>
#include <cmath>

namespace rough {

namespace {

/// Nodes of a surface on the finer grid.
double finer_nodes(const Profile& scan) {
    const auto [columns, rows] = scan.shape();
    return static_cast<double>(finer_times * columns) *
           static_cast<double>(scan.is_2d() ? finer_times * rows : 1);
}

bool is_omitted(const Profile& scan, Resolution resolution) {
    return resolution == Resolution::off ||
           (resolution == Resolution::automatic &&
            finer_nodes(scan) >
                static_cast<double>(scan.is_2d() ? most_finer_map_nodes : most_finer_line_nodes));
}

/// Largest relative error of the interpolated surfaces' solutions, far below what interpolation leaves open.
constexpr double tolerance = 1e-4;

/// Distance of the highest node from where displacements end on every grid: from height 0, or for a periodic
/// body from the mean plane.
double top(const Profile& surface, const Body& body) {
    return surface.heights.maxCoeff() - (body.kernel == Kernel::periodic ? surface.heights.mean() : 0);
}

/// Values of an interpolated surface at the measured pressures, read between its load steps.
Eigen::VectorXd at_measured_pressures(const Response& finer, const Eigen::VectorXd& values,
                                      const Response& measured) {
    Eigen::VectorXd read = values;
    for (Index j = 0; read.size() > 1 && j < read.size(); ++j) {
        const auto [left, weight] = segment_at({finer.pressure, {}}, measured.pressure[j]);
        if (std::abs(weight) <= 2) // infinite between loads that a hardness makes equal
            read[j] = values[left] + weight * (values[left + 1] - values[left]);
    }
    return read;
}

/// The least and the greatest of the columns, wider by `margin`.
void take_band(const Eigen::MatrixXd& columns, const Eigen::VectorXd& margin, Eigen::VectorXd& low,
               Eigen::VectorXd& high) {
    low = (columns.rowwise().minCoeff() - margin).cwiseMax(0);
    high = columns.rowwise().maxCoeff() + margin;
}

} // namespace

const std::vector<std::string>& resolution_names() {
    static const std::vector<std::string> names{"auto", "on", "off"};
    return names;
}

Index spot_width(const std::vector<int>& contact, Extent shape, bool periodic) {
    std::vector<Index> sizes = contact_spots(contact, shape, periodic);
    std::size_t below = 0;
    while (!sizes.empty() && 2 * (below += static_cast<std::size_t>(sizes.back())) < contact.size())
        sizes.pop_back();
    const double nodes = sizes.empty() ? 0 : static_cast<double>(sizes.back());
    return std::lround(shape.rows > 1 ? std::sqrt(nodes) : nodes);
}

std::vector<Response> finer_responses(const Profile& scan, const Model& model, const Response& measured,
                                      Resolution resolution) {
    std::vector<Response> responses;
    if (is_omitted(scan, resolution))
        return responses;
    const Body body = completed(model.body, model.grid.length);
    ContactOptions options = model.contact;
    options.solver = Solver::automatic;
    options.tolerance = std::max(options.tolerance, tolerance);
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline}) {
        const Profile surface = finer(scan, finer_times, by, body.kernel == Kernel::periodic);
        std::vector<double> displacements;
        for (const double displacement : measured.displacement)
            displacements.push_back(displacement + top(surface, body) - top(scan, body));
        // Under load control this would take six times longer.
        const ContactCurve curve = solve_contact(surface, body, displacements, options);
        responses.push_back(response_of(curve.steps, curve.solver, displacement_range(surface, body.kernel),
                                        full_contact_stiffness(surface, body)));
    }
    return responses;
}

ResolutionBand resolution_band(const Profile& scan, const Model& model, const Response& measured,
                               Resolution resolution) {
    if (is_omitted(scan, resolution))
        return {.omitted =
                    resolution == Resolution::off ? "" : "too many nodes; --resolution on computes it"};
    const Index rows = measured.steps();
    Eigen::MatrixXd fraction(rows, 4), stiffness(rows, 4);
    fraction.col(0) = measured.contact_fraction;
    stiffness.col(0) = measured.tangent_stiffness;
    Index column = 0;
    try {
        for (const Response& finer : finer_responses(scan, model, measured, resolution)) {
            fraction.col(++column) = at_measured_pressures(finer, finer.contact_fraction, measured);
            stiffness.col(column) = at_measured_pressures(finer, finer.tangent_stiffness, measured);
        }
    } catch (const std::exception& error) { // costs the band, not the curve
        if (is_stopped(model.contact))
            throw;
        return {.omitted = error.what()};
    }
    for (Eigen::MatrixXd* values : {&fraction, &stiffness}) // the spline's to spacing 0
        values->col(3) = values->col(2) + (values->col(2) - values->col(0)) / (finer_times - 1);
    const double node = 1 / finer_nodes(scan);
    Eigen::VectorXd change(rows); // of the stiffness, by one node
    for (Index j = 0; j < rows; ++j) {
        const Index right = std::max<Index>(j, 1), left = right - 1;
        const double area = measured.contact_fraction[right] - measured.contact_fraction[left];
        change[j] = std::abs(measured.tangent_stiffness[right] - measured.tangent_stiffness[left]) *
                    std::min(1., area > 0 ? node / area : 1.);
    }
    ResolutionBand band;
    take_band(fraction, Eigen::VectorXd::Constant(rows, node), band.contact_fraction_low,
              band.contact_fraction_high);
    band.contact_fraction_high = band.contact_fraction_high.cwiseMin(1);
    take_band(stiffness, change, band.tangent_stiffness_low, band.tangent_stiffness_high);
    return band;
}

} // namespace rough
