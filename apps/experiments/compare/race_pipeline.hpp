#pragma once

#include "apps/experiments/compare/race.hpp"
#include "ga/number.hpp"
#include "ga/text/parser.hpp"
#include "ga/text/whole_vocabulary.hpp"

namespace app {

/// An instance as the engine takes it.
template <class G>
struct BenchmarkProblem {
    using Genome = G;
    using Outcome = Valued;

    const Instance<G>* instance;
    std::vector<ga::Objective<Valued>> list;

    explicit BenchmarkProblem(const Instance<G>& of) : instance(&of) {
        for (std::size_t k = 0; k < of.objectives; ++k)
            list.push_back({"f" + std::to_string(k + 1),
                            [k](const Valued& value) { return value.objectives[k]; }, true});
    }

    Valued evaluate(const G& genome) const { return instance->evaluate(genome); }
    const std::vector<ga::Objective<Valued>>& objectives() const { return list; }
    double violation(const Valued& value) const { return value.violation; }
    std::size_t bytes(const Valued& value) const { return value.objectives.size() * sizeof(double); }
    const std::vector<ga::Variable>& bounds(const G&) const requires std::same_as<G, std::vector<double>> {
        return instance->box;
    }
    G sample(ga::Stream& stream) const {
        if constexpr (std::same_as<G, ga::Permutation>) {
            return ga::Permutation::random(instance->genes, stream);
        } else {
            G genome(instance->genes);
            for (std::size_t i = 0; i < genome.size(); ++i)
                if constexpr (std::same_as<G, std::vector<bool>>)
                    genome[i] = stream.chance(0.5);
                else
                    genome[i] = stream.uniform(instance->box[i].lower, instance->box[i].upper);
            return genome;
        }
    }
};

/// One evaluation after the other, each tallied.
template <class G>
class Tallied : public ga::Evaluator<BenchmarkProblem<G>> {
  public:
    Tallied(const Instance<G>& instance, Tally& tally) : nearness_(instance), tally_(tally) {}

    void outcomes(const BenchmarkProblem<G>& problem, std::span<ga::Call<BenchmarkProblem<G>>> calls,
                  const ga::Watch& watch) override {
        for (auto& call : calls) {
            if (watch.expired())
                return;
            *call.answer = ga::evaluated(problem, *call.genome);
            const Valued* value = std::get_if<Valued>(call.answer);
            tally_.note(++made_, value ? nearness_.after(*value) : HUGE_VAL);
        }
    }

  private:
    Nearness nearness_;
    Tally& tally_;
    long made_ = 0;
};

template <class G>
ga::Stage<BenchmarkProblem<G>> stage_of(const Instance<G>& instance, std::string text) {
    std::string names;
    for (std::size_t k = 1; k <= instance.objectives; ++k)
        names += (k > 1 ? " f" : "f") + std::to_string(k);
    const auto put = [&](const std::string& word, const std::string& meaning) {
        for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + meaning.size()))
            text.replace(at, word.size(), meaning);
    };
    put("1/n", ga::number(1 / static_cast<double>(instance.genes)));
    put("18n", std::to_string(18 * instance.genes));
    put("objectives", names);
    return ga::Parser<BenchmarkProblem<G>>(ga::whole_vocabulary<BenchmarkProblem<G>>()).parse(text);
}

template <class G>
void expect_fits(const Instance<G>& instance, const std::string& pipeline) {
    ga::check(stage_of(instance, pipeline), BenchmarkProblem<G>(instance), {});
}

template <class G>
Reached raced(const Instance<G>& instance, const std::string& pipeline, const std::vector<double>& targets,
              const Attempt& attempt) {
    const BenchmarkProblem<G> problem(instance);
    const auto stage = stage_of(instance, pipeline);
    Tally tally(targets, attempt);
    Tallied<G> evaluator(instance, tally);
    ga::RunOptions options;
    options.memory_bytes = std::size_t{1} << 26;
    long left = attempt.budget;
    for (std::uint64_t start = 0; left > 0 && !tally.over(); ++start) {
        options.seed = ga::fold(attempt.seed, start);
        options.budget = {left, std::numeric_limits<double>::infinity(), &tally.over()};
        try {
            const auto found = ga::run_by(evaluator, stage, problem, {}, options);
            if (found.counters.asked == 0 || !found.stopped.empty())
                break;
            left -= found.counters.asked;
        } catch (const ga::NothingLeft&) {
            break;
        }
    }
    return tally.reached();
}

} // namespace app
