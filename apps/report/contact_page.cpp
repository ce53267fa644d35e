#include "apps/report/contact_page.hpp"

#include "apps/report/map_plot.hpp"
#include "apps/report/page.hpp"
#include "apps/report/profile_page.hpp"
#include "apps/report/units.hpp"
#include "domain/contact/names.hpp"
#include "domain/contact/pressure_and_gap.hpp"

namespace app {

namespace {

using rough::Index;

/// All of up to four load steps, else one early, one half-way and the last.
std::vector<Index> shown_steps(Index steps) {
    if (steps <= 4) {
        std::vector<Index> all;
        for (Index j = 0; j < steps; ++j)
            all.push_back(j);
        return all;
    }
    return {steps / 10, (steps - 1) / 2, steps - 1};
}

Plot against_pressure(const rough::Response& response, const Eigen::VectorXd& y, const std::string& label,
                      const std::string& alt) {
    const Unit unit = pressure_unit(response.pressure.maxCoeff());
    Plot plot;
    plot.alt = alt;
    plot.x = {"Mean pressure p (" + unit.name + ")", false, 0, unset};
    plot.y = {label, false, 0, unset};
    plot.series.push_back({"", unit.factor * response.pressure, y, Colour::blue, Style::line_points, 1.5});
    return plot;
}

/// The page's head: what was pressed, and the curve.
Page begun(const ContactShown& shown, const std::string& nodes) {
    const rough::Response& response = shown.response;
    const rough::Body& body = shown.model.body;
    const Unit mean = pressure_unit(response.pressure.maxCoeff());
    const Index last = response.steps() - 1;
    Page page("Contact: " + shown.name, nodes + " nodes pressed on a " + name_of(body.kernel) +
                                            " elastic body, E* = " + readable(body.effective_modulus) +
                                            " MPa, in " + std::to_string(response.steps()) + " load steps.");
    page.tiles({{"Last mean pressure, " + mean.name, readable(mean.factor * response.pressure[last])},
                {"Contact at the last load", percent(response.contact_fraction[last])},
                {"Stiffness at the last load, MPa/mm", readable(response.tangent_stiffness[last])},
                {"Largest KKT residual", readable(response.kkt_residual.maxCoeff(), 2)}});
    for (const std::string& note : shown.notes)
        page.prose(note);
    page.section("The curve");
    page.figure(
        {"curve",
         "Stiffness and contact against mean pressure.",
         "Tangent stiffness dp/dΔ at each load step's contact set, and the share of nodes that touch.",
         {against_pressure(response, response.tangent_stiffness, "Stiffness K (MPa/mm)",
                           "Tangent stiffness against mean pressure"),
          against_pressure(response, response.contact_fraction, "Contact fraction A",
                           "Contact fraction against mean pressure")}});
    return page;
}

/// The load steps that the page shows, solved anew with their pressures.
rough::ContactCurve solved_anew(const ContactShown& shown, const std::vector<Index>& steps) {
    std::vector<double> displacements;
    for (const Index j : steps)
        displacements.push_back(shown.response.displacement[j]);
    rough::ContactOptions options = shown.model.contact;
    options.states = true;
    options.tolerance = std::min(options.tolerance, rough::ContactOptions{}.tolerance);
    return solve_contact(shown.profile, shown.model.body, displacements, options);
}

std::string ended(Page page, const ContactShown& shown) {
    page.section("Files");
    page.links(shown.files);
    return page.html();
}

std::string page_of_area(const ContactShown& shown) {
    const rough::Grid& grid = shown.model.grid;
    const auto steps = shown_steps(shown.response.steps());
    const rough::ContactCurve curve = solved_anew(shown, steps);
    Page page = begun(shown, std::to_string(grid.nodes) + " x " + std::to_string(grid.rows));
    Table table{
        "",
        {"Mean pressure", "p/E*", "Contact", "Spots", "Largest spot, mm²", "Highest pressure", "Mean gap"},
        {},
        std::vector<bool>(7, true)};
    Figure figure{"area",
                  "Heights and pressure.",
                  "At the mean pressures over the pictures.",
                  {heights_plot(grid, shown.profile.heights, "The surface")}};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const rough::LoadStep& step = curve.steps[i];
        const rough::ContactState& state = curve.states[i];
        const rough::Interface at = interface_at(shown.profile, shown.model.body, step, state);
        const double gap = at.gap.mean();
        const Unit mean = pressure_unit(step.pressure), top = pressure_unit(state.pressure.maxCoeff()),
                   open = length_unit(gap);
        const std::string label = readable(mean.factor * step.pressure) + " " + mean.name;
        table.rows.push_back({label, readable(step.pressure / shown.model.body.effective_modulus),
                              percent(step.contact_fraction), std::to_string(at.spots), readable(at.widest),
                              readable(top.factor * state.pressure.maxCoeff()) + " " + top.name,
                              readable(open.factor * gap) + " " + open.name});
        figure.panels.push_back(pressure_plot(grid, state, label));
    }
    page.section("On the surface");
    page.table(table);
    page.figure(figure);
    return ended(std::move(page), shown);
}

} // namespace

std::string contact_page(const ContactShown& shown) {
    const rough::Response& response = shown.response;
    const rough::Model& model = shown.model;
    if (shown.profile.is_2d())
        return page_of_area(shown);
    const auto steps = shown_steps(response.steps());
    const rough::ContactCurve curve = solved_anew(shown, steps);

    const rough::Profile& profile = shown.profile;
    const double length = profile.spacing * static_cast<double>(profile.nodes() - 1);
    const Unit across = length_unit(length), mean = pressure_unit(response.pressure.maxCoeff());
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(profile.nodes(), 0, across.factor * length);
    Plot pressure, gap;
    pressure.alt = "Contact pressure along the profile at some mean pressures";
    gap.alt = "Gap between the profile and the deformed body along the profile";
    pressure.x = gap.x = {"Position x (" + across.name + ")"};
    Table table{"",
                {"Mean pressure", "p/E*", "Contact", "Spots", "Widest spot", "Highest pressure", "Mean gap"},
                {},
                std::vector<bool>(7, true)};
    std::vector<rough::Interface> along;
    double peak = 0, widest_gap = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        along.push_back(interface_at(profile, model.body, curve.steps[i], curve.states[i]));
        peak = std::max(peak, along[i].pressure.maxCoeff());
        widest_gap = std::max(widest_gap, along[i].gap.maxCoeff());
    }
    const Unit high = pressure_unit(peak), deep = length_unit(widest_gap);
    pressure.y = {"Pressure (" + high.name + ")", false, 0, unset};
    gap.y = {"Gap (" + deep.name + ")", false, 0, unset};
    for (std::size_t i = steps.size(); i-- > 0;) { // the lightest load is drawn last, over the others
        const rough::LoadStep& step = curve.steps[i];
        const rough::Interface& at = along[i];
        const std::string label = readable(mean.factor * step.pressure) + " " + mean.name;
        const Colour colour = line_colours[i];
        pressure.series.push_back({label, x, high.factor * at.pressure, colour, Style::line, 1.2});
        gap.series.push_back({label, x, deep.factor * at.gap.cwiseMax(0), colour, Style::line, 1.2});
        const Unit width = length_unit(at.widest), open = length_unit(at.gap.mean());
        const Unit top = pressure_unit(at.pressure.maxCoeff());
        table.rows.insert(table.rows.begin(), {label, readable(step.pressure / model.body.effective_modulus),
                                               percent(step.contact_fraction), std::to_string(at.spots),
                                               readable(width.factor * at.widest) + " " + width.name,
                                               readable(top.factor * at.pressure.maxCoeff()) + " " + top.name,
                                               readable(open.factor * at.gap.mean()) + " " + open.name});
    }

    Page page = begun(shown, std::to_string(profile.nodes()));
    page.section("Along the profile");
    page.table(table);
    page.figure({"along",
                 "Pressure and gap.",
                 "At the mean pressures that the key names; where there is pressure, there is no gap.",
                 {pressure, gap}});
    page.figure({"profile",
                 "The profile.",
                 "Heights from their mean, and how much of the length is higher than a height.",
                 {profile_plot(profile), bearing_plot(profile.heights)}});
    return ended(std::move(page), shown);
}

} // namespace app
