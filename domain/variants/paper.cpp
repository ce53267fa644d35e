#include "domain/variants/paper.hpp"

namespace rough {

using namespace ga;

namespace {

/// n_it evaluations of GCMMA in either form.
auto refine_by(Form form, int n_it, const Variables<Genome>& variables) {
    return refine(form == Form::minimax ? minimax(gcmma(n_it)) : ResidualMethod(gcmma(n_it)), variables);
}

} // namespace

PaperPipeline sog(const PaperChoices& choices) { // Algorithm 3
    const auto& [rule, form, reach] = choices;
    const auto dominant = dominant_phases(rule, reach), others = other_phases(rule, reach);
    return score() | best(3) | refine_by(form, 5, dominant) | refine_by(form, 2, others) | best(1);
}

PaperPipeline gco(const PaperChoices& choices) { // Algorithm 4
    const auto& [rule, form, reach] = choices;
    const auto dominant = dominant_phases(rule, reach), others = other_phases(rule, reach);
    const auto U1 = score("low") | above(0.95, at_least(3));
    const auto U2 = score("high") | above(0.95, at_least(3));
    return pair(U1, U2, unite()) | score() | best(3) | refine_by(form, 3, dominant) |
           refine_by(form, 2, others) | best(1);
}

PaperPipeline cco(const PaperChoices& choices) { // Algorithm 5
    const auto& [rule, form, reach] = choices;
    const auto U1 = score("low") | above(0.95, at_least(3)) | reduce(rule);
    const auto U2 = score("high") | above(0.95, at_least(3)) | reduce(rule);
    return pair(U1, U2, unite()) | score() | best(3) | refine_by(form, 3, all_phases(reach)) | best(1);
}

} // namespace rough
