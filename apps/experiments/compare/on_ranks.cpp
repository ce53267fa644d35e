#include "apps/experiments/compare/on_ranks.hpp"

#include "apps/cluster/crew.hpp"
#include "apps/cluster/frame.hpp"
#include "apps/cluster/kinds.hpp"
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
    const auto task = [&](std::size_t place) {
        const CompareRun run = run_of(place);
        return cbor_of(json::array({run.problem, run.pipeline, run.instance, run.seed, run.budget}));
    };
    crew::hand_out({.kind = "races",
                    .setting = cbor_of(roughness ? json(*roughness) : json()),
                    .threads = threads,
                    .count = count,
                    .next = crew::one_after_another(count, task),
                    .take =
                        [&](std::size_t place, const std::string& answer) {
                            const json j = json::from_cbor(answer);
                            take(place, {j.at(0).get<std::vector<double>>(), j.at(1), j.at(2),
                                         j.at(3).get<std::vector<std::pair<long, double>>>()});
                        },
                    .ended = [] { return Interrupt::flag().load(); }});
}

Work races_under(const std::string& setting) {
    const json j = json::from_cbor(setting);
    const auto roughness = j.is_null() ? std::nullopt : std::optional(j.get<rough::DesignSetup>());
    return [roughness](const std::string& task) {
        const json r = json::from_cbor(task);
        const CompareRun race{r.at(0), r.at(1), r.at(2), r.at(3), r.at(4)};
        const Reached reached = raced(benchmarks({race.problem}, roughness).front(), race);
        return cbor_of(json::array({reached.evaluations, reached.precision, reached.spent, reached.found}));
    };
}

} // namespace app
