#pragma once

#include "apps/commands/optimise/search.hpp"
#include "apps/report/output.hpp"
#include "domain/errors.hpp"
#include "ga/adaptation/vocabulary.hpp"
#include "ga/checkpoint.hpp"
#include "ga/observers/progress.hpp"
#include "ga/refinement/vocabulary.hpp"

#include <cmath>
#include <stdexcept>

namespace app {

/// A problem whose evaluations are made by children: genomes are drawn here, and no more is known of them.
template <class G>
struct OutsideProblem {
    using Genome = G;
    using Outcome = Answer;

    Genes genes;
    std::vector<ga::Objective<Answer>> list;
    std::vector<ga::Variable> range; ///< of real genes

    OutsideProblem(const Genes& of, const std::vector<bool>& minimise) : genes(of) {
        const auto names = objective_names(minimise.size());
        for (std::size_t k = 0; k < names.size(); ++k)
            list.push_back(
                {names[k], [k](const Answer& answer) { return answer.objectives.at(k); }, minimise[k]});
        for (std::size_t i = 0; i < genes.count; ++i)
            range.push_back({i, genes.lower, genes.upper});
    }

    Answer evaluate(const G&) const { throw std::logic_error("evaluated here, expected by a child"); }
    const std::vector<ga::Objective<Answer>>& objectives() const { return list; }
    double violation(const Answer& answer) const { return answer.violation; }
    std::size_t bytes(const Answer& answer) const { return answer.objectives.size() * sizeof(double); }
    const std::vector<ga::Variable>& bounds(const G&) const requires std::same_as<G, std::vector<double>> {
        return range;
    }
    G sample(ga::Stream& stream) const {
        if constexpr (std::same_as<G, ga::Permutation>) {
            return ga::Permutation::random(genes.count, stream);
        } else {
            G genome(genes.count);
            for (std::size_t i = 0; i < genes.count; ++i)
                if constexpr (std::same_as<G, std::vector<bool>>)
                    genome[i] = stream.chance(0.5);
                else
                    genome[i] = stream.uniform(genes.lower, genes.upper);
            return genome;
        }
    }
};

/// "[0.5,1]": 17 digits where they are needed.
template <class G>
std::string genes_text(const G& genome) {
    std::string text;
    for (const auto gene : genome)
        text += (text.empty() ? "[" : ",") + ga::number(static_cast<double>(gene));
    return text + "]";
}

/// The paid calls, made by children.
template <class P>
class ByChildren : public ga::Evaluator<P> {
  public:
    explicit ByChildren(Children& children) : children_(children) {}

    void outcomes(const P&, std::span<ga::Call<P>> calls, const ga::Watch& watch) override {
        std::vector<std::string> genes;
        for (const auto& call : calls)
            genes.push_back(genes_text(*call.genome));
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
        ga::Parser<P> parser(ga::with_adaptation(ga::with_refinement(ga::vocabulary<P>())),
                             outside_variants(asked.genes, objectives));
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

} // namespace app
