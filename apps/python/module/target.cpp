#include "domain/target/target.hpp"

#include "apps/prompt/targets.hpp"
#include "apps/python/module/python.hpp"
#include "domain/mwm/sampling.hpp"

namespace rugosa::python {

using rough::Target;
using namespace py::literals;

namespace {

Target target_from(const py::object& x, const py::object& y, const std::string& quantity, double weight) {
    Target target;
    target.quantity = rough::quantity_named(quantity);
    target.name = quantity;
    target.x = numbers_from(x, "Target: x");
    target.y = numbers_from(y, "Target: y");
    if (target.x.size() != target.y.size())
        rough::refuse("Target: ", target.x.size(), " x and ", target.y.size(), " y; give as many of each");
    target.weight = weight;
    validate(target);
    return target;
}

Target target_read(const std::filesystem::path& file, const py::kwargs& given) {
    Keywords keywords(given, "Target.read");
    const app::Settings settings = keywords.settings(app::scale_settings());
    const rough::Model model = model_from(keywords);
    keywords.expect_none_left();
    return rough::read_target(file, scales_from(settings, model));
}

Target target_like(const py::object& like, const Spacing& spacing, const std::string& quantity, rough::Index points,
                   std::optional<double> last, const py::kwargs& given) {
    Keywords keywords(given, "Target.like");
    const bool is_genome = py::isinstance<rough::Genome>(like);
    Filling filling = filling_from(keywords);
    rough::Profile surface = is_genome ? rough::Profile() : surface_from(like, spacing, "Target.like", filling);
    const rough::Model model = is_genome ? model_from(keywords) : model_from(keywords, surface);
    keywords.expect_none_left();
    if (is_genome) surface = sample(like.cast<const rough::Genome&>(), model.grid);
    warn_of_filling(surface, filling, model);
    return rough::target_like(surface, model, "like", rough::quantity_named(quantity), {points, last});
}

} // namespace

void add_target(py::module_& module) {
    py::class_<Target>(module, "Target", R"(A requested curve.

x: pressures (MPa), or displacements (mm) of 'area-displacement' and 'load'; y: values of the quantity
('stiffness' and 'interface_stiffness' in MPa/mm, 'area' a fraction, 'load' in MPa).

>>> import numpy, rugosa
>>> p = numpy.linspace(8e-6, 1.6e-4, 20)
>>> len(rugosa.Target(p, 0.3 + 0.8 * numpy.sqrt(p / 1.6e-4)))
20
)")
        .def(py::init(&target_from), "x"_a, "y"_a, "quantity"_a = "stiffness", "weight"_a = 1.0)
        .def_static("read", &target_read, "file"_a,
                    "Reads a target file (CSV). A conductance needs conductivity (W/(m K)) or resistivity\n"
                    "(ohm m) of the two bodies. Friction needs shear_strength (MPa). Model keywords are\n"
                    "as in contact().")
        .def_static("like", &target_like, "surface"_a, "spacing"_a = py::none(), py::kw_only(),
                    "quantity"_a = "stiffness", "points"_a = 20, "last"_a = py::none(),
                    "The response of a surface at evenly spaced points up to `last` (default: its whole load);\n"
                    "model keywords as in contact().")
        .def_readonly("x", &Target::x)
        .def_readonly("y", &Target::y)
        .def_property_readonly("quantity", [](const Target& t) { return rough::name_of(t.quantity); })
        .def_readwrite("weight", &Target::weight, "Factor of the misfit, in (0, 1].")
        .def("to_csv", &rough::to_csv, "The text of a target file.")
        .def("__len__", &Target::points)
        .def("__repr__", [](const Target& t) {
            return rough::line_of("<rugosa.Target of ", rough::name_of(t.quantity), ", ", t.points(), " points>");
        });
}

} // namespace rugosa::python
