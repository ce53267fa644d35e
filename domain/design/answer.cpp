#include "domain/design/search.hpp"

#include <algorithm>

namespace rough {

Answer verified_answer(const DesignSetup& reported, const Genome& genome, Verification verified) {
    DesignSetup setup = reported;
    setup.model.contact.stop = {};
    Answer answer{genome};
    if (std::isnan(verified.worst())) {
        if (verified.on_own.empty()) {
            verified.on_own = pressed(setup, genome, refined(setup.model, 1));
            verified.misfits[0] = misfits_of(setup, scored(setup, verified.on_own));
            verified.similarity = least_similarity(verified.misfits[0]);
        }
        if (setup.max_pressure)
            answer.genome.scale = eq_11(setup, verified.on_own.front());
    } else {
        answer.genome = in_final_form(setup, genome);
    }
    answer.genome = folded(answer.genome);
    answer.similarity = verified.similarity;
    answer.similarity_refined = verified.refined;
    answer.similarity_stepped = verified.stepped;
    answer.similarity_worst = verified.worst();
    answer.within_limits = holds_limits(setup, answer.genome);
    answer.verification = std::move(verified);
    return answer;
}

Answer verified_answer(const DesignSetup& reported, const Genome& genome) {
    return verified_answer(reported, genome, Verifier(reported).of(genome));
}

DesignResponse response_of(const DesignSetup& setup, const Answer& answer) {
    return answer.is_verified() ? respond(setup, answer.genome, setup.model)
                                : scored(setup, answer.verification.on_own);
}

bool holds_limits(const DesignSetup& setup, const Genome& genome) {
    const auto all = margins(genome, setup.model.grid, setup.limits);
    return std::all_of(all.begin(), all.end(), [](const Margin& margin) { return margin.holds(); });
}

} // namespace rough
