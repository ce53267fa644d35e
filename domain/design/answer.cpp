#include "domain/design/search.hpp"

#include <algorithm>

namespace rough {

Answer judged_answer(const DesignSetup& reported, const Genome& genome, Judgement judged) {
    DesignSetup setup = reported;
    setup.model.contact.stop = {};
    Answer answer{genome};
    if (std::isnan(judged.worst())) {
        if (judged.on_own.empty()) {
            judged.on_own = pressed(setup, genome, refined(setup.model, 1));
            judged.misfits[0] = misfits_of(setup, scored(setup, judged.on_own));
            judged.similarity = least_similarity(judged.misfits[0]);
        }
        if (setup.max_pressure)
            answer.genome.scale = eq_11(setup, judged.on_own.front());
    } else {
        answer.genome = in_final_form(setup, genome);
    }
    answer.genome = folded(answer.genome);
    answer.similarity = judged.similarity;
    answer.similarity_refined = judged.refined;
    answer.similarity_stepped = judged.stepped;
    answer.similarity_worst = judged.worst();
    answer.within_limits = holds_limits(setup, answer.genome);
    answer.judgement = std::move(judged);
    return answer;
}

Answer judged_answer(const DesignSetup& reported, const Genome& genome) {
    return judged_answer(reported, genome, Judge(reported).of(genome));
}

DesignResponse response_of(const DesignSetup& setup, const Answer& answer) {
    return answer.is_judged() ? respond(setup, answer.genome, setup.model)
                              : scored(setup, answer.judgement.on_own);
}

bool holds_limits(const DesignSetup& setup, const Genome& genome) {
    const auto all = margins(genome, setup.model.grid, setup.limits);
    return std::all_of(all.begin(), all.end(), [](const Margin& margin) { return margin.holds(); });
}

} // namespace rough
