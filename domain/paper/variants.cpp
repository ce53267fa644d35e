#include "domain/paper/variants.hpp"

#include "ga/text/whole_vocabulary.hpp"

namespace rough {

using namespace ga;

namespace {

/// Maximises s|s| with s = 1 - max_k |r_k| by the globally convergent method of moving asymptotes (Svanberg
/// 2002; NLopt's LD_MMA). The paper's form is s^2, which would reward worse fits for s < 0. If several rows
/// attain the maximum, the gradient is that of the first.
struct Gcmma {
    static constexpr bool on_residuals = true; ///< and their derivatives

    int evaluations = 1; ///< maximum after the start, >= 1; inner iterations count

    static Words words() { return {"gcmma", "refinement", "GCMMA on s|s|, s = 1 - max|r|: the paper's"}; }
    static void describe(auto& self, auto visit) { visit(self.evaluations, evaluations_parameter()); }
    Eigen::VectorXd improve(const Landscape& land) const {
        return maximised_by_mma(land, evaluations, [](const Eigen::VectorXd& residuals) -> Reading {
            Eigen::Index worst = 0;
            const double s = 1 - residuals.cwiseAbs().maxCoeff(&worst);
            const double sign = residuals[worst] < 0 ? -1 : 1;
            return {s * std::abs(s), s, {{worst, -2 * std::abs(s) * sign}}};
        });
    }
};

/// Refinement with n_it evaluations in either form.
auto refine_by(Form form, int n_it, const Variables<Genome>& variables) {
    return refine(form == Form::minimax ? minimax(n_it) : method_of(Gcmma{n_it}), variables);
}

/// The phases of the dominant chromosomes, or of all others.
Variables<Genome> phases_where(const char* name, const Vocabulary& words, bool dominant) {
    return {name, [rule = words.rule, reach = words.reach, dominant](const Genome& genome) {
                const Dominance dominance = (*rule)(genome);
                return phase_variables(genome, reach, [&](std::size_t s, std::size_t c) {
                    return dominance.at(s, c) == dominant;
                });
            }};
}
Variables<Genome> dominant_phases(const Vocabulary& words) { return phases_where("dominant", words, true); }
Variables<Genome> other_phases(const Vocabulary& words) { return phases_where("others", words, false); }
Variables<Genome> all_phases(const Vocabulary& words) {
    return {"phases", [reach = words.reach](const Genome& genome) { return phase_variables(genome, reach); }};
}

/// Keeps only a genome's dominant chromosomes, at the same scale.
auto reduce_dominant(const Vocabulary& words) {
    return transform("reduce dominant",
                     [rule = words.rule](const Genome& genome) { return reduced(genome, (*rule)(genome)); });
}

/// The sum of two parents at their scored scales, because their relative amplitude matters.
Combine<Genome> unite(const Vocabulary& words) {
    return {"unite",
            [fitted = words.fitted](const Individual<Genome>& left, const Individual<Genome>& right) {
                const Genome both = sum(left.genome, right.genome);
                return std::optional(fitted ? fitted(both) : both);
            }};
}

/// The genomes that are good at low or at high pressure, at least three.
auto good_at(const char* half) { return score(half) | above(0.95, at_least(3)); }

} // namespace

DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold, PhaseReach reach) {
    return {.model = std::move(model),
            .targets = {std::move(target)},
            .max_pressure = max_pressure,
            .threshold = threshold,
            .phases = reach};
}

Pipeline sog(const Vocabulary& words, Form form) { // Algorithm 3
    return score() | best(3) | refine_by(form, 5, dominant_phases(words)) |
           refine_by(form, 2, other_phases(words)) | best(1);
}

Pipeline gco(const Vocabulary& words, Form form) { // Algorithm 4
    return pair(good_at("low"), good_at("high"), unite(words)) | score() | best(3) |
           refine_by(form, 3, dominant_phases(words)) | refine_by(form, 2, other_phases(words)) | best(1);
}

Pipeline cco(const Vocabulary& words, Form form) { // Algorithm 5
    return pair(good_at("low") | reduce_dominant(words), good_at("high") | reduce_dominant(words),
                unite(words)) |
           score() | best(3) | refine_by(form, 3, all_phases(words)) | best(1);
}

Pipeline cco_of_sums(const Vocabulary& words) {
    return pair(good_at("low"), good_at("high"), unite(words)) | reduce_dominant(words) | score() | best(3) |
           refine_by(Form::paper, 3, all_phases(words)) | best(1);
}

Registry<DesignProblem> paper_registry(const Vocabulary& words) {
    auto registry = whole_vocabulary<DesignProblem>();
    add_method<Gcmma>(registry);
    registry.add("reduce dominant", "roughness", "keeps each genome's dominant chromosomes (Algorithm 1)",
                 reduce_dominant(words));
    registry.add(unite(words), "the sum of two genomes, each at its scored scale");
    registry.add(dominant_phases(words), "phases of the dominant chromosomes (Algorithm 1)");
    registry.add(other_phases(words), "phases of the other chromosomes");
    registry.add(all_phases(words), "phases of all chromosomes");
    return registry;
}

Variants paper_variants() {
    const Vocabulary words;
    Variants variants;
    for (const auto& [name, algorithm] :
         {std::pair("sog", &sog), std::pair("gco", &gco), std::pair("cco", &cco)}) {
        variants[name] = algorithm(words, Form::paper).text();
        variants[std::string(name) + "-minimax"] = algorithm(words, Form::minimax).text();
    }
    return variants;
}

} // namespace rough

GA_PIPELINES_HERE(rough::DesignProblem)
