#include "domain/accuracy/resolution.hpp"

#include "domain/contact/pressure_and_gap.hpp"
#include "domain/errors.hpp"
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

/// Contact fraction and stiffness of an interpolated surface at the measured pressures: solved where the
/// measured curve's displacements leave its top and read between these load steps, whose pressures nearly are
/// the measured ones. Load control would take six times longer.
Eigen::MatrixX2d at_measured_pressures(const Profile& surface, const Profile& scan, const Model& model,
                                       const Response& measured) {
    std::vector<double> displacements;
    for (const double displacement : measured.displacement)
        displacements.push_back(displacement + top(surface, model.body) - top(scan, model.body));
    ContactOptions options = model.contact;
    options.tolerance = std::max(options.tolerance, tolerance);
    const Response found =
        response_of(solve_contact(surface, model.body, displacements, options).steps, Solver::automatic, 0);
    Eigen::MatrixX2d columns(found.steps(), 2);
    columns << found.contact_fraction, found.tangent_stiffness;
    const Eigen::MatrixX2d solved = columns;
    for (Index j = 0; found.steps() > 1 && j < found.steps(); ++j) {
        const auto [left, weight] = segment_at({found.pressure, {}}, measured.pressure[j]);
        if (std::abs(weight) <= 2) // infinite between loads that a hardness makes equal
            columns.row(j) = solved.row(left) + weight * (solved.row(left + 1) - solved.row(left));
    }
    return columns;
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

Resolution resolution_named(const std::string& name) {
    const auto& names = resolution_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        refuse_value("resolution", "'", name, "' given, expected auto, on or off");
    return static_cast<Resolution>(found - names.begin());
}

Index spot_width(const std::vector<int>& contact, Extent shape, bool wraps) {
    std::vector<Index> sizes = contact_spots(contact, shape, wraps);
    std::size_t below = 0;
    while (!sizes.empty() && 2 * (below += static_cast<std::size_t>(sizes.back())) < contact.size())
        sizes.pop_back();
    const double nodes = sizes.empty() ? 0 : static_cast<double>(sizes.back());
    return std::lround(shape.rows > 1 ? std::sqrt(nodes) : nodes);
}

std::vector<Profile> finer_surfaces(const Profile& scan, Kernel kernel, Resolution resolution) {
    if (is_omitted(scan, resolution))
        return {};
    const bool wraps = kernel == Kernel::periodic;
    return {finer(scan, finer_times, Interpolation::linear, wraps),
            finer(scan, finer_times, Interpolation::spline, wraps)};
}

ResolutionBand resolution_band(const Profile& scan, const Model& model, const Response& measured,
                               Resolution resolution) {
    if (is_omitted(scan, resolution))
        return {.omitted =
                    resolution == Resolution::off ? "" : "too many nodes; --resolution on computes it"};
    const Index rows = measured.steps();
    Eigen::MatrixXd fraction(rows, 4), stiffness(rows, 4);
    Model at = model;
    at.body = completed(at.body, at.grid.length);
    fraction.col(0) = measured.contact_fraction;
    stiffness.col(0) = measured.tangent_stiffness;
    Index column = 0;
    for (const Profile& surface : finer_surfaces(scan, model.body.kernel, resolution)) {
        const Eigen::MatrixX2d found = at_measured_pressures(surface, scan, at, measured);
        fraction.col(++column) = found.col(0);
        stiffness.col(column) = found.col(1);
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
