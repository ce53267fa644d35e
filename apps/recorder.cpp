#include "apps/recorder.hpp"

#include <algorithm>
#include <limits>

namespace app {

ga::Observer<rough::Genome> recorder(std::vector<StageRecord>& stages) {
    return [&stages](const ga::Event<rough::Genome>& event) {
        StageRecord record{event.path, {}};
        for (const auto& individual : event.population) {
            const bool scored = individual.fitness.known() && individual.fitness.objective() == "similarity";
            record.candidates.push_back(
                {individual.identity,
                 {individual.parents.begin(), individual.parents.end()},
                 scored ? individual.value() : std::numeric_limits<double>::quiet_NaN()});
        }
        stages.push_back(std::move(record));
    };
}

const StageRecord* stage_at(const std::vector<StageRecord>& stages, const std::string& path) {
    const auto found = std::find_if(stages.begin(), stages.end(),
                                    [&](const StageRecord& stage) { return stage.path == path; });
    return found == stages.end() ? nullptr : &*found;
}

} // namespace app
