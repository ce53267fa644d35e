#include "apps/python/module/python.hpp"

namespace rugosa::python {

using rough::GenomeStore, rough::StoredAnswer;
using namespace py::literals;

namespace {

std::vector<StoredAnswer> query(const GenomeStore& store,
                                const std::variant<rough::Target, std::vector<rough::Target>>& targets,
                                std::size_t best, std::optional<double> max_pressure, int threads,
                                const py::kwargs& model) {
    rough::DesignSetup setup;
    setup.model = store.setup().model;
    if (!model.empty()) {
        Keywords keywords(model, "query");
        setup.model = model_from(keywords);
        keywords.expect_none_left();
    }
    const auto* one = std::get_if<rough::Target>(&targets);
    setup.targets = one ? std::vector{*one} : std::get<1>(targets);
    setup.max_pressure = max_pressure;
    const py::gil_scoped_release unlocked;
    return stored_answers(GenomeStore::open(store.file()), setup, best, threads); // another thread may build
}

void build_store(const GenomeStore& store, std::uint64_t genomes, int threads) {
    Interruptible interrupt;
    rough::BuildOptions options;
    options.genomes = genomes;
    options.threads = threads;
    options.stop = &interrupt.stop();
    {
        const py::gil_scoped_release unlocked;
        GenomeStore own = GenomeStore::open(store.file()); // other threads may read by `store`
        build(own, options);
    }
    interrupt.rethrow();
}

GenomeStore create_store(const std::filesystem::path& file, std::uint64_t genomes, int threads,
                         const py::kwargs& model) {
    Keywords keywords(model, "Database.create");
    rough::DatabaseSetup setup;
    setup.law.seed = keywords.take("seed", setup.law.seed);
    setup.law.series = keywords.take("series", setup.law.series);
    setup.model = model_from(keywords);
    setup.law.shortest = keywords.take("shortest_wave", 8 * setup.model.grid.spacing());
    keywords.expect_none_left();
    GenomeStore store = GenomeStore::create(file, setup);
    build_store(store, genomes, threads);
    return store;
}

} // namespace

void add_database(py::module_& module) {
    py::class_<StoredAnswer>(module, "Stored", "A stored genome that matches the targets of a query.")
        .def_readonly("index", &StoredAnswer::index, "Its number in the database.")
        .def_property_readonly(
            "similarity", [](const StoredAnswer& stored) { return stored.answer.similarity; },
            "On the grid and load steps of the database.")
        .def_property_readonly(
            "similarity_worst", [](const StoredAnswer& stored) { return stored.answer.lowest(); },
            "The lowest of `similarity` and those on a grid four times finer, in four times the load steps,\n"
            "and with both.")
        .def_property_readonly(
            "genome", [](const StoredAnswer& stored) { return stored.answer.genome; },
            "The genome with the amplitude that matches the targets best.");
    py::class_<GenomeStore>(module, "Database", "A file of genomes and their responses.")
        .def(py::init(&GenomeStore::open), "file"_a, "Opens an existing database.")
        .def_static(
            "create", &create_store, "file"_a, "genomes"_a = 1000, py::kw_only(), "threads"_a = 0,
            "Makes a database of this many genomes, or adds missing ones. Takes the model keywords of\n"
            "contact() for a Genome, and seed, series and shortest_wave (mm).")
        .def("build", &build_store, "genomes"_a, py::kw_only(), "threads"_a = 0,
             "Adds genomes until there are this many.")
        .def("query", &query, "targets"_a, "best"_a = 10, py::kw_only(), "max_pressure"_a = py::none(),
             "threads"_a = 0,
             "The stored genomes nearest to a Target or a list of Targets, sorted by falling\n"
             "similarity_worst. They are verified as designs are. Model keywords must be those of the\n"
             "database, except length and modulus, to which it is scaled exactly.")
        .def("genome", &GenomeStore::genome, "index"_a, "The genome as it is stored.")
        .def("__len__", &GenomeStore::stored);
}

} // namespace rugosa::python
