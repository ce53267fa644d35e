#include "apps/python/module/engine.hpp"

#include "ga/problem/permutation.hpp"

namespace rugosa::python {

using app::Genes;

namespace {

py::array array_of(const std::string& genes) {
    return py::array::ensure(py::module_::import("json").attr("loads")(genes));
}

/// real: bounds of every gene; bits and permutation: how many.
Genes genes_from(Keywords& keywords) {
    const auto lower = keywords.take<Eigen::VectorXd>("lower"),
               upper = keywords.take<Eigen::VectorXd>("upper");
    const auto bits = keywords.take<std::size_t>("bits", 0),
               permutation = keywords.take<std::size_t>("permutation", 0);
    const bool real = lower || upper;
    if (real + (bits > 0) + (permutation > 0) != 1)
        throw rough::InputError("optimise: expected one of lower and upper, bits, permutation");
    if (!real)
        return {bits > 0 ? Genes::Kind::bits : Genes::Kind::permutation, bits + permutation};
    if (!lower || !upper || lower->size() != upper->size() || lower->size() == 0 ||
        !(lower->array() < upper->array()).all() || !(*upper - *lower).allFinite())
        throw rough::InputError(
            "optimise: expected lower and upper of one length, each lower bound below its "
            "upper one and finite");
    Genes genes{Genes::Kind::numbers, static_cast<std::size_t>(lower->size())};
    for (Eigen::Index gene = 0; gene < lower->size(); ++gene)
        genes.parts.push_back({1, (*lower)[gene], (*upper)[gene]});
    return genes;
}

Optimisation asked_for(const py::object& problem, const py::kwargs& given) {
    Keywords keywords(given, "optimise");
    Optimisation asked;
    asked.genes = genes_from(keywords);
    asked.problem = problem;
    const auto objectives = keywords.take<std::size_t>("objectives", 1);
    if (objectives == 0 || objectives > 1000)
        throw rough::InputError("optimise: " + std::to_string(objectives) +
                                " objectives given, expected 1 to 1000");
    const auto less = keywords.take<std::variant<bool, std::vector<bool>>>("minimise", false);
    const bool* all = std::get_if<bool>(&less);
    asked.minimise = all ? std::vector<bool>(objectives, *all) : std::get<1>(less);
    if (asked.minimise.size() != objectives)
        throw rough::InputError("optimise: minimise of " + std::to_string(asked.minimise.size()) +
                                " objectives given, expected " + std::to_string(objectives));
    asked.record.minimise = asked.minimise;
    take_search(keywords.settings(app::outside_settings()), asked);
    asked.operators = keywords.take<std::vector<py::object>>("operators", {});
    asked.observers = keywords.take<std::vector<py::object>>("observers", {});
    keywords.expect_none_left();
    asked.variant = app::variant_of(asked, objectives);
    return asked;
}

/// Calls with a genome of the kind that is asked for.
template <class Call>
auto by_kind(const Optimisation& asked, Call call) {
    return asked.genes.kind == Genes::Kind::numbers ? call(std::vector<double>())
           : asked.genes.kind == Genes::Kind::bits  ? call(std::vector<bool>())
                                                    : call(ga::Permutation());
}

/// A search in a loop of the caller's: stays where it is, as its engine points at what was asked.
struct Search {
    Optimisation asked;
    std::unique_ptr<Asking> engine;

    explicit Search(Optimisation of) : asked(std::move(of)) {
        engine = by_kind(asked, [this](auto genome) { return asking<decltype(genome)>(asked); });
    }
};

} // namespace

void add_engine(py::module_& module) {
    py::class_<Optimisation>(module, "Optimisation", "What optimise() found.")
        .def_property_readonly(
            "best",
            [](const Optimisation& o) -> py::object {
                return o.record.best() ? py::object(array_of(o.record.best()->genes))
                                       : py::object(py::none());
            },
            "Genes of the best that was evaluated (of several objectives: by the first).")
        .def_property_readonly(
            "objectives",
            [](const Optimisation& o) {
                return o.record.best() ? o.record.best()->answer.objectives : std::vector<double>();
            },
            "Of the best, as they were returned.")
        .def_property_readonly(
            "front",
            [](const Optimisation& o) {
                py::list front;
                for (const app::Solution& solution : o.record.front())
                    front.append(py::make_tuple(array_of(solution.genes), solution.answer.objectives));
                return front;
            },
            "Of several objectives: (genes, objectives) of all that none dominates.")
        .def_readonly("population", &Optimisation::population, "The pipeline's answer, individuals x genes.")
        .def_readonly("evaluations", &Optimisation::spent, "How many were made.")
        .def_readonly("pipeline", &Optimisation::searched, "As it was run.")
        .def_readonly("stopped", &Optimisation::stopped,
                      "Why it ended before its pipeline; empty when it did not.")
        .def_readonly("notes", &Optimisation::notes)
        .def_readonly("interrupted", &Optimisation::interrupted, "Ctrl-C ended it; this is the best so far.")
        .def("__repr__", [](const Optimisation& o) {
            return "<rugosa.Optimisation of " + std::to_string(o.spent) + " evaluations>";
        });
    py::class_<Search>(module, "Search", "A search that search() began.")
        .def(
            "ask", [](Search& s) { return s.engine->ask(); },
            "Genomes to be evaluated, a row each; no rows when the search has ended.")
        .def(
            "tell", [](Search& s, const py::object& answers) { s.engine->tell(py::list(answers)); },
            py::arg("answers"),
            "One answer for each row that ask() gave, as evaluate of optimise() returns it.")
        .def(
            "result",
            [](Search& s) {
                s.engine->end();
                return s.asked;
            },
            "Ends the search and returns what it found: an Optimisation.");
    module.def(
        "search",
        [](const py::kwargs& given) { return std::make_unique<Search>(asked_for(py::none(), given)); },
        "The search of optimise() in a loop of one's own; keywords as there.\n\n"
        ">>> import rugosa\n"
        ">>> search = rugosa.search(lower=[-5, -5], upper=[5, 5], minimise=True, evaluations=2000)\n"
        ">>> while len(genes := search.ask()):\n"
        "...     search.tell((genes**2).sum(axis=1))\n"
        ">>> search.result().objectives[0] < 1e-3\n"
        "True\n");
    module.def(
        "optimise",
        [](const py::object& problem, const py::kwargs& given) {
            Optimisation asked = asked_for(problem, given);
            by_kind(asked, [&](auto genome) { optimise<decltype(genome)>(asked); });
            return asked;
        },
        py::arg("problem"),
        documented(
            "Runs a genetic algorithm on a problem of one's own.\n\n"
            "problem: a function of genes, or an object with evaluate(genes) or evaluate_batch(genes of "
            "many, a\n"
            "row each), and perhaps gradient(genes). evaluate returns a number, `objectives` many, or "
            "(numbers,\n"
            "violation), a violation (a number, or one per constraint) above 0 for a constraint that is "
            "broken.\n"
            "genes: real between lower and upper, `bits` many, or a `permutation` of 0 .. n-1. minimise: for "
            "all "
            "objectives, or one bool each.\n"
            "operators: objects with a name, which is a stage of the pipeline, called with (genes, fitness,\n"
            "random) of the population; they return new genes, or positions of those who stay. observers: "
            "called\n"
            "with a dictionary after every stage. The same seed gives the same result, bit for bit.\n\n"
            ">>> import rugosa\n"
            ">>> found = rugosa.optimise(lambda x: float((x**2).sum()), lower=[-5, -5], upper=[5, 5],\n"
            "...                         minimise=True, evaluations=2000)\n"
            ">>> found.objectives[0] < 1e-3\n"
            "True\n",
            app::outside_settings())
            .c_str());
}

} // namespace rugosa::python
