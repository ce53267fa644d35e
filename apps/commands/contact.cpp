#include "apps/commands/commands.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/targets.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/record.hpp"
#include "apps/report/render.hpp"
#include "apps/report/surface.hpp"
#include "domain/contact/interface.hpp"
#include "domain/mwm/response.hpp"
#include "domain/text/atomic_file.hpp"

namespace app {
namespace {

using rough::Index;

/// The tables of the page, CURVE-NAME.csv by NAME: `loads`, and pressure and gap along a profile or on a map.
/// If there are more than four load steps, an early one, the middle one and the last are shown. They are
/// solved again. The model is complete. Throws as solve_contact.
std::map<std::string, std::string> contact_tables(const rough::Profile& surface, const rough::Model& model,
                                                  const rough::Response& response) {
    const Eigen::VectorXd& all = response.displacement;
    std::vector<double> shown(all.begin(), all.end());
    if (const Index steps = all.size(); steps > 4) shown = {all[steps / 10], all[(steps - 1) / 2], all[steps - 1]};
    rough::ContactOptions options = model.contact;
    options.states = true;
    options.tolerance = std::min(options.tolerance, rough::ContactOptions{}.tolerance);
    const rough::ContactCurve curve = solve_contact(surface, model.body, shown, options);
    const bool is_2d = surface.is_2d();
    Csv loads("load,mean_pressure_MPa,pressure_over_modulus,contact_fraction,spots," +
              std::string(is_2d ? "max_spot_mm2" : "max_spot_width_mm") + ",highest_pressure_MPa,mean_gap_mm");
    std::string along = "load,x_mm,pressure_MPa,gap_mm\n";
    std::vector<std::string> names{"height_mm"};
    std::vector<Eigen::VectorXd> maps{below_highest(surface)};
    for (std::size_t i = 0; i < curve.steps.size(); ++i) {
        const rough::LoadStep& step = curve.steps[i];
        const rough::Interface at = interface_at(surface, model.body, step, curve.states[i]);
        loads.row(i + 1, step.pressure, step.pressure / model.body.effective_modulus, step.contact_fraction, at.spots,
                  at.widest, curve.states[i].pressure.maxCoeff(), at.gap.mean());
        if (is_2d) {
            names.push_back("pressure_" + std::to_string(i + 1) + "_MPa");
            maps.emplace_back(Eigen::VectorXd::Constant(surface.nodes(), NAN));
            maps.back()(curve.states[i].nodes) = curve.states[i].pressure;
        } else {
            along += drawn_rows(std::to_string(i + 1), {positions(surface), at.pressure, at.gap.cwiseMax(0)});
        }
    }
    if (is_2d) return {{"loads", loads.text()}, {"map", map_csv(surface, names, maps)}};
    return {{"loads", loads.text()},
            {"along", along},
            {"heights-drawn", heights_csv(surface)},
            {"bearing", bearing_csv(surface.heights)}};
}

std::vector<Setting> contact_settings() {
    const std::vector<Setting> settings{
        {"out", "", "curve file to write (CSV)"},
        {"report", "", "page to write (HTML): the curve, with pressure and gap along the profile or on the map [none]"},
        force_setting(),
        threads_setting(),
        whole("seed", "1", 0, 0x1p53, ""), // accepted as in design and run; nothing is random
        accuracy_setting("the resolved model. That has --nodes, or else 64 nodes for the shortest wave. A scan is "
                         "solved on its nodes; so is a map, unless one line is enough"),
        positive("friction", "",
                 "friction coefficient; writes partial slip under the last load to CURVE-slip.csv [none]"),
    };
    return joined(
        {surface_settings(), settings, loading_settings(), scan_settings(), {resolution_setting()}, model_settings()});
}

/// The model under the given loads and within the accuracy, from which the solver's tolerance follows unless
/// one is given.
rough::Model with_load(const rough::Model& unloaded, const Settings& settings) {
    rough::Model model = loaded(unloaded, settings);
    settings.take("accuracy", model.accuracy);
    model.contact.threads = ga::thread_count(settings.whole<int>("threads"));
    model.contact.spots = !settings.has("genome");
    if (model.accuracy > 0 && !settings.given("tolerance")) model.contact.tolerance = 0.01;
    return model;
}

/// A surface and its response.
struct ContactResult : Scene {
    rough::ReportedResponse result = {};
    bool is_measured = false;               ///< a scan or map, not a genome
    rough::ResolutionBand band = {};        ///< for a scan or map
    std::string unresolved = {};            ///< warning of a scan or map; "": every contact is resolved
    std::vector<std::string> warnings = {}; ///< reasons not to believe the curve
};

/// The surface whose nodes last_contact names: the line, if one line answered for the map.
rough::Profile contact_surface(const ContactResult& found) {
    return found.result.account.by_line ? rough::line_of_map(found.surface).line : found.surface;
}

/// Adds the band of a scan or map, and the reasons to doubt a curve: outliers that carry the contact,
/// pressures beyond the material.
void add_doubts(ContactResult& found, const Settings& settings) {
    const auto& [response, account, contact] = found.result;
    if (found.is_measured) {
        found.band = resolution_band(found.surface, found.model, response, resolution_from(settings));
        found.unresolved = resolution_warning(response);
    }
    if (!found.missing.empty()) found.notes.push_back(fill_note(found.surface, found.missing, found.model));
    const auto touches = [&, &touching = contact](rough::Index node) {
        return std::ranges::find(touching, node) != touching.end();
    };
    if (const auto& all = found.outliers; std::ranges::any_of(all, touches)) {
        const rough::OutlierCost cost = outlier_cost(found.surface, all, found.model, response);
        if (cost.matters())
            found.warnings.push_back("outliers carry the contact: without them the contact is " +
                                     readable(cost.contact_fraction) + " times and the stiffness " +
                                     readable(cost.stiffness) + " times as large at " + readable(cost.pressure) +
                                     " MPa; set --outliers remove");
    }
    if (!found.unresolved.empty()) found.warnings.push_back(found.unresolved);
    const double limit = elastic_limit(settings, found.model.body);
    if (std::isinf(limit)) return;
    const rough::ElasticEnd end = elastic_end(contact_surface(found), found.model, response, limit);
    if (end.is_reached(response))
        found.warnings.push_back("elastic theory is not valid from a mean pressure of " +
                                 readable(response.pressure[end.step]) + " MPa on: node pressures exceed " +
                                 readable(limit) + " MPa (" +
                                 (settings.has("material") ? "the hardness of " + settings.text("material")
                                                           : std::string("a tenth of E*, which no solid withstands")) +
                                 "), and reach " + readable(end.largest_pressure) +
                                 " MPa at the last load; use --hardness to limit pressures");
}

/// The contact of a scan or map at the last load, with `words` on it, and whether its spots are resolved.
nlohmann::json resolution_json(const ContactResult& found) {
    const auto& [low_area, high_area, low, high, omitted] = found.band;
    const Index last = found.result.response.steps() - 1;
    const auto nodes = static_cast<Index>(found.result.response.spot_width[last]);
    nlohmann::json values{{"spot_width_nodes", nodes}, {"is_resolved", found.unresolved.empty()}};
    std::string words = "band not computed" + (omitted.empty() ? "" : " (" + omitted + ")");
    if (found.band.is_computed()) {
        values["band"] = {{"contact_fraction_low", low_area[last]},
                          {"contact_fraction_high", high_area[last]},
                          {"stiffness_low_MPa_per_mm", low[last]},
                          {"stiffness_high_MPa_per_mm", high[last]}};
        words = "at the last load the contact fraction is " + readable(100 * low_area[last]) + " to " +
                percent(high_area[last]) + " and K is " + readable(low[last]) + " to " + readable(high[last]) +
                " MPa/mm (limits of the band over measured and interpolated heights)";
    }
    values["words"] = words + "; half of the contact nodes are in spots at most " + std::to_string(nodes) +
                      (nodes == 1 ? " node" : " nodes") + " wide; spots of this width are " +
                      (nodes < rough::resolved_spot_nodes ? "not " : "") + "resolved";
    return values;
}

/// The numbers of nodes of the contact spots of a map at the last load step, the largest first. Those of a
/// line that answered for the map are as wide as the map.
Eigen::VectorXd spots_of(const ContactResult& found) {
    const rough::Extent shape = contact_surface(found).shape();
    const auto sizes = rough::group_sizes(found.result.last_contact, shape, found.model.grid.periodic);
    Eigen::VectorXd nodes(static_cast<Index>(sizes.size()));
    std::copy(sizes.begin(), sizes.end(), nodes.begin());
    return nodes * static_cast<double>(found.surface.nodes() / shape.nodes());
}

ContactResult map_result(const Settings& settings) {
    ContactResult found{map_from(settings, "surface")};
    found.model = with_load(found.model, settings);
    found.result = respond_within(found.surface, found.model);
    if (!settings.has("genome") && found.model.grid.periodic) found.notes.push_back(jump_note(found.surface));
    return found;
}

/// A note that a genome has wavelengths under 8 node spacings. "" if it has none.
std::string wave_note(const rough::Genome& genome, const rough::Grid& grid) {
    constexpr double min_nodes = 8 * (1 - 1e-9);
    const double nodes = shortest_wave(genome) / grid.spacing();
    return nodes < min_nodes ? "note: the shortest wavelength is " + readable(nodes) +
                                   " nodes long, under 8: light contact depends on the grid"
                             : "";
}

ContactResult line_result(const Settings& settings) {
    const Source source = source_from(settings, "profile");
    const std::optional<rough::Genome>& genome = source.genome;
    ContactResult found;
    rough::Model& model = found.model;
    model = with_load(model_from(settings, source), settings);
    if (model.accuracy > 0 && genome && !settings.has("nodes"))
        model.grid = rough::resolved_grid(*genome, model.grid.length, model.grid.periodic);
    found.surface = source.on(model.grid);
    found.result = genome ? respond_within(*genome, model) : respond_within(found.surface, model);
    found.missing = source.missing.nodes;
    found.outliers = source.outliers;
    found.notes = {genome ? wave_note(*genome, model.grid) : source.account};
    const double range = found.surface.heights.maxCoeff() - found.surface.heights.minCoeff();
    if (model.grid.periodic)
        found.notes.push_back(genome ? jump_note(*genome, model.grid.length, range) : jump_note(found.surface));
    return found;
}

/// A written file as the page links to it.
std::string from_page(const std::filesystem::path& file, const std::filesystem::path& page) {
    const auto folder = std::filesystem::absolute(page).parent_path();
    return std::filesystem::absolute(file).lexically_proximate(folder).string();
}

/// The files of a contact curve. All are checked before anything is computed.
struct CurveFiles {
    std::filesystem::path curve, account, page;          ///< CURVE.csv; CURVE.json and the page, if they are written
    std::map<std::string, std::filesystem::path> tables; ///< CURVE-NAME.csv by NAME
};

CurveFiles files_from(const Settings& settings, bool is_2d) {
    if (!settings.has("out")) rough::refuse("--out: missing; name the curve file to write");
    const std::filesystem::path given = settings.text("out");
    CurveFiles files;
    files.curve = expect_writable(given, settings);
    if (std::filesystem::exists(files.curve) && !std::filesystem::is_regular_file(files.curve)) {
        for (const char* flag : {"friction", "report", is_2d ? "out" : ""}) // a device or a pipe
            if (*flag && settings.has(flag))
                rough::refuse("--", flag, ": ", given.string(),
                              " is not a regular file; choose one that further files can be written next to");
        return files;
    }
    std::filesystem::path account = given;
    given.extension() == ".json" ? account += ".json" : account.replace_extension(".json");
    files.account = expect_writable(account, settings);
    std::vector<std::string> names;
    if (settings.has("friction")) names.emplace_back("slip");
    if (is_2d) names.emplace_back("spots");
    if (settings.has("report")) {
        files.page = expect_writable(settings.text("report"), settings);
        const auto drawn = rough::listed(is_2d ? "loads,map" : "loads,along,heights-drawn,bearing");
        names.insert(names.end(), drawn.begin(), drawn.end());
    }
    for (const std::string& name : names)
        files.tables[name] = expect_writable(
            std::filesystem::path(account).replace_filename(account.stem().string() + "-" + name + ".csv"), settings);
    return files;
}

/// Writes CURVE.csv and the other files, the page last.
void write_files(const CurveFiles& files, const ContactResult& found, const std::vector<std::string>& notes,
                 const Settings& settings) {
    const rough::Response& response = found.result.response;
    rough::write_atomically(files.curve, csv(response, found.is_measured ? &found.band : nullptr));
    if (files.account.empty()) return;
    std::map<std::string, std::string> tables;
    if (!files.page.empty()) tables = contact_tables(found.surface, found.model, response);
    if (files.tables.contains("slip")) {
        const rough::PartialSlip slip =
            partial_slip(found.surface, found.model.body, response, settings.number("friction"), found.model.contact);
        tables["slip"] = csv({"tangential_displacement_mm", "tangential_traction_MPa",
                              "tangential_stiffness_MPa_per_mm", "stick_fraction"},
                             {slip.displacement, slip.traction, slip.stiffness, slip.stick_fraction});
    }
    if (files.tables.contains("spots"))
        tables["spots"] = csv({"nodes", "area_mm2"},
                              {spots_of(found), spots_of(found) * found.surface.spacing * found.surface.row_spacing});
    for (const auto& [name, table] : tables) rough::write_atomically(files.tables.at(name), table);

    nlohmann::json values = account_json(found.result.account);
    values["warnings"] = found.warnings;
    values["resolution"] = found.is_measured ? resolution_json(found) : nlohmann::json();
    if (files.tables.contains("slip"))
        values["partial_slip"] = {{"friction", settings.number("friction")},
                                  {"assumed", slip_assumption(found.model.body, found.surface.is_2d())}};
    if (files.page.empty()) return write_json(files.account, values);
    const rough::Profile& surface = found.surface;
    const rough::Body& body = found.model.body;
    const Index last = response.steps() - 1;
    values.update({{"kind", "contact"},
                   {"is_2d", surface.is_2d()},
                   {"pressed_nodes", surface.nodes()},
                   {"kernel", name_of(body.kernel)},
                   {"effective_modulus_MPa", body.effective_modulus},
                   {"last",
                    {{"pressure_MPa", response.pressure[last]},
                     {"contact_fraction", response.contact_fraction[last]},
                     {"stiffness_MPa_per_mm", response.tangent_stiffness[last]}}},
                   {"max_kkt_residual", response.kkt_residual.maxCoeff()},
                   {"name", settings.text(the_given(settings, surface_names, "contact"))},
                   {"notes", notes},
                   {"curve", files.curve.filename().string().substr(files.account.stem().string().size())}});
    if (surface.is_2d()) values["pressed_nodes"] = {surface.shape().columns, surface.shape().rows};
    values["notes"].push_back(in_words(found.result.account));
    for (const auto& file : {files.curve, files.account}) values["files"].push_back(from_page(file, files.page));
    for (const char* name : {"slip", "spots"})
        if (files.tables.contains(name)) values["files"].push_back(from_page(files.tables.at(name), files.page));
    write_json(files.account, values);
    rough::write_atomically(files.page, render(page_source(files.account)));
}

int contact(const Settings& settings, const std::string&) {
    the_given(settings, surface_names, "contact");
    if (settings.has("friction") && settings.has("hardness"))
        rough::refuse("--friction: given with --hardness; give one of them, as partial slip rests on elastic contact");
    const bool is_2d = asks_for_map(settings);
    const CurveFiles files = files_from(settings, is_2d);
    ContactResult found = is_2d ? map_result(settings) : line_result(settings);
    found.model.contact.tolerance = found.result.account.tolerance;
    found.is_measured = !settings.has("genome");
    add_doubts(found, settings);
    std::vector<std::string> notes = found.notes;
    if (found.is_measured) notes.insert(notes.begin(), resolution_json(found)["words"]);
    std::ranges::copy(notes_on(settings, found.model), std::back_inserter(notes));
    notes.push_back(states_modulus(settings) ? material_note(settings) : modulus_note);
    std::erase(notes, "");
    write_files(files, found, notes, settings);

    if (files.tables.contains("spots"))
        tell(files.tables.at("spots").string() + ": " + std::to_string(spots_of(found).size()) +
             " contact spots under the last load");
    if (files.tables.contains("slip"))
        tell(files.tables.at("slip").string() +
             ": partial slip under the last load, f = " + readable(settings.number("friction")) +
             "; assumed: " + slip_assumption(found.model.body, found.surface.is_2d()));
    for (const std::string& warning : found.warnings) say("warning: " + warning);
    std::ranges::for_each(notes, say);
    const rough::Response& response = found.result.response;
    tell(settings.text("out") + ": " + std::to_string(response.steps()) + " load steps by " + name_of(response.solver) +
         ", height range " + readable(response.range) + " mm, largest KKT residual " +
         readable(response.kkt_residual.maxCoeff()));
    // Held nodes change the meaning of the curve.
    (found.result.account.held_nodes > 0 || (is_2d && found.model.accuracy > 0) ? say
                                                                                : tell)(in_words(found.result.account));
    if (!files.account.empty()) {
        const Index last = response.steps() - 1;
        const Unit unit = pressure_unit(response.pressure[last]);
        say(settings.text("out") + ": at " + readable(unit.factor * response.pressure[last]) + " " + unit.name +
            " the contact fraction is " + percent(response.contact_fraction[last]) + " and the stiffness " +
            readable(response.tangent_stiffness[last]) + " MPa/mm" +
            (files.page.empty() ? "" : "; page " + files.page.string()));
    }
    return 0;
}

} // namespace

Command contact_command() { return {"contact", contact_settings(), contact}; }

} // namespace app
