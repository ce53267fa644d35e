#pragma once

#include "ga/refinement/landscape.hpp"
#include "ga/variation/mutate.hpp"

namespace ga {

/// The problem's descriptors of these names, in their order. Throws UsageError on an unknown one.
template <Describing P>
std::vector<const Descriptor<typename P::Genome>*>
descriptors_of(const P& problem, const std::vector<std::string>& names, const std::string& stage) {
    std::vector<const Descriptor<typename P::Genome>*> found;
    for (const std::string& name : names) {
        std::string list;
        for (const auto& each : problem.descriptors()) {
            if (each.name == name) found.push_back(&each);
            list += (list.empty() ? "" : ", ") + each.name;
        }
        if (found.empty() || found.back()->name != name)
            throw UsageError("stage '" + stage + "': unknown descriptor '" + name + "'; use one of " + list);
    }
    return found;
}

/// MAP-Elites (Mouret and Clune 2015, Illuminating search spaces by mapping elites). The range of each
/// descriptor is divided into `cells` cells; values beyond it belong to the outermost ones. The best
/// individual of every cell stays, from the generation's start and the population. These are the archive.
struct MapElites : Operator {
    std::vector<std::string> descriptors; ///< names of at least one of the problem's descriptors
    std::size_t cells = 10;               ///< number of cells per descriptor, >= 1

    static constexpr const char* needs = "features of its genomes: descriptors";
    static Words words() {
        return {"map-elites", "niches", "the best in every cell of the descriptors' ranges, the start included"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.descriptors, word_list("descriptors", "names of the problem's descriptors"));
        visit(self.cells, whole("cells", 1, "per descriptor").up_to(1e6).keyed().quiet());
    }
    std::size_t reads_of_start() const { return all_individuals; }
    void check(CheckState& known) const {
        known.need_comparable_start(text_of(*this));
        known.need_one_objective(text_of(*this));
    }

    template <Describing P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context) const {
        const auto by = descriptors_of(context.problem(), descriptors, text_of(*this));
        PopulationOf<P> all = joined_with(context.generation_start(), std::move(population));
        std::vector<std::vector<std::size_t>> cell(all.size());
        parallel_for(all.size(), context.threads(), [&](std::size_t i) {
            for (const auto* descriptor : by) {
                const double share =
                    (descriptor->of(all[i].genome) - descriptor->lower) / (descriptor->upper - descriptor->lower);
                if (std::isnan(share)) return;
                cell[i].push_back(static_cast<std::size_t>(
                    std::clamp(share * static_cast<double>(cells), 0.0, static_cast<double>(cells) - 1)));
            }
        });
        std::map<std::vector<std::size_t>, std::size_t> elites;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (cell[i].size() != by.size() || all[i].fitness.has_failed()) continue;
            const auto [held, fresh] = elites.try_emplace(cell[i], i);
            if (!fresh && better(all[i].fitness, all[held->second].fitness)) held->second = i;
        }
        PopulationOf<P> archive;
        for (const auto& [place, i] : elites) archive.push_back(std::move(all[i]));
        if (archive.empty())
            context.end_with(all, "no individual has descriptors that are numbers; return finite descriptors");
        return archive;
    }
};

/// The stage `map-elites descriptors cells=cells`.
inline MapElites map_elites(std::vector<std::string> descriptors, std::size_t cells = 10) {
    return checked(MapElites{{}, std::move(descriptors), cells});
}

/// The gradient emitter OMG-MEGA (Fontaine and Nikolaidis 2021, Differentiable quality diversity, Algorithm
/// 1). It makes n children of random elites. Let theta be the genes of an elite, and m_j the descriptors. f
/// is minus the sum of squared residuals, or the fitness if the problem only has `gradient`. c_0 and c_j are
/// normal random numbers with the standard deviation sigma. The child has the genes
///
///     theta + |c_0| grad f + sum_j c_j grad m_j.
///
/// Gradients are scaled to unit length. Genes are divided by the distance between their bounds, and reflected
/// at the bounds. A derivative of f counts as an evaluation.
struct Emit : Operator {
    std::size_t n;                        ///< number of children
    std::vector<std::string> descriptors; ///< names of at least one of the problem's descriptors
    double sigma = 0.1;                   ///< length of a step, > 0

    static constexpr const char* needs = MapElites::needs;
    static Words words() {
        return {"emit", "niches", "n children of elites along the gradients of fitness and descriptors"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.n, whole("n", std::nullopt, 1, "number of children"));
        visit(self.descriptors, word_list("descriptors", "names of the problem's descriptors"));
        visit(self.sigma, number("sigma", above_zero, no_limit, "length of a step, in widths").keyed());
    }
    void check(CheckState& known) const {
        known.need_one_objective(text_of(*this));
        known.scored.reset();
    }

    template <Problem P>
    requires Describing<P> && HasGenes<P> PopulationOf<P>
    operator()(PopulationOf<P> population, Context<P>& context) const {
        using G = typename P::Genome;
        const P& problem = context.problem();
        const auto by = descriptors_of(problem, descriptors, text_of(*this));
        if (population.empty()) return population;
        context.need_room(n, population);
        std::vector<std::size_t> chosen(n);
        for (std::size_t i = 0; i < n; ++i) {
            Stream stream = context.stream(i);
            chosen[i] = stream.below(population.size());
        }
        std::vector<std::vector<double>> slopes;
        try {
            slopes = slopes_of(population, chosen, context);
            if (context.watch().expired()) // some slopes may be missing
                throw Stopped{context.watch().reason()};
        } catch (const Stopped&) {
            context.state.stopped_population = std::move(population);
            throw;
        }
        Population<G> fresh = context.gather(std::move(population), chosen);
        std::vector<std::vector<double>> moved(n);
        parallel_for(n, context.threads(), [&](std::size_t i) {
            Stream stream = context.stream(n + i);
            std::vector<double> genes = genes_of(problem, fresh[i].genome);
            const auto& moving = variables_of(problem, fresh[i].genome);
            std::vector<double> step(genes.size(), 0);
            const auto add = [&](std::vector<double> gradient, double length) {
                double squares = 0;
                for (const Variable& v : moving)
                    if (v.gene < gradient.size()) squares += std::pow(gradient[v.gene] * width(v), 2);
                if (!(squares > 0) || !std::isfinite(squares)) return;
                for (const Variable& v : moving) // unit gradient, converted to the gene's unit
                    if (v.gene < gradient.size())
                        step[v.gene] += length * gradient[v.gene] * width(v) * width(v) / std::sqrt(squares);
            };
            add(slopes[i], sigma * std::abs(stream.normal()));
            for (const auto* descriptor : by)
                add(gradient_of(problem, *descriptor, fresh[i].genome, genes, moving), sigma * stream.normal());
            for (const Variable& v : moving)
                if (v.gene < genes.size()) genes[v.gene] = reflected(genes[v.gene] + step[v.gene], v);
            moved[i] = std::move(genes);
        });
        for (std::size_t i = 0; i < n; ++i) {
            const Identity parent = fresh[i].identity;
            fresh[i].genome = with_genes(problem, fresh[i].genome, std::move(moved[i]));
            context.make_child(fresh[i], Parents(parent));
        }
        return fresh;
    }

  private:
    /// The direction in which each chosen individual improves; empty if it is unknown.
    template <Problem P>
    static std::vector<std::vector<double>> slopes_of(const PopulationOf<P>& population,
                                                      const std::vector<std::size_t>& chosen, Context<P>& context) {
        std::vector<std::vector<double>> all(chosen.size());
        if (Sensitive<P> || has_gradient(context.problem())) {
            std::vector<Slope<P>> slopes;
            for (const std::size_t i : chosen) {
                const auto& each = population[i];
                const std::size_t objective = context.objective_index(each.fitness.objective());
                slopes.push_back({each.genome, each.fitness.objective_name(),
                                  context.problem().objectives()[objective].level, Sensitive<P>});
            }
            EvaluationRequest<P> request;
            for (auto& slope : slopes) request.slopes.push_back(&slope);
            context.queue().serve(request);
            for (std::size_t i = 0; i < slopes.size(); ++i) {
                if (slopes[i].failure) context.note_missing_derivative(*slopes[i].failure);
                if (slopes[i].sensitivity) {
                    const Eigen::VectorXd down =
                        -slopes[i].sensitivity->jacobian.transpose() * slopes[i].sensitivity->residuals;
                    all[i].assign(down.begin(), down.end());
                } else if (!slopes[i].gradient.empty()) {
                    all[i] = slopes[i].gradient;
                    if (population[chosen[i]].fitness.minimises())
                        for (double& each : all[i]) each = -each;
                }
            }
        }
        return all;
    }

    /// The descriptor's gradient if it has one, otherwise finite differences over a millionth of the distance
    /// between bounds.
    template <Problem P>
    static std::vector<double> gradient_of(const P& problem, const Descriptor<typename P::Genome>& descriptor,
                                           const typename P::Genome& genome, const std::vector<double>& genes,
                                           const auto& moving) {
        if (descriptor.gradient) return descriptor.gradient(genome);
        std::vector<double> gradient(genes.size(), 0);
        const double here = descriptor.of(genome);
        for (const Variable& v : moving) {
            if (v.gene >= genes.size() || !(width(v) > 0)) continue;
            std::vector<double> beside = genes;
            const double step = (genes[v.gene] + 1e-6 * width(v) <= v.upper ? 1e-6 : -1e-6) * width(v);
            beside[v.gene] += step;
            gradient[v.gene] = (descriptor.of(with_genes(problem, genome, std::move(beside))) - here) / step;
        }
        return gradient;
    }
};

/// The stage `emit n descriptors sigma=sigma`.
inline Emit emit(std::size_t n, std::vector<std::string> descriptors, double sigma = 0.1) {
    return checked(Emit{{}, n, std::move(descriptors), sigma});
}

} // namespace ga
