#include "apps/python/module/engine.hpp"

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
    genes.kind = real ? Genes::Kind::real : bits > 0 ? Genes::Kind::bits : Genes::Kind::permutation;
    genes.count = real ? 0 : bits + permutation;
    if (!real)
        return;
    if (!lower || !upper || lower->size() != upper->size() || lower->size() == 0 ||
        !(lower->array() < upper->array()).all() || !(*upper - *lower).allFinite())
        throw rough::InputError(
            "optimise: expected lower and upper of one length, each lower bound below its "
            "upper one and finite");
    genes.count = static_cast<std::size_t>(lower->size());
    genes.lower = lower->minCoeff();
    genes.upper = upper->maxCoeff();
    asked.lower.assign(lower->begin(), lower->end());
    asked.upper.assign(upper->begin(), upper->end());
}

Optimisation optimised(const py::object& problem, const std::optional<Eigen::VectorXd>& lower,
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
    switch (asked.genes.kind) {
    case Genes::Kind::real:
        optimise_real(asked);
        break;
    case Genes::Kind::bits:
        optimise_bits(asked);
        break;
    case Genes::Kind::permutation:
        optimise_permutation(asked);
    }
    return asked;
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
    module.def(
        "optimise", &optimised, py::arg("problem"), py::kw_only(), py::arg("lower") = py::none(),
        py::arg("upper") = py::none(), py::arg("bits") = 0, py::arg("permutation") = 0,
        py::arg("pipeline") = "", py::arg("variant") = "", py::arg("minimise") = false,
        py::arg("objectives") = 1, py::arg("evaluations") = 10000,
        py::arg("seconds") = std::numeric_limits<double>::infinity(), py::arg("seed") = 1,
        py::arg("operators") = std::vector<py::object>(), py::arg("observers") = std::vector<py::object>(),
        "Runs a genetic algorithm on a problem of one's own.\n\n"
        "problem: a function of genes, or an object with evaluate(genes) or evaluate_batch(genes of many, a\n"
        "row each), and perhaps gradient(genes). evaluate returns a number, `objectives` many, or (numbers,\n"
        "violation), a violation above 0 where constraints are broken. genes: real between lower and upper,\n"
        "`bits` many, or a `permutation` of 0 .. n-1. minimise: for all objectives, or one bool each.\n"
        "pipeline: text (rugosa operators lists the stages; objectives are called f1, f2, ...).\n"
        "operators: objects with a name, which is a stage of the pipeline, called with (genes, fitness,\n"
        "random) of the population; they return new genes, or positions of those who stay. observers: "
        "called\n"
        "with a dictionary after every stage. The same seed gives the same result, bit for bit.\n\n"
        ">>> import rugosa\n"
        ">>> found = rugosa.optimise(lambda x: float((x**2).sum()), lower=[-5, -5], upper=[5, 5],\n"
        "...                         minimise=True, evaluations=2000)\n"
        ">>> found.objectives[0] < 1e-3\n"
        "True\n");
}

} // namespace rugosa::python
