#include "apps/commands/design/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"

#include <regex>

namespace rugosa::python {

using rough::Answer;
using namespace py::literals;

namespace {

/// A design run with the response of its answer. Its tolerance is computed when it is first read.
struct Design : app::DesignRun {
    Curve curve;
};

/// None if the similarity was not verified.
std::optional<double> if_verified(double similarity) {
    return std::isnan(similarity) ? std::nullopt : std::optional(similarity);
}

/// The targets of the arguments.
std::vector<rough::Target> targets_from(Keywords& keywords) {
    std::vector<rough::Target> targets;
    if (const auto given = keywords.take<py::object>("target")) {
        if (py::isinstance<rough::Target>(*given))
            targets = {given->cast<rough::Target>()};
        else if (py::isinstance<py::str>(*given) || py::hasattr(*given, "__fspath__"))
            targets = {rough::read_target(given->cast<std::filesystem::path>())};
        else
            targets = given->cast<std::vector<rough::Target>>();
    }
    const auto x = keywords.take_numbers("target_pressure");
    for (const auto& [name, quantity] : {std::pair("target_stiffness", rough::Quantity::stiffness),
                                         {"target_interface_stiffness", rough::Quantity::interface_stiffness},
                                         {"target_contact_fraction", rough::Quantity::area_at_pressure}}) {
        const auto y = keywords.take_numbers(name);
        if (!y) continue;
        if (!x || x->size() != y->size())
            rough::refuse("design: ", name, " and target_pressure differ in length; give the same length");
        rough::Target target;
        target.quantity = quantity;
        target.name = name;
        target.x = *x;
        target.y = *y;
        validate(target);
        targets.push_back(std::move(target));
    }
    return targets;
}

/// An observer that calls a Python callable after each stage: progress(path, generation, evaluations, best).
ga::Observer<rough::Genome> observer(const py::object& progress, Callback& callback) {
    return [progress, &callback, best = -HUGE_VAL](const ga::Event<rough::Genome>& event) mutable {
        for (const auto& individual : event.population)
            if (individual.fitness.has_value()) best = std::max(best, individual.value());
        callback([&] { progress(event.path, event.generation, event.counters.requested, best); });
    };
}

/// Flags of the program that are arguments of trust() here.
const std::vector<std::string> flags_of_trust{"hardness"};

Design design(const py::object& pressure, const py::object& stiffness, py::kwargs given) {
    given["target_pressure"] = pressure;
    given["target_stiffness"] = stiffness;
    Keywords keywords(given, "design");
    const std::vector<rough::Target> targets = targets_from(keywords);
    const auto starts = keywords.take<std::vector<rough::Genome>>("starts");
    const auto progress = keywords.take<py::object>("progress");
    const auto like = keywords.take<py::object>("like");
    const Spacing spacing = keywords.take<OneOrTwo>("spacing");
    if (like && !targets.empty()) throw py::type_error("design: like and a target were given; give only one of them");
    if (!like && targets.empty())
        throw py::type_error("design: no target; give target_pressure and target_stiffness, target= or like=");
    std::optional<rough::Profile> surface;
    Filling filling = like ? filling_from(keywords) : Filling();
    std::vector<std::string> unknown = flags_of_trust;
    if (like) {
        surface = surface_from(*like, spacing, "design: like", filling);
        unknown.emplace_back("length");
    } else {
        unknown.insert(unknown.end(), {"quantity", "points"});
    }
    const app::Settings settings = keywords.settings(app::search_settings(), unknown);
    keywords.expect_none_left();
    app::DesignRequest request;
    if (surface) {
        const rough::Model model = model_of(*surface, settings.with({{"nodes", ""}}));
        warn_of_filling(*surface, filling, model);
        request.setup = setup_like(*surface, model, "like", settings);
    } else {
        request.setup = {.model = surface_model_from(settings), .targets = targets};
    }
    Design run{app::design_from(settings, std::move(request)), {}};
    if (starts) run.options.starts = *starts;
    Interruptible interrupt;
    run.options.stop = &interrupt.stop();
    Callback callback(interrupt.stop());
    std::vector<ga::Observer<rough::Genome>> observers;
    if (progress) observers.push_back(observer(*progress, callback));
    {
        const py::gil_scoped_release unlocked;
        run.found = search(run.setup, run.options, observers);
        static_cast<rough::Response&>(run.curve) = response_of(run.setup, run.found.best).responses.front();
    }
    callback.rethrow();
    run.interrupted = interrupt.requested();
    return run;
}

/// A part of result.json without units in its keys.
py::dict without_units(const nlohmann::json& part) {
    static const std::regex unit("_(mm|MPa)\":");
    return py::module_::import("json").attr("loads")(std::regex_replace(part.dump(), unit, "\":"));
}

py::dict tolerance_of(Design& design) {
    if (!design.tolerance) {
        const py::gil_scoped_release unlocked;
        const rough::DesignSetup tried = app::toleranced(design);
        design.tolerance = rough::tolerance_of(tried, design.found.best.genome, app::priced_tolerance(design, tried));
    }
    py::dict result = without_units(app::tolerance_json(*design.tolerance));
    py::list curve;
    for (const rough::NoiseQuantile& one : design.tolerance->curve)
        curve.append(py::dict("noise_rms"_a = one.noise_rms, "quantile"_a = one.quantile, "median"_a = one.median,
                              "draws"_a = one.draws));
    result["curve"] = curve;
    return result;
}

py::dict trust_of(const Design& design, double noise, double tilt, std::optional<double> hardness, std::uint64_t seed,
                  int threads) {
    rough::TrustOptions options = design.trust_options;
    rough::DesignSetup setup = design.setup;
    setup.errors.noise = noise;
    setup.errors.tilt = tilt;
    if (hardness) options.hardness = hardness;
    options.seed = seed;
    options.threads = threads;
    rough::Trust trust;
    {
        const py::gil_scoped_release unlocked;
        trust = trust_in(setup, design.found.best.genome, options);
    }
    return without_units(app::trust_json(trust));
}

constexpr const char* help_of_design =
    R"(Finds a rough profile, or with nodes=(NX, NY) a map, whose response matches a target.

target_pressure (MPa) with target_stiffness (MPa/mm), target_interface_stiffness or
target_contact_fraction; or target=Target, list of Targets or file; or like=Profile, whose stiffness and
contact area are the targets. Further arguments are starts (Genomes) and progress (a callable with the
arguments path, generations, evaluations, best). Ctrl-C ends the search with the best so far. Returns a
Design.
)";

} // namespace

void add_design(py::module_& module) {
    constexpr auto inside = py::return_value_policy::reference_internal;
    py::class_<Answer>(module, "Answer", "A genome in final amplitude, and its similarities to the target.")
        .def_readonly("genome", &Answer::genome)
        .def_readonly("similarity", &Answer::similarity, "On the grid of the design (Eq. 12).")
        .def_property_readonly(
            "similarity_refined", [](const Answer& a) { return if_verified(a.refined); },
            "On a grid four times finer; None if the time was too short to verify a 2-D design.")
        .def_property_readonly(
            "similarity_worst", [](const Answer& a) { return if_verified(a.worst); },
            "On that grid in finer load steps, less the estimated error that is left; None "
            "likewise.")
        .def_readonly("within_limits", &Answer::within_limits, "Whether it keeps all limits on shape.");
    const auto of_heights = [](const char* member) {
        return [member](const py::object& self) -> py::object { return self.attr("profile").attr(member); };
    };
    py::class_<Design>(module, "Design", "The result of design().")
        .def_property_readonly(
            "genome", [](const Design& d) -> const rough::Genome& { return d.found.best.genome; }, inside)
        .def_property_readonly(
            "profile", [](const Design& d) { return as_python(sample(d.found.best.genome, d.setup.model.grid)); },
            "Its heights on the grid of the design: a Profile or a Surface.")
        .def_property_readonly("heights", of_heights("heights"), "N heights, mm; N_y x N_x of a Surface.")
        .def_property_readonly("spacing", of_heights("spacing"), "Node spacing, mm; a pair along x and y of a Surface.")
        .def_property_readonly("similarity", [](const Design& d) { return d.found.best.similarity; })
        .def_property_readonly("similarity_refined", [](const Design& d) { return if_verified(d.found.best.refined); })
        .def_property_readonly("similarity_worst", [](const Design& d) { return if_verified(d.found.best.worst); })
        .def_property_readonly(
            "found", [](const Design& d) { return is_found(d); },
            "Whether similarity_worst is as high as requested, by default 0.99.")
        .def_property_readonly(
            "bound", [](const Design& d) { return d.unreachable.bound; },
            "Upper bound of the similarity of every profile, or of every map if the design is one.")
        .def_property_readonly(
            "out_of_reach",
            [](const Design& d) {
                std::vector<std::string> reasons;
                for (const auto& reason : d.unreachable.reasons) reasons.push_back(reason.verdict());
                return reasons;
            },
            "Reasons why no profile, or no map, can match the target exactly; empty if one may.")
        .def_property_readonly(
            "alternatives", [](const Design& d) -> const std::vector<Answer>& { return d.found.alternatives; },
            "Different answers, the best first.")
        .def_property_readonly("targets", [](const Design& d) { return d.setup.targets; })
        .def_readonly("curve", &Design::curve, "The response of the answer.")
        .def_readonly("interrupted", &Design::interrupted,
                      "Whether Ctrl-C ended the search; the answer is then the best so far.")
        .def_property_readonly("evaluations", [](const Design& d) { return d.found.counters.evaluations; })
        .def_property_readonly(
            "price", [](const Design& d) { return d.found.counters.price; },
            "Price of all curves and gradients of the search, in curves of the design's grid and load steps.")
        .def_property_readonly("pipeline", [](const Design& d) { return d.found.pipeline; })
        .def_property_readonly("notes", [](const Design& d) { return d.found.notes; })
        .def_property_readonly(
            "stopped", [](const Design& d) { return d.found.stopped; },
            "Why the search ended before its pipeline did; empty if it did not.")
        .def_property_readonly(
            "tolerance", &tolerance_of,
            R"(Required precision of the machine, computed when it is first read: `tolerance` of result.json as
a dictionary, with the curve of similarities under noise. Lengths in mm.)")
        .def("trust", &trust_of, py::kw_only(), "noise"_a = 0.0, "tilt"_a = 0.0, "hardness"_a = py::none(),
             "seed"_a = 1, "threads"_a = 0,
             R"(Checks the answer on finer grids, in more load steps, with another datum, under height noise
(mm rms) or a tilt (mm over the length) and on other bodies: `trust` of result.json as a dictionary.)")
        .def("__repr__", [](const Design& d) {
            return d.found.best.is_verified() ? rough::line_of("<rugosa.Design, ", is_found(d) ? "found" : "not found",
                                                               ": lowest similarity ", d.found.best.lowest(), ">")
                                              : rough::line_of("<rugosa.Design, not verified: similarity ",
                                                               d.found.best.similarity, " on its grid>");
        });
    module.def("design", &design, "target_pressure"_a = py::none(), "target_stiffness"_a = py::none(),
               documented(help_of_design, app::search_settings(), flags_of_trust).c_str());
}

} // namespace rugosa::python
