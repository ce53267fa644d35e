#pragma once

#include "ga/variation/mutate.hpp"

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

namespace ga {

/// The constants of CMA-ES for n variables and `lambda` children (Hansen, The CMA Evolution Strategy: A
/// Tutorial, arXiv:1604.00772, 2016; also for equation numbers).
struct CmaConstants {
    std::size_t lambda; ///< number of children per generation
    Eigen::Index mu;    ///< number of parents: children whose weight is above 0
    Eigen::VectorXd
        weights;        ///< size lambda, best child first; the first mu sum to 1, later ones are 0 or less
    double mu_eff;      ///< variance-effective number of parents, Eq. 8
    double c_c;         ///< decay of C's path, Eq. 56
    double c_sigma;     ///< decay of sigma's path, Eq. 55
    double c_1;         ///< rate of the rank-one update, Eq. 57
    double c_mu;        ///< rate of the rank-mu update, Eq. 58
    double d_sigma;     ///< damping of sigma, Eq. 55
    double chi;         ///< expected length of a standard normal vector
    Eigen::Index every; ///< generations between two decompositions of the covariance, 1 or more

    /// The number of children by Eq. 48.
    static std::size_t usual_children(Eigen::Index n) {
        return 4 + static_cast<std::size_t>(3 * std::log(static_cast<double>(n)));
    }
    /// The constants for n = `variables` >= 1 and lambda = `children` >= 2.
    CmaConstants(Eigen::Index variables, std::size_t children)
        : lambda(children), mu(static_cast<Eigen::Index>(children / 2)),
          weights(static_cast<Eigen::Index>(children)) {
        const auto n = static_cast<double>(variables);
        for (Eigen::Index i = 0; i < weights.size(); ++i) // Eq. 49
            weights[i] =
                std::log((static_cast<double>(children) + 1) / 2) - std::log(static_cast<double>(i + 1));
        const auto effective = [](const auto& w) { return w.sum() * w.sum() / w.squaredNorm(); };
        auto above = weights.head(mu), below = weights.tail(weights.size() - mu);
        mu_eff = effective(above);
        c_sigma = (mu_eff + 2) / (n + mu_eff + 5);                                        // Eq. 55
        d_sigma = 1 + 2 * std::max(0.0, std::sqrt((mu_eff - 1) / (n + 1)) - 1) + c_sigma; // Eq. 55
        c_c = (4 + mu_eff / n) / (n + 4 + 2 * mu_eff / n);                                // Eq. 56
        c_1 = 2 / ((n + 1.3) * (n + 1.3) + mu_eff);                                       // Eq. 57
        c_mu =
            std::min(1 - c_1, 2 * (0.25 + mu_eff + 1 / mu_eff - 2) / ((n + 2) * (n + 2) + mu_eff)); // Eq. 58
        chi = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
        above /= above.sum();
        const double smallest = std::min({1 + c_1 / c_mu,                                          // Eq. 50
                                          1 + 2 * effective(below) / (mu_eff + 2),                 // Eq. 51
                                          (1 - c_1 - c_mu) / (n * c_mu)});                         // Eq. 52
        below *= below.sum() < 0 && std::isfinite(smallest) ? smallest / -below.sum() : 0;         // Eq. 53
        every = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(1 / (10 * n * (c_1 + c_mu)))); // B.2
    }
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
    SearchDistribution(Eigen::VectorXd middle, double step)
        : mean(std::move(middle)), sigma(step),
          covariance(Eigen::MatrixXd::Identity(mean.size(), mean.size())),
          path_sigma(Eigen::VectorXd::Zero(mean.size())), path_c(path_sigma), axes(covariance),
          scales(Eigen::VectorXd::Ones(mean.size())) {}

    /// The point for a standard normal vector (Eq. 38-40).
    Eigen::VectorXd at(const Eigen::VectorXd& z) const {
        return mean + sigma * (axes * scales.cwiseProduct(z));
    }
    /// C^(-1/2) y.
    Eigen::VectorXd whitened(const Eigen::VectorXd& y) const {
        return axes * (axes.transpose() * y).cwiseQuotient(scales);
    }
    /// Learns from steps (x - mean)/sigma, one or more columns, best first. With fewer than lambda steps the
    /// last weights are not used and the positive ones sum to 1 again. Negative weights of `altered` steps
    /// (of any size) are not used either: Eq. 46 assumes that their length is random.
    template <class Flags = std::vector<bool>> // a template, so that only files that call it compile it
    void learn(const CmaConstants& c, const Eigen::MatrixXd& steps, const Flags& altered = {}) {
        const Eigen::Index n = mean.size(), used = std::min(steps.cols(), c.weights.size());
        const Eigen::Index parents = std::min(c.mu, used);
        Eigen::VectorXd weights = c.weights.head(used);
        weights.head(parents) /= weights.head(parents).sum();
        for (Eigen::Index i = parents; i < used; ++i)
            if (const auto k = static_cast<std::size_t>(i); k < altered.size() && altered[k])
                weights[i] = 0;
        const Eigen::VectorXd step = steps.leftCols(parents) * weights.head(parents); // Eq. 41
        mean += sigma * step;                                                         // Eq. 42
        path_sigma = (1 - c.c_sigma) * path_sigma +
                     std::sqrt(c.c_sigma * (2 - c.c_sigma) * c.mu_eff) * whitened(step); // Eq. 43
        ++learnt;
        const double length = path_sigma.norm() / c.chi;
        const double settled = 1 - std::pow(1 - c.c_sigma, 2 * static_cast<double>(learnt));
        const bool calm = length / std::sqrt(settled) < 1.4 + 2 / (static_cast<double>(n) + 1);
        path_c = (1 - c.c_c) * path_c;
        if (calm)
            path_c += std::sqrt(c.c_c * (2 - c.c_c) * c.mu_eff) * step; // Eq. 45
        const double decay = 1 + (calm ? 0 : c.c_1 * c.c_c * (2 - c.c_c)) - c.c_1 - c.c_mu * weights.sum();
        for (Eigen::Index i = parents; i < used; ++i) // Eq. 46
            weights[i] *= static_cast<double>(n) / std::max(whitened(steps.col(i)).squaredNorm(), 1e-300);
        const auto columns = steps.leftCols(used);
        covariance = (decay * covariance + c.c_1 * path_c * path_c.transpose() +
                      c.c_mu * columns * weights.asDiagonal() * columns.transpose())
                         .eval();                                               // Eq. 47
        sigma *= std::exp(std::min(1.0, c.c_sigma / c.d_sigma * (length - 1))); // Eq. 44
        if (learnt - drawn < c.every)
            return;
        covariance = (0.5 * (covariance + covariance.transpose())).eval();
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
        axes = solver.eigenvectors();
        scales = solver.eigenvalues().cwiseMax(1e-40 * solver.eigenvalues().maxCoeff()).cwiseSqrt();
        drawn = learnt;
    }
};

/// The progress of one run of CMA-ES, with higher values being better.
struct CmaRecord {
    std::vector<double> best;   ///< best value per generation, as far back as the rules need
    std::vector<double> median; ///< median value per generation
    std::vector<double> equal;  ///< 1 if the best and the k-th best value were equal
    long spent = 0;             ///< number of children that were scored

    /// Adds the values of a generation, best first.
    void note(const std::vector<double>& values, std::size_t lambda) {
        const auto k = static_cast<std::size_t>(1 + std::ceil(0.1 + static_cast<double>(lambda) / 4));
        best.push_back(values.front());
        median.push_back(values[values.size() / 2]);
        equal.push_back(values.size() >= k && values[k - 1] == values.front() ? 1 : 0);
        spent += static_cast<long>(values.size());
    }
    /// Forgets generations that no rule needs.
    void forget(std::size_t window) {
        for (auto* each : {&best, &median, &equal})
            if (each->size() > 2 * window)
                each->erase(each->begin(), each->end() - static_cast<std::ptrdiff_t>(window));
    }
};

/// Why a run of CMA-ES is over, or null. The rules are those of Hansen (2009, Benchmarking a BI-population
/// CMA-ES on the BBOB-2009 function testbed, sec. 2.1); Stagnation has a window of 120 + 30 n/lambda
/// generations. `scale` is the run's first sigma.
inline const char* stop_criterion(const SearchDistribution& distribution, const CmaConstants& c,
                                  CmaRecord& record, double scale) {
    const auto n = static_cast<double>(distribution.mean.size()), lambda = static_cast<double>(c.lambda);
    const auto last = [](const std::vector<double>& all, double count) {
        return std::vector<double>(static_cast<double>(all.size()) > count
                                       ? all.end() - static_cast<std::ptrdiff_t>(count)
                                       : all.begin(),
                                   all.end());
    };
    const double few = 10 + std::ceil(30 * n / lambda), many = 120 + std::ceil(30 * n / lambda);
    record.forget(static_cast<std::size_t>(std::max(many, n)));
    const auto generations = static_cast<double>(distribution.learnt);
    const Eigen::VectorXd deviations = distribution.sigma * distribution.covariance.diagonal().cwiseSqrt();
    if (generations >= 100 + 50 * (n + 3) * (n + 3) / std::sqrt(lambda))
        return "MaxIter";
    if (generations >= few) {
        const auto recent = last(record.best, few);
        const auto [low, high] = std::minmax_element(recent.begin(), recent.end());
        if (*high - *low < 1e-12)
            return "TolHistFun";
    }
    const auto equal = last(record.equal, n);
    if (generations >= n && std::accumulate(equal.begin(), equal.end(), 0.0) > n / 3)
        return "EqualFunVals";
    if (deviations.maxCoeff() < 1e-12 * scale &&
        distribution.sigma * distribution.path_c.cwiseAbs().maxCoeff() < 1e-12 * scale)
        return "TolX";
    if (!(distribution.sigma <= 1e20 * scale * distribution.scales.maxCoeff()))
        return "TolUpSigma";
    if (static_cast<double>(record.best.size()) >= many) {
        const auto middle = [](std::vector<double> part) {
            std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2),
                             part.end());
            return part[part.size() / 2];
        };
        const auto better = [&](const std::vector<double>& all) {
            const auto window = last(all, many);
            return middle({window.end() - 20, window.end()}) > middle({window.begin(), window.begin() + 20});
        };
        if (!better(record.best) && !better(record.median))
            return "Stagnation";
    }
    if (std::pow(distribution.scales.maxCoeff() / distribution.scales.minCoeff(), 2) > 1e14)
        return "ConditionCov";
    const Eigen::Index axis = distribution.learnt % distribution.mean.size();
    if (distribution.mean == distribution.mean + 0.1 * distribution.sigma * distribution.scales[axis] *
                                                     distribution.axes.col(axis))
        return "NoEffectAxis";
    if (((distribution.mean + 0.2 * deviations).array() == distribution.mean.array()).any())
        return "NoEffectCoord";
    return nullptr;
}

/// The sequence of runs. In IPOP each has four times the children of the previous one; Auger and Hansen
/// (2005) double them. In BIPOP (Hansen 2009) the large runs double, and as many evaluations are spent on
/// additional runs with few children and small steps.
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
    Run next(long spent, bool both, Stream& random) {
        if (begun)
            (now_large ? large : small) += spent;
        if (now_large)
            last_large = spent;
        begun = true;
        now_large = !both || large <= small;
        if (now_large)
            return {usual << std::min<std::size_t>((both ? 1 : 2) * ++restarts, 20), 1, 0};
        const double ratio = 0.5 * std::pow(2, static_cast<double>(restarts)), u = random.uniform();
        const double children = static_cast<double>(usual) * std::pow(ratio, u * u);
        return {static_cast<std::size_t>(children), std::pow(10, -2 * random.uniform()), last_large / 2};
    }
};

/// CMA-ES with active covariance adaptation (Hansen and Ostermeier 2001; Hansen 2016, see CmaConstants). It
/// starts at the best of the population. It learns from those children of the previous generation that are
/// still in the population. Then new children replace the population. Steps are given as fractions of the
/// distance between a gene's bounds. A gene outside its bounds is reflected at them until it is inside.
/// Negative weights of reflected children are set to 0. Steps of refined children are shortened to sqrt(n) +
/// 2n/(n + 2) standard deviations (Hansen 2011, Injecting external solutions into CMA-ES). After a run has
/// ended (`stop_criterion`), CmaPlan starts another at a uniform random mean; genes without bounds start as
/// in the first run.
struct CmaEs : Operator {
    double sigma = 0.3; ///< first standard deviation, as a fraction of the distance between bounds, > 0
    std::size_t population = 0; ///< number of children of the first run; 0 for 4 + 3 ln n
    std::string restarts =
        "bipop"; ///< ipop, bipop, or none; with none an ended run returns its population unchanged

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
        visit(self.sigma, number("sigma", above_zero, no_limit,
                                 "first step, as a fraction of the distance between bounds")
                              .keyed());
        visit(
            self.population,
            whole("population", 0, "children of the first run; 0 for 4 + 3 ln n").up_to(1e6).keyed().quiet());
        visit(self.restarts, word("restarts", "restarts after a run has ended: bipop, ipop or none").keyed());
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
        Stream random = context.stream(all_individuals);
        const bool begins = state.moving.empty();
        if (begins)
            begin(genes_of(context.problem(), best.genome), variables_of(context.problem(), best.genome),
                  state);
        const CmaConstants constants(state.first.size(), state.run.lambda);
        if (!begins && !state.ended)
            learn(population, order, context.problem(), constants, state);
        if (!state.ended && state.record.spent > 0 &&
            (stop_criterion(state.distribution, constants, state.record, sigma * state.run.shrink) ||
             (state.run.max_evaluations > 0 && state.record.spent >= state.run.max_evaluations)))
            begin_again(state, random);
        return state.ended ? population : children(std::move(population), best.genome, context, state);
    }

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
        state.distribution = SearchDistribution(state.first, sigma);
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
            Eigen::VectorXd step =
                (coordinates(genes, state.moving) - state.distribution.mean) / state.distribution.sigma;
            if (individual.origin)
                step *= std::min(1.0,
                                 (std::sqrt(n) + 2 * n / (n + 2)) / state.distribution.whitened(step).norm());
            steps.col(static_cast<Eigen::Index>(values.size())) = step;
            altered.push_back(state.mirrored[static_cast<std::size_t>(child - state.children.begin())]);
            const Fitness& fitness = individual.fitness;
            values.push_back(fitness.feasible() ? fitness.merit() : -fitness.violation());
        }
        if (values.empty())
            return;
        state.distribution.learn(constants, steps.leftCols(static_cast<Eigen::Index>(values.size())),
                                 altered);
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
        state.distribution = SearchDistribution(std::move(mean), sigma * state.run.shrink);
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
            const Eigen::VectorXd x = state.distribution.at(z);
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

inline void to_json(nlohmann::json& j, const CmaEs::State& s) {
    const auto numbers = [](const auto& m) { return std::vector<double>(m.data(), m.data() + m.size()); };
    std::vector<double> moving;
    for (const Variable& v : s.moving)
        moving.insert(moving.end(), {static_cast<double>(v.gene), v.lower, v.upper});
    const SearchDistribution& c = s.distribution;
    j = {moving,
         numbers(s.first),
         {numbers(c.mean), c.sigma, numbers(c.covariance), numbers(c.path_sigma), numbers(c.path_c),
          numbers(c.axes), numbers(c.scales), c.learnt, c.drawn},
         {s.record.best, s.record.median, s.record.equal, s.record.spent},
         {s.plan.usual, s.plan.restarts, s.plan.large, s.plan.small, s.plan.last_large, s.plan.now_large,
          s.plan.begun},
         {s.run.lambda, s.run.shrink, s.run.max_evaluations},
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
    s.distribution.mean = numbers(c.at(0), n);
    s.distribution.sigma = c.at(1);
    s.distribution.covariance = numbers(c.at(2), n * n).reshaped(n, n);
    s.distribution.path_sigma = numbers(c.at(3), n), s.distribution.path_c = numbers(c.at(4), n);
    s.distribution.axes = numbers(c.at(5), n * n).reshaped(n, n);
    s.distribution.scales = numbers(c.at(6), n);
    read_part(c.at(7), s.distribution.learnt), read_part(c.at(8), s.distribution.drawn);
    read_parts(j.at(3), s.record.best, s.record.median, s.record.equal, s.record.spent);
    CmaPlan& p = s.plan;
    read_parts(j.at(4), p.usual, p.restarts, p.large, p.small, p.last_large, p.now_large, p.begun);
    read_parts(j.at(5), s.run.lambda, s.run.shrink, s.run.max_evaluations);
    for (const long count : {p.large, p.small, p.last_large, s.record.spent})
        expect_fit(count >= 0 && count <= 1L << 53);
    constexpr std::size_t max_children = 10'000'000;
    expect_fit(s.moving.empty() || (s.run.lambda >= 2 && s.plan.usual >= 2 && s.distribution.sigma > 0 &&
                                    s.run.lambda <= max_children && s.plan.usual <= max_children));
    read_part(j.at(6), s.children);
    s.ended = j.at(7);
    read_part(j.at(8), s.mirrored);
    expect_fit(s.mirrored.size() == s.children.size());
}

/// The stage `cma-es sigma=sigma population=children restarts=restarts`.
inline CmaEs cma_es(double sigma = 0.3, std::string restarts = "bipop", std::size_t children = 0) {
    return checked(CmaEs{{}, sigma, children, std::move(restarts)});
}

} // namespace ga
