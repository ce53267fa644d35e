#include "apps/python/module/python.hpp"

#include <nlohmann/json.hpp>

namespace rugosa::python {

namespace {

py::object in_python(const nlohmann::json& json) {
    return py::module_::import("json").attr("loads")(json.dump());
}

nlohmann::json in_cpp(const py::object& object) {
    return nlohmann::json::parse(py::cast<std::string>(py::module_::import("json").attr("dumps")(object)));
}

} // namespace

void add_genome(py::module_& module) {
    using rough::Genome;
    py::class_<Genome>(module, "Genome",
                       "A profile as a sum of Weierstrass-Mandelbrot series (lengths in mm).\n\n"
                       ">>> import rugosa\n"
                       ">>> wave = {'A': 0.01, 'H': 0.8, 'gamma': 1.5, 'lambda': 1.0,\n"
                       "...         'chromosomes': [{'n': 1, 'phases': [0.3]}, {'n': 2, 'phases': [1.1]}]}\n"
                       ">>> genome = rugosa.Genome({'series': [wave]})\n"
                       ">>> genome.genes.shape\n"
                       "(6,)\n")
        .def(py::init(
                 [](const py::dict& content) { return rough::genome_from_json(in_cpp(content), "genome"); }),
             py::arg("content"), "From a dictionary as a genome file (JSON) holds it.")
        .def_static(
            "read", [](const std::filesystem::path& file) { return rough::read_genome(file); },
            py::arg("file"), "Reads a genome file.")
        .def(
            "to_dict", [](const Genome& genome) { return in_python(rough::genome_to_json(genome)); },
            "As a genome file holds it; the scale is folded into the amplitudes.")
        .def_readonly("scale", &Genome::scale, "Factor on all heights.")
        .def_property_readonly(
            "genes", [](const Genome& genome) { return py::array(py::cast(rough::genes(genome))); },
            "All genes: of each series A, H, gamma, lambda (mm), then the phases (rad).")
        .def(
            "with_genes",
            [](const Genome& genome, const std::vector<double>& values) {
                if (values.size() != rough::genes(genome).size())
                    throw rough::InputError("genes: " + std::to_string(values.size()) + " given, expected " +
                                            std::to_string(rough::genes(genome).size()));
                Genome changed = rough::with_genes(genome, values);
                validate(changed, "genes");
                return changed;
            },
            py::arg("genes"), "The genome with its genes replaced.")
        .def(
            "profile",
            [](const Genome& genome, const py::object& nodes, const py::object& length,
               const py::object& kernel) {
                using namespace py::literals;
                Keywords keywords(py::dict("nodes"_a = nodes, "length"_a = length, "kernel"_a = kernel),
                                  "profile");
                return as_python(rough::sample(genome, model_from(keywords).grid));
            },
            py::arg("nodes") = 512, py::arg("length") = rough::standard_length, py::arg("kernel") = "free",
            "Its heights at `nodes` nodes over `length` mm: a Profile, or, where one of them is a pair along "
            "x\n"
            "and y, a Surface.")
        .def("__repr__", [](const Genome& genome) {
            std::size_t chromosomes = 0;
            for (const auto& series : genome.series)
                chromosomes += series.chromosomes.size();
            return "<rugosa.Genome of " + std::to_string(genome.series.size()) + " series, " +
                   std::to_string(chromosomes) + " chromosomes>";
        });
}

} // namespace rugosa::python
