#pragma once

#include "apps/python/module/engine.hpp"
#include "ga/run.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/whole_vocabulary.hpp"

#include <pybind11/numpy.h>

namespace rugosa::python {

/// The type of a gene as NumPy has it.
template <class G>
using Gene = std::conditional_t<std::same_as<G, std::vector<double>>, double,
                                std::conditional_t<std::same_as<G, std::vector<bool>>, bool, long>>;

/// Genomes as rows of an array.
template <class G, class Genomes>
py::array_t<Gene<G>> rows_of(const Genomes& genomes, std::size_t columns) {
    py::array_t<Gene<G>> rows({genomes.size(), columns});
    auto cell = rows.template mutable_unchecked<2>();
    for (std::size_t i = 0; i < genomes.size(); ++i) {
        std::size_t k = 0;
        for (const auto gene : *genomes[i])
            cell(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k++)) = static_cast<Gene<G>>(gene);
    }
    return rows;
}

/// A genome of a row. Throws rough::InputError on what is none.
template <class G>
G genome_of(const py::object& row, std::size_t count) {
    const auto values = row.cast<std::vector<Gene<G>>>();
    if (values.size() != count)
        throw rough::InputError("genes: " + std::to_string(values.size()) + " given, expected " +
                                std::to_string(count));
    if constexpr (std::same_as<G, ga::Permutation>)
        return ga::Permutation{{values.begin(), values.end()}};
    else
        return G(values.begin(), values.end());
}

/// The answer that an `evaluate` returned: a number, several, or (numbers, violation).
inline app::Answer answer_of(const py::handle& given, std::size_t objectives) {
    app::Answer answer;
    py::object values = py::reinterpret_borrow<py::object>(given);
    if (py::isinstance<py::tuple>(given) && py::len(given) == 2 &&
        py::hasattr(py::reinterpret_borrow<py::tuple>(given)[0], "__len__")) {
        const auto pair = py::reinterpret_borrow<py::tuple>(given);
        values = pair[0];
        answer.violation = pair[1].cast<double>();
    }
    answer.objectives = py::hasattr(values, "__len__") ? values.cast<std::vector<double>>()
                                                       : std::vector<double>{values.cast<double>()};
    if (answer.objectives.size() != objectives)
        throw rough::InputError("evaluate: " + std::to_string(answer.objectives.size()) +
                                " objectives returned, expected " + std::to_string(objectives));
    return answer;
}

/// A Python problem: genomes are drawn here, as by `rugosa optimise`; a gradient is asked of it where it has
/// one.
template <class G>
struct PythonProblem : app::OutsideProblem<G> {
    py::object object;
    bool has_gradient;
    Callback* callback;

    PythonProblem(const Optimisation& asked, Callback& call)
        : app::OutsideProblem<G>(asked.genes, asked.minimise), object(asked.problem),
          has_gradient(py::hasattr(object, "gradient")), callback(&call) {
        for (std::size_t i = 0; i < asked.lower.size(); ++i) {
            this->range[i].lower = asked.lower[i];
            this->range[i].upper = asked.upper[i];
        }
    }

    /// Of the objective that `refine` climbs.
    std::vector<double> gradient(const G& genome,
                                 const std::string&) const requires std::same_as<G, std::vector<double>> {
        std::vector<double> slopes;
        if (!has_gradient)
            throw std::runtime_error("the problem has no gradient");
        (*callback)([&] {
            slopes =
                object.attr("gradient")(py::array(py::cast(genome))).template cast<std::vector<double>>();
        });
        if (slopes.size() != genome.size())
            throw std::runtime_error("the gradient has " + std::to_string(slopes.size()) + " numbers");
        return slopes;
    }
};

/// The paid calls, made by Python with the interpreter's lock: all of a batch at once where the problem has
/// `evaluate_batch`, else one after the other.
template <class P>
class ByPython : public ga::Evaluator<P> {
  public:
    ByPython(Callback& callback, app::BestKnown& record) : callback_(callback), record_(record) {}

    void outcomes(const P& problem, std::span<ga::Call<P>> calls, const ga::Watch& watch) override {
        callback_([&] {
            std::vector<const typename P::Genome*> genomes;
            for (const auto& call : calls)
                genomes.push_back(call.genome);
            const auto rows = rows_of<typename P::Genome>(genomes, problem.genes.count);
            const std::size_t objectives = problem.objectives().size();
            if (py::hasattr(problem.object, "evaluate_batch")) {
                const py::list answers(problem.object.attr("evaluate_batch")(rows));
                if (answers.size() != calls.size())
                    throw rough::InputError("evaluate_batch: " + std::to_string(answers.size()) +
                                            " answers returned, expected " + std::to_string(calls.size()));
                for (std::size_t i = 0; i < calls.size(); ++i)
                    take(calls[i], answer_of(answers[i], objectives));
                return;
            }
            const py::object evaluate =
                py::hasattr(problem.object, "evaluate") ? problem.object.attr("evaluate") : problem.object;
            for (std::size_t i = 0; i < calls.size() && !watch.expired(); ++i)
                take(calls[i], answer_of(evaluate(rows[py::int_(i)]), objectives));
        });
    }

  private:
    void take(ga::Call<P>& call, app::Answer answer) {
        record_.take({app::genes_text(*call.genome), answer});
        *call.answer = std::move(answer);
    }

    Callback& callback_;
    app::BestKnown& record_;
};

/// An operator written in Python: called with (genes, fitness, random), it returns a new array of genes, or
/// positions of the individuals that stay.
struct PythonOperator : ga::Operator {
    py::object object;
    std::string name;
    Callback* callback;

    std::string text() const { return name; }
    void check(ga::Known& known) const { known.scored.reset(); }

    template <ga::Problem P>
    ga::Population<typename P::Genome> operator()(ga::Population<typename P::Genome> population,
                                                  ga::Context<P>& context) const {
        using G = typename P::Genome;
        ga::Population<G> made;
        (*callback)([&] {
            std::vector<const G*> genomes;
            py::array_t<double> fitness(population.size());
            for (std::size_t i = 0; i < population.size(); ++i) {
                genomes.push_back(&population[i].genome);
                const ga::Fitness& f = population[i].fitness;
                fitness.mutable_at(i) =
                    f.known() && !f.has_failed() && !f.several() ? population[i].value() : std::nan("");
            }
            const std::size_t columns = context.problem().genes.count;
            const auto seed = static_cast<std::uint64_t>(context.stream(0).uniform(0, 0x1p53));
            const py::object random = py::module_::import("numpy.random").attr("default_rng")(seed);
            const py::array answer = py::array::ensure(object(rows_of<G>(genomes, columns), fitness, random));
            if (answer && answer.ndim() == 1) {
                for (const long i : answer.cast<std::vector<long>>())
                    made.push_back(population.at(static_cast<std::size_t>(i)));
                return;
            }
            if (!answer || answer.ndim() != 2)
                throw rough::InputError("operator " + name +
                                        ": expected an array of genes or of positions to be returned");
            for (py::ssize_t i = 0; i < answer.shape(0); ++i) {
                ga::Individual<G> child;
                child.genome = genome_of<G>(answer[py::int_(i)], columns);
                context.make_child(child, {});
                made.push_back(std::move(child));
            }
        });
        if (made.empty())
            throw ga::NothingLeft("operator " + name + " left nobody");
        return made;
    }
};

/// Carries out a search for genomes of one type.
template <class G>
void optimise(Optimisation& asked) {
    using P = PythonProblem<G>;
    Interruptible interrupt;
    Callback callback(interrupt.stop());
    const P problem(asked, callback);
    auto registry = ga::whole_vocabulary<P>();
    for (const py::object& each : asked.operators) {
        const auto name = each.attr("name").cast<std::string>();
        registry.add(name, "yours", "written in Python", PythonOperator{{}, each, name, &callback});
    }
    ga::Parser<P> parser(std::move(registry), app::outside_variants(asked.genes, asked.minimise.size()));
    const auto stage = asked.pipeline.empty() ? parser.variant(asked.variant) : parser.parse(asked.pipeline);
    asked.searched = stage.text();
    ByPython<P> evaluator(callback, asked.record);
    ga::RunOptions run;
    run.variant = asked.variant;
    run.seed = asked.seed;
    run.budget = {asked.evaluations, asked.seconds, &interrupt.stop()};
    std::vector<ga::Observer<G>> observers;
    for (const py::object& each : asked.observers)
        observers.push_back([&, each](const ga::Event<G>& event) {
            callback([&] {
                std::vector<const G*> genomes;
                std::vector<double> fitness;
                for (const auto& individual : event.population) {
                    genomes.push_back(&individual.genome);
                    const ga::Fitness& f = individual.fitness;
                    fitness.push_back(f.known() && !f.has_failed() && !f.several() ? individual.value()
                                                                                   : std::nan(""));
                }
                py::dict told;
                told["path"] = event.path;
                told["generation"] = event.generation;
                told["genes"] = rows_of<G>(genomes, problem.genes.count);
                told["fitness"] = py::array(py::cast(fitness));
                told["evaluations"] = event.counters.asked;
                each(told);
            });
        });
    ga::Result<G> found;
    try {
        const py::gil_scoped_release unlocked;
        found = ga::run_by(evaluator, stage, problem, {}, run, std::move(observers));
    } catch (const std::exception&) {
        callback.rethrow();
        throw;
    }
    callback.rethrow();
    std::vector<const G*> genomes;
    for (const auto& individual : found.population)
        genomes.push_back(&individual.genome);
    asked.population = rows_of<G>(genomes, problem.genes.count);
    asked.spent = found.counters.evaluations;
    asked.stopped = found.stopped;
    asked.notes = found.notes;
    asked.interrupted = interrupt.asked();
}

} // namespace rugosa::python
