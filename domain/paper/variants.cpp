#include "domain/paper/variants.hpp"

#include "domain/text/words.hpp"
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
        return maximised_by_mma(land, evaluations, [](const Eigen::VectorXd& residuals) -> ResidualMerit {
            Eigen::Index worst = 0;
            const double s = 1 - residuals.cwiseAbs().maxCoeff(&worst);
            const double sign = residuals[worst] < 0 ? -1 : 1;
            return {s * std::abs(s), s, {{worst, -2 * std::abs(s) * sign}}};
        });
    }
};

/// The phases of the dominant chromosomes, or of all others.
Variables<Genome> phases_where(const char* name, const Vocabulary& words, bool dominant) {
    return {name, [rule = words.rule, reach = words.reach, dominant](const Genome& genome, Work& work) {
                const Dominance dominance = (*rule)(genome);
                work.price += dominance.price;
                return phase_variables(genome, reach,
                                       [&](std::size_t s, std::size_t c) { return dominance.at(s, c) == dominant; });
            }};
}

} // namespace

DesignSetup paper_setup(Model model, Target target, double max_pressure, double threshold, PhaseReach reach) {
    return {.model = std::move(model),
            .targets = {std::move(target)},
            .max_pressure = max_pressure,
            .threshold = threshold,
            .phases = reach};
}

Registry<DesignProblem> paper_registry(const Vocabulary& words) {
    auto registry = whole_vocabulary<DesignProblem>();
    add_method<Gcmma>(registry);
    registry.add("reduce dominant", "roughness", "keeps each genome's dominant chromosomes (Algorithm 1)",
                 transform("reduce dominant", [rule = words.rule](const Genome& genome, Work& work) {
                     const Dominance dominance = (*rule)(genome);
                     work.price += dominance.price;
                     return reduced(genome, dominance); // at the same scale
                 }));
    // At their scored scales, because the relative amplitude of the parents matters.
    registry.add(Combine<Genome>{"unite",
                                 [fitted = words.fitted](const auto& left, const auto& right, Work& work) {
                                     const Genome both = sum(left.genome, right.genome);
                                     return std::optional(fitted ? fitted(both, work) : both);
                                 }},
                 "the sum of two genomes, each at its scored scale");
    registry.add(phases_where("dominant", words, true), "phases of the dominant chromosomes (Algorithm 1)");
    registry.add(phases_where("others", words, false), "phases of the other chromosomes");
    registry.add(Variables<Genome>{"phases", [reach = words.reach](
                                                 const Genome& genome) { return phase_variables(genome, reach); }},
                 "phases of all chromosomes");
    return registry;
}

Variants variants_in(const std::string& ini) {
    Variants variants;
    std::string name;
    std::istringstream lines(ini);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(' '))
            variants.at(name).append(" ").append(trim(line));
        else if (const std::size_t equals = line.find(" = "); !line.starts_with('#') && equals != line.npos) {
            name = line.substr(0, equals);
            variants[name] = line.substr(equals + 3);
        }
    return variants;
}

extern const char* const paper_variants_ini; // variants.ini (.cmake/data.cmake)

Variants paper_variants() { return variants_in(paper_variants_ini); }

} // namespace rough

GA_PIPELINES_HERE(rough::DesignProblem)
