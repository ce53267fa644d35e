#include "apps/cluster/evaluator.hpp"

#include "domain/problem/stored.hpp"

namespace app {

using nlohmann::json;

namespace {

using rough::DesignOutcome;
using rough::DesignProblem;
using rough::Genome;

json json_of(const ga::Slope<DesignProblem>& slope) {
    if (!slope.sensitivity)
        return slope.failure ? json(*slope.failure) : json();
    return json::array(
        {slope.sensitivity->residuals, Eigen::VectorXd(slope.sensitivity->jacobian.reshaped())});
}
void take(const json& j, ga::Slope<DesignProblem>& slope) {
    if (j.is_string()) {
        slope.failure = ga::reason(j.get<std::string>());
    } else if (!j.is_null()) {
        const auto residuals = j.at(0).get<Eigen::VectorXd>(), jacobian = j.at(1).get<Eigen::VectorXd>();
        const auto columns = static_cast<Eigen::Index>(genes(slope.genome).size());
        cluster::expect_message(jacobian.size() == residuals.size() * columns);
        slope.sensitivity = std::make_shared<const ga::Sensitivity>(
            ga::Sensitivity{residuals, jacobian.reshaped(residuals.size(), columns)});
    }
}

class OnRanks : public ga::OnThreads<DesignProblem> {
  public:
    explicit OnRanks(int threads) : OnThreads(threads), requested_(threads) {}

    void outcomes(const DesignProblem& problem, std::span<ga::Call<DesignProblem>> calls,
                  const ga::Watch& watch) override {
        if (problem.shares_memory() || calls.size() < 2)
            return OnThreads::outcomes(problem, calls, watch);
        cluster::Job job = designs(problem, calls.size());
        job.task = [&](std::size_t i) { return json::array({*calls[i].genome}); };
        job.take = [&](std::size_t i, const json& j) {
            if (j.is_string()) {
                *calls[i].answer = ga::reason(j.get<std::string>());
                return;
            }
            auto outcome = j.get<DesignOutcome>();
            cluster::expect_message(problem.valid_outcome(outcome));
            *calls[i].answer = std::move(outcome);
        };
        job.stopped = [&] { return watch.expired(); };
        cluster::hand_out(job);
    }
    /// All of them: a search takes an unanswered request for a failure.
    void slopes(const DesignProblem& problem, std::span<ga::Slope<DesignProblem>* const> slopes,
                const ga::Watch& watch) override {
        if (slopes.size() < 2)
            return OnThreads::slopes(problem, slopes, watch);
        cluster::Job job = designs(problem, slopes.size());
        job.task = [&](std::size_t i) {
            return json::array({slopes[i]->genome, slopes[i]->objective.text()});
        };
        job.take = [&](std::size_t i, const json& j) { app::take(j, *slopes[i]); };
        cluster::hand_out(job);
    }

  private:
    cluster::Job designs(const DesignProblem& problem, std::size_t count) const {
        return {"designs", problem.setup(), requested_, count, {}, {}};
    }

    int requested_;
};

} // namespace

cluster::Work designs_under(const json& setup) {
    const auto problem = std::make_shared<const DesignProblem>(setup.get<rough::DesignSetup>());
    return [problem](const json& task) {
        if (task.size() > 1) {
            ga::Slope<DesignProblem> slope;
            slope.genome = task[0].get<Genome>();
            slope.objective = ga::Name(task[1].get<std::string>());
            ga::differentiate(*problem, slope);
            return json_of(slope);
        }
        const auto found = ga::evaluated(*problem, task.at(0).get<Genome>());
        const DesignOutcome* outcome = std::get_if<DesignOutcome>(&found);
        return outcome ? json(*outcome) : json(*std::get<ga::Reason>(found));
    };
}

std::unique_ptr<ga::Evaluator<DesignProblem>> design_evaluator(int threads) {
    if (cluster::is_alone())
        return std::make_unique<ga::OnThreads<DesignProblem>>(threads);
    return std::make_unique<OnRanks>(threads);
}

cluster::Work responses_under(const nlohmann::json& setting) {
    const rough::DatabaseSetup setup = rough::setup_from(setting.get<rough::Fields>(), "the genome database");
    return [setup](const nlohmann::json& genome) {
        const rough::Response response = rough::response_for(setup, genome.get<std::uint64_t>());
        return json::array({genome, response.range, response.pressure, response.contact_fraction,
                            response.tangent_stiffness});
    };
}

rough::Computing computing_on_ranks(int threads) {
    return [threads](const rough::DatabaseSetup& setup, const rough::Orders& orders) {
        cluster::hand_out({.kind = "responses",
                           .setting = rough::fields(setup),
                           .threads = threads,
                           .count = orders.count,
                           .task = [&](std::size_t) -> std::optional<json> {
                               const auto genome = orders.next();
                               return genome ? std::optional<json>(*genome) : std::nullopt;
                           },
                           .take =
                               [&](std::size_t, const json& answer) {
                                   rough::Response response;
                                   response.range = answer.at(1);
                                   answer.at(2).get_to(response.pressure);
                                   answer.at(3).get_to(response.contact_fraction);
                                   answer.at(4).get_to(response.tangent_stiffness);
                                   for (const auto* column : {&response.pressure, &response.contact_fraction,
                                                              &response.tangent_stiffness})
                                       cluster::expect_message(column->size() == setup.model.loading.steps);
                                   orders.take(answer.at(0), std::move(response));
                               },
                           .stopped = orders.ended});
    };
}

} // namespace app
