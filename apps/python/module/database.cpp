#include "apps/commands/database.hpp"

#include "apps/python/module/python.hpp"

namespace rugosa::python {

using rough::GenomeStore, rough::StoredAnswer;
using namespace py::literals;

namespace {

std::vector<StoredAnswer> query(const GenomeStore& store,
                                const std::variant<rough::Target, std::vector<rough::Target>>& targets,
                                const py::object& best, py::kwargs given) {
    given["best"] = best;
    const app::Settings settings = Keywords(given, "query").only(app::query_settings());
    const auto* one = std::get_if<rough::Target>(&targets);
    const py::gil_scoped_release unlocked;
    const GenomeStore opened = GenomeStore::open(store.file()); // another thread may build
    return stored_answers(opened, query_from(settings, opened, one ? std::vector{*one} : std::get<1>(targets)),
                          settings.whole<std::size_t>("best"), settings.whole<int>("threads"));
}

GenomeStore create_store(const std::filesystem::path& file, const py::object& genomes, py::kwargs given) {
    given["genomes"] = genomes;
    const auto settings = Keywords(given, "Database.create").only(app::build_settings());
    rough::BuildOptions options;
    app::take(settings, app::bindings_of(options));
    Interruptible interrupt;
    options.stop = &interrupt.stop();
    GenomeStore store = [&] {
        const py::gil_scoped_release unlocked;
        GenomeStore built = app::database_from(file, settings);
        build(built, options);
        return built;
    }();
    interrupt.rethrow();
    return store;
}

/// Builds in a second store, as other threads may read by `store`.
void build_store(const GenomeStore& store, const py::object& genomes, const py::kwargs& given) {
    create_store(GenomeStore::open(store.file()).file(), genomes, given);
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
            "On a finer grid in finer load steps, less the estimated error of this curve.")
        .def_property_readonly(
            "genome", [](const StoredAnswer& stored) { return stored.answer.genome; },
            "The genome with the amplitude that matches the targets best.");
    py::class_<GenomeStore>(module, "Database", "A file of genomes and their responses.")
        .def(py::init(&GenomeStore::open), "file"_a, "Opens an existing database.")
        .def_static(
            "create", &create_store, "file"_a, "genomes"_a = py::none(),
            documented("Makes a database. An existing one keeps its set-up if none is given.\n", app::build_settings())
                .c_str())
        .def("build", &build_store, "genomes"_a, "Adds missing genomes. Keywords are those of create().")
        .def("query", &query, "targets"_a, "best"_a = py::none(),
             documented("The stored genomes nearest to a Target or a list of Targets, sorted by falling\n"
                        "similarity_worst. They are verified as designs are. The model must be that of the\n"
                        "database, except length and modulus, to which it is scaled exactly.\n",
                        app::query_settings())
                 .c_str())
        .def("genome", &GenomeStore::genome, "index"_a, "The genome as it is stored.")
        .def("__len__", &GenomeStore::stored);
}

} // namespace rugosa::python
