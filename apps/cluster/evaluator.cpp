#include "apps/cluster/evaluator.hpp"

#include "domain/problem/stored.hpp"

namespace rough {
/// The part of a response that a database stores.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Response, range, pressure, contact_fraction, tangent_stiffness)
} // namespace rough

namespace app {

using nlohmann::json;

namespace {

using rough::DesignProblem;

class OnRanks : public ga::OnThreads<DesignProblem> {
  public:
    explicit OnRanks(int threads) : OnThreads(threads), requested_(threads) {}

    void outcomes(const DesignProblem& problem, std::span<ga::EvaluationCall<DesignProblem>> calls,
                  const ga::Watch& watch) override {
        if (problem.shares_memory() || calls.size() < 2) return OnThreads::outcomes(problem, calls, watch);
        cluster::Job job = designs(problem, calls.size());
        job.task = [&](std::size_t i) { return json::array({*calls[i].genome, static_cast<int>(calls[i].level)}); };
        job.take = [&](std::size_t i, const json& j) {
            if (j.is_string())
                *calls[i].answer = ga::reason(j.get<std::string>());
            else if (auto outcome = j.get<rough::DesignOutcome>(); problem.valid_outcome(outcome))
                *calls[i].answer = std::move(outcome);
            else
                cluster::expect_message(false);
        };
        job.stopped = [&] { return watch.expired(); };
        cluster::hand_out(job);
    }
    /// All of them: a search takes an unanswered request for a failure.
    void slopes(const DesignProblem& problem, std::span<ga::Slope<DesignProblem>* const> slopes,
                const ga::Watch& watch) override {
        if (slopes.size() < 2) return OnThreads::slopes(problem, slopes, watch);
        cluster::Job job = designs(problem, slopes.size());
        job.task = [&](std::size_t i) { return json::array({slopes[i]->genome, slopes[i]->objective.text()}); };
        job.take = [&](std::size_t i, const json& j) {
            if (j.is_string()) {
                slopes[i]->failure = ga::reason(j.get<std::string>());
                return;
            }
            const auto residuals = j.at(0).get<Eigen::VectorXd>(), jacobian = j.at(1).get<Eigen::VectorXd>();
            slopes[i]->sensitivity = std::make_shared<const ga::Sensitivity>(
                ga::Sensitivity{residuals, jacobian.reshaped(residuals.size(), Eigen::AutoSize)});
        };
        cluster::hand_out(job);
    }

  private:
    cluster::Job designs(const DesignProblem& problem, std::size_t count) const {
        return {"designs", {problem.verifier().setup(), problem.setup()}, requested_, count, {}, {}};
    }

    int requested_;
};

} // namespace

cluster::Work designs_under(const json& setups) {
    const auto problem = std::make_shared<const DesignProblem>(
        DesignProblem(setups.at(0).get<rough::DesignSetup>()).with(setups.at(1).get<rough::DesignSetup>()));
    return [problem](const json& task) -> json {
        if (task.at(1).is_string()) {
            ga::Slope<DesignProblem> slope;
            slope.genome = task[0].get<rough::Genome>();
            slope.objective = ga::Name(task[1].get<std::string>());
            ga::differentiate(*problem, slope);
            if (!slope.sensitivity) return *slope.failure;
            const auto& [residuals, jacobian] = *slope.sensitivity;
            return {residuals, Eigen::VectorXd(jacobian.reshaped())};
        }
        const int level = task.at(1).get<int>();
        cluster::expect_message(level >= 0 && level < std::ssize(problem->levels()));
        const auto found = ga::evaluated(*problem, task.at(0).get<rough::Genome>(), 0, static_cast<ga::Level>(level));
        const auto* outcome = std::get_if<rough::DesignOutcome>(&found);
        return outcome ? json(*outcome) : json(*std::get<ga::Reason>(found));
    };
}

std::unique_ptr<ga::Evaluator<DesignProblem>> design_evaluator(int threads) {
    if (cluster::is_alone()) return std::make_unique<ga::OnThreads<DesignProblem>>(threads);
    return std::make_unique<OnRanks>(threads);
}

cluster::Work responses_under(const json& setting) {
    const rough::DatabaseSetup setup = rough::setup_from(setting.get<rough::NamedValues>(), "the genome database");
    return [setup](const json& genome) -> json {
        return {genome, rough::response_for(setup, genome.get<std::uint64_t>())};
    };
}

rough::Computing computing_on_ranks(int threads) {
    return [threads](const rough::DatabaseSetup& setup, const rough::Orders& orders) {
        cluster::Job job{"responses", rough::named_values(setup), threads, orders.count, {}, {}, orders.ended};
        job.task = [&](std::size_t) -> std::optional<json> { return orders.next(); };
        job.take = [&](std::size_t, const json& answer) {
            auto found = answer.at(1).get<rough::Response>();
            for (const auto* column : {&found.pressure, &found.contact_fraction, &found.tangent_stiffness})
                cluster::expect_message(column->size() == setup.model.loading.steps);
            orders.take(answer.at(0), std::move(found));
        };
        cluster::hand_out(job);
    };
}

} // namespace app
