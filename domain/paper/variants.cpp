#include "domain/paper/variants.hpp"

namespace rough {

using namespace ga;

namespace {

/// n_it evaluations of GCMMA in either form.
auto refine_by(Form form, int n_it, const ga::Variables<Genome>& variables) {
    return refine(form == Form::minimax ? minimax(n_it) : gcmma(n_it), variables);
}

} // namespace

DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold, PhaseReach reach) {
    DesignSetup setup;
    setup.model = std::move(model);
    setup.targets = {std::move(target)};
    setup.max_pressure = max_pressure;
    setup.threshold = threshold;
    setup.phases = reach;
    return setup;
}

Pipeline sog(const Vocabulary& words, Form form) { // Algorithm 3
    const auto dominant = words.dominant(), others = words.others();
    return score() | best(3) | refine_by(form, 5, dominant) | refine_by(form, 2, others) | best(1);
}

Pipeline gco(const Vocabulary& words, Form form) { // Algorithm 4
    const auto dominant = words.dominant(), others = words.others();
    const auto U1 = score("low") | above(0.95, at_least(3));
    const auto U2 = score("high") | above(0.95, at_least(3));
    return pair(U1, U2, words.unite()) | score() | best(3) | refine_by(form, 3, dominant) |
           refine_by(form, 2, others) | best(1);
}

Pipeline cco(const Vocabulary& words, Form form) { // Algorithm 5
    const auto U1 = score("low") | above(0.95, at_least(3)) | words.reduce_dominant();
    const auto U2 = score("high") | above(0.95, at_least(3)) | words.reduce_dominant();
    return pair(U1, U2, words.unite()) | score() | best(3) | refine_by(form, 3, words.phases()) | best(1);
}

Pipeline cco_of_sums(const Vocabulary& words) {
    const auto U1 = score("low") | above(0.95, at_least(3));
    const auto U2 = score("high") | above(0.95, at_least(3));
    return pair(U1, U2, words.unite()) | words.reduce_dominant() | score() | best(3) |
           refine(gcmma(3), words.phases()) | best(1);
}

Registry<DesignProblem> paper_registry(const Vocabulary& words) {
    auto registry = engine_words();
    add_words(registry, words);
    return registry;
}

Pipeline paper_pipeline(const Vocabulary& words, const ga::Variants& variants, const std::string& name) {
    return Parser<DesignProblem>(paper_registry(words), variants).variant(name);
}

ga::Variants paper_variants(const Vocabulary& words) {
    ga::Variants variants;
    for (const auto& [name, algorithm] :
         {std::pair("sog", &sog), std::pair("gco", &gco), std::pair("cco", &cco)}) {
        variants[name] = algorithm(words, Form::paper).text();
        variants[std::string(name) + "-minimax"] = algorithm(words, Form::minimax).text();
    }
    return variants;
}

} // namespace rough
