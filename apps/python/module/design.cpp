#include "apps/commands/design/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"

#include <cmath>

namespace rugosa::python {

using rough::Answer;

namespace {

/// What a design was asked and what it found.
struct Design {
    app::DesignRun run; ///< its tolerance is found when it is first read
    Curve curve;

    const Answer& best() const { return run.found.best; }
};

/// None where it was not verified.
std::optional<double> if_verified(double similarity) {
    return std::isnan(similarity) ? std::nullopt : std::optional(similarity);
}

std::vector<rough::Target> targets_from(const py::object& given) {
    if (py::isinstance<rough::Target>(given))
        return {given.cast<rough::Target>()};
    if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"))
        return {rough::read_target(given.cast<std::filesystem::path>())};
    return given.cast<std::vector<rough::Target>>();
}

/// The targets of the arguments, one of them at least.
std::vector<rough::Target> targets_from(const std::optional<Eigen::VectorXd>& pressure,
                                        const std::optional<Eigen::VectorXd>& stiffness, Keywords& keywords) {
    std::vector<rough::Target> targets;
    if (auto given = keywords.take<py::object>("target"))
        targets = targets_from(*given);
    const auto add = [&](const std::optional<Eigen::VectorXd>& y, rough::Quantity quantity,
                         const std::string& name) {
        if (!y)
            return;
        if (!pressure || pressure->size() != y->size())
            throw rough::InputError("design: " + name +
                                    " given, expected target_pressure of the same length");
        rough::Target target;
        target.quantity = quantity;
        target.name = name;
        target.x = *pressure;
        target.y = *y;
        validate(target);
        targets.push_back(std::move(target));
    };
    add(stiffness, rough::Quantity::stiffness, "target_stiffness");
    add(keywords.take<Eigen::VectorXd>("target_interface_stiffness"), rough::Quantity::interface_stiffness,
        "target_interface_stiffness");
    add(keywords.take<Eigen::VectorXd>("target_contact_fraction"), rough::Quantity::area_at_pressure,
        "target_contact_fraction");
    return targets;
}

/// Tells a Python callable of each stage: progress(path, generation, evaluations, best).
ga::Observer<rough::Genome> observer(const py::object& progress, Callback& callback) {
    return [progress, &callback, best = -HUGE_VAL](const ga::Event<rough::Genome>& event) mutable {
        for (const auto& individual : event.population)
            if (const ga::Fitness& f = individual.fitness; f.known() && !f.has_failed() && !f.several())
                best = std::max(best, individual.value());
        callback([&] { progress(event.path, event.generation, event.counters.asked, best); });
    };
}

/// Parameters of the program's design that trust() has.
const std::vector<std::string> of_trust{"hardness"};

Design designed(const std::optional<Eigen::VectorXd>& pressure,
                const std::optional<Eigen::VectorXd>& stiffness, const py::kwargs& given) {
    Keywords keywords(given, "design");
    const std::vector<rough::Target> targets = targets_from(pressure, stiffness, keywords);
    const auto starts = keywords.take<std::vector<rough::Genome>>("starts");
    const py::object progress = keywords.take<py::object>("progress", py::none());
    const auto like = keywords.take<py::object>("like");
    const Spacing spacing = keywords.take<OneOrTwo<double>>("spacing");
    if (like && !targets.empty())
        throw py::type_error("design: like given with a target, expected one of them");
    if (!like && targets.empty())
        throw py::type_error("design: expected target_pressure and target_stiffness, target= or like=");
    std::optional<rough::Profile> surface;
    std::vector<std::string> unknown = of_trust;
    if (like)
        surface = surface_from(*like, spacing, "design: like");
    for (const char* each : {"quantity", "points"})
        if (!like)
            unknown.emplace_back(each);
    for (const char* each : {"length", "nodes"})
        if (surface && (surface->is_2d() || each[0] == 'l'))
            unknown.emplace_back(each);
    const app::Settings settings = keywords.settings(app::search_settings(), unknown);
    keywords.expect_none_left();
    Design design;
    app::DesignRun& run = design.run;
    run = app::design_from(settings, [&](const app::Settings&, app::DesignRun& begun) {
        if (surface)
            return like_surface(*surface, model_of(*surface, settings.with({{"nodes", ""}})), "like",
                                settings, begun.setup);
        begun.setup.targets = targets;
        begun.setup.model = surface_model_from(settings);
    });
    if (starts)
        run.options.starts = *starts;
    Interruptible interrupt;
    run.options.stop = &interrupt.stop();
    Callback callback(interrupt.stop());
    std::vector<ga::Observer<rough::Genome>> observers;
    if (!progress.is_none())
        observers.push_back(observer(progress, callback));
    {
        const py::gil_scoped_release unlocked;
        run.found = search(run.searched, run.options, observers);
        run.setup = rough::exactly(run.found.setup);
        design.curve.response = response_of(run.setup, run.found.best).responses.front();
    }
    callback.rethrow();
    run.interrupted = interrupt.asked();
    return design;
}

/// As `tolerance` of result.json, without units in the names.
py::dict tolerance_of(Design& design) {
    if (!design.run.tolerance) {
        const py::gil_scoped_release unlocked;
        design.run.tolerance =
            rough::tolerance_of(design.run.setup, design.best().genome, design.run.tolerance_options);
    }
    const rough::Tolerance& tolerance = *design.run.tolerance;
    py::list levels, curve;
    for (const rough::ToleranceLevel& level : tolerance.levels)
        levels.append(py::dict(py::arg("similarity") = level.similarity,
                               py::arg("noise_rms") = level.noise_rms, py::arg("tilt") = level.tilt,
                               py::arg("scale") = level.scale));
    for (const rough::NoiseQuantile& one : tolerance.curve)
        curve.append(py::dict(py::arg("noise_rms") = one.noise_rms, py::arg("quantile") = one.quantile,
                              py::arg("median") = one.median, py::arg("draws") = one.draws));
    return py::dict(py::arg("noise_length") = tolerance.noise_length,
                    py::arg("share") = rough::Tolerance::share, py::arg("share_from") = tolerance.share_from,
                    py::arg("share_to") = tolerance.share_to, py::arg("draws") = tolerance.draws,
                    py::arg("similarity") = tolerance.similarity, py::arg("levels") = levels,
                    py::arg("curve") = curve);
}

py::dict trust_of(const Design& design, double noise, double tilt, double hardness, std::uint64_t seed,
                  int threads) {
    rough::TrustOptions options = design.run.trust_options;
    rough::DesignSetup setup = design.run.setup;
    setup.errors.noise = noise;
    setup.errors.tilt = tilt;
    options.hardness = hardness;
    options.seed = seed;
    options.threads = threads;
    rough::Trust trust;
    {
        const py::gil_scoped_release unlocked;
        trust = trust_in(setup, design.best().genome, options);
    }
    py::dict all, checks, kernels;
    for (const rough::Check& check : trust.checks)
        checks[py::str(check.name)] = check.similarity;
    for (const rough::Check& check : trust.kernels)
        kernels[py::str(check.name)] = check.similarity;
    all["checks"] = checks;
    all["kernels"] = kernels;
    for (const auto& [name, value] : {std::pair{"median", trust.median},
                                      {"tenth_percentile", trust.tenth},
                                      {"redrawn_best", trust.redrawn_best},
                                      {"redrawn_median", trust.redrawn_median},
                                      {"rms_slope", trust.rms_slope},
                                      {"peak_pressure", trust.peak_pressure},
                                      {"shortest_wave_nodes", trust.shortest_wave_nodes}})
        all[name] = value;
    all["contact_at_ends"] = trust.contact_at_ends;
    all["flags"] = trust.flags;
    return all;
}

} // namespace

void add_design(py::module_& module) {
    constexpr auto inside = py::return_value_policy::reference_internal;
    py::class_<Answer>(module, "Answer", "A genome in final amplitude and how well it answers.")
        .def_readonly("genome", &Answer::genome)
        .def_readonly("similarity", &Answer::similarity, "On the grid of the design (Eq. 12).")
        .def_property_readonly(
            "similarity_refined", [](const Answer& a) { return if_verified(a.similarity_refined); },
            "On a grid four times finer; None of an area that there was no time to verify.")
        .def_property_readonly(
            "similarity_worst", [](const Answer& a) { return if_verified(a.similarity_worst); },
            "The least over that grid, four times the load steps and both; None as similarity_refined.")
        .def_readonly("within_limits", &Answer::within_limits, "It holds every limit of making.");
    py::class_<Design>(module, "Design", "What design() found.")
        .def_property_readonly(
            "genome", [](const Design& d) -> const rough::Genome& { return d.best().genome; }, inside)
        .def_property_readonly(
            "profile",
            [](const Design& d) { return as_python(sample(d.best().genome, d.run.setup.model.grid)); },
            "Its heights on the grid of the design: a Profile, or a Surface.")
        .def_property_readonly(
            "heights",
            [](const py::object& self) -> py::object { return self.attr("profile").attr("heights"); },
            "N heights, mm; of an area N_y x N_x.")
        .def_property_readonly(
            "spacing",
            [](const py::object& self) -> py::object { return self.attr("profile").attr("spacing"); },
            "Distance of the nodes, mm; of an area along x and y.")
        .def_property_readonly("similarity", [](const Design& d) { return d.best().similarity; })
        .def_property_readonly("similarity_refined",
                               [](const Design& d) { return if_verified(d.best().similarity_refined); })
        .def_property_readonly("similarity_worst",
                               [](const Design& d) { return if_verified(d.best().similarity_worst); })
        .def_property_readonly(
            "found", [](const Design& d) { return is_found(d.run); },
            "similarity_worst is what was asked for, 0.99 by default.")
        .def_property_readonly(
            "bound", [](const Design& d) { return d.run.bound; },
            "No profile whatever has a higher similarity.")
        .def_property_readonly(
            "out_of_reach",
            [](const Design& d) {
                std::vector<std::string> reasons;
                for (const auto& reason : d.run.out_of_reach)
                    reasons.push_back(reason.verdict());
                return reasons;
            },
            "Why no profile can answer exactly; empty where one may.")
        .def_property_readonly(
            "alternatives",
            [](const Design& d) -> const std::vector<Answer>& { return d.run.found.alternatives; },
            "Different answers, the best first.")
        .def_property_readonly("targets", [](const Design& d) { return d.run.setup.targets; })
        .def_readonly("curve", &Design::curve, "The answer's own response.")
        .def_property_readonly(
            "interrupted", [](const Design& d) { return d.run.interrupted; },
            "Ctrl-C ended the search; this is the best so far.")
        .def_property_readonly("evaluations",
                               [](const Design& d) { return d.run.found.counters.evaluations; })
        .def_property_readonly("pipeline", [](const Design& d) { return d.run.found.pipeline; })
        .def_property_readonly("notes", [](const Design& d) { return d.run.found.notes; })
        .def_property_readonly(
            "stopped", [](const Design& d) { return d.run.found.stopped; },
            "Why the search ended before its pipeline; empty when it did not.")
        .def_property_readonly(
            "tolerance", &tolerance_of,
            "How precise the machine must be, found when it is first read: a dictionary of "
            "noise_length\n(mm), share, draws and levels, a list of dictionaries with "
            "similarity, noise_rms, tilt (mm) and scale.")
        .def(
            "trust", &trust_of, py::kw_only(), py::arg("noise") = 0.0, py::arg("tilt") = 0.0,
            py::arg("hardness") = 0.0, py::arg("seed") = 1, py::arg("threads") = 0,
            "Asks the same again on finer grids, in more load steps, with another datum, under height noise\n"
            "(mm rms) or a tilt (mm over the length) and on other bodies; a dictionary of similarities and "
            "flags.")
        .def("__repr__", [](const Design& d) {
            return d.best().is_verified()
                       ? "<rugosa.Design, " + std::string(is_found(d.run) ? "found" : "not found") +
                             ": similarity " + rough::line_of(d.best().lowest()) + " at worst>"
                       : "<rugosa.Design, not verified: similarity " + rough::line_of(d.best().similarity) +
                             " as designed>";
        });
    module.def(
        "design", &designed, py::arg("target_pressure") = py::none(),
        py::arg("target_stiffness") = py::none(),
        documented(
            "Finds a rough profile that answers as a target asks.\n\n"
            "target_pressure (MPa) with target_stiffness (MPa/mm), target_interface_stiffness or\n"
            "target_contact_fraction; or target=Target, list of Targets or file; or like=Profile, whose own\n"
            "stiffness and contact area are the targets. Besides: starts (Genomes), progress (a callable of "
            "path,\n"
            "generations, evaluations, best). Ctrl-C ends the search with the best so far. Returns a "
            "Design.\n",
            app::search_settings(), of_trust)
            .c_str());
}

} // namespace rugosa::python
