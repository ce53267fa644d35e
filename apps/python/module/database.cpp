#include "apps/python/module/python.hpp"
#include "domain/database/setup.hpp"
#include "domain/database/starts.hpp"

namespace rugosa::python {

namespace {

using rough::GenomeStore;

using rough::StoredAnswer;

std::vector<StoredAnswer> queried(const GenomeStore& store,
                                  const std::variant<rough::Target, std::vector<rough::Target>>& asked,
                                  std::size_t best, std::optional<double> max_pressure, int threads,
                                  const py::kwargs& model) {
    rough::DesignSetup setup;
    setup.model = store.setup().model;
    if (!model.empty()) {
        Keywords keywords(model, "query");
        setup.model = model_from(keywords);
        keywords.expect_none_left();
    }
    const auto* one = std::get_if<rough::Target>(&asked);
    setup.targets = one ? std::vector{*one} : std::get<1>(asked);
    setup.max_pressure = max_pressure;
    const py::gil_scoped_release unlocked;
    return stored_answers(store, setup, best, threads);
}

void built(GenomeStore& store, std::uint64_t genomes, int threads) {
    Interruptible interrupt;
    rough::BuildOptions options;
    options.genomes = genomes;
    options.threads = threads;
    options.stop = &interrupt.stop();
    {
        const py::gil_scoped_release unlocked;
        build(store, options);
    }
    if (interrupt.asked()) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw py::error_already_set();
    }
}

} // namespace

void add_database(py::module_& module) {
    py::class_<StoredAnswer>(module, "Stored", "A stored genome that answers a query.")
        .def_readonly("index", &StoredAnswer::index, "Its number in the database.")
        .def_property_readonly(
            "similarity", [](const StoredAnswer& stored) { return stored.answer.similarity; },
            "On the database's grid and load steps.")
        .def_property_readonly(
            "similarity_worst", [](const StoredAnswer& stored) { return stored.answer.lowest(); },
            "The lowest of that, of a grid four times finer, of four times the load steps, and of both.")
        .def_property_readonly(
            "genome", [](const StoredAnswer& stored) { return stored.answer.genome; },
            "In the amplitude that meets the target best.");
    py::class_<GenomeStore>(module, "Database", "A file of genomes and their responses.")
        .def(py::init([](const std::filesystem::path& file) { return GenomeStore::open(file); }),
             py::arg("file"), "Opens an existing database.")
        .def_static(
            "create",
            [](const std::filesystem::path& file, std::uint64_t genomes, int threads,
               const py::kwargs& model) {
                Keywords keywords(model, "Database.create");
                rough::DatabaseSetup setup;
                setup.law.seed = keywords.take("seed", setup.law.seed);
                setup.law.series = keywords.take("series", setup.law.series);
                setup.model = model_from(keywords);
                setup.law.shortest = keywords.take("shortest", 8 * setup.model.grid.spacing());
                keywords.expect_none_left();
                GenomeStore store = GenomeStore::create(file, setup);
                built(store, genomes, threads);
                return store;
            },
            py::arg("file"), py::arg("genomes") = 1000, py::kw_only(), py::arg("threads") = 0,
            "Makes a database of that many genomes, or adds what is missing; model keywords as in\n"
            "contact() of a Genome, besides seed, series and shortest (mm).")
        .def("build", &built, py::arg("genomes"), py::kw_only(), py::arg("threads") = 0,
             "Adds genomes until there are that many.")
        .def(
            "query", &queried, py::arg("targets"), py::arg("best") = 10, py::kw_only(),
            py::arg("max_pressure") = py::none(), py::arg("threads") = 0,
            "The stored genomes nearest to a Target or a list of them, verified as a design is, the highest\n"
            "similarity_worst first. Model keywords are compared with the database's, but for length and\n"
            "modulus, which it is scaled to exactly.")
        .def("genome", &GenomeStore::genome, py::arg("index"), "As it is stored.")
        .def("__len__", &GenomeStore::stored);
}

} // namespace rugosa::python
