#include "apps/prompt/model_settings.hpp"
#include "apps/python/module/python.hpp"
#include "domain/response/interface.hpp"
#include "domain/response/partial_slip.hpp"

namespace rugosa::python {

using Eigen::VectorXd;
using rough::Response;

namespace {

/// Read-only access to a member array, without a copy.
template <class Member>
auto view(Member member) {
    return [member](const Curve& curve) -> const auto& { return curve.response.*member; };
}

/// What interrupts a solution; the exception that Python knows for it.
template <class Solve>
auto interruptible(rough::Model& model, Solve solve) {
    Interruptible interrupt;
    model.contact.stop = [&] { return interrupt.asked(); };
    try {
        const py::gil_scoped_release unlocked;
        return solve();
    } catch (const rough::NotConverged&) {
        if (!interrupt.asked())
            throw;
    }
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
}

/// Which derivatives are asked for.
struct Gradient {
    bool of_pressure = false, of_area = false;
};

/// Presses heights; `in_genes` pulls rows of derivatives in heights back where they are a genome's.
template <class Accounted, class Pull>
Curve pressed(const rough::Profile& surface, rough::Model model, Gradient gradient, Accounted accounted,
              Pull pull) {
    return interruptible(model, [&] {
        Curve curve;
        if (gradient.of_pressure || gradient.of_area) {
            auto both =
                respond_with_gradient(surface, model.body, model.loading, model.contact, gradient.of_area);
            curve.response = std::move(both.response);
            curve.smooth_fraction = both.area.fraction;
            auto rows = pull(both.gradient, both.area);
            curve.pressure_gradient = std::move(rows.pressure);
            curve.displacement_gradient = rows.last_displacement.transpose();
            curve.fraction_gradient = std::move(rows.contact_fraction);
        } else if (model.accuracy > 0) {
            auto within = accounted(model);
            curve.response = std::move(within.response);
            curve.account = in_words(within.account);
        } else {
            curve.response = respond(surface, model);
        }
        return curve;
    });
}

Curve of_surface(const rough::Profile& surface, Keywords& keywords, Gradient gradient) {
    rough::Model model = model_from(keywords, surface);
    const app::Settings of_scan = keywords.settings({app::resolution_setting()});
    keywords.expect_none_left();
    Curve curve = pressed(
        surface, model, gradient,
        [&](const rough::Model& m) { return respond_within(surface, m); },
        [](const rough::ResponseGradient& rows, const rough::AreaGradient& area) {
            return rough::ResponseJacobian{rows.pressure, rows.last_displacement, area.by_heights};
        });
    if (of_scan.given("resolution"))
        curve.band = interruptible(model, [&] {
            return resolution_band(surface, model, curve.response, app::resolution_from(of_scan));
        });
    return curve;
}

Curve of_genome(const rough::Genome& genome, Keywords& keywords, Gradient gradient) {
    const rough::Model model = model_from(keywords);
    keywords.expect_none_left();
    return pressed(
        sample(genome, model.grid), model, gradient,
        [&](const rough::Model& m) { return respond_within(genome, m); },
        [&](const rough::ResponseGradient& rows, const rough::AreaGradient& area) {
            return rough::in_genes(
                rows,
                [&](const Eigen::MatrixXd& each) { return rough::pulled_back(each, genome, model.grid); },
                area);
        });
}

py::tuple slip_of(const Curve& curve, double friction) {
    rough::PartialSlip slip = rough::partial_slip(curve.response, friction);
    return py::make_tuple(std::move(slip.displacement), std::move(slip.traction), std::move(slip.stiffness),
                          std::move(slip.stick_fraction));
}

/// Read-only access to a member of the band.
auto band(Eigen::VectorXd rough::ResolutionBand::*member) {
    return [member](const Curve& curve) -> const VectorXd& { return curve.band.*member; };
}

} // namespace

void add_contact(py::module_& module) {
    using rough::ResolutionBand;
    constexpr auto inside = py::return_value_policy::reference_internal;
    py::class_<Curve>(module, "Curve",
                      "What a surface answers to its load steps; arrays are read-only views.")
        .def_property_readonly("displacement", view(&Response::displacement), inside, "Approach, mm.")
        .def_property_readonly("pressure", view(&Response::pressure), inside, "Mean pressure, MPa.")
        .def_property_readonly("contact_fraction", view(&Response::contact_fraction), inside,
                               "Nodes that touch over all nodes.")
        .def_property_readonly("tangent_stiffness", view(&Response::tangent_stiffness), inside,
                               "dp/d displacement, MPa/mm.")
        .def_property_readonly("kkt_residual", view(&Response::kkt_residual), inside,
                               "Certificate of each step, scale-free.")
        .def_property_readonly(
            "interface_stiffness", [](const Curve& c) { return rough::interface_stiffness(c.response); },
            "1/(1/K - 1/K_full), MPa/mm; does not depend on the datum.")
        .def_property_readonly(
            "full_stiffness", [](const Curve& c) { return c.response.full_stiffness; },
            "K of the same body with every node in contact, MPa/mm.")
        .def_property_readonly(
            "height_range", [](const Curve& c) { return c.response.range; }, "mm.")
        .def_property_readonly(
            "solver", [](const Curve& c) { return rough::name_of(c.response.solver); },
            "Name of the solver that was used.")
        .def_property_readonly(
            "contact_fraction_low", band(&ResolutionBand::contact_fraction_low), inside,
            "With resolution='auto' or 'on': least of the heights as given and interpolated "
            "4 times, linearly and by a spline. Empty if it was not computed.")
        .def_property_readonly("contact_fraction_high", band(&ResolutionBand::contact_fraction_high), inside,
                               "The greatest.")
        .def_property_readonly("tangent_stiffness_low", band(&ResolutionBand::tangent_stiffness_low), inside,
                               "The same of K, MPa/mm: least.")
        .def_property_readonly("tangent_stiffness_high", band(&ResolutionBand::tangent_stiffness_high),
                               inside, "The greatest.")
        .def_readonly("account", &Curve::account,
                      "Under accuracy=: what was modelled and how wrong it may be.")
        .def_property_readonly(
            "pressure_gradient", [](const Curve& c) -> const Eigen::MatrixXd& { return c.pressure_gradient; },
            inside,
            "With gradient=True: dp/dheights (steps x N, MPa/mm; an area row after row), of a genome "
            "dp/dgenes.")
        .def_property_readonly(
            "displacement_gradient",
            [](const Curve& c) -> const VectorXd& { return c.displacement_gradient; }, inside,
            "With gradient=True: the same of the last displacement.")
        .def_property_readonly(
            "smooth_contact_fraction", [](const Curve& c) -> const VectorXd& { return c.smooth_fraction; },
            inside,
            "With area_gradient=True: the contact fraction without its steps, as targets of area are "
            "refined.")
        .def_property_readonly(
            "contact_fraction_gradient",
            [](const Curve& c) -> const Eigen::MatrixXd& { return c.fraction_gradient; }, inside,
            "With area_gradient=True: its derivative, as pressure_gradient (1/mm, or in genes).")
        .def(
            "secant_stiffness",
            [](const Curve& c) {
                rough::Curve secants = rough::secant_stiffness(c.response);
                return py::make_tuple(std::move(secants.x), std::move(secants.y));
            },
            "(p in MPa, K in MPa/mm): the stiffness that designs are scored by.")
        .def("partial_slip", &slip_of, py::arg("friction"),
             "(tangential displacement mm, traction MPa, stiffness MPa/mm, stick fraction) under the last "
             "load (Ciavarella 1998, Jaeger 1998; uncoupled bodies).")
        .def("__len__", [](const Curve& c) { return c.response.steps(); })
        .def("__repr__", [](const Curve& c) {
            return "<rugosa.Curve of " + std::to_string(c.response.steps()) + " load steps to " +
                   rough::line_of(c.response.pressure[c.response.steps() - 1]) + " MPa>";
        });
    module.def(
        "contact",
        [](const py::object& surface, const Spacing& spacing, bool of_pressure, bool of_area,
           const py::kwargs& model) {
            const Gradient gradient{of_pressure, of_area};
            Keywords keywords(model, "contact");
            if (!py::isinstance<rough::Genome>(surface))
                return of_surface(surface_from(surface, spacing, "contact"), keywords, gradient);
            if (spacing)
                throw py::type_error("contact: spacing given with a Genome, expected nodes and length");
            return of_genome(surface.cast<const rough::Genome&>(), keywords, gradient);
        },
        py::arg("heights"), py::arg("spacing") = py::none(), py::kw_only(), py::arg("gradient") = false,
        py::arg("area_gradient") = false,
        documented(
            "Presses a rough surface on an elastic body, load step by load step.\n\n"
            "heights: N heights (mm) of a line, or N_y x N_x of an area, with their spacing (mm; a pair "
            "along x\n"
            "and y), a Profile, a Surface, or a Genome.\n"
            "Only a Genome takes nodes and length (pairs along x and y for an area). An area has no datum,\n"
            "strip_width or accuracy. resolution='auto' or 'on' adds the band of a scan's or map's "
            "resolution\n"
            "(Curve.contact_fraction_low and so on), as the program does; plain heights are taken as they "
            "are.\n"
            "Returns a Curve. Raises InputError, NotConverged.\n\n"
            ">>> import numpy, rugosa\n"
            ">>> x = (numpy.arange(512) - 255.5) / 512\n"
            ">>> curve = rugosa.contact(-x**2 / 2, 1 / 512)\n"
            ">>> curve.pressure.shape\n"
            "(20,)\n"
            ">>> bool(curve.kkt_residual.max() < 1e-9)\n"
            "True\n",
            response_settings())
            .c_str());
}

} // namespace rugosa::python
