#include "tests/catch.hpp"
#include "tests/ga/problems.hpp"

using namespace ga;

namespace {

/// Evaluations that a pipeline needs to reach the target; all there are if it does not.
long evaluations_to(double target, const Reals& problem, const std::string& pipeline, std::uint64_t seed = 1,
                    long most = 200000) {
    const auto result = run(pipeline, problem, {}, {.seed = seed, .threads = 1, .budget = {.evaluations = most}});
    CHECK(result.best->value() <= target);
    return result.counters.evaluations;
}
std::string by_cma(double target, const std::string& words = "") {
    return "sample 1 | score | until fitness " + number(target) + " { cma-es " + words + " | score }";
}

/// Constants and steps of six children in two dimensions.
const CmaConstants six(2, 6);
const Eigen::MatrixXd six_steps{{1, 0.3, -0.2, 0.9, -1.5, 0.1}, {0.5, -1, 0.4, 1.1, 0.2, 2}};

/// Self-adaptive mutation that shows its state before and after each generation.
struct Watched : SelfAdaptive {
    std::function<void(const State& before, const State& after)> look;

    Population<Vector> operator()(Population<Vector> population, Context<Reals>& context, State& state) const {
        const State before = state;
        auto next = SelfAdaptive::operator()(std::move(population), context, state);
        look(before, state);
        return next;
    }
};

/// Counts its calls as its state, and notes the calls before and the generation.
struct Counting : Operator {
    struct State {
        std::size_t calls = 0;
        friend void to_json(json& j, const State& state) { j = state.calls; }
        friend void from_json(const json& j, State& state) { j.get_to(state.calls); }
    };
    using Seen = std::vector<std::pair<std::size_t, std::size_t>>;
    std::shared_ptr<Seen> seen = std::make_shared<Seen>();
    /// Guards `seen`, because each island has a thread.
    std::shared_ptr<std::mutex> guard = std::make_shared<std::mutex>();

    std::string text() const { return "counting"; }
    void check(CheckState&) const {}
    Population<Vector> operator()(Population<Vector> population, Context<Reals>& context, State& state) const {
        const std::lock_guard lock(*guard);
        seen->emplace_back(state.calls++, context.position.generations().back());
        return population;
    }
};
/// Runs it in a block and returns its notes.
Counting::Seen seen_in(const std::function<Pipeline<Reals>(const Pipeline<Reals>&)>& block) {
    const Counting counting;
    run(reals("sample 2 | score") | block(counting), Reals{}, {}, {.threads = 1});
    std::stable_sort(counting.seen->begin(), counting.seen->end(),
                     [](const auto& a, const auto& b) { return a.second < b.second; });
    return *counting.seen;
}

} // namespace

TEST_CASE("the constants of CMA-ES follow Hansen's tutorial for few and many children") {
    // computed from the formulas in Python
    CHECK(CmaConstants(10, 10).weights[9] == Approx(-0.5497499176973852).epsilon(1e-13));
    CHECK(CmaConstants(40, 15).weights[14] == Approx(-0.30836725932054165).epsilon(1e-13));
    const CmaConstants many(2, 200);
    REQUIRE(many.mu_eff > 4); // (mu_eff - 1) / (n + 1) is above 1
    CHECK(many.d_sigma == Approx(1 + 2 * (std::sqrt((many.mu_eff - 1) / 3) - 1) + many.c_sigma).epsilon(1e-14));
}

TEST_CASE("three generations of CMA-ES equal those of an independent program") {
    SearchDistribution distribution(Eigen::Vector2d(1, 2), 0.5);
    const auto check = [&](double m0, double m1, double sigma, double c00, double c01, double c11, double p0,
                           double p1) {
        CHECK((distribution.mean[0] == Approx(m0).epsilon(1e-13) && distribution.mean[1] == Approx(m1).epsilon(1e-13)));
        CHECK(distribution.sigma == Approx(sigma).epsilon(1e-13));
        CHECK(distribution.covariance(0, 0) == Approx(c00).epsilon(1e-13));
        CHECK(distribution.covariance(0, 1) == Approx(c01).epsilon(1e-12));
        CHECK(distribution.covariance(1, 1) == Approx(c11).epsilon(1e-13));
        CHECK((distribution.path_c[0] == Approx(p0).epsilon(1e-12) &&
               distribution.path_c[1] == Approx(p1).epsilon(1e-13)));
    };
    distribution.learn(six, six_steps);
    check(1.3533681071042383, 2.032652948355438, 0.4517482891753802, 0.9914491124828981, 0.01512945756488861,
          0.7596880712640123, 0.9329613559687964, 0.08621021071684297);
    distribution.learn(six, six_steps.rowwise().reverse());
    check(1.2211853493352072, 2.6728819547164044, 0.5396732465936928, 0.8352413023389593, -0.017983686540776412,
          1.3479413344979199, -0.035988220829193174, 1.903243816844794);
    distribution.learn(six, 5 * six_steps); // so far that the path of C stalls
    check(3.1282184853713275, 2.8491011812147575, 1.3130938780643515, 2.197923196966732, 0.44020658447124417,
          2.2152431620282624, -0.013511614158820797, 0.714564252159636);
}

TEST_CASE("CMA-ES needs the published evaluations on sphere, ellipsoid and Rosenbrock") {
    // 1,500 to 2,000 on the sphere, 6,000 to 8,000 on Rosenbrock; here 1,611, 4,221 and 5,711
    for (const auto& [f, least, most] : {std::tuple(&functions::sphere, 1000, 2200),
                                         {functions::ellipsoid, 0, 7500},
                                         {functions::rosenbrock, 0, 8000}}) {
        std::array<long, 5> spent;
        for (std::size_t i = 0; i < 5; ++i) spent[i] = evaluations_to(1e-9, minimum(10, f), by_cma(1e-9), 1 + i);
        std::ranges::sort(spent);
        CAPTURE(spent);
        CHECK(spent[2] > least); // the median
        CHECK(spent[2] < most);
    }
}

TEST_CASE("CMA-ES depends only on the order of fitness") {
    const auto by = [](auto f) {
        return run("sample 1 | score | repeat 40 { cma-es | score }", minimum(6, f)).population.back().genome;
    };
    CHECK(by(functions::rosenbrock) == by([](const Vector& x) { return std::sqrt(functions::rosenbrock(x)) - 7; }));
}

TEST_CASE("CMA-ES converges in a corner of its box, and without bounds") {
    const auto corner = [](const Vector& x) { return functions::sphere({x[0] - 5, x[1] + 5, x[2] - 1}); };
    evaluations_to(1e-9, minimum(3, corner), by_cma(1e-9), 1, 5000);
    const auto far = [](const Vector& x) { return functions::sphere({x[0] - 1000, x[1] + 500}); };
    evaluations_to(1e-9, minimum(2, far, -HUGE_VAL, HUGE_VAL), by_cma(1e-9), 1, 5000);
    const auto ramp = [](const Vector& x) { // every descent leads out of the box
        double sum = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            sum += std::pow(10, static_cast<double>(i) / 4) * (i % 2 ? 5 - x[i] : x[i] + 5);
        return sum;
    };
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        evaluations_to(1e-6, minimum(5, ramp), by_cma(1e-6, "restarts=none"), seed, 3000);
}

TEST_CASE("restarts of CMA-ES find Rastrigin's minimum, unlike a single run") {
    const Reals rastrigin = minimum(5, functions::rastrigin);
    int single = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        evaluations_to(1e-8, rastrigin, by_cma(1e-8, "restarts=ipop"), seed, 100000);
        evaluations_to(1e-8, rastrigin, by_cma(1e-8, "restarts=bipop"), seed, 100000);
        const auto once = run(by_cma(1e-8, "restarts=none"), rastrigin, {}, {.seed = seed, .threads = 1});
        CHECK(once.counters.evaluations < 5000); // it ended by itself
        single += once.best->value() < 0.1 ? 1 : 0;
    }
    CHECK(single < 3);
}

TEST_CASE("a run of CMA-ES ends by each of Hansen's rules") {
    using Change = std::function<void(SearchDistribution&, CmaRecord&)>;
    const auto flat = [](std::vector<double>& values) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i % 2);
    };
    const auto small = [](double sigma, double variance) {
        return [=](SearchDistribution& distribution, CmaRecord&) {
            distribution.mean.setZero();
            distribution.sigma = sigma;
            distribution.covariance.diagonal().setConstant(variance);
        };
    };
    const std::vector<std::tuple<std::string, Change, double>> cases = {
        {"", [](SearchDistribution&, CmaRecord&) {}, 0.3},
        {"MaxIter", [](SearchDistribution& distribution, CmaRecord&) { distribution.learnt = 3000; }, 0.3},
        {"TolHistFun",
         [](SearchDistribution&, CmaRecord& record) { std::fill(record.best.end() - 40, record.best.end(), 7.0); },
         0.3},
        {"EqualFunVals", [](SearchDistribution&, CmaRecord& record) { std::fill_n(record.equal.end() - 10, 4, 1.0); },
         0.3},
        {"TolX", small(1.8e-12, 0.25), 1}, // the standard deviation is sigma sqrt(C)
        {"TolUpSigma", [](SearchDistribution& distribution, CmaRecord&) { distribution.sigma = 1e20; }, 0.3},
        {"Stagnation", [&](SearchDistribution&, CmaRecord& record) { flat(record.best), flat(record.median); }, 0.3},
        {"ConditionCov", [](SearchDistribution& distribution, CmaRecord&) { distribution.scales[4] = 1e-8; }, 0.3},
        {"NoEffectAxis", [](SearchDistribution& distribution, CmaRecord&) { distribution.sigma = 1e-17; }, 1e-10},
        {"NoEffectCoord", [](SearchDistribution& distribution, CmaRecord&) { distribution.covariance(3, 3) = 1e-40; },
         0.3}};
    for (const auto& [reason, change, scale] : cases) {
        SearchDistribution distribution(Eigen::VectorXd::Ones(10), 0.3);
        distribution.learnt = 155;
        CmaRecord record;
        for (int i = 0; i < 200; ++i) record.note({i + 0.0, i + 0.0, i - 1.0}, 10);
        change(distribution, record);
        const char* const why = stop_criterion(distribution, CmaConstants(10, 10), record, scale);
        CHECK(std::string(why ? why : "") == reason);
    }
}

TEST_CASE("BIPOP spends as much on small runs as on large ones, and large runs double, as in IPOP") {
    Stream random(1);
    CmaPlan plan, ipop;
    plan.usual = ipop.usual = 10;
    CmaPlan::Run run{10, 1, 0};
    std::size_t last = 10;
    while (last < 1000) {
        const long all = 100 * static_cast<long>(run.lambda);
        run = plan.next(run.max_evaluations > 0 ? std::min(run.max_evaluations, all) : all, true, random);
        CHECK((plan.now_large ? plan.small >= plan.large : plan.small < plan.large));
        CHECK((plan.now_large ? run.lambda == 2 * last : run.lambda >= 10 && run.lambda <= last / 2));
        CHECK((plan.now_large ? run.shrink == 1 : run.shrink >= 0.01 && run.shrink <= 1));
        CHECK(plan.now_large == (run.max_evaluations == 0));
        last = plan.now_large ? run.lambda : last;
    }
    for (const std::size_t expected : {20u, 40u, 80u}) CHECK(ipop.next(1000, false, random).lambda == expected);
}

TEST_CASE("CMA-ES learns only from children that it made") {
    const Reals rosenbrock = minimum(4, functions::rosenbrock);
    const auto alone = run("sample 3 | score | repeat 30 { cma-es | score }", rosenbrock);
    const auto joined = run("sample 3 | score | repeat 30 { cma-es | score | parents }", rosenbrock);
    REQUIRE(joined.population.size() > alone.population.size());
    for (std::size_t i = 0; i < alone.population.size(); ++i)
        CHECK(joined.population[i].genome == alone.population[i].genome);
}

TEST_CASE("CMA-ES converges when a refinement moves its children far, or its start fails") {
    evaluations_to(1e-9, minimum(6, functions::sphere),
                   "sample 1 | score | until fitness 1e-9 { cma-es sigma=0.001 | score | refine nlopt LN_COBYLA 15 }",
                   1, 60000);
    const Reals hole = minimum(2, [](const Vector& x) {
        return x == Vector{0.5, 0.5} ? throw std::runtime_error("cannot be evaluated here") : functions::sphere(x);
    });
    CHECK(run("score | repeat 30 { cma-es | score }", hole, population<Vector>({{0.5, 0.5}})).best->value() < 1e-3);
}

TEST_CASE("a learning operator without a gene to move keeps genomes or refuses") {
    const auto start = population<Vector>({{1, 2}, {3, 4}, {5, 6}, {7, 8}});
    const auto after = run("score | de | score", minimum(0, functions::sphere), start).population;
    for (std::size_t i = 0; i < 4; ++i) CHECK(after[i].genome == start[i].genome);
    CHECK_THROWS_WITH(run("score | repeat 2 { cma-es | score }", minimum(2, functions::sphere, 1, 1), start),
                      "cma-es: the genome has no gene that may move; give bounds that differ");
}

TEST_CASE("a trial of differential evolution crosses the mutant, halfway to a passed bound") {
    const Vector base{1, 1, 1}, a{2, 3, 1}, b{4, 0, 9}, c{1, 1, 1}, target{7, 8, 0};
    const std::vector<Variable> box{{0, -10, 10}, {1, -10, 10}, {2, -10, 4}};
    Stream stream(1);
    const Vector trial = Difference{base, a, b, c, 0.5, 0.8, 1}.trial(target, box, stream);
    CHECK(trial[0] == Approx(1 + 0.5 * 1 + 0.8 * 3));
    CHECK(trial[1] == Approx(1 + 0.5 * 2 - 0.8));
    CHECK(trial[2] == (0 + 4) / 2.0);
    int first = 0;
    for (std::uint64_t i = 0; i < 300; ++i) { // with CR = 0 one gene, each as often
        Stream each(i);
        const Vector one = Difference{base, a, b, c, 0.5, 0.8, 0}.trial(target, box, each);
        CHECK((one[0] != target[0]) + (one[1] != target[1]) + (one[2] != target[2]) == 1);
        first += one[0] != target[0] ? 1 : 0;
    }
    CHECK((first > 70 && first < 130));
}

TEST_CASE("exponential cross-over takes genes in a row, of geometric length") {
    const std::size_t n = 5;
    const Vector ones(n, 1), zeros(n, 0);
    std::vector<Variable> box;
    for (std::size_t g = 0; g < n; ++g) box.push_back({g, -10, 10});
    const double cr = 0.7;
    const int trials = 20000;
    std::vector<int> of_length(n + 1);
    for (int i = 0; i < trials; ++i) {
        Stream stream(static_cast<std::uint64_t>(i));
        const Vector trial = Difference{ones, ones, zeros, zeros, 0, 0, cr, true}.trial(zeros, box, stream);
        std::size_t taken = 0, begins = 0;
        for (std::size_t g = 0; g < n; ++g) {
            taken += trial[g] == 1 ? 1 : 0;
            begins += trial[g] == 1 && trial[(g + n - 1) % n] == 0 ? 1 : 0;
        }
        REQUIRE(begins == (taken < n ? 1 : 0)); // the row continues at the first gene after the last
        ++of_length[taken];
    }
    for (std::size_t length = 1; length <= n; ++length) { // P(L >= l) = CR^(l - 1), 4 standard deviations
        const double p = std::pow(cr, static_cast<double>(length - 1)) * (length < n ? 1 - cr : 1);
        CHECK(std::abs(of_length[length] - trials * p) < 4 * std::sqrt(trials * p * (1 - p)));
    }
}

TEST_CASE("the history of L-SHADE holds weighted Lehmer means and final zeros") {
    SuccessHistory history(2);
    history.learn({{0.5, 0.2, 1}, {1, 0.6, 3}});
    history.learn({});
    history.learn({{0.4, 0, 2}});
    CHECK(history.F[0] == Approx(3.25 / 3.5));
    CHECK(history.CR[0] == Approx(1.12 / 2));
    CHECK(history.F[1] == Approx(0.4));
    history.next = 1;
    history.learn({{0.4, 0.9, 2}});
    CHECK(history.CR[1] < 0); // final
    history.CR[0] = -1;
    for (std::uint64_t i = 0; i < 200; ++i) {
        Stream stream(i);
        const auto [f, cr] = history.draw(stream);
        CHECK((f > 0 && f <= 1 && cr == 0));
    }
}

TEST_CASE("differential evolution and L-SHADE solve their published problems") {
    for (const std::string base : {"rand", "best", "current-to-best"})
        evaluations_to(1e-6, minimum(5, functions::sphere),
                       "sample 30 | score | until fitness 1e-6 { de " + base + " | score | duel }", 1, 20000);
    const std::string converging = "sample 20 | score | until converged 1e-9 evaluations 100000 ";
    for (const std::string crossing : {"bin", "exp"}) { // ends by itself, and at the bottom
        const auto result = run(converging + "{ de F=0.8 crossing=" + crossing + " | score | duel }",
                                minimum(5, functions::sphere), {}, {.seed = 1, .threads = 1});
        CHECK(result.best->value() < 1e-9);
        CHECK(result.counters.requested < 20000);
        for (const auto& individual : result.population) CHECK(individual.value() <= result.best->value() + 1e-9);
    }
    const std::string l_shade = "sample 180 | score | until fitness 1e-8 { l-shade | score | duel }";
    evaluations_to(1e-8, minimum(10, functions::rastrigin), (l_shade), 1, 60000);
    evaluations_to(1e-8, minimum(10, functions::rosenbrock), (l_shade), 1, 60000);
}

TEST_CASE("duel keeps the better of child and parent while L-SHADE's population shrinks") {
    std::vector<std::size_t> sizes;
    double worst = HUGE_VAL;
    const Observer<Vector> observer = [&](const auto& event) {
        if (!event.path.ends_with("duel.1")) return;
        sizes.push_back(event.population.size());
        double now = 0;
        for (const auto& each : event.population) now = std::max(now, each.value());
        CHECK(now <= worst); // no individual gets worse, and the worst are removed
        worst = now;
    };
    const auto result = run("sample 60 | score | until evaluations 2940 { l-shade evaluations=3000 | score | duel }",
                            minimum(5, functions::sphere), {}, {}, {observer});
    double spent = 60;
    for (const std::size_t size : sizes) {
        CHECK(static_cast<double>(size) == std::round(60 - 56 * spent / 3000)); // Eq. 10
        spent += static_cast<double>(size);
    }
    CHECK(sizes.back() == 4);
    CHECK(result.best->value() < 1e-3);
    const auto orphans = run("score | repeat 2 { duel }", given(), individuals({9, 1, 2}));
    CHECK(values_of(orphans.population) == Vector{9, 1, 2}); // without parents all stay
}

TEST_CASE("inherited step sizes multiply by log-normal factors in every generation") {
    for (const std::string steps : {"one", "each"}) {
        int generation = 0;
        const Watched watched{self_adaptive(0.001, steps), [&](const auto& before, const auto& now) {
                                  double mean = 0, square = 0, count = 0;
                                  for (const auto& [identity, sizes] : now.sizes)
                                      if (!before.sizes.count(identity))
                                          for (const double size : sizes) {
                                              mean += size - std::log(0.001);
                                              square += std::pow(size - std::log(0.001), 2);
                                              ++count;
                                          }
                                  CHECK(count == (steps == "one" ? 2000 : 16000));
                                  const double variance = // for n = 8
                                      steps == "one" ? 1.0 / 8 : 1.0 / 16 + 1 / (2 * std::sqrt(8.0));
                                  CHECK(square / count == Approx(++generation * variance).epsilon(0.15));
                                  CHECK(std::abs(mean / count) < 4 * std::sqrt(generation * variance / 2000));
                              }};
        run(reals("sample 2000 | score") | repeat(3, Pipeline<Reals>(watched) | reals("score")),
            minimum(8, functions::sphere), {});
        CHECK(generation == 3);
    }
}

TEST_CASE("a learning operator gives the same bits on any threads and after stops") {
    for (const std::string body : {"cma-es | score", "l-shade | score | duel", "self-adaptive 0.1 | score | plus",
                                   "tournament 2 | cross blend | self-adaptive steps=one | score | elite 2",
                                   "random | cross blend | score | crowding",
                                   "emit 7 first second sigma=0.05 | score | map-elites first second cells=5"}) {
        CAPTURE(body);
        Reals problem = minimum(10, functions::rastrigin);
        problem.features = {{"first", [](const Vector& x) { return x[0]; }, -5, 5},
                            {"second", [](const Vector& x) { return x[1] * x[2]; }, -5, 5}};
        const std::string pipeline = "sample 12 | score | repeat 25 { " + body + " }";
        const std::string whole = bits_of(run(pipeline, problem, {}, {.threads = 1}));
        CHECK(bits_of(run(pipeline, problem, {}, {.threads = 2})) == whole);
        CHECK(bits_of(run(pipeline, problem, {}, {.threads = 5})) == whole);
        CHECK(bits_of(in_pieces(pipeline, problem, 11)) == whole);
    }
}

TEST_CASE("an operator's state starts again with its block and differs between islands") {
    using Seen = Counting::Seen;
    CHECK(seen_in([](const auto& body) { return repeat(3, body); }) == Seen{{0, 0}, {1, 1}, {2, 2}});
    CHECK(seen_in([](const auto& body) { return restarts(3, body); }) == Seen{{0, 0}, {0, 1}, {0, 2}});
    CHECK(seen_in([](const auto& body) { return repeat(2, Pipeline<Reals>(repeat(2, body))); }) ==
          Seen{{0, 0}, {0, 0}, {1, 1}, {1, 1}});
    CHECK(seen_in([](const auto& body) { return islands(2, {.rounds = 2, .migrants = 0}, body); }) ==
          Seen{{0, 0}, {0, 0}, {1, 1}, {1, 1}});
}

TEST_CASE("a learning operator is refused when nothing repeats or scores it") {
    const auto refused = [](const std::string& pipeline, const std::string& message) {
        CHECK_THROWS_WITH(run(pipeline, Reals{}), Catch::Contains(message));
    };
    for (const std::string name : {"cma-es", "l-shade", "self-adaptive"})
        refused("sample 9 | score | " + name + " | score", "learns from one generation to the next");
    for (const std::string name : {"cma-es", "de"})
        refused("sample 9 | repeat 2 { " + name + " | score }", "needs a scored population");
    for (const std::string name : {"cma-es", "l-shade"})
        refused("sample 9 | pareto squares first | repeat 2 { " + name + " | score }", "one objective's");
    for (const std::string name : {"de", "l-shade"}) {
        refused("sample 9 | score | repeat 2 { " + name + " | score }",
                "replaces parents by children that may be worse; put duel after the score");
        refused("sample 3 | score | repeat 2 { " + name + " | score | duel }", " has 3 individuals; give 4 or more");
    }
    refused("sample 9 | score | best 5 | islands 8 { score }", " has 5 individuals; give 8 or more");
    refused("sample 12 | score | islands 4 { repeat 2 { de | score | duel } }", " has 3 individuals; give 4");
    refused("sample 9 | score | repeat 2 { cma-es restarts=often | score }", "; use bipop, ipop or none");
    refused("sample 9 | score | repeat 2 { de worst | score }", "; use rand, best or current-to-best");
    refused("sample 9 | score | repeat 2 { de crossing=Exp | score }", "crossing is 'Exp'; use bin or exp");
    refused("sample 9 | score | repeat 2 { self-adaptive steps=two | score }", "; use each or one");
    refused("sample 9 | score | repeat 2 { cma-es population=1 | score }", "population is '1'; give 0, or 2 or more");
}
