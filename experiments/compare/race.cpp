#include "experiments/compare/race.hpp"

#include "apps/external/problem.hpp"
#include "ga/pareto/pareto.hpp"

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

namespace app {

double Nearness::after(const Evaluation& value) {
    if (violated(value) > 0) return nearest_;
    if (!front_) return nearest_ = std::min(nearest_, (value.objectives[0] - best_) / scale_);
    bool nearer = false;
    for (std::size_t i = 0; i < short_of_.size(); ++i) {
        const ga::Point& wanted = (*front_)[i];
        double sum = 0;
        for (std::size_t k = 0; k < wanted.size() && sum < short_of_[i]; ++k) {
            const double worse = std::max(0.0, value.objectives[k] - wanted[k]);
            sum += worse * worse;
        }
        if (sum < short_of_[i]) {
            short_of_[i] = sum;
            nearer = true;
        }
    }
    if (nearer) {
        nearest_ = 0;
        for (const double squared : short_of_) nearest_ += std::sqrt(squared) / static_cast<double>(short_of_.size());
    }
    return nearest_;
}

template <class G>
double hypervolume(const Instance<G>& instance, std::vector<ga::Point> points) {
    if (!instance.front) return NAN;
    constexpr double reference = 1.1;
    for (std::size_t k = 0; k < instance.objectives; ++k) {
        const auto [low, high] = std::ranges::minmax(*instance.front, {}, [k](const ga::Point& f) { return f[k]; });
        const double best = low[k], range = high[k] - best;
        for (ga::Point& point : points) point[k] = (best - point[k]) / range;
    }
    return ga::hypervolume(std::move(points), ga::Point(instance.objectives, -reference));
}
template double hypervolume(const RealInstance&, std::vector<ga::Point>);

Tally::Tally(const std::vector<double>& targets, const Attempt& attempt) : targets_(targets), stop_(attempt.stop) {
    reached_.evaluations.assign(targets.size(), NAN);
}

void Tally::note(long evaluations, double precision) {
    reached_.spent = evaluations;
    const bool is_better = precision < reached_.precision;
    reached_.precision = std::min(reached_.precision, precision);
    if (reached_.found.empty() || (is_better && (next_ == targets_.size() || reached_.precision <= targets_[next_])))
        reached_.found.emplace_back(evaluations, reached_.precision);
    while (next_ < targets_.size() && reached_.precision <= targets_[next_])
        reached_.evaluations[next_++] = static_cast<double>(evaluations);
    if (next_ == targets_.size() || (stop_ && stop_->load(std::memory_order_relaxed))) ended_ = true;
}

namespace {

/// One evaluation after the other, each tallied.
template <class G>
class Tallied : public ga::Evaluator<OutsideProblem<G>> {
  public:
    Tallied(const Instance<G>& instance, Tally& tally)
        : evaluate_(instance.evaluate), nearness_(instance), tally_(tally) {}

    void outcomes(const OutsideProblem<G>&, std::span<ga::EvaluationCall<OutsideProblem<G>>> calls,
                  const ga::Watch& watch) override {
        for (auto& call : calls) {
            if (watch.expired()) return;
            Evaluation answer = evaluate_(*call.genome);
            tally_.note(++made_, nearness_.after(answer));
            *call.answer = std::move(answer);
        }
    }

  private:
    const std::function<Evaluation(const G&)>& evaluate_;
    Nearness nearness_;
    Tally& tally_;
    long made_ = 0;
};

template <class G>
ga::Pipeline<OutsideProblem<G>> stage_of(const Instance<G>& instance, std::string text) {
    boost::replace_all(text, "0.5/n", ga::number(0.5 / static_cast<double>(instance.genes)));
    boost::replace_all(text, "1/n", ga::number(1 / static_cast<double>(instance.genes)));
    boost::replace_all(text, "18n", std::to_string(18 * instance.genes));
    boost::replace_all(text, "objectives", boost::join(objective_names(instance.objectives), " "));
    return ga::Parser<OutsideProblem<G>>(ga::whole_vocabulary<OutsideProblem<G>>()).parse(text);
}

bool is_pagmos(const std::string& variant) { return variant.starts_with("pagmo:"); }

template <class G>
OutsideProblem<G> problem_of(const Instance<G>& instance) {
    return {instance.genes, instance.box, std::vector<bool>(instance.objectives, true)};
}

} // namespace

template <class G>
void expect_fits(const Instance<G>& instance, const std::string& variant) {
    if constexpr (std::is_same_v<Instance<G>, RealInstance>)
        if (is_pagmos(variant)) return expect_pagmos(instance, variant);
    ga::check(stage_of(instance, variant), problem_of(instance), {});
}

template <class G>
Reached raced(const Instance<G>& instance, const std::string& variant, const std::vector<double>& targets,
              const Attempt& attempt) {
    if constexpr (std::is_same_v<Instance<G>, RealInstance>)
        if (is_pagmos(variant)) return raced_by_pagmo(instance, variant, targets, attempt);
    const OutsideProblem<G> problem = problem_of(instance);
    const auto stage = stage_of(instance, variant);
    Tally tally(targets, attempt);
    Tallied<G> evaluator(instance, tally);
    ga::RunOptions options;
    options.memory_bytes = std::size_t{1} << 26;
    std::vector<ga::Point> last;
    long left = attempt.budget;
    for (std::uint64_t start = 0; left > 0 && !tally.ended(); ++start) {
        options.seed = ga::fold(attempt.seed, start);
        options.budget = {left, std::numeric_limits<double>::infinity(), &tally.ended()};
        const auto found = ga::run_by(evaluator, stage, problem, {}, options);
        if (instance.front) {
            last.clear();
            for (const auto& each : found.population)
                if (each.fitness.several()) last.push_back(instance.evaluate(each.genome).objectives);
        }
        if (found.counters.requested == 0 || !found.stopped.empty()) break;
        left -= found.counters.requested;
    }
    Reached reached = tally.reached();
    reached.hypervolume = hypervolume(instance, std::move(last));
    return reached;
}

template Reached raced(const RealInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const RealInstance&, const std::string&);
template Reached raced(const BitsInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const BitsInstance&, const std::string&);
template Reached raced(const TourInstance&, const std::string&, const std::vector<double>&, const Attempt&);
template void expect_fits(const TourInstance&, const std::string&);

} // namespace app
