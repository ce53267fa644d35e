#pragma once

#include "ga/adaptation/cma_runs.hpp"
#include "ga/pipeline/stage.hpp"
#include "ga/variation/mutate.hpp"

#include <nlohmann/json.hpp>

namespace ga {

/// CMA-ES with active covariance adaptation (Hansen and Ostermeier 2001; Hansen 2016, see CmaConstants). It
/// starts at the best of the population. It learns from those children of the previous generation that are
/// still in the population. Then new children replace the population. Steps are given as fractions of the
/// distance between a gene's bounds. A gene outside its bounds is reflected at them until it is inside.
/// Negative weights of reflected children are set to 0. Steps of refined children are shortened to sqrt(n) +
/// 2n/(n + 2) standard deviations (Hansen 2011, Injecting external solutions into CMA-ES). After a run has
/// ended (`over`), CmaPlan starts another at a uniform random mean; genes without bounds start as in the
/// first run.
struct CmaEs : Operator {
    double sigma = 0.3; ///< first standard deviation, as a fraction of the distance between bounds, > 0
    std::size_t population = 0; ///< number of children of the first run; 0 for 4 + 3 ln n
    std::string restarts =
        "bipop"; ///< ipop, bipop, or none; with none an ended run returns its population unchanged

    /// The learnt state. Coordinates are genes divided by the distance between their bounds.
    struct State {
        std::vector<Variable> moving;   ///< genes that move
        Eigen::VectorXd first;          ///< start point of the first run
        Cloud cloud;                    ///< distribution of the children
        CmaRecord record;               ///< record of the current run
        CmaPlan plan;                   ///< plan of all runs
        CmaPlan::Run run{0, 1, 0};      ///< settings of the current run
        std::vector<Identity> children; ///< identities of the last children, ascending
        std::vector<bool> mirrored;     ///< whether each of them was reflected
        bool ended = false;             ///< whether there is no further run
    };

    ///@{ Members that every operator has (Operator).
    static constexpr const char* needs = real_genes;
    static Words words() {
        return {"cma-es", "adaptation",
                "children drawn from a normal distribution that adapts to earlier children (Hansen and "
                "Ostermeier)"};
    }
    static void describe(auto& self, auto visit) {
        visit(self.sigma, number("sigma", "0.3", above_zero, no_limit,
                                 "first step, as a fraction of the distance between bounds")
                              .keyed());
        visit(self.population, whole("population", "0", 0, "children of the first run; 0 for 4 + 3 ln n")
                                   .up_to(1e6)
                                   .keyed()
                                   .quiet());
        visit(self.restarts,
              word("restarts", "bipop", "restarts after a run has ended: bipop, ipop or none").keyed());
    }
    void validate() const {
        if (restarts != "bipop" && restarts != "ipop" && restarts != "none")
            throw UsageError("stage 'cma-es': restarts is '" + restarts + "'; use bipop, ipop or none");
        if (population == 1)
            throw UsageError("stage 'cma-es': population is '1'; give 0, or 2 or more");
    }
    void check(CheckState& known) const {
        known.need_repetition(text_of(*this));
        known.need_one_objective(text_of(*this));
        known.scored.reset();
    }

    template <HasGenes P>
    PopulationOf<P> operator()(PopulationOf<P> population, Context<P>& context, State& state) const {
        if (population.empty())
            return population;
        const auto order = ranking(population);
        const auto& best = population[order.front()];
        Stream random = context.stream(everyone);
        const bool begins = state.moving.empty();
        if (begins)
            begin(genes_of(context.problem(), best.genome), variables_of(context.problem(), best.genome),
                  state);
        const CmaConstants constants(state.first.size(), state.run.lambda);
        if (!begins && !state.ended)
            learn(population, order, context.problem(), constants, state);
        if (!state.ended && state.record.spent > 0 &&
            (over(state.cloud, constants, state.record, sigma * state.run.shrink) ||
             (state.run.most > 0 && state.record.spent >= state.run.most)))
            begin_again(state, random);
        return state.ended ? population : children(std::move(population), best.genome, context, state);
    }
    ///@}

  private:
    void begin(const std::vector<double>& genes, std::vector<Variable> moving, State& state) const {
        std::erase_if(moving,
                      [&](const Variable& v) { return !(v.lower < v.upper) || v.gene >= genes.size(); });
        if (moving.empty())
            throw UsageError("cma-es: the genome has no gene that may move; give bounds that differ");
        state.moving = std::move(moving);
        state.first = coordinates(genes, state.moving);
        state.run.lambda = state.plan.usual =
            population > 0 ? population : CmaConstants::usual_children(state.first.size());
        state.cloud = Cloud(state.first, sigma);
    }

    /// Reflects a value at its bounds until it is between them.
    static double mirrored(double value, const Variable& v) {
        const double width = v.upper - v.lower;
        if ((value >= v.lower && value <= v.upper) || !std::isfinite(width))
            return reflected(value, v);
        return std::clamp(v.lower + std::abs(std::remainder(value - v.lower, 2 * width)), v.lower, v.upper);
    }

    /// The moving genes divided by the distance between their bounds.
    static Eigen::VectorXd coordinates(const std::vector<double>& genes,
                                       const std::vector<Variable>& moving) {
        Eigen::VectorXd x(static_cast<Eigen::Index>(moving.size()));
        for (std::size_t i = 0; i < moving.size(); ++i)
            x[static_cast<Eigen::Index>(i)] = genes[moving[i].gene] / width(moving[i]);
        return x;
    }

    template <Problem P>
    static void learn(const PopulationOf<P>& population, const std::vector<std::size_t>& order,
                      const P& problem, const CmaConstants& constants, State& state) {
        const auto n = static_cast<double>(state.first.size());
        Eigen::MatrixXd steps(state.first.size(), static_cast<Eigen::Index>(state.children.size()));
        std::vector<double> values;
        std::vector<bool> altered;
        for (const std::size_t i : order) {
            const auto& individual = population[i];
            const auto child =
                std::lower_bound(state.children.begin(), state.children.end(), individual.identity);
            if (child == state.children.end() || *child != individual.identity ||
                values.size() == state.children.size())
                continue;
            const auto genes = genes_of(problem, individual.genome);
            if (genes.size() <= state.moving.back().gene)
                continue;
            Eigen::VectorXd step = (coordinates(genes, state.moving) - state.cloud.mean) / state.cloud.sigma;
            if (individual.origin)
                step *= std::min(1.0, (std::sqrt(n) + 2 * n / (n + 2)) / state.cloud.whitened(step).norm());
            steps.col(static_cast<Eigen::Index>(values.size())) = step;
            altered.push_back(state.mirrored[static_cast<std::size_t>(child - state.children.begin())]);
            const Fitness& fitness = individual.fitness;
            values.push_back(fitness.feasible() ? fitness.merit() : -fitness.violation());
        }
        if (values.empty())
            return;
        state.cloud.learn(constants, steps.leftCols(static_cast<Eigen::Index>(values.size())), altered);
        state.record.note(values, state.run.lambda);
    }

    void begin_again(State& state, Stream& random) const {
        if (restarts == "none") {
            state.ended = true;
            return;
        }
        state.run = state.plan.next(state.record.spent, restarts == "bipop", random);
        Eigen::VectorXd mean = state.first;
        for (std::size_t i = 0; i < state.moving.size(); ++i)
            if (const Variable& v = state.moving[i]; std::isfinite(v.upper - v.lower))
                mean[static_cast<Eigen::Index>(i)] = random.uniform(v.lower, v.upper) / width(v);
        state.cloud = Cloud(std::move(mean), sigma * state.run.shrink);
        state.record = {};
    }

    template <Problem P, class G = typename P::Genome>
    static Population<G> children(Population<G> population, G like, Context<P>& context, State& state) {
        context.need_room(state.run.lambda, population, &like);
        std::vector<double> genes = genes_of(context.problem(), like);
        Population<G> fresh(state.run.lambda);
        state.children.clear();
        state.mirrored.assign(fresh.size(), false);
        for (std::size_t k = 0; k < fresh.size(); ++k) {
            Stream stream = context.stream(k);
            Eigen::VectorXd z(state.first.size());
            for (double& each : z)
                each = stream.normal();
            const Eigen::VectorXd x = state.cloud.at(z);
            for (std::size_t i = 0; i < state.moving.size(); ++i) {
                const Variable& v = state.moving[i];
                const double drawn = x[static_cast<Eigen::Index>(i)] * width(v);
                if (drawn < v.lower || drawn > v.upper)
                    state.mirrored[k] = true;
                if (v.gene < genes.size())
                    genes[v.gene] = mirrored(drawn, v);
            }
            fresh[k].genome = with_genes(context.problem(), like, genes);
            context.make_child(fresh[k], Parents());
            state.children.push_back(fresh[k].identity);
        }
        return fresh;
    }
};

///@{ Write and read the state for checkpoints, without loss.
inline void to_json(nlohmann::json& j, const CmaEs::State& s) {
    const auto numbers = [](const auto& m) { return std::vector<double>(m.data(), m.data() + m.size()); };
    std::vector<double> moving;
    for (const Variable& v : s.moving)
        moving.insert(moving.end(), {static_cast<double>(v.gene), v.lower, v.upper});
    const Cloud& c = s.cloud;
    j = {moving,
         numbers(s.first),
         {numbers(c.mean), c.sigma, numbers(c.covariance), numbers(c.path_sigma), numbers(c.path_c),
          numbers(c.axes), numbers(c.scales), c.learnt, c.drawn},
         {s.record.best, s.record.median, s.record.equal, s.record.spent},
         {s.plan.usual, s.plan.restarts, s.plan.large, s.plan.small, s.plan.last_large, s.plan.now_large,
          s.plan.begun},
         {s.run.lambda, s.run.shrink, s.run.most},
         s.children,
         s.ended,
         s.mirrored};
}
inline void from_json(const nlohmann::json& j, CmaEs::State& s) {
    const auto numbers = [](const nlohmann::json& from, Eigen::Index count) {
        const auto all = from.get<std::vector<double>>();
        expect_fit(all.size() == static_cast<std::size_t>(count) &&
                   std::all_of(all.begin(), all.end(), [](double each) { return std::isfinite(each); }));
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(all.data(), count));
    };
    const auto moving = j.at(0).get<std::vector<double>>();
    expect_fit(moving.size() % 3 == 0);
    for (std::size_t i = 0; i < moving.size(); i += 3) {
        expect_fit(moving[i] >= (i > 0 ? moving[i - 3] + 1 : 0) && moving[i] < 1e9 &&
                   moving[i + 1] < moving[i + 2]);
        s.moving.push_back({static_cast<std::size_t>(moving[i]), moving[i + 1], moving[i + 2]});
    }
    const auto n = static_cast<Eigen::Index>(s.moving.size());
    s.first = numbers(j.at(1), n);
    const auto& c = j.at(2);
    s.cloud.mean = numbers(c.at(0), n);
    s.cloud.sigma = c.at(1);
    s.cloud.covariance = numbers(c.at(2), n * n).reshaped(n, n);
    s.cloud.path_sigma = numbers(c.at(3), n), s.cloud.path_c = numbers(c.at(4), n);
    s.cloud.axes = numbers(c.at(5), n * n).reshaped(n, n);
    s.cloud.scales = numbers(c.at(6), n);
    read_part(c.at(7), s.cloud.learnt), read_part(c.at(8), s.cloud.drawn);
    read_parts(j.at(3), s.record.best, s.record.median, s.record.equal, s.record.spent);
    CmaPlan& p = s.plan;
    read_parts(j.at(4), p.usual, p.restarts, p.large, p.small, p.last_large, p.now_large, p.begun);
    read_parts(j.at(5), s.run.lambda, s.run.shrink, s.run.most);
    for (const long count : {p.large, p.small, p.last_large, s.record.spent})
        expect_fit(count >= 0 && count <= 1L << 53);
    constexpr std::size_t most = 10'000'000; // children
    expect_fit(s.moving.empty() || (s.run.lambda >= 2 && s.plan.usual >= 2 && s.cloud.sigma > 0 &&
                                    s.run.lambda <= most && s.plan.usual <= most));
    read_part(j.at(6), s.children);
    s.ended = j.at(7);
    read_part(j.at(8), s.mirrored);
    expect_fit(s.mirrored.size() == s.children.size());
}
///@}

/// The stage `cma-es sigma=sigma population=children restarts=restarts`.
inline CmaEs cma_es(double sigma = 0.3, std::string restarts = "bipop", std::size_t children = 0) {
    return checked(CmaEs{{}, sigma, children, std::move(restarts)});
}

} // namespace ga
