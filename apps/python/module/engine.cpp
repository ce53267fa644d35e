#include "apps/python/module/engine.hpp"

namespace rugosa::python {

using app::Genes;
using namespace py::literals;

namespace {

py::array array_of(const std::string& genes) {
    return py::array::ensure(py::module_::import("json").attr("loads")(genes));
}

/// The genes of the arguments: lower and upper of real ones, or the number of bits or of permuted items.
Genes genes_from(Keywords& keywords) {
    const auto lower = keywords.take_numbers("lower"), upper = keywords.take_numbers("upper");
    const auto bits = keywords.take<std::size_t>("bits", 0), permutation = keywords.take<std::size_t>("permutation", 0);
    const bool real = lower || upper;
    if (real + (bits > 0) + (permutation > 0) != 1)
        rough::refuse("optimise: no kind of genes, or two; give one of lower and upper, bits, "
                      "permutation");
    if (!real) return {bits > 0 ? Genes::Kind::bits : Genes::Kind::permutation, bits + permutation};
    if (!lower || !upper || lower->size() != upper->size() || lower->size() == 0 ||
        !(lower->array() <= upper->array()).all() || !(*upper - *lower).allFinite())
        rough::refuse("optimise: lower and upper do not fit; give lists of one length, no lower "
                      "bound above its upper bound and both finite");
    Genes genes{Genes::Kind::numbers, static_cast<std::size_t>(lower->size())};
    for (Eigen::Index gene = 0; gene < lower->size(); ++gene)
        genes.parts.push_back({1, (*lower)[gene], (*upper)[gene]});
    return genes;
}

Optimisation requested(const py::object& problem, const py::kwargs& given) {
    Keywords keywords(given, "optimise");
    Optimisation search;
    search.genes = genes_from(keywords);
    search.problem = problem;
    const auto objectives = keywords.take<std::size_t>("objectives", 1);
    if (objectives == 0 || objectives > 1000)
        rough::refuse("optimise: objectives=", objectives, " is out of range (1 to 1000)");
    const auto less = keywords.take<std::variant<bool, std::vector<bool>>>("minimise", false);
    const bool* all = std::get_if<bool>(&less);
    search.minimise = all ? std::vector<bool>(objectives, *all) : std::get<1>(less);
    if (search.minimise.size() != objectives)
        rough::refuse("optimise: minimise has ", search.minimise.size(), " values; give ", objectives,
                      ", one per objective");
    search.record.minimise = search.minimise;
    take_search(keywords.settings(app::outside_settings()), search);
    const auto start = keywords.take<std::vector<std::vector<double>>>("start", {});
    for (std::size_t i = 0; i < start.size(); ++i) {
        std::vector<std::string> values;
        for (const double value : start[i]) values.push_back(ga::number(value));
        search.start.push_back(
            app::numbers_from(search.genes, values, "optimise: start, row " + std::to_string(i + 1)));
    }
    search.operators = keywords.take<std::vector<py::object>>("operators", {});
    search.observers = keywords.take<std::vector<py::object>>("observers", {});
    if (const auto file = keywords.take<std::filesystem::path>("history", {}); !file.empty()) {
        if (std::filesystem::exists(file))
            rough::refuse("optimise: history ", file.string(), " exists; choose another name");
        *search.history = {file, false};
        search.history->begin(objectives);
    }
    keywords.expect_none_left();
    search.variant = app::variant_of(search, objectives);
    return search;
}

constexpr const char* help_of_search = R"(The search of optimise() in a loop of the caller; the same keywords.

>>> import rugosa
>>> search = rugosa.search(lower=[-5, -5], upper=[5, 5], minimise=True, evaluations=2000)
>>> while len(genes := search.ask()):
...     search.tell((genes**2).sum(axis=1))
>>> search.result().objectives[0] < 1e-3
True
)";

constexpr const char* help_of_optimise = R"(Runs a genetic algorithm on your problem.

problem: a function of genes, or an object with evaluate(genes) or evaluate_batch(genes of many, one row
each), and perhaps gradient(genes). evaluate returns a number, `objectives` numbers, or (numbers,
violation). A violation (a number, or one per constraint) above 0 breaks a constraint. An exception, None and
NaN are failures of that genome (an exception of evaluate_batch: of the batch). If all fail, the first
exception is raised. With `levels`, these functions get a level's name as their second argument.
genes: real ones between lower and upper, `bits` bits, or a `permutation` of 0 .. n-1.
minimise: for all objectives, or one bool each.
start: genomes to begin with, one per row. A leading `sample n` of the pipeline draws only the missing ones.
operators: objects with a name, which is a stage of the pipeline. They are called with (genes, fitness,
random) of the population, and return new genes, or the positions of the individuals to keep.
observers: called with a dictionary after every stage.
history: a new file (CSV) for all evaluations: generation, genes, objectives, violation, failure.
The same seed gives the same result, bit for bit.

>>> import rugosa
>>> found = rugosa.optimise(lambda x: float((x**2).sum()), lower=[-5, -5], upper=[5, 5],
...                         minimise=True, evaluations=2000)
>>> found.objectives[0] < 1e-3
True
)";

} // namespace

void add_engine(py::module_& module) {
    py::class_<Optimisation>(module, "Optimisation", "The result of optimise().")
        .def_property_readonly(
            "best",
            [](const Optimisation& o) {
                return o.record.best() ? std::optional(array_of(o.record.best()->genes)) : std::nullopt;
            },
            "Genes of the best evaluated genome; with several objectives, by the first.")
        .def_property_readonly(
            "objectives",
            [](const Optimisation& o) {
                return o.record.best() ? o.record.best()->answer.objectives : std::vector<double>();
            },
            "Objectives of the best genome, as returned.")
        .def_property_readonly(
            "front",
            [](const Optimisation& o) {
                py::list front;
                if (o.minimise.size() > 1)
                    for (const app::Solution& solution : o.record.front())
                        front.append(py::make_tuple(array_of(solution.genes), solution.answer.objectives));
                return front;
            },
            "With several objectives: (genes, objectives) of all non-dominated genomes.")
        .def_readonly("population", &Optimisation::population,
                      "Genes of the pipeline's last population, individuals x genes.")
        .def_readonly("evaluations", &Optimisation::spent, "Number of evaluations.")
        .def_readonly("price", &Optimisation::price,
                      "Price of the evaluations and gradients, in evaluations of the first level.")
        .def_property_readonly(
            "level", [](const Optimisation& o) { return app::level_of(o, o.record); },
            "Level of `best` and `front`, the last one that was evaluated; empty if there is one.")
        .def_readonly("failures", &Optimisation::failures, "Number of evaluations that failed.")
        .def_readonly("pipeline", &Optimisation::searched, "The pipeline that ran.")
        .def_readonly("stopped", &Optimisation::stopped,
                      "Why the search ended before its pipeline did; empty if it did not.")
        .def_readonly("notes", &Optimisation::notes)
        .def_readonly("interrupted", &Optimisation::interrupted,
                      "Whether Ctrl-C ended the search; the result is then the best so far.")
        .def("__repr__", [](const Optimisation& o) {
            return rough::line_of("<rugosa.Optimisation of ", o.spent, " evaluations>");
        });
    py::class_<Search>(module, "Search", "A search that search() began.")
        .def("ask", &Search::ask, "Genomes to evaluate, one per row; no rows after the end of the search.")
        .def_property_readonly("levels", &Search::levels,
                               "The level of each row of ask(); empty names if there is one.")
        .def("tell", &Search::tell, "answers"_a,
             "One answer per row of ask(), as evaluate of optimise() returns it; None or an exception: it "
             "failed.")
        .def("result", &Search::result, "Ends the search and returns its Optimisation.");
    module.def(
        "search", [](const py::kwargs& given) { return begin_search(requested(py::none(), given)); }, help_of_search);
    module.def(
        "optimise",
        [](const py::object& problem, const py::kwargs& given) {
            Optimisation search = requested(problem, given);
            optimise(search);
            return search;
        },
        "problem"_a, documented(help_of_optimise, app::outside_settings()).c_str());
}

} // namespace rugosa::python
