#include "apps/python/module/python.hpp"
#include "domain/mwm/sampling.hpp"
#include "domain/text/json.hpp"
#include "ga/base/json.hpp"

namespace rugosa::python {

using namespace py::literals;

void add_genome(py::module_& module) {
    using rough::Genome;
    py::class_<Genome>(module, "Genome",
                       R"(A profile as a sum of Weierstrass-Mandelbrot series (lengths in mm).

>>> import rugosa
>>> wave = {'A': 0.01, 'H': 0.8, 'gamma': 1.5, 'lambda': 1.0,
...         'chromosomes': [{'n': 1, 'phases': [0.3]}, {'n': 2, 'phases': [1.1]}]}
>>> genome = rugosa.Genome({'series': [wave]})
>>> genome.genes.shape
(6,)
)")
        .def(py::init([](const py::dict& content) {
                 const auto text = py::module_::import("json").attr("dumps")(content).cast<std::string>();
                 return rough::genome_from_json(rough::parsed_json(text, "genome"), "genome");
             }),
             "content"_a, "content: a dictionary as in a genome file (JSON).")
        .def_static("read", &rough::read_genome, "file"_a, "Reads a genome file.")
        .def(
            "to_dict",
            [](const Genome& genome) {
                return py::module_::import("json").attr("loads")(rough::genome_to_json(genome).dump());
            },
            "The content of a genome file; the amplitudes include the scale.")
        .def_readonly("scale", &Genome::scale, "Factor on all heights.")
        .def_property_readonly(
            "genes", [](const Genome& genome) { return py::array(py::cast(rough::genes(genome))); },
            "All genes: A, H, gamma and lambda (mm) of each series, then its phases (rad).")
        .def(
            "with_genes",
            [](const Genome& genome, const py::object& given) {
                const Eigen::VectorXd values = numbers_from(given, "genes");
                if (const auto count = std::ssize(rough::genes(genome)); values.size() != count)
                    rough::refuse("genes: ", values.size(), " were given; give ", count);
                Genome changed = rough::with_genes(genome, {values.begin(), values.end()});
                validate(changed, "genes");
                return changed;
            },
            "genes"_a, "The genome with its genes replaced.")
        .def(
            "profile",
            [](const Genome& genome, const py::object& nodes, const py::object& length, const py::object& kernel) {
                Keywords keywords(py::dict("nodes"_a = nodes, "length"_a = length, "kernel"_a = kernel), "profile");
                return as_python(rough::sample(genome, model_from(keywords).grid));
            },
            "nodes"_a = py::none(), "length"_a = py::none(), "kernel"_a = py::none(),
            "Its heights at `nodes` nodes over `length` mm, by default as in contact(): a Profile, or a\n"
            "Surface if one of them is a pair along x and y.")
        .def("__repr__", [](const Genome& genome) {
            std::size_t chromosomes = 0;
            for (const auto& series : genome.series) chromosomes += series.chromosomes.size();
            return rough::line_of("<rugosa.Genome of ", genome.series.size(), " series, ", chromosomes,
                                  " chromosomes>");
        });
}

} // namespace rugosa::python
