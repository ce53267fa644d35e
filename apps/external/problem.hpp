#pragma once

#include "apps/external/genes.hpp"
#include "apps/external/solution.hpp"
#include "ga/text/compiled_once.hpp"

namespace app {

/// Bits or a permutation as a JSON array, "[0,1]".
template <class G>
std::string genes_text(const G& genome) {
    std::string text;
    for (const auto gene : genome) text += (text.empty() ? "[" : ",") + ga::number(static_cast<double>(gene));
    return text + "]";
}

/// A problem that draws genomes. An evaluator makes its evaluations, if it has no function `answer`.
template <class G>
struct OutsideProblem {
    using Genome = G;
    using Outcome = Evaluation;

    std::size_t count;                           ///< number of genes
    std::vector<ga::Variable> range;             ///< bounds of real genes
    std::vector<ga::Objective<Evaluation>> list; ///< f1, f2, ..., then those of each further level: f1-fine, ...
    Genes genes = {};                            ///< kinds of the genes
    std::vector<ga::LevelPrice> prices = {{}};   ///< levels of evaluation
    std::size_t objectives_per_level = 1;        ///< number of objectives of one answer
    /// Derivatives of the first objective of a level with respect to real genes; empty if they are unknown.
    std::function<std::vector<double>(const G&, const std::string& level)> slopes = {};
    std::function<Evaluation(const G&)> answer = {}; ///< makes an evaluation; empty if an evaluator does

    OutsideProblem(std::size_t genes, std::vector<ga::Variable> range_of_reals, const std::vector<bool>& minimise)
        : count(genes), range(std::move(range_of_reals)), objectives_per_level(minimise.size()) {
        const auto names = objective_names(minimise.size());
        for (std::size_t k = 0; k < names.size(); ++k)
            list.push_back({names[k], [k](const Evaluation& answer) { return answer.objectives.at(k); }, minimise[k]});
    }
    OutsideProblem(const OutsideSearch& search, const std::vector<bool>& minimise)
        : OutsideProblem(search.genes.count, range_of(search.genes), minimise) {
        genes = search.genes;
        prices = levels_from(search.levels);
        for (std::size_t level = 1; level < prices.size(); ++level)
            for (std::size_t k = 0; k < minimise.size(); ++k) {
                list.push_back(list[k]);
                list.back().name += "-" + prices[level].name;
                list.back().level = static_cast<ga::Level>(level);
            }
    }

    Evaluation evaluate(const G& genome) const { return answer(genome); }
    Evaluation evaluate(const G& genome, ga::Level) const { return answer(genome); }
    const std::vector<ga::LevelPrice>& levels() const { return prices; }
    const std::string& name_of(ga::Level level) const { return prices.at(static_cast<std::size_t>(level)).name; }
    const std::vector<ga::Objective<Evaluation>>& objectives() const { return list; }
    /// Genomes that are rounded to the same numbers have one key.
    std::string key(const G& genome) const requires std::same_as<G, std::vector<double>> {
        const std::vector<double> values = rounded(genes, genome);
        return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
    }
    /// The genes as a JSON array.
    std::string text_of(const G& genome) const {
        if constexpr (std::same_as<G, std::vector<double>>)
            return genes_text(genes, genome);
        else
            return genes_text(genome);
    }
    bool valid(const G& genome) const {
        if constexpr (std::same_as<G, std::vector<double>>)
            if (!std::ranges::all_of(genome, [](double gene) { return std::isfinite(gene); })) return false;
        return genome.size() == count;
    }
    bool valid_outcome(const Evaluation& answer) const { return is_valid(answer, objectives_per_level); }
    const std::vector<double>& violation(const Evaluation& answer) const { return answer.violation; }
    std::size_t bytes(const Evaluation& answer) const {
        return (answer.objectives.size() + answer.violation.size()) * sizeof(double);
    }
    const std::vector<ga::Variable>& bounds(const G&) const requires std::same_as<G, std::vector<double>> {
        return range;
    }
    bool has_gradient() const { return static_cast<bool>(slopes); }
    std::vector<double> gradient(const G& genome,
                                 const std::string& objective) const requires std::same_as<G, std::vector<double>> {
        const auto level = std::ranges::find(list, objective, &ga::Objective<Evaluation>::name)->level;
        return slopes(genome, name_of(level));
    }
    G sample(ga::Stream& stream) const {
        if constexpr (std::same_as<G, ga::Permutation>) {
            return ga::Permutation::random(count, stream);
        } else {
            G genome(count);
            for (std::size_t i = 0; i < count; ++i)
                if constexpr (std::same_as<G, std::vector<bool>>)
                    genome[i] = stream.chance(0.5);
                else
                    genome[i] = stream.uniform(range[i].lower, range[i].upper);
            return genome;
        }
    }
};

} // namespace app

namespace ga {
template <Problem P>
Registry<P> whole_vocabulary(); // text/whole_vocabulary.hpp, which brings Eigen and NLopt
}

namespace app {

/// Calls with a genome of the type that the genes have.
template <class Call>
auto by_kind(const Genes& genes, Call call) {
    return genes.kind == Genes::Kind::numbers ? call(std::vector<double>())
           : genes.kind == Genes::Kind::bits  ? call(std::vector<bool>())
                                              : call(ga::Permutation());
}

/// The name of the level whose solutions a record contains.
inline std::string level_of(const OutsideSearch& search, const BestKnown& record) {
    const auto levels = levels_from(search.levels);
    return levels[std::min(record.level(), levels.size() - 1)].name; // a checkpoint may be forged
}

/// The variant of a search: the given one, "pipeline" for a text, or the default for the objectives.
inline std::string variant_of(const OutsideSearch& search, std::size_t objectives) {
    return !search.variant.empty()    ? search.variant
           : !search.pipeline.empty() ? "pipeline"
           : objectives > 1           ? "nsga2"
                                      : "ga";
}

/// The pipeline of a search, parsed with the words of `registry`. Throws ga::UsageError if it cannot work.
template <class P>
ga::Pipeline<P> stage_of(const OutsideSearch& search, std::size_t objectives,
                         ga::Registry<P> registry = ga::whole_vocabulary<P>()) {
    ga::Parser<P> parser(std::move(registry), outside_variants(search.genes, objectives));
    return search.pipeline.empty() ? parser.variant(variant_of(search, objectives)) : parser.parse(search.pipeline);
}

/// The population that a search begins with, and the pipeline that runs on it. With given genomes, a leading
/// `sample` is left out, and the population has as many individuals as it would draw.
template <class G>
std::pair<ga::Population<G>, ga::Pipeline<OutsideProblem<G>>>
begun(const OutsideSearch& search, const OutsideProblem<G>& problem, ga::Pipeline<OutsideProblem<G>> stage,
      ga::Registry<OutsideProblem<G>> registry = ga::whole_vocabulary<OutsideProblem<G>>()) {
    std::vector<G> genomes;
    for (const std::vector<double>& given : search.start) {
        G genome;
        for (const double gene : given)
            ga::places(genome).push_back(
                static_cast<std::ranges::range_value_t<std::decay_t<decltype(ga::places(genome))>>>(gene));
        genomes.push_back(std::move(genome));
    }
    if (const std::string text = stage.text(); !genomes.empty() && leading_sample(text) > 0) {
        for (std::size_t i = genomes.size(); i < leading_sample(text); ++i) {
            ga::Stream stream(ga::fold(ga::fold(search.seed, "start"), i));
            genomes.push_back(problem.sample(stream));
        }
        stage = ga::Parser<OutsideProblem<G>>(std::move(registry))
                    .parse(text.substr(std::min(text.find('|'), text.size() - 1) + 1));
    }
    return {ga::population(std::move(genomes)), std::move(stage)};
}

} // namespace app

GA_PIPELINES_ELSEWHERE(app::OutsideProblem<std::vector<double>>)
GA_PIPELINES_ELSEWHERE(app::OutsideProblem<std::vector<bool>>)
GA_PIPELINES_ELSEWHERE(app::OutsideProblem<ga::Permutation>)
