#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"
#include "domain/mwm/response.hpp"
#include "domain/response/curve.hpp"
#include "ga/base/parallel.hpp"

namespace rugosa::python {
namespace {

/// The response of a surface under the model, with the requested derivatives. They are with respect to the
/// genes if the heights are a genome's, else to the heights.
Curve press(const rough::Profile& surface, const rough::Genome* genome, const rough::Model& model, bool gradient,
            bool area_gradient) {
    Curve curve;
    rough::Response& response = curve;
    if (gradient || area_gradient) {
        auto both = respond_with_gradient(surface, model.body, model.loading, model.contact, area_gradient);
        const auto pull_back = [&](const Eigen::MatrixXd& rows) {
            return rough::pulled_back(rows, *genome, model.grid);
        };
        auto rows = genome ? rough::in_genes(both.gradient, pull_back) : std::move(both.gradient);
        response = std::move(both.response);
        curve.smooth_contact_fraction = both.smooth_fraction;
        curve.pressure_gradient = std::move(rows.pressure);
        curve.displacement_gradient = rows.last_displacement.transpose();
        curve.contact_fraction_gradient = std::move(rows.contact_fraction);
    } else if (model.accuracy > 0) {
        auto within = genome ? respond_within(*genome, model) : respond_within(surface, model);
        response = std::move(within.response);
        curve.account = in_words(within.account);
    } else {
        response = respond(surface, model);
    }
    return curve;
}

Curve contact(const py::object& heights, const Spacing& spacing, bool gradient, bool area_gradient,
              const py::kwargs& given) {
    Keywords keywords(given, "contact");
    const auto* genome = py::isinstance<rough::Genome>(heights) ? &heights.cast<const rough::Genome&>() : nullptr;
    if (genome && spacing) throw py::type_error("contact: a Genome has no spacing; give nodes and length");
    Filling filling = filling_from(keywords);
    rough::Profile surface = genome ? rough::Profile() : surface_from(heights, spacing, "contact", filling);
    rough::Model model = genome ? model_from(keywords) : model_from(keywords, surface);
    model.contact.threads = ga::thread_count(keywords.settings({app::threads_setting()}).whole<int>("threads"));
    std::optional<rough::Resolution> resolution;
    if (genome)
        surface = sample(*genome, model.grid);
    else if (const auto scan = keywords.settings({app::resolution_setting()}); scan.given("resolution"))
        resolution = app::resolution_from(scan);
    keywords.expect_none_left();
    Interruptible interrupt;
    model.contact.stop = [&] { return interrupt.requested(); };
    try {
        const py::gil_scoped_release unlocked;
        Curve curve = press(surface, genome, model, gradient, area_gradient);
        if (!filling.filled.empty())
            curve.account += (curve.account.empty() ? "" : "; ") + app::fill_note(surface, filling.filled, model);
        curve.body = model.body;
        if (resolution)
            static_cast<rough::ResolutionBand&>(curve) = resolution_band(surface, model, curve, *resolution);
        curve.surface = std::move(surface);
        return curve;
    } catch (const rough::NotConverged&) {
        interrupt.rethrow();
        throw;
    }
}

py::tuple slip_of(const Curve& curve, double friction) {
    rough::PartialSlip slip = rough::partial_slip(curve.surface, curve.body, curve, friction);
    return py::make_tuple(std::move(slip.displacement), std::move(slip.traction), std::move(slip.stiffness),
                          std::move(slip.stick_fraction));
}

constexpr const char* help_of_contact = R"(Presses a rough surface on an elastic body, load step by load step.

heights: N heights (mm) of a line, or N_y x N_x of a 2-D surface, with their spacing (mm; a pair along x
and y); a Profile, a Surface or a Genome. Only a Genome takes nodes and length (pairs for a 2-D grid).
datum and strip_width are for lines. layer takes a list of (T, E, nu). resolution='auto' or 'on' adds the band of a scan's or
map's resolution (Curve.contact_fraction_low and so on); heights in an array are taken as they are.
NaN and masked points are missing. fill=True fills them, at most the share max_filled (0.3): along a line by
interpolation, on a map by Laplace's equation. Curve.account then has their effect on the contact.
threads=0 takes all threads for a 2-D surface; the curve does not depend on them.
Returns a Curve. Raises InputError, NotConverged.

>>> import numpy, rugosa
>>> x = (numpy.arange(512) - 255.5) / 512
>>> curve = rugosa.contact(-x**2 / 2, 1 / 512)
>>> curve.pressure.shape
(20,)
>>> bool(curve.kkt_residual.max() < 1e-9)
True
)";

} // namespace

void add_contact(py::module_& module) {
    py::class_<Curve>(module, "Curve", "The response of a surface at its load steps; arrays are read-only views.")
        .def_readonly("displacement", &Curve::displacement, "Approach, mm.")
        .def_readonly("pressure", &Curve::pressure, "Mean pressure, MPa.")
        .def_readonly("contact_fraction", &Curve::contact_fraction,
                      "Number of nodes in contact over that of all nodes.")
        .def_readonly("tangent_stiffness", &Curve::tangent_stiffness, "dp/d displacement, MPa/mm.")
        .def_readonly("kkt_residual", &Curve::kkt_residual, "Certificate of each step, scale-free.")
        .def_property_readonly(
            "interface_stiffness", [](const Curve& c) { return rough::interface_stiffness(c); },
            "1/(1/K - 1/K_full), MPa/mm; does not depend on the datum.")
        .def_readonly("full_stiffness", &Curve::full_stiffness,
                      "K of the same body with every node in contact, MPa/mm.")
        .def_readonly("height_range", &Curve::range, "Highest minus lowest height, mm.")
        .def_property_readonly(
            "solver", [](const Curve& c) { return rough::name_of(c.solver); }, "Name of the solver that was used.")
        .def_readonly("contact_fraction_low", &Curve::contact_fraction_low,
                      "With resolution='auto' or 'on': lowest value over the heights as given and "
                      "interpolated 4 times, linearly and by a spline. Empty if it was not computed.")
        .def_readonly("contact_fraction_high", &Curve::contact_fraction_high, "Highest value over these heights.")
        .def_readonly("tangent_stiffness_low", &Curve::tangent_stiffness_low, "Lowest K over these heights, MPa/mm.")
        .def_readonly("tangent_stiffness_high", &Curve::tangent_stiffness_high, "Highest K over these heights, MPa/mm.")
        .def_readonly("account", &Curve::account,
                      "With accuracy=: how it was modelled, and its errors. With filled points: their effect.")
        .def_readonly("pressure_gradient", &Curve::pressure_gradient,
                      "With gradient=True: dp/dheights (steps x N, MPa/mm, a map row by row), or dp/dgenes for a "
                      "genome.")
        .def_readonly("displacement_gradient", &Curve::displacement_gradient,
                      "With gradient=True: derivative of the last displacement with respect to heights or genes.")
        .def_readonly("smooth_contact_fraction", &Curve::smooth_contact_fraction,
                      "With area_gradient=True: contact fraction without its steps, which refinement uses.")
        .def_readonly("contact_fraction_gradient", &Curve::contact_fraction_gradient,
                      "With area_gradient=True: its derivative (1/mm, or per gene), as pressure_gradient.")
        .def(
            "secant_stiffness",
            [](const Curve& c) {
                rough::Curve secants = rough::secant_stiffness(c);
                return py::make_tuple(std::move(secants.x), std::move(secants.y));
            },
            "(p in MPa, K in MPa/mm): the stiffness that the similarity of designs uses.")
        .def("partial_slip", &slip_of, py::arg("friction"),
             "(tangential displacement mm, traction MPa, stiffness MPa/mm, stick fraction) under the last "
             "load. slip_assumption says what it assumes.")
        .def_property_readonly(
            "slip_assumption", [](const Curve& c) { return rough::slip_assumption(c.body, c.surface.is_2d()); },
            "The assumptions of partial_slip(), in words.")
        .def("__len__", &Curve::steps)
        .def("__repr__", [](const Curve& c) {
            return rough::line_of("<rugosa.Curve of ", c.steps(), " load steps to ", c.pressure[c.steps() - 1],
                                  " MPa>");
        });
    module.def("contact", &contact, py::arg("heights"), py::arg("spacing") = py::none(), py::kw_only(),
               py::arg("gradient") = false, py::arg("area_gradient") = false,
               documented(help_of_contact, response_settings()).c_str());
}

} // namespace rugosa::python
