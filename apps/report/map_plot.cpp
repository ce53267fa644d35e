#include "apps/report/map_plot.hpp"

#include "apps/report/units.hpp"

namespace app {

Plot shades_plot(const rough::Grid& grid, const Eigen::VectorXd& values, const std::string& title,
                 const std::string& label, const std::string& alt) {
    Plot plot;
    plot.alt = alt;
    plot.title = title;
    plot.x = {"x (mm)", false, 0, grid.length};
    plot.y = {"y (mm)", false, 0, grid.width};
    plot.height = 400;
    plot.shades = {values.reshaped(grid.nodes, grid.rows),
                   grid.spacing() * static_cast<double>(grid.nodes - 1),
                   grid.row_spacing() * static_cast<double>(grid.rows - 1), label};
    return plot;
}

Plot heights_plot(const rough::Grid& grid, const Eigen::VectorXd& heights, const std::string& title) {
    const Unit unit = length_unit(heights.maxCoeff() - heights.minCoeff());
    return shades_plot(grid, unit.factor * (heights.array() - heights.maxCoeff()).matrix(), title,
                       "Height under the highest point (" + unit.name + ")",
                       "Heights of the surface as colours");
}

Plot pressure_plot(const rough::Grid& grid, const rough::ContactState& state, const std::string& title) {
    Eigen::VectorXd pressure = Eigen::VectorXd::Constant(grid.shape().nodes(), unset);
    pressure(state.nodes) = state.pressure;
    const Unit unit = pressure_unit(state.pressure.maxCoeff());
    return shades_plot(grid, unit.factor * pressure, title, "Pressure (" + unit.name + ")",
                       "Contact pressure as colours, nothing where there is none");
}

Plot heights_plot(const rough::Profile& map) {
    const auto [columns, rows] = map.shape();
    const rough::Grid grid{.nodes = columns,
                           .length = map.spacing * static_cast<double>(columns - 1),
                           .rows = rows,
                           .width = map.row_spacing * static_cast<double>(rows - 1)};
    return heights_plot(grid, map.heights, "");
}

Plot pressure_plot(const rough::Model& model, const rough::Profile& surface, double displacement,
                   const std::string& title) {
    rough::ContactOptions options = model.contact;
    options.states = true;
    return pressure_plot(model.grid, solve_contact(surface, model.body, {displacement}, options).states[0],
                         title);
}

} // namespace app
