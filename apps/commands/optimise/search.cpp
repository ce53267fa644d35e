#include "apps/commands/optimise/search.hpp"

#include "apps/external/problem.hpp"
#include "apps/report/output.hpp"
#include "domain/errors.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "ga/observers/progress.hpp"

namespace app {

namespace {

/// The paid calls, made by children.
template <class P>
class ByChildren : public ga::Evaluator<P> {
  public:
    explicit ByChildren(Children& children) : children_(children) {}

    void outcomes(const P& problem, std::span<ga::Call<P>> calls, const ga::Watch& watch) override {
        std::vector<std::string> genes;
        for (const auto& call : calls)
            genes.push_back(problem.text_of(*call.genome));
        auto answers = children_.ask(genes, watch);
        for (std::size_t i = 0; i < answers.size(); ++i)
            if (answers[i])
                *calls[i].answer = std::move(*answers[i]);
    }
    int threads() const override { return children_.count(); }

  private:
    Children& children_;
};

/// Searches for genomes of one type.
template <class G>
void search_by_children(OutsideSearch& asked, Children& children) {
    using P = OutsideProblem<G>;
    const ga::Stopwatch clock;
    const auto parsed = [&](std::size_t objectives) {
        ga::Parser<P> parser(ga::whole_vocabulary<P>(), outside_variants(asked.genes, objectives));
        return asked.pipeline.empty() ? parser.variant(asked.variant) : parser.parse(asked.pipeline);
    };
    const std::string given = asked.variant;
    if (asked.variant.empty())
        asked.variant = asked.pipeline.empty() ? "ga" : "pipeline";
    parsed(2); // words that are wrong are refused before anything is started

    // The first genome that a leading `sample` draws tells how many objectives there are.
    ByChildren<P> evaluator(children);
    ga::RunOptions run;
    run.seed = asked.seed;
    run.budget = {2, asked.seconds, asked.stop};
    asked.stopped =
        ga::run_by(evaluator, ga::sample(1) | ga::score(), P(asked.genes, {false}), {}, run).stopped;
    const std::size_t objectives = children.objectives();
    if (objectives == 0)
        return;
    asked.spent = 1;
    const P problem(asked.genes, children.record.minimise = minimised(asked.minimise, objectives));
    if (given.empty() && asked.pipeline.empty() && objectives > 1)
        asked.variant = "nsga2";
    const auto stage = parsed(objectives);
    asked.searched = stage.text();

    const bool draws_it_again = asked.searched.starts_with("sample ");
    const long apart = draws_it_again ? 0 : 1; // evaluations that the run does not count
    run.variant = asked.variant;
    run.budget = {asked.evaluations - apart, asked.seconds - clock.seconds(), asked.stop};
    ga::Checkpoints<P> keeper(asked.checkpoint, asked.description + " " + std::to_string(objectives),
                              asked.resume, checkpoint_interval());
    keeper.keep("record", children.record);
    try {
        const auto found =
            ga::run_by(evaluator, stage, problem, {}, run, {ga::progress<G>(asked.show)}, &keeper);
        asked.spent = found.counters.evaluations + apart;
        asked.stopped = found.stopped;
        asked.notes = found.notes;
    } catch (const ga::NothingLeft& nothing) {
        asked.stopped = nothing.what();
    }
}

} // namespace

void search(OutsideSearch& search, Children& children) {
    switch (search.genes.kind) {
    case Genes::Kind::numbers:
        return search_by_children<std::vector<double>>(search, children);
    case Genes::Kind::bits:
        return search_by_children<std::vector<bool>>(search, children);
    case Genes::Kind::permutation:
        return search_by_children<ga::Permutation>(search, children);
    }
}

} // namespace app
