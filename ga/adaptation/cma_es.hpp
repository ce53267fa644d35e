#pragma once

#include "ga/variation/mutate.hpp"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

namespace ga {

/// The constants of CMA-ES for n variables and `lambda` children (Hansen, The CMA Evolution Strategy: A
/// Tutorial, arXiv:1604.00772, 2016; also for equation numbers).
struct CmaConstants {
    std::size_t lambda;      ///< number of children per generation
    Eigen::Index mu;         ///< number of parents: children whose weight is above 0
    Eigen::VectorXd weights; ///< size lambda, best child first; the first mu sum to 1, later ones are 0 or less
    double mu_eff;           ///< variance-effective number of parents, Eq. 8
    double c_c;              ///< decay of C's path, Eq. 56
    double c_sigma;          ///< decay of sigma's path, Eq. 55
    double c_1;              ///< rate of the rank-one update, Eq. 57
    double c_mu;             ///< rate of the rank-mu update, Eq. 58
    double d_sigma;          ///< damping of sigma, Eq. 55
    double chi;              ///< expected length of a standard normal vector
    Eigen::Index every;      ///< generations between two decompositions of the covariance, 1 or more

    /// The number of children by Eq. 48.
    static std::size_t usual_children(Eigen::Index n) {
        return 4 + static_cast<std::size_t>(3 * std::log(static_cast<double>(n)));
    }
    /// The constants for n = `variables` >= 1 and lambda = `children` >= 2.
    CmaConstants(Eigen::Index variables, std::size_t children);
};

/// The normal distribution of CMA-ES. Equation numbers as in CmaConstants.
struct SearchDistribution {
    Eigen::VectorXd mean;       ///< mean, n values
    double sigma = 0;           ///< step size
    Eigen::MatrixXd covariance; ///< covariance C, n x n
    Eigen::VectorXd path_sigma; ///< evolution path of sigma, n values
    Eigen::VectorXd path_c;     ///< evolution path of C, n values
    Eigen::MatrixXd axes;       ///< B, eigenvectors of C as it was last decomposed
    Eigen::VectorXd scales;     ///< D, square roots of the eigenvalues of C
    Eigen::Index learnt = 0;    ///< number of generations from which it has learnt
    Eigen::Index drawn = 0;     ///< value of `learnt` when C was last decomposed

    SearchDistribution() = default;
    /// An isotropic distribution with this mean and step size.
    SearchDistribution(Eigen::VectorXd middle, double step);

    /// The point for a standard normal vector (Eq. 38-40).
    Eigen::VectorXd at(const Eigen::VectorXd& z) const;
    /// C^(-1/2) y.
    Eigen::VectorXd whitened(const Eigen::VectorXd& y) const;
    /// Learns from steps (x - mean)/sigma, one or more columns, best first. With fewer than lambda steps the
    /// last weights are not used and the positive ones sum to 1 again. Negative weights of `altered` steps
    /// (of any size) are not used either: Eq. 46 assumes that their length is random.
    void learn(const CmaConstants& c, const Eigen::MatrixXd& steps, const std::vector<bool>& altered = {});
};

/// The progress of one run of CMA-ES, with higher values being better.
struct CmaRecord {
    std::vector<double> best;   ///< best value per generation, as far back as the rules need
    std::vector<double> median; ///< median value per generation
    std::vector<double> equal;  ///< 1 if the best and the k-th best value were equal
    long spent = 0;             ///< number of children that were scored

    /// Adds the values of a generation, best first.
    void note(const std::vector<double>& values, std::size_t lambda);
    /// Forgets generations that no rule needs.
    void forget(std::size_t window);
};

/// Why a run of CMA-ES is over, or null. The rules are those of Hansen (2009, Benchmarking a BI-population
/// CMA-ES on the BBOB-2009 function testbed, sec. 2.1); Stagnation has a window of 120 + 30 n/lambda
/// generations. `scale` is the run's first sigma.
const char* stop_criterion(const SearchDistribution& distribution, const CmaConstants& c, CmaRecord& record,
                           double scale);

/// The sequence of runs. Each large run has twice the children of the previous one (IPOP, Auger and Hansen 2005). In
/// BIPOP (Hansen 2009) as many evaluations are spent on additional runs with few children and small steps.
struct CmaPlan {
    std::size_t usual = 0;    ///< number of children of the first run
    std::size_t restarts = 0; ///< number of large runs after the first
    long large = 0;           ///< evaluations spent in large runs
    long small = 0;           ///< evaluations spent in small runs
    long last_large = 0;      ///< evaluations of the last large run
    bool now_large = false;   ///< whether the current run is large
    bool begun = false;       ///< whether the first run is over

    /// Settings of a run.
    struct Run {
        std::size_t lambda;   ///< number of children
        double shrink;        ///< factor of the first sigma
        long max_evaluations; ///< maximum number of evaluations; 0 for no limit
    };
    /// The next run, after one that spent this number of evaluations.
    Run next(long spent, bool both, Stream& random);
};

/// CMA-ES with active covariance adaptation (Hansen and Ostermeier 2001; Hansen 2016, see CmaConstants).
/// ga/README.md lists the differences. It starts at the best of the population. Then new children replace the
/// population in each generation. Steps are given as fractions of the distance between a gene's bounds. Steps
/// of refined children are shortened to sqrt(n) + 2n/(n + 2) standard deviations (Hansen 2011, Injecting
/// external solutions into CMA-ES). After a run has ended (`stop_criterion`), CmaPlan starts another at a
/// uniform random mean; genes without bounds start as in the first run.
struct CmaEs : Operator {
    double sigma = 0.3;             ///< first standard deviation, as a fraction of the distance between bounds, > 0
    std::size_t population = 0;     ///< number of children of the first run; 0 for 4 + 3 ln n
    std::string restarts = "bipop"; ///< ipop, bipop, or none; with none an ended run returns its population unchanged

    /// The learnt state. Coordinates are genes divided by the distance between their bounds.
    struct State {
        std::vector<Variable> moving;    ///< genes that move
        Eigen::VectorXd first;           ///< start point of the first run
        SearchDistribution distribution; ///< distribution of the children
        CmaRecord record;                ///< record of the current run
        CmaPlan plan;                    ///< plan of all runs
        CmaPlan::Run run{0, 1, 0};       ///< settings of the current run
        std::vector<Identity> children;  ///< identities of the last children, ascending
        std::vector<bool> mirrored;      ///< whether each of them was reflected
        bool ended = false;              ///< whether there is no further run
    };

    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"cma-es", "adaptation",
                "children drawn from a normal distribution that adapts to earlier children (Hansen and "
                "Ostermeier)"};
    }
    static void describe(auto& self, auto visit) {
        visit(
            self.sigma,
            number("sigma", above_zero, no_limit, "first step, as a fraction of the distance between bounds").keyed());
        visit(self.population,
              whole("population", 0, "children of the first run; 0 for 4 + 3 ln n").up_to(1e6).keyed().quiet());
        visit(self.restarts, word("restarts", "restarts after a run has ended: bipop, ipop or none").keyed());
    }
    void validate() const {
        if (restarts != "bipop" && restarts != "ipop" && restarts != "none")
            throw UsageError("stage 'cma-es': restarts is '" + restarts + "'; use bipop, ipop or none");
        if (population == 1) throw UsageError("stage 'cma-es': population is '1'; give 0, or 2 or more");
    }
    void check(CheckState& known) const {
        known.need_repetition(text_of(*this));
        known.need_one_objective(text_of(*this));
        known.scored.reset();
    }

    template <HasGenes P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context, State& state) const {
        if (population.empty()) return population;
        const auto order = ranking(population);
        const auto& best = population[order.front()];
        Stream random = context.stream(all_individuals);
        const bool begins = state.moving.empty();
        if (begins) {
            const std::vector<Variable> moving = variables_of(context.problem(), best.genome);
            if (std::ranges::any_of(moving, &Variable::is_choice))
                context.note("some genes are choices, which have no order; cross and mutate fit them better");
            begin(genes_of(context.problem(), best.genome), moving, state);
        }
        const CmaConstants constants(state.first.size(), state.run.lambda);
        if (!begins && !state.ended)
            learn(scored_children(population, order, context.problem(), state), constants, state);
        if (!state.ended && state.record.spent > 0 &&
            (stop_criterion(state.distribution, constants, state.record, sigma * state.run.shrink) ||
             (state.run.max_evaluations > 0 && state.record.spent >= state.run.max_evaluations)))
            begin_again(state, random);
        return state.ended ? population : children(std::move(population), best.genome, context, state);
    }

  private:
    void begin(const std::vector<double>& genes, std::vector<Variable> moving, State& state) const;
    /// A scored child of the previous generation.
    struct Child {
        std::vector<double> genes; ///< all its genes
        bool refined;              ///< whether a stage has refined it
        bool mirrored;             ///< whether it was reflected at a bound
        double value;              ///< merit, or minus the violation; higher is better
    };
    /// The children that are still in the population, best first.
    template <Problem P>
    static std::vector<Child> scored_children(const PopulationOf<P>& population, const std::vector<std::size_t>& order,
                                              const P& problem, const State& state) {
        std::vector<Child> scored;
        for (const std::size_t i : order) {
            const auto& individual = population[i];
            const auto child = std::lower_bound(state.children.begin(), state.children.end(), individual.identity);
            if (child == state.children.end() || *child != individual.identity ||
                scored.size() == state.children.size())
                continue;
            auto genes = genes_of(problem, individual.genome);
            if (genes.size() <= state.moving.back().gene) continue;
            const Fitness& fitness = individual.fitness;
            scored.push_back({std::move(genes), individual.origin != nullptr,
                              state.mirrored[static_cast<std::size_t>(child - state.children.begin())],
                              fitness.feasible() ? fitness.merit() : -fitness.violation()});
        }
        return scored;
    }
    static void learn(const std::vector<Child>& scored, const CmaConstants& constants, State& state);
    /// Draws the genes of child k.
    static void draw(std::size_t k, Stream stream, std::vector<double>& genes, State& state);

    void begin_again(State& state, Stream& random) const;

    template <Problem P, class G = typename P::Genome>
    static Population<G> children(Population<G> population, G best, Context<P>& context, State& state) {
        context.need_room(state.run.lambda, population, &best);
        std::vector<double> genes = genes_of(context.problem(), best);
        Population<G> fresh(state.run.lambda);
        state.children.clear();
        state.mirrored.assign(fresh.size(), false);
        for (std::size_t k = 0; k < fresh.size(); ++k) {
            draw(k, context.stream(k), genes, state);
            fresh[k].genome = with_genes(context.problem(), best, genes);
            context.make_child(fresh[k], Parents());
            state.children.push_back(fresh[k].identity);
        }
        return fresh;
    }
};

void to_json(nlohmann::json& j, const CmaEs::State& s);
void from_json(const nlohmann::json& j, CmaEs::State& s);

/// The stage `cma-es sigma=sigma population=children restarts=restarts`.
inline CmaEs cma_es(double sigma = 0.3, std::string restarts = "bipop", std::size_t children = 0) {
    return checked(CmaEs{{}, sigma, children, std::move(restarts)});
}

} // namespace ga
