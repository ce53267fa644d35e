#pragma once

#include "apps/report/plot.hpp"
#include "domain/contact/solve.hpp"
#include "domain/response/model.hpp"

namespace app {

/// What stands at an area's nodes, as colours; NaN stays empty.
Plot shades_plot(const rough::Grid& grid, const Eigen::VectorXd& values, const std::string& title,
                 const std::string& label, const std::string& alt);
/// Heights (mm) under the highest.
Plot heights_plot(const rough::Grid& grid, const Eigen::VectorXd& heights, const std::string& title);
/// The same of a map alone.
Plot heights_plot(const rough::Profile& map);
/// The pressure at one load step; nothing where there is none.
Plot pressure_plot(const rough::Grid& grid, const rough::ContactState& state, const std::string& title);
/// The same at a displacement (mm), of heights (mm) that are pressed for it.
Plot pressure_plot(const rough::Model& model, const rough::Profile& surface, double displacement,
                   const std::string& title);

} // namespace app
