#include "apps/python/module/python.hpp"

namespace rugosa::python {

using rough::Target;

void add_target(py::module_& module) {
    py::class_<Target>(module, "Target",
                       "A curve that is asked for.\n\n"
                       "x: pressures (MPa), or displacements (mm) of 'area-displacement' and 'load'; y: the\n"
                       "quantity there ('stiffness' and 'interface_stiffness' in MPa/mm, 'area' a fraction,\n"
                       "'load' in MPa).\n\n"
                       ">>> import numpy, rugosa\n"
                       ">>> p = numpy.linspace(8e-6, 1.6e-4, 20)\n"
                       ">>> len(rugosa.Target(p, 0.3 + 0.8 * numpy.sqrt(p / 1.6e-4)))\n"
                       "20\n")
        .def(py::init([](const Eigen::VectorXd& x, const Eigen::VectorXd& y, const std::string& quantity,
                         double weight) {
                 if (x.size() != y.size())
                     throw rough::InputError("Target: " + std::to_string(x.size()) + " x and " +
                                             std::to_string(y.size()) + " y given, expected as many");
                 Target target;
                 target.quantity = rough::quantity_named(quantity);
                 target.name = quantity;
                 target.x = x;
                 target.y = y;
                 target.weight = weight;
                 validate(target);
                 return target;
             }),
             py::arg("x"), py::arg("y"), py::arg("quantity") = "stiffness", py::arg("weight") = 1.0)
        .def_static(
            "read", [](const std::filesystem::path& file) { return rough::read_target(file); },
            py::arg("file"), "Reads a target file (CSV).")
        .def_static(
            "like",
            [](const py::object& surface, const Spacing& spacing, const std::string& quantity,
               rough::Index points, double last, const py::kwargs& model) {
                Keywords keywords(model, "Target.like");
                const bool genome = py::isinstance<rough::Genome>(surface);
                const rough::Profile own =
                    genome ? rough::Profile() : surface_from(surface, spacing, "Target.like");
                const rough::Model under = genome ? model_from(keywords) : model_from(keywords, own);
                keywords.expect_none_left();
                return rough::target_like(genome ? sample(surface.cast<const rough::Genome&>(), under.grid)
                                                 : own,
                                          under, "like", rough::quantity_named(quantity), points, last);
            },
            py::arg("surface"), py::arg("spacing") = py::none(), py::kw_only(),
            py::arg("quantity") = "stiffness", py::arg("points") = 20, py::arg("last") = 0.0,
            "A surface's own response at even points up to `last` (0: as far as it is loaded); model\n"
            "keywords as in contact().")
        .def_property_readonly(
            "x", [](const Target& t) -> const Eigen::VectorXd& { return t.x; },
            py::return_value_policy::reference_internal)
        .def_property_readonly(
            "y", [](const Target& t) -> const Eigen::VectorXd& { return t.y; },
            py::return_value_policy::reference_internal)
        .def_property_readonly("quantity", [](const Target& t) { return rough::name_of(t.quantity); })
        .def_readwrite("weight", &Target::weight, "(0, 1]: a misfit counts so much.")
        .def("to_csv", &rough::to_csv, "As a target file.")
        .def("__len__", &Target::points)
        .def("__repr__", [](const Target& t) {
            return "<rugosa.Target of " + rough::name_of(t.quantity) + ", " + std::to_string(t.points()) +
                   " points>";
        });
}

} // namespace rugosa::python
