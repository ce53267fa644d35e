#include "apps/python/module/engine.hpp"

#include "ga/problem/permutation.hpp"

namespace rugosa::python {

using app::Genes;

namespace {

py::array array_of(const std::string& genes) {
    return py::array::ensure(py::module_::import("json").attr("loads")(genes));
}

/// real: bounds of every gene; bits and permutation: how many.
void take_genes(Optimisation& asked, const std::optional<Eigen::VectorXd>& lower,
                const std::optional<Eigen::VectorXd>& upper, std::size_t bits, std::size_t permutation) {
    const bool real = lower || upper;
    if (real + (bits > 0) + (permutation > 0) != 1)
        throw rough::InputError("optimise: expected one of lower and upper, bits, permutation");
    Genes& genes = asked.genes;
    genes.kind = real ? Genes::Kind::numbers : bits > 0 ? Genes::Kind::bits : Genes::Kind::permutation;
    genes.count = real ? 0 : bits + permutation;
    if (!real)
        return;
    if (!lower || !upper || lower->size() != upper->size() || lower->size() == 0 ||
        !(lower->array() < upper->array()).all() || !(*upper - *lower).allFinite())
        throw rough::InputError(
            "optimise: expected lower and upper of one length, each lower bound below its "
            "upper one and finite");
    genes.count = static_cast<std::size_t>(lower->size());
    for (std::size_t i = 0; i < genes.count; ++i) {
        const auto gene = static_cast<Eigen::Index>(i);
        asked.range.push_back({i, (*lower)[gene], (*upper)[gene]});
    }
}

Optimisation asked_for(const py::object& problem, const std::optional<Eigen::VectorXd>& lower,
                       const std::optional<Eigen::VectorXd>& upper, std::size_t bits, std::size_t permutation,
                       const std::string& pipeline, const std::string& variant, const py::object& minimise,
                       std::size_t objectives, long evaluations, double seconds, std::uint64_t seed,
                       std::vector<py::object> operators, std::vector<py::object> observers) {
    Optimisation asked;
    take_genes(asked, lower, upper, bits, permutation);
    if (objectives == 0 || objectives > 1000)
        throw rough::InputError("optimise: " + std::to_string(objectives) +
                                " objectives given, expected 1 to 1000");
    asked.minimise = py::isinstance<py::bool_>(minimise)
                         ? std::vector<bool>(objectives, minimise.cast<bool>())
                         : minimise.cast<std::vector<bool>>();
    if (asked.minimise.size() != objectives)
        throw rough::InputError("optimise: minimise of " + std::to_string(asked.minimise.size()) +
                                " objectives given, expected " + std::to_string(objectives));
    asked.record.minimise = asked.minimise;
    asked.problem = problem;
    asked.pipeline = pipeline;
    asked.variant = !variant.empty()    ? variant
                    : !pipeline.empty() ? "pipeline"
                    : objectives > 1    ? "nsga2"
                                        : "ga";
    asked.evaluations = evaluations;
    asked.seconds = seconds;
    asked.seed = seed;
    asked.operators = std::move(operators);
    asked.observers = std::move(observers);
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

///@{
/// Functions of asked_for's arguments: the search carried out, and one that asks.
template <class... Words>
auto optimised(Optimisation (*read)(const py::object&, Words...)) {
    return [read](const py::object& problem, Words... words) {
        Optimisation asked = read(problem, std::forward<Words>(words)...);
        by_kind(asked, [&](auto genome) { optimise<decltype(genome)>(asked); });
        return asked;
    };
}
template <class... Words>
auto searching(Optimisation (*read)(const py::object&, Words...)) {
    return [read](Words... words) {
        return std::make_unique<Search>(read(py::none(), std::forward<Words>(words)...));
    };
}
///@}

/// Adds a function whose keywords are asked_for's.
template <class Function, class... First>
void add(py::module_& module, const char* name, Function function, const char* doc, First... first) {
    module.def(name, function, first..., py::kw_only(), py::arg("lower") = py::none(),
               py::arg("upper") = py::none(), py::arg("bits") = 0, py::arg("permutation") = 0,
               py::arg("pipeline") = "", py::arg("variant") = "", py::arg("minimise") = false,
               py::arg("objectives") = 1, py::arg("evaluations") = 10000,
               py::arg("seconds") = std::numeric_limits<double>::infinity(), py::arg("seed") = 1,
               py::arg("operators") = std::vector<py::object>(),
               py::arg("observers") = std::vector<py::object>(), doc);
}

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
    add(module, "search", searching(&asked_for),
        "The search of optimise() in a loop of one's own; keywords as there.\n\n"
        ">>> import rugosa\n"
        ">>> search = rugosa.search(lower=[-5, -5], upper=[5, 5], minimise=True, evaluations=2000)\n"
        ">>> while len(genes := search.ask()):\n"
        "...     search.tell((genes**2).sum(axis=1))\n"
        ">>> search.result().objectives[0] < 1e-3\n"
        "True\n");
    add(module, "optimise", optimised(&asked_for),
        "Runs a genetic algorithm on a problem of one's own.\n\n"
        "problem: a function of genes, or an object with evaluate(genes) or evaluate_batch(genes of many, a\n"
        "row each), and perhaps gradient(genes). evaluate returns a number, `objectives` many, or (numbers,\n"
        "violation), a violation (a number, or one per constraint) above 0 for a constraint that is broken.\n"
        "genes: real between lower and upper, `bits` many, or a `permutation` of 0 .. n-1. minimise: for all "
        "objectives, or one bool each.\n"
        "pipeline: text (rugosa operators lists the stages; objectives are called f1, f2, ...).\n"
        "operators: objects with a name, which is a stage of the pipeline, called with (genes, fitness,\n"
        "random) of the population; they return new genes, or positions of those who stay. observers: "
        "called\n"
        "with a dictionary after every stage. The same seed gives the same result, bit for bit.\n\n"
        ">>> import rugosa\n"
        ">>> found = rugosa.optimise(lambda x: float((x**2).sum()), lower=[-5, -5], upper=[5, 5],\n"
        "...                         minimise=True, evaluations=2000)\n"
        ">>> found.objectives[0] < 1e-3\n"
        "True\n",
        py::arg("problem"));
}

} // namespace rugosa::python
