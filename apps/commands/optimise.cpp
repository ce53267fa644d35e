#include "apps/commands/optimise/children.hpp"
#include "apps/external/problem.hpp"
#include "apps/prompt/terminal.hpp"
#include "apps/prompt/units.hpp"
#include "apps/report/history.hpp"
#include "apps/report/output.hpp"
#include "apps/report/record.hpp"
#include "domain/text/atomic_file.hpp"
#include "domain/text/json.hpp"
#include "domain/text/words.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/progress.hpp"

#include <boost/algorithm/string.hpp>

namespace app {
namespace {

/// A search whose genomes are evaluated by child processes.
struct SearchByChildren : OutsideSearch {
    std::string minimise;    ///< as for `minimised`
    bool resume = false;     ///< continue from the checkpoint
    nlohmann::json inputs;   ///< see Origin
    std::string description; ///< all that decides the result besides pipeline and seed
    History history;         ///< has all evaluations
};

template <class P>
class ByChildren : public ga::Evaluator<P> {
  public:
    explicit ByChildren(Children& children) : children_(children) {}

    void outcomes(const P& problem, std::span<ga::EvaluationCall<P>> calls, const ga::Watch& watch) override {
        std::vector<Children::Request> requests;
        for (const auto& call : calls)
            requests.push_back(
                {problem.text_of(*call.genome), problem.name_of(call.level), static_cast<std::size_t>(call.level)});
        auto answers = children_.ask(requests, watch);
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (!std::holds_alternative<ga::Pending>(answers[i])) *calls[i].answer = std::move(answers[i]);
    }
    int threads() const override { return children_.count(); }

  private:
    Children& children_;
};

/// Searches for genomes of one type, with checkpoints in a file.
template <class G>
void search_by_children(SearchByChildren& search, Children& children, const std::filesystem::path& checkpoint,
                        ProgressLine& progress) {
    using P = OutsideProblem<G>;
    const ga::Stopwatch clock;
    stage_of<P>(search, 2); // refuses a wrong text before anything is started

    // The first success among the genomes that a leading `sample` draws tells how many objectives there are.
    ByChildren<P> by_children(children);
    WithHistory<P> evaluator(by_children, search.history);
    ga::RunOptions run;
    run.seed = search.seed;
    run.budget = {search.evaluations, search.seconds, &Interrupt::flag(), search.max_failures};
    const auto tries = static_cast<std::size_t>(std::min(search.evaluations, 200L));
    const P unknown(search, {false});
    const auto [given, probe] =
        begun<G>(search, unknown, ga::Pipeline<P>(ga::sample(search.start.empty() ? tries : 1) | ga::score()));
    const auto first = ga::run_by(evaluator, probe, unknown, given, run);
    const auto book = [&](const auto& result, long extra) {
        search.spent = result.counters.evaluations + extra;
        search.price = result.counters.price + static_cast<double>(extra);
        search.failures = result.counters.failures;
        search.stopped = result.stopped;
        search.is_dead_end = result.is_dead_end;
        search.notes = result.notes;
    };
    book(first, 0);
    const std::size_t objectives = children.objectives();
    if (objectives == 0) return;
    const P problem(search, children.record.minimise = minimised(search.minimise, objectives));
    const auto whole = stage_of<P>(search, objectives);
    search.searched = whole.text();
    const auto [start, stage] = begun<G>(search, problem, whole);

    const bool draws_alike =
        search.searched.find_first_not_of("0123456789", 7) == search.searched.find(" |"); // no `sobol`
    const auto drawn_again = static_cast<long>(!search.start.empty() ? search.start.size()
                                               : draws_alike         ? leading_sample(search.searched)
                                                                     : 0);
    const long extra = std::max(0L, search.spent - drawn_again); // evaluations that the run does not count
    search.history.begin(objectives, static_cast<std::size_t>(drawn_again));
    run.variant = search.variant = variant_of(search, objectives);
    run.budget.evaluations = search.evaluations - extra;
    run.budget.seconds = search.seconds - clock.seconds();
    ga::Checkpoints<P> keeper(checkpoint, search.description + " " + std::to_string(objectives), search.resume,
                              checkpoint_interval());
    keeper.keep("record", children.record);
    keeper.keep("history", search.history.written);
    const auto show = [&](const std::string& text) { progress.show(text); };
    book(ga::run_by(evaluator, stage, problem, start, run, {ga::progress<G>(show)}, &keeper), extra);
}

using nlohmann::json;

std::vector<Setting> optimise_settings() {
    Setting minimise("minimise", "", "lower is better: for all objectives, or only for those that X = 1,3 names");
    minimise.alone = "all";
    return joined(
        {{{"genes", "",
           "genome: real:COUNT:LOWER:UPPER (:log or :STEP may follow), int:COUNT:FROM:TO and "
           "choice:COUNT:WORD:WORD:..., with commas between, or bits:COUNT, or permutation:COUNT (of 0, 1, "
           "...)"},
          {"evaluate", "", "program that evaluates, with its arguments; quotes as in a shell, but no shell"},
          {"start", "", "file of genomes to begin with, one per line, with commas between their genes"},
          minimise,
          positive("timeout", "60", "maximum seconds for one evaluation"),
          whole("threads", "0", 0, 1024,
                "number of child processes, which evaluate at the same time; 0: one per processor"),
          {"history", "", "file (CSV) for all evaluations: generation, genes, objectives, violation, failure"},
          {"out", "", "folder for result.json [out/optimise]"},
          Setting("resume", "", "continue the interrupted run in the folder given by --out", true),
          force_setting()},
         outside_settings()});
}

json solution_json(const Solution& solution) {
    json result = {{"genes", rough::parsed_json(solution.genes, "genes")}, {"objectives", solution.answer.objectives}};
    const auto& violation = solution.answer.violation;
    if (violation.size() > 1)
        result["violation"] = violation;
    else if (!violation.empty() && violation.front() != 0)
        result["violation"] = violation.front();
    return result;
}

json outside_json(const OutsideSearch& searched, const BestKnown& record, const Settings& settings) {
    json result{{"genes", settings.text("genes")}, {"evaluate", settings.text("evaluate")},
                {"variant", searched.variant},     {"pipeline", searched.searched},
                {"minimise", json::array()},       {"best", record.best() ? solution_json(*record.best()) : json()},
                {"evaluations", searched.spent},   {"failures", searched.failures},
                {"stopped", searched.stopped},     {"notes", searched.notes}};
    if (!searched.levels.empty())
        result.update({{"levels", searched.levels}, {"price", searched.price}, {"level", level_of(searched, record)}});
    for (std::size_t k = 0; k < record.minimise.size(); ++k)
        if (record.minimise[k]) result["minimise"].push_back(k + 1);
    if (record.minimise.size() > 1) {
        result["front"] = json::array();
        for (const Solution& solution : record.front()) result["front"].push_back(solution_json(solution));
    }
    return result;
}

/// The genomes in a file: one per line, with commas or spaces between the genes. Lines that begin with # do not count.
std::vector<std::vector<double>> start_from(const Genes& genes, const std::filesystem::path& path) {
    constexpr std::size_t max_bytes = 64'000'000;
    std::string bytes = rough::read_whole(path, max_bytes);
    const rough::Lines lines = rough::text_lines(bytes, path.string());
    std::vector<std::vector<double>> start;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string line(lines[i]);
        std::vector<std::string> values;
        boost::trim_if(line, boost::is_any_of(", \t\r[]"));
        if (line.empty() || line[0] == '#') continue;
        boost::split(values, line, boost::is_any_of(", \t\""), boost::token_compress_on);
        std::erase(values, "");
        start.push_back(numbers_from(genes, values, path.string() + ", line " + std::to_string(i + 1)));
    }
    if (start.empty()) rough::refuse("--start: ", path.string(), " has no genome; give one per line");
    return start;
}

/// The search that the settings describe. Their mistakes are found before any file is written.
SearchByChildren search_from(const Settings& settings) {
    for (const char* needed : {"genes", "evaluate"})
        if (!settings.has(needed))
            rough::refuse("--", needed, ": missing; give it",
                          needed[0] == 'g' ? ", e.g. real:5:-5:5" : ", e.g. 'python3 fitness.py'");
    SearchByChildren search;
    take_search(settings, search);
    search.genes = genes_from(settings.text("genes"));
    if (settings.has("start")) search.start = start_from(search.genes, settings.path("start"));
    search.minimise = settings.text("minimise");
    if (search.minimise != "all") // the number of objectives is not known yet
        minimised(search.minimise, 1000);
    std::vector<std::filesystem::path> files = settings.files();
    for (const std::string& word : split_command(settings.text("evaluate")))
        if (std::error_code none; std::filesystem::is_regular_file(word, none)) files.emplace_back(word);
    search.inputs = inputs_json(files);
    search.description = rough::json_text({RUGOSA_VERSION, key_of(search.inputs), settings.text("genes"),
                                           settings.text("evaluate"), search.minimise, search.levels},
                                          true);
    search.resume = resumes(settings);
    if (settings.has("history"))
        search.history = {search.resume ? std::filesystem::path(settings.text("history"))
                                        : expect_writable(settings.text("history"), settings, "--history"),
                          search.resume};
    return search;
}

int optimise(const Settings& settings, const std::string& line) {
    const ga::Stopwatch clock;
    SearchByChildren search = search_from(settings);
    const int threads = ga::thread_count(settings.whole<int>("threads"));
    const double timeout = settings.number("timeout");
    const OutputFolder output(settings.text("out"), "optimise",
                              {{"result.json", "checkpoint.cbor", "checkpoint.cbor.before", "evaluate.log"},
                               settings.files(),
                               settings.is_on("force"),
                               search.resume});
    const auto& folder = output.path();
    const std::filesystem::path checkpoint = folder / "checkpoint.cbor";
    if (search.resume && says_finished(folder, "checkpoint.cbor", search.inputs)) return 0;

    const Interrupt interrupt;
    ProgressLine progress;
    Children children(settings.text("evaluate"), threads, timeout, folder / "evaluate.log");
    search.seconds -= clock.seconds();
    by_kind(search.genes,
            [&](auto genome) { search_by_children<decltype(genome)>(search, children, checkpoint, progress); });
    if (!children.trouble().empty())
        search.stopped = children.trouble();
    else if (search.failures > 0 && !search.is_dead_end)
        search.notes.push_back(std::to_string(search.failures) +
                               " evaluations failed; the first: " + children.first_failure());
    const BestKnown& record = children.record;
    if (record.best() || interrupt.requested()) {
        json result = origin_json({"optimise", line, search.seed, threads, search.inputs});
        result.update(outside_json(search, record, settings));
        result["seconds"] = clock.seconds();
        write_json(output.restored() / "result.json", result);
    }
    if (search.stopped.empty() || (search.is_dead_end && search.failures == 0))
        for (const char* kept : {"checkpoint.cbor", "checkpoint.cbor.before"})
            std::filesystem::remove(ga::held_path(folder / kept));
    if (!children.trouble().empty())
        rough::refuse(children.trouble(), record.best() ? "; the best so far is in " + folder.string() : "");
    if (!record.best() && search.is_dead_end) rough::refuse("--evaluate: ", search.stopped, "; correct the program");
    tell_notes(search.notes);
    std::string best = "nothing was evaluated";
    if (record.best()) {
        best = "best";
        for (const double value : record.best()->answer.objectives) best += " " + readable(value, 6);
    }
    say(folder.string() + ": " + best + " after " + std::to_string(search.spent) + " evaluations (" +
        readable(clock.seconds()) + " s)" + (search.stopped.empty() ? "" : "; " + search.stopped) +
        (std::filesystem::exists(checkpoint)
             ? "; --resume with more --evaluations, --seconds or --max-failures continues"
             : ""));
    return interrupt.requested() ? exit_interrupted : 0;
}

} // namespace

Command optimise_command() { return {"optimise", optimise_settings(), optimise}; }

} // namespace app
