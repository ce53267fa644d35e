#include "apps/cluster/evaluator.hpp"

#include "apps/cluster/crew.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/kinds.hpp"
#include "domain/problem/stored.hpp"

namespace app {

namespace {

using nlohmann::json;
using rough::DesignOutcome;
using rough::DesignProblem;
using rough::Genome;

std::shared_ptr<const DesignProblem> problem_under(const std::string& setting) {
    return std::make_shared<const DesignProblem>(json::from_cbor(setting).get<rough::DesignSetup>());
}

json json_of(const ga::Slope<DesignProblem>& slope) {
    json j{slope.failure ? json(*slope.failure) : json(), json(), json(), json()};
    if (const auto& found = slope.sensitivity) {
        j[1] = rough::numbers_of(found->residuals);
        j[2] = rough::numbers_of(found->jacobian.reshaped());
        j[3] = found->jacobian.cols();
    }
    return j;
}
void take(const json& j, ga::Slope<DesignProblem>& slope) {
    if (!j.at(0).is_null())
        slope.failure = ga::reason(j.at(0).get<std::string>());
    if (!j.at(1).is_null()) {
        const Eigen::VectorXd residuals = rough::vector_from(j.at(1));
        slope.sensitivity = std::make_shared<const ga::Sensitivity>(ga::Sensitivity{
            residuals, rough::vector_from(j.at(2)).reshaped(residuals.size(), j.at(3).get<Eigen::Index>())});
    }
}

class OnRanks : public ga::OnThreads<DesignProblem> {
  public:
    explicit OnRanks(int threads) : OnThreads(threads), asked_(threads) {}

    void outcomes(const DesignProblem& problem, std::span<ga::Call<DesignProblem>> calls,
                  const ga::Watch& watch) override {
        if (problem.shares_memory() || !crew::is_worth("outcomes", calls.size(), threads()))
            return OnThreads::outcomes(problem, calls, watch);
        hand_out(
            "outcomes", problem, calls.size(), watch, [&](std::size_t i) { return json(*calls[i].genome); },
            [&](std::size_t i, const json& j) {
                if (j.is_string())
                    *calls[i].answer = ga::reason(j.get<std::string>());
                else
                    *calls[i].answer = j.get<DesignOutcome>();
            });
    }
    void slopes(const DesignProblem& problem, std::span<ga::Slope<DesignProblem>* const> slopes,
                const ga::Watch& watch) override {
        if (!crew::is_worth("slopes", slopes.size(), threads()))
            return OnThreads::slopes(problem, slopes, watch);
        static const ga::Budget endless; // a search takes an unanswered request for a failure
        static const ga::Watch never(endless);
        hand_out(
            "slopes", problem, slopes.size(), never,
            [&](std::size_t i) {
                return json::array({slopes[i]->genome, slopes[i]->objective.text()});
            },
            [&](std::size_t i, const json& j) { app::take(j, *slopes[i]); });
    }

  private:
    template <class Task, class Take>
    void hand_out(const char* kind, const DesignProblem& problem, std::size_t count, const ga::Watch& watch,
                  Task task, Take take) const {
        crew::hand_out(
            {.kind = kind,
             .setting = cbor_of(problem.setup()),
             .threads = asked_,
             .count = count,
             .next = crew::one_after_another(count, [&](std::size_t i) { return cbor_of(task(i)); }),
             .take = [&](std::size_t i, const std::string& answer) { take(i, json::from_cbor(answer)); },
             .ended = [&] { return watch.expired(); }});
    }

    int asked_;
};

} // namespace

Work outcomes_under(const std::string& setting) {
    return [problem = problem_under(setting)](const std::string& task) {
        const auto found = ga::evaluated(*problem, json::from_cbor(task).get<Genome>());
        const DesignOutcome* outcome = std::get_if<DesignOutcome>(&found);
        return cbor_of(outcome ? json(*outcome) : json(*std::get<ga::Reason>(found)));
    };
}

Work slopes_under(const std::string& setting) {
    return [problem = problem_under(setting)](const std::string& task) {
        const json j = json::from_cbor(task);
        ga::Slope<DesignProblem> slope;
        j.at(0).get_to(slope.genome);
        slope.objective = ga::Name(j.at(1).get<std::string>());
        ga::differentiate(*problem, slope);
        return cbor_of(json_of(slope));
    };
}

std::unique_ptr<ga::Evaluator<DesignProblem>> design_evaluator(int threads) {
    if (crew::is_alone())
        return std::make_unique<ga::OnThreads<DesignProblem>>(threads);
    return std::make_unique<OnRanks>(threads);
}

} // namespace app
