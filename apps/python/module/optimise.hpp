#pragma once

#include "apps/python/module/engine.hpp"
#include "ga/pipeline/ask_tell.hpp"

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

/// The answer that an `evaluate` returned: a number, several, or (numbers, violation), the violation a number
/// or one per constraint.
inline app::Answer answer_of(const py::handle& given, std::size_t objectives) {
    app::Answer answer;
    py::object values = py::reinterpret_borrow<py::object>(given);
    if (py::isinstance<py::tuple>(given) && py::len(given) == 2 &&
        py::hasattr(py::reinterpret_borrow<py::tuple>(given)[0], "__len__")) {
        const auto pair = py::reinterpret_borrow<py::tuple>(given);
        values = pair[0];
        answer.violation = py::hasattr(pair[1], "__len__") ? pair[1].cast<std::vector<double>>()
                                                           : std::vector<double>{pair[1].cast<double>()};
    }
    answer.objectives = py::hasattr(values, "__len__") ? values.cast<std::vector<double>>()
                                                       : std::vector<double>{values.cast<double>()};
    if (answer.objectives.size() != objectives)
        throw rough::InputError("evaluate: " + std::to_string(answer.objectives.size()) +
                                " objectives returned, expected " + std::to_string(objectives));
    return answer;
}

/// Real genes, of which Python may know a gradient. What is Python's is pointed at: the engine copies
/// problems without the interpreter's lock.
struct RealProblem : app::OutsideProblem<std::vector<double>> {
    const py::object* object;
    bool has_gradient;
    Callback* callback;

    RealProblem(const Optimisation& asked, Callback& call)
        : app::OutsideProblem<std::vector<double>>(asked.genes, asked.minimise), object(&asked.problem),
          has_gradient(py::hasattr(*object, "gradient")), callback(&call) {}

    /// Of the objective that `refine` climbs.
    std::vector<double> gradient(const Genome& genome, const std::string&) const {
        std::vector<double> slopes;
        if (!has_gradient)
            throw std::runtime_error("the problem has no gradient");
        (*callback)([&] {
            slopes = object->attr("gradient")(py::array(py::cast(genome))).cast<std::vector<double>>();
        });
        if (slopes.size() != genome.size())
            throw std::runtime_error("the gradient has " + std::to_string(slopes.size()) + " numbers");
        return slopes;
    }
};

///@{
/// The problem as the engine takes it.
template <class G>
app::OutsideProblem<G> problem_of(const Optimisation& asked, Callback&, G) {
    return {asked.genes, asked.minimise};
}
inline RealProblem problem_of(const Optimisation& asked, Callback& callback, std::vector<double>) {
    return {asked, callback};
}
///@}
template <class G>
using PythonProblem = decltype(problem_of(std::declval<Optimisation>(), std::declval<Callback&>(), G()));

/// Throws InputError where a batch has more or fewer answers than genomes.
inline void expect_answers(const std::string& of, std::size_t given, std::size_t expected) {
    if (given != expected)
        throw rough::InputError(of + ": " + std::to_string(given) + " answers given, expected " +
                                std::to_string(expected));
}

/// The paid calls, made by Python with the interpreter's lock: all of a batch at once where the problem has
/// `evaluate_batch`, else one after the other.
template <class P>
class ByPython : public ga::Evaluator<P> {
  public:
    ByPython(Callback& callback, Optimisation& asked) : callback_(callback), asked_(asked) {}

    void outcomes(const P& problem, std::span<ga::Call<P>> calls, const ga::Watch& watch) override {
        callback_([&] {
            std::vector<const typename P::Genome*> genomes;
            for (const auto& call : calls)
                genomes.push_back(call.genome);
            const auto rows = rows_of<typename P::Genome>(genomes, problem.count);
            const py::object& own = asked_.problem;
            const std::size_t objectives = problem.objectives().size();
            if (py::hasattr(own, "evaluate_batch")) {
                const py::list answers(own.attr("evaluate_batch")(rows));
                expect_answers("evaluate_batch", answers.size(), calls.size());
                for (std::size_t i = 0; i < calls.size(); ++i)
                    take(calls[i], answer_of(answers[i], objectives));
                return;
            }
            const py::object evaluate = py::hasattr(own, "evaluate") ? py::object(own.attr("evaluate")) : own;
            for (std::size_t i = 0; i < calls.size() && !watch.expired(); ++i)
                take(calls[i], answer_of(evaluate(rows[py::int_(i)]), objectives));
        });
    }

  private:
    void take(ga::Call<P>& call, app::Answer answer) {
        asked_.record.take({app::genes_text(*call.genome), answer});
        *call.answer = std::move(answer);
    }

    Callback& callback_;
    Optimisation& asked_;
};

/// One number each; NaN where there is none.
template <class Population>
py::array_t<double> fitness_of(const Population& population) {
    py::array_t<double> fitness(population.size());
    for (std::size_t i = 0; i < population.size(); ++i) {
        const ga::Fitness& f = population[i].fitness;
        fitness.mutable_at(i) =
            f.known() && !f.has_failed() && !f.several() ? population[i].value() : std::nan("");
    }
    return fitness;
}

/// An operator written in Python: called with (genes, fitness, random), it returns a new array of genes, or
/// positions of the individuals that stay.
struct PythonOperator : ga::Operator {
    const py::object* object;
    std::string name;
    Callback* callback;

    std::string text() const { return name; }
    void check(ga::CheckState& known) const { known.scored.reset(); }

    template <ga::Problem P>
    ga::Population<typename P::Genome> operator()(ga::Population<typename P::Genome> population,
                                                  ga::Context<P>& context) const {
        using G = typename P::Genome;
        ga::Population<G> made;
        (*callback)([&] {
            std::vector<const G*> genomes;
            const py::array_t<double> fitness = fitness_of(population);
            for (const auto& individual : population)
                genomes.push_back(&individual.genome);
            const std::size_t columns = context.problem().count;
            const auto seed = static_cast<std::uint64_t>(context.stream(0).uniform(0, 0x1p53));
            const py::object random = py::module_::import("numpy.random").attr("default_rng")(seed);
            const py::array answer =
                py::array::ensure((*object)(rows_of<G>(genomes, columns), fitness, random));
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

/// A search as it was asked for, ready to run. Nothing in it owns what is Python's: it is copied and
/// destroyed without the interpreter's lock.
template <class G>
struct Prepared {
    using P = PythonProblem<G>;
    Optimisation& asked;
    Callback callback;
    P problem;
    ga::Stage<P> stage;
    ga::RunOptions run;

    Prepared(Optimisation& of, std::atomic<bool>& stop)
        : asked(of), callback(stop), problem(problem_of(of, callback, G())), stage(parsed()) {
        asked.searched = stage.text();
        run.variant = asked.variant;
        run.seed = asked.seed;
        run.budget = {asked.evaluations, asked.seconds, &stop};
    }

    ga::Stage<P> parsed() {
        auto registry = ga::whole_vocabulary<P>();
        for (const py::object& each : asked.operators) {
            const auto name = each.attr("name").template cast<std::string>();
            registry.add(name, "yours", "written in Python", PythonOperator{{}, &each, name, &callback});
        }
        return app::stage_of(asked, asked.minimise.size(), std::move(registry));
    }

    std::vector<ga::Observer<G>> observers() {
        std::vector<ga::Observer<G>> all;
        for (const py::object& each : asked.observers)
            all.push_back([this, one = &each](const ga::Event<G>& event) {
                callback([&] {
                    py::dict told;
                    told["path"] = event.path;
                    told["generation"] = event.generation;
                    told["genes"] = genes_of(event.population);
                    told["fitness"] = fitness_of(event.population);
                    told["evaluations"] = event.counters.asked;
                    (*one)(told);
                });
            });
        return all;
    }

    template <class Population>
    py::array genes_of(const Population& population) const {
        std::vector<const G*> genomes;
        for (const auto& individual : population)
            genomes.push_back(&individual.genome);
        return rows_of<G>(genomes, problem.count);
    }

    /// What a run without the interpreter's lock found goes to the Optimisation; an exception of Python's
    /// ends it.
    template <class Run>
    void finish(Run found_by) {
        ga::Result<G> found;
        try {
            const py::gil_scoped_release unlocked;
            found = found_by();
        } catch (const std::exception&) {
            callback.rethrow();
            throw;
        }
        callback.rethrow();
        asked.population = genes_of(found.population);
        asked.spent = found.counters.evaluations;
        asked.stopped = found.stopped;
        asked.notes = found.notes;
    }
};

template <class G>
void optimise(Optimisation& asked) {
    Interruptible interrupt;
    Prepared<G> search(asked, interrupt.stop());
    ByPython<PythonProblem<G>> evaluator(search.callback, asked);
    search.finish([&] {
        return ga::run_by(evaluator, search.stage, search.problem, {}, search.run, search.observers());
    });
    asked.interrupted = interrupt.asked();
}

/// The same search, asking.
template <class G>
class AskingFor : public Asking {
    using P = PythonProblem<G>;

  public:
    explicit AskingFor(Optimisation& asked)
        : search_(asked, stop_),
          engine_(search_.stage, search_.problem, {}, search_.run, search_.observers()) {}
    ~AskingFor() override {
        const py::gil_scoped_release unlocked; // its thread may call Python
        engine_.stop();
        stop_ = true;
        try {
            engine_.result();
        } catch (...) { // told by ask() or end(), or of no interest
        }
    }

    py::array ask() override {
        search_.callback.rethrow();
        {
            const py::gil_scoped_release unlocked;
            try {
                open_ = engine_.ask();
            } catch (...) {
                if (!search_.callback.failed())
                    throw;
                open_.clear();
            }
        }
        search_.callback.rethrow();
        std::vector<const G*> genomes;
        for (const auto& question : open_)
            genomes.push_back(&question.genome);
        return rows_of<G>(genomes, search_.problem.count);
    }
    void tell(const py::list& answers) override {
        expect_answers("tell", answers.size(), open_.size());
        std::vector<app::Answer> read;
        for (const py::handle& each : answers)
            read.push_back(answer_of(each, search_.problem.objectives().size()));
        const py::gil_scoped_release unlocked;
        for (std::size_t i = 0; i < read.size(); ++i) {
            search_.asked.record.take({app::genes_text(open_[i].genome), read[i]});
            engine_.tell(open_[i].id, std::move(read[i]));
        }
        open_.clear();
    }
    void end() override {
        search_.finish([&] { return engine_.result(); });
    }

  private:
    std::atomic<bool> stop_ = false;
    Prepared<G> search_;
    ga::AskTell<P> engine_;
    std::vector<typename ga::AskTell<P>::Question> open_;
};

template <class G>
std::unique_ptr<Asking> asking(Optimisation& asked) {
    return std::make_unique<AskingFor<G>>(asked);
}

} // namespace rugosa::python
