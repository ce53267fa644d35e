#include "apps/report/record.hpp"

#include <algorithm>
#include <limits>

namespace app {

ga::Observer<rough::Genome> recorder(std::vector<StageRecord>& stages) {
    return [&stages, counted = std::size_t{0},
            candidates = std::size_t{0}](const ga::Event<rough::Genome>& event) mutable {
        StageRecord record{event.path, {}, event.counters.evaluations + event.counters.gradients};
        for (const auto& individual : event.population) {
            const bool scored = individual.fitness.known() && individual.fitness.objective() == "similarity";
            record.candidates.push_back(
                {individual.identity,
                 {individual.parents.begin(), individual.parents.end()},
                 scored ? individual.value() : std::numeric_limits<double>::quiet_NaN()});
        }
        for (; counted < stages.size(); ++counted) // one more, or those of a run that is gone on with
            candidates += stages[counted].candidates.size();
        const auto last = candidates < most_candidates
                              ? stages.rend()
                              : std::find_if(stages.rbegin(), stages.rend(), [&](const StageRecord& each) {
                                    return each.path == event.path;
                                });
        if (last == stages.rend())
            stages.push_back(std::move(record));
        else
            *last = std::move(record);
    };
}

const StageRecord* stage_at(const std::vector<StageRecord>& stages, const std::string& path) {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageRecord& stage) { return stage.path == path; });
    return found == stages.end() ? nullptr : &*found;
}

} // namespace app
