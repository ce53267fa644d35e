#include "domain/accuracy/line_of_map.hpp"

#include "domain/accuracy/error_bounds.hpp"
#include "domain/contact/kernel.hpp"
#include "domain/errors.hpp"
#include "domain/profile/roughness.hpp"

#include <optional>

namespace rough {

namespace {

/// A line's curve in place of a map's.
struct ByLine {
    Response response;
    double bound; ///< relative, of pressures and secants; infinite where there is none
};

/// Nothing where the line cannot be pressed as far as the map.
std::optional<ByLine> pressed_line(const LineOfMap& of, const Profile& map, const Model& model) {
    const Loading& loading = model.loading;
    const bool by_reach = loading.pressures.empty() && loading.to_pressure == 0;
    try {
        const auto displacements =
            step_displacements(by_reach ? map : of.line, model.body, loading, model.contact);
        const ContactCurve curve = solve_contact(of.line, model.body, displacements, model.contact);
        ByLine result{
            response_of(curve.steps, curve.solver, displacement_range(map, model.body.kernel), HUGE_VAL),
            HUGE_VAL};
        const Bounds bounds = pressure_bounds(of.line, of.window, model.body, displacements, model.contact);
        const Eigen::VectorXd& pressure = result.response.pressure;
        const Eigen::VectorXd errors =
            relative(doubt_of(pressure, bounds.lower, bounds.upper), error_scale(pressure));
        if (errors.allFinite())
            result.bound = errors.maxCoeff();
        return result;
    } catch (const InputError&) { // flat, or in full contact before the map is
        return std::nullopt;
    }
}

} // namespace

LineOfMap line_of_map(const Profile& map) {
    if (!map.is_2d())
        refuse("line of a map: a profile given, expected a map");
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

AccountedResponse respond_map_within(const Profile& map, const Model& asked, double accuracy) {
    Model model = completed(asked);
    if (model.body.yields())
        throw InputError("accuracy: given with a hardness, expected one of them: its bounds rest on elastic "
                         "contact");
    model.accuracy = 0;
    model.contact.tolerance = std::min(model.contact.tolerance, accuracy / 20);
    AccountedResponse result;
    Account& account = result.account;
    account.accuracy = accuracy;
    account.resolved_nodes = map.nodes();
    account.tolerance = model.contact.tolerance;
    std::optional<ByLine> by_line;
    if (model.body.kernel == Kernel::periodic) {
        const LineOfMap of = line_of_map(map);
        account.aspect_ratio = texture(map, true).Str;
        by_line = pressed_line(of, map, model);
        if (by_line && by_line->bound <= accuracy) {
            account.by_line = true;
            account.grids = {of.line.nodes()};
            account.window = of.window;
            account.line_error = account.dropped_error = account.estimated_error = by_line->bound;
            account.area_error = of.window.width() > 0 ? std::nan("") : 0;
            result.response = std::move(by_line->response);
        }
    }
    if (!account.by_line) {
        result.response = respond(map, model);
        account.grids = {map.nodes()};
        if (by_line && model.loading.pressures.empty() && model.loading.to_pressure == 0)
            account.line_error = relative_error(by_line->response.pressure, result.response.pressure);
        // Gaps and penetrations of a residual bound the load by that much more or less approach.
        const Response& r = result.response;
        account.solver_error = account.estimated_error = (r.kkt_residual.array() * r.displacement.array() *
                                                          r.tangent_stiffness.array() / r.pressure.array())
                                                             .maxCoeff();
    }
    account.rows = account.solved_rows = static_cast<int>(result.response.steps());
    account.solver = result.response.solver;
    return result;
}

} // namespace rough
