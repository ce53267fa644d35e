#include "apps/experiments/compare/on_ranks.hpp"

#include "apps/prompt/interrupt.hpp"
#include "domain/problem/stored.hpp"

namespace app {

using nlohmann::json;

Reached raced(const Benchmark& problem, const CompareRun& race) {
    return problem.run(race.pipeline, race.instance, {race.seed, race.budget, &Interrupt::flag()});
}

void race_on_ranks(const std::optional<rough::DesignSetup>& roughness, int threads, std::size_t count,
                   const std::function<CompareRun(std::size_t)>& run_of,
                   const std::function<void(std::size_t, Reached)>& take) {
    cluster::hand_out(
        {.kind = "races",
         .setting = roughness ? json(*roughness) : json(),
         .threads = threads,
         .count = count,
         .task =
             [&](std::size_t i) {
                 const CompareRun run = run_of(i);
                 return json::array({run.problem, run.pipeline, run.instance, run.seed, run.budget});
             },
         .take =
             [&](std::size_t i, const json& j) {
                 take(i, {j.at(0).get<std::vector<double>>(), j.at(1), j.at(2),
                          j.at(3).get<std::vector<std::pair<long, double>>>()});
             },
         .stopped = [] { return Interrupt::flag().load(); }});
}

cluster::Work races_under(const json& setting) {
    const auto roughness =
        setting.is_null() ? std::nullopt : std::optional(setting.get<rough::DesignSetup>());
    return [roughness](const json& r) {
        const CompareRun race{r.at(0), r.at(1), r.at(2), r.at(3), r.at(4)};
        const Reached reached = raced(benchmarks({race.problem}, roughness).front(), race);
        return json::array({reached.evaluations, reached.precision, reached.spent, reached.found});
    };
}

} // namespace app
