#include "apps/report/contact_tables.hpp"

#include "apps/report/csv.hpp"
#include "apps/report/drawn.hpp"
#include "domain/contact/names.hpp"
#include "domain/contact/pressure_and_gap.hpp"

#include <cmath>

namespace app {

namespace {

using rough::Index;

/// All load steps, if there are at most four. If there are more: an early one, the middle one and the last.
std::vector<Index> shown_steps(Index steps) {
    if (steps > 4)
        return {steps / 10, (steps - 1) / 2, steps - 1};
    std::vector<Index> all;
    for (Index j = 0; j < steps; ++j)
        all.push_back(j);
    return all;
}

rough::ContactCurve solved_again(const rough::Profile& surface, const rough::Model& model,
                                 const rough::Response& response) {
    std::vector<double> displacements;
    for (const Index j : shown_steps(response.steps()))
        displacements.push_back(response.displacement[j]);
    rough::ContactOptions options = model.contact;
    options.states = true;
    options.tolerance = std::min(options.tolerance, rough::ContactOptions{}.tolerance);
    return solve_contact(surface, model.body, displacements, options);
}

} // namespace

ContactTables contact_tables(const rough::Profile& surface, const rough::Model& model,
                             const rough::Response& response) {
    const rough::ContactCurve curve = solved_again(surface, model, response);
    const bool is_2d = surface.is_2d();
    Csv loads("load,mean_pressure_MPa,pressure_over_modulus,contact_fraction,spots," +
              std::string(is_2d ? "largest_spot_mm2" : "widest_spot_mm") +
              ",highest_pressure_MPa,mean_gap_mm");
    std::string along = "load,x_mm,pressure_MPa,gap_mm\n";
    std::vector<std::string> names{"height_mm"};
    std::vector<Eigen::VectorXd> maps{below_highest(surface)};
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
        const rough::LoadStep& step = curve.steps[i];
        const rough::Interface at = interface_at(surface, model.body, step, curve.states[i]);
        loads.row(i + 1, step.pressure, step.pressure / model.body.effective_modulus, step.contact_fraction,
                  at.spots, at.widest, curve.states[i].pressure.maxCoeff(), at.gap.mean());
        if (is_2d) {
            names.push_back("pressure_" + std::to_string(i + 1) + "_MPa");
            maps.emplace_back(Eigen::VectorXd::Constant(surface.nodes(), NAN));
            maps.back()(curve.states[i].nodes) = curve.states[i].pressure;
        } else {
            along += drawn_rows(std::to_string(i + 1), {positions(surface), at.pressure, at.gap.cwiseMax(0)});
        }
    }
    const Index last = response.steps() - 1;
    ContactTables all;
    all.values = {{"kind", "contact"},
                  {"is_2d", is_2d},
                  {"pressed_nodes", surface.nodes()},
                  {"kernel", name_of(model.body.kernel)},
                  {"effective_modulus_MPa", model.body.effective_modulus},
                  {"last",
                   {{"pressure_MPa", response.pressure[last]},
                    {"contact_fraction", response.contact_fraction[last]},
                    {"stiffness_MPa_per_mm", response.tangent_stiffness[last]}}},
                  {"largest_kkt_residual", response.kkt_residual.maxCoeff()}};
    if (is_2d)
        all.values["pressed_nodes"] = {surface.shape().columns, surface.shape().rows};
    all.tables["loads"] = loads.text();
    if (is_2d) {
        all.tables["map"] = map_csv(surface, names, maps);
    } else {
        all.tables["along"] = along;
        all.tables["heights-drawn"] = heights_csv(surface);
        all.tables["bearing"] = bearing_csv(surface.heights);
    }
    return all;
}

std::vector<std::string> contact_table_names(bool is_2d) {
    return is_2d ? std::vector<std::string>{"loads", "map"}
                 : std::vector<std::string>{"loads", "along", "heights-drawn", "bearing"};
}

} // namespace app
