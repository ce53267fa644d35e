#include "apps/python/module/engine.hpp"
#include "ga/pipeline/ask_tell.hpp"

namespace rugosa::python {
namespace {

/// The type of a gene in NumPy.
template <class G>
using Gene = std::conditional_t<std::same_as<G, std::vector<double>>, double,
                                std::conditional_t<std::same_as<G, std::vector<bool>>, bool, long>>;

/// The genomes of some items as rows of an array.
template <class G, class Items, class GenomeOf>
py::array_t<Gene<G>> rows_of(const Items& items, std::size_t columns, GenomeOf genome_of) {
    py::array_t<Gene<G>> rows({items.size(), columns});
    Gene<G>* cell = rows.mutable_data();
    for (const auto& item : items)
        for (const auto gene : std::invoke(genome_of, item)) *cell++ = static_cast<Gene<G>>(gene);
    return rows;
}
template <class G>
py::array_t<Gene<G>> genes_of(const ga::Population<G>& population, std::size_t columns) {
    return rows_of<G>(population, columns, &ga::Individual<G>::genome);
}

/// The fitness of each individual, NaN if it has none or several.
template <class G>
py::array_t<double> fitness_of(const ga::Population<G>& population) {
    py::array_t<double> fitness(std::ssize(population));
    double* cell = fitness.mutable_data();
    for (const auto& each : population) *cell++ = each.fitness.has_value() ? each.value() : std::nan("");
    return fitness;
}

/// A genome from a row. Throws InputError if it has another number of genes.
template <class G>
G genome_of(const py::object& row, std::size_t count) {
    const auto values = row.cast<std::vector<Gene<G>>>();
    if (values.size() != count) rough::refuse("genes: an operator returned ", values.size(), " genes; return ", count);
    if constexpr (std::same_as<G, ga::Permutation>) {
        ga::Permutation permutation;
        for (const long value : values) // one outside 0 .. count - 1 becomes one that is not valid
            permutation.order.push_back(static_cast<std::uint32_t>(std::clamp<long>(value, -1, 0x7fffffff)));
        return permutation;
    } else
        return G(values.begin(), values.end());
}

/// The first line of an exception, "ValueError: mesh failed". Throws the exception again if it is not an
/// Exception, e.g. KeyboardInterrupt.
std::string first_line_of(py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;
    const std::string text = error.what();
    return text.substr(0, text.find('\n'));
}

/// The numbers of a sequence, or one number. `where` begins the message of an InputError.
std::vector<double> values_from(const py::object& value, const std::string& where) {
    if (py::isinstance<py::float_>(value)) // takes least time
        return {value.cast<double>()};
    const RealArray array = array_from(value, where + " returned");
    return {array.data(), array.data() + array.size()};
}

/// The answer that `evaluate` returned: a number, several, or (numbers, violation), the violation a number or
/// one per constraint. None, an exception and numbers that are not finite are failures.
ga::Evaluation<app::Evaluation> answer_of(const py::handle& given, std::size_t objectives) {
    const auto whole = py::reinterpret_borrow<py::object>(given);
    if (whole.is_none()) return ga::reason("evaluate returned None");
    if (PyExceptionInstance_Check(whole.ptr())) return ga::reason(py::str(whole));
    app::Evaluation answer;
    if (py::isinstance<py::tuple>(whole) && py::len(whole) == 2 && py::hasattr(whole[py::int_(0)], "__len__"))
        answer = {values_from(whole[py::int_(0)], "evaluate"), values_from(whole[py::int_(1)], "evaluate")};
    else
        answer = {values_from(whole, "evaluate")};
    if (answer.objectives.size() != objectives)
        rough::refuse("evaluate: ", answer.objectives.size(), " objectives returned; return ", objectives);
    if (!app::is_valid(answer, objectives)) return ga::reason("an objective or violation is not finite");
    return answer;
}

/// The answer of Python for genes, and for the level's name if the problem has several levels.
py::object called(const py::object& function, const py::object& genes, const std::string& level) {
    return level.empty() ? function(genes) : function(genes, level);
}

/// The problem of a search, with the gradient if Python has one. Python's objects are pointed at, because the
/// engine copies problems without the interpreter's lock.
template <class G>
app::OutsideProblem<G> problem_of(const Optimisation& search, Callback& callback) {
    app::OutsideProblem<G> problem(search, search.minimise);
    if constexpr (std::same_as<G, std::vector<double>>)
        if (py::hasattr(search.problem, "gradient"))
            problem.slopes = [object = &search.problem, call = &callback](const G& genome, const std::string& level) {
                std::vector<double> slopes;
                std::string error;
                (*call)([&] {
                    try {
                        slopes = values_from(called(object->attr("gradient"), py::array(py::cast(genome)), level),
                                             "gradient");
                    } catch (py::error_already_set& raised) {
                        error = first_line_of(raised);
                    } catch (const rough::InputError& refused) {
                        error = refused.what();
                    }
                });
                if (!error.empty()) throw std::runtime_error(error);
                return slopes;
            };
    return problem;
}

/// Throws InputError if there are more or fewer answers than genomes.
void expect_answers(const char* where, std::size_t given, std::size_t genomes) {
    if (given != genomes)
        rough::refuse(where, ": ", given, " answers given for ", genomes, " genomes; give one for each");
}

/// Evaluations by Python, with the interpreter's lock: a whole batch if the problem has `evaluate_batch`,
/// else one after the other.
template <class P>
class ByPython : public ga::Evaluator<P> {
  public:
    ByPython(Callback& callback, Optimisation& search) : callback_(callback), search_(search) {}

    void outcomes(const P& problem, std::span<ga::EvaluationCall<P>> calls, const ga::Watch& watch) override {
        // A batch has one level.
        for (auto end = calls.begin(); !calls.empty(); calls = {end, calls.end()}) {
            const ga::Level level = calls.front().level;
            end = std::ranges::find_if(calls, [&](const auto& call) { return call.level != level; });
            outcomes_at(level, problem, {calls.begin(), end}, watch);
        }
    }

  private:
    void outcomes_at(ga::Level level, const P& problem, std::span<ga::EvaluationCall<P>> calls,
                     const ga::Watch& watch) {
        using G = typename P::Genome;
        callback_([&] {
            const std::string& name = problem.name_of(level);
            const auto rows =
                rows_of<G>(calls, problem.count, [](const auto& call) -> const G& { return *call.genome; });
            const py::object& own = search_.problem;
            const std::size_t objectives = problem.objectives_per_level;
            const auto take = [&](ga::EvaluationCall<P>& call, const py::handle& given) {
                *call.answer = answer_of(given, objectives);
                if (const auto* answer = std::get_if<app::Evaluation>(call.answer))
                    search_.record.take({app::genes_text(*call.genome), *answer}, static_cast<std::size_t>(level));
            };
            const auto fail = [&](std::span<ga::EvaluationCall<P>> failed, py::error_already_set& error) {
                const ga::Reason why = ga::reason(first_line_of(error));
                if (!search_.first_error) search_.first_error = std::current_exception();
                for (auto& call : failed) *call.answer = why;
            };
            if (py::hasattr(own, "evaluate_batch")) {
                try {
                    const py::list answers(called(own.attr("evaluate_batch"), rows, name));
                    expect_answers("evaluate_batch", answers.size(), calls.size());
                    for (std::size_t i = 0; i < calls.size(); ++i) take(calls[i], answers[i]);
                } catch (py::error_already_set& error) {
                    fail(calls, error);
                }
                return;
            }
            const py::object evaluate = py::hasattr(own, "evaluate") ? py::object(own.attr("evaluate")) : own;
            for (std::size_t i = 0; i < calls.size() && !watch.expired(); ++i) try {
                    take(calls[i], called(evaluate, rows[py::int_(i)], name));
                } catch (py::error_already_set& error) {
                    fail(calls.subspan(i, 1), error);
                }
        });
    }

    Callback& callback_;
    Optimisation& search_;
};

/// An operator written in Python. It is called with (genes, fitness, random) and returns a new array of genes
/// or the positions of the individuals to keep.
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
            const std::size_t columns = context.problem().count;
            const auto seed = static_cast<std::uint64_t>(context.stream(0).uniform(0, 0x1p53));
            const py::object random = py::module_::import("numpy.random").attr("default_rng")(seed);
            const py::array answer =
                py::array::ensure((*object)(genes_of(population, columns), fitness_of(population), random));
            if (answer && answer.ndim() == 1) {
                for (const long i : answer.cast<std::vector<long>>())
                    made.push_back(population.at(static_cast<std::size_t>(i)));
                return;
            }
            if (!answer || answer.ndim() != 2)
                rough::refuse("operator ", name, ": it returned no array; return genes or positions");
            for (py::ssize_t i = 0; i < answer.shape(0); ++i) {
                ga::Individual<G> child;
                child.genome = genome_of<G>(answer[py::int_(i)], columns);
                if (!ga::is_valid(context.problem(), child.genome))
                    rough::refuse("operator ", name, ": row ", i + 1,
                                  " is not a genome; return finite numbers or each of 0 to ", columns - 1, " once");
                context.make_child(child, {});
                made.push_back(std::move(child));
            }
        });
        if (made.empty())
            context.end_with(population, "it returned an empty population; return at least one individual");
        return made;
    }
};

/// A search that is ready to run. It only points at Python's objects, because it is copied and destroyed
/// without the interpreter's lock.
template <class G>
struct Prepared {
    using P = app::OutsideProblem<G>;
    Optimisation& search;
    Callback callback;
    P problem;
    ga::Population<G> start;
    ga::Pipeline<P> stage;
    ga::RunOptions run;

    Prepared(Optimisation& of, std::atomic<bool>& stop)
        : search(of), callback(stop), problem(problem_of<G>(of, callback)) {
        const ga::Pipeline<P> whole = app::stage_of(search, search.minimise.size(), registry());
        search.searched = whole.text();
        std::tie(start, stage) = app::begun<G>(search, problem, whole, registry());
        run.variant = search.variant;
        run.seed = search.seed;
        run.budget = {search.evaluations, search.seconds, &stop, search.max_failures};
    }

    ga::Registry<P> registry() {
        auto registry = ga::whole_vocabulary<P>();
        for (const py::object& each : search.operators) {
            const auto name = each.attr("name").template cast<std::string>();
            registry.add(name, "yours", "written in Python", PythonOperator{{}, &each, name, &callback});
        }
        return registry;
    }

    std::vector<ga::Observer<G>> observers() {
        using namespace py::literals;
        std::vector<ga::Observer<G>> all;
        for (const py::object& each : search.observers)
            all.push_back([this, one = &each](const ga::Event<G>& event) {
                callback([&] {
                    (*one)(py::dict("path"_a = event.path, "generation"_a = event.generation,
                                    "genes"_a = genes_of(event.population, problem.count),
                                    "fitness"_a = fitness_of(event.population),
                                    "evaluations"_a = event.counters.requested));
                });
            });
        return all;
    }

    /// Runs without the interpreter's lock and stores the result. Rethrows an exception of Python's.
    template <class Run>
    void finish(Run result_of_run) {
        const ga::Result<G> found = callback.unlocked(result_of_run);
        search.population = genes_of(found.population, problem.count);
        if (found.is_dead_end && !search.record.best() && search.first_error)
            std::rethrow_exception(search.first_error);
        if (found.is_dead_end && !search.record.best()) rough::refuse("optimise: ", found.stopped);
        search.spent = found.counters.evaluations;
        search.price = found.counters.price;
        search.failures = found.counters.failures;
        search.stopped = found.stopped;
        search.notes = found.notes;
    }
};

template <class G>
class AskTell : public Search {
    using Engine = ga::AskTell<app::OutsideProblem<G>>;

  public:
    explicit AskTell(Optimisation search)
        : search_(std::move(search)), prepared_(search_, stop_),
          engine_(prepared_.stage, prepared_.problem, prepared_.start, prepared_.run, prepared_.observers()) {}
    ~AskTell() override {
        const py::gil_scoped_release unlocked; // its thread may call Python
        engine_.stop();
        stop_ = true;
        try {
            engine_.result();
        } catch (...) { // thrown before by ask() or result(), or not needed any more
        }
    }

    py::array ask() override {
        prepared_.callback.rethrow();
        open_ = prepared_.callback.unlocked([&] { return engine_.ask(); });
        levels_.clear();
        for (const auto& proposal : open_) levels_.push_back(engine_.level_of(proposal.id));
        asker_ = std::this_thread::get_id();
        return rows_of<G>(open_, prepared_.problem.count, &Engine::Proposal::genome);
    }
    std::vector<std::string> levels() const override {
        std::vector<std::string> names;
        for (const ga::Level level : levels_) names.push_back(prepared_.problem.name_of(level));
        return names;
    }
    void tell(const py::object& iterable) override {
        const py::list given(iterable);
        expect_answers("tell", given.size(), open_.size());
        if (asker_ != std::this_thread::get_id() && !open_.empty())
            rough::refuse("tell: another thread has asked since; use a search in one thread");
        std::vector<ga::Evaluation<app::Evaluation>> answers;
        for (const py::handle& each : given) answers.push_back(answer_of(each, search_.minimise.size()));
        const auto open = std::exchange(open_, {}); // another thread may ask
        const auto levels = std::exchange(levels_, {});
        app::History& history = *search_.history;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const std::string genes = app::genes_text(open[i].genome);
            if (const auto* answer = std::get_if<app::Evaluation>(&answers[i]))
                search_.record.take({genes, *answer}, static_cast<std::size_t>(levels[i]));
            if (history.is_kept())
                history.add(engine_.generation_of(open[i].id), prepared_.problem.name_of(levels[i]), genes, answers[i]);
        }
        history.write();
        const py::gil_scoped_release unlocked;
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (auto* answer = std::get_if<app::Evaluation>(&answers[i]))
                engine_.tell(open[i].id, std::move(*answer));
            else
                engine_.fail(open[i].id, *std::get<ga::Reason>(answers[i]));
    }
    Optimisation result() override {
        prepared_.finish([&] { return engine_.result(); });
        return search_;
    }

  private:
    Optimisation search_;
    std::atomic<bool> stop_ = false;
    Prepared<G> prepared_;
    Engine engine_;
    std::vector<ga::Level> levels_;               ///< levels of the last proposals
    std::vector<typename Engine::Proposal> open_; ///< used only with the interpreter's lock
    std::thread::id asker_;                       ///< the thread that has asked last
};

} // namespace

void optimise(Optimisation& search) {
    Interruptible interrupt;
    by_kind(search.genes, [&]<class G>(const G&) {
        Prepared<G> prepared(search, interrupt.stop());
        ByPython<app::OutsideProblem<G>> by_python(prepared.callback, search);
        app::WithHistory<app::OutsideProblem<G>> evaluator(by_python, *search.history);
        prepared.finish([&] {
            return ga::run_by(evaluator, prepared.stage, prepared.problem, prepared.start, prepared.run,
                              prepared.observers());
        });
    });
    search.interrupted = interrupt.requested();
}

std::unique_ptr<Search> begin_search(Optimisation search) {
    return by_kind(search.genes, [&]<class G>(const G&) -> std::unique_ptr<Search> {
        return std::make_unique<AskTell<G>>(std::move(search));
    });
}

} // namespace rugosa::python
