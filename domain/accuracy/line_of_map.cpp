#include "domain/accuracy/line_of_map.hpp"

#include "domain/accuracy/error_bounds.hpp"
#include "domain/errors.hpp"

namespace rough {

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

std::optional<ByLine> respond_by_line(const Profile& map, const Model& model) {
    const Loading& loading = model.loading;
    const bool by_reach = loading.pressures.empty() && loading.to_pressure == 0;
    const LineOfMap of = line_of_map(map);
    try {
        const auto displacements =
            step_displacements(by_reach ? map : of.line, model.body, loading, model.contact);
        ContactCurve curve = solve_contact(of.line, model.body, displacements, model.contact);
        ByLine result{
            of, response_of(curve.steps, curve.solver, displacement_range(map, model.body.kernel), HUGE_VAL),
            std::move(curve.last_contact), HUGE_VAL};
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

} // namespace rough
