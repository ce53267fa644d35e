#include "ga/adaptation/adaptation.hpp"
#include "ga/checkpoint/checkpoint.hpp"
#include "tests/folder.hpp"
#include "tests/ga/functions.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace ga;

namespace {

using Vector = std::vector<double>;
const Population<Vector> nobody = population<Vector>({{}});

/// An operator that learns, whose state is shown before and after each of its generations.
template <class Op>
struct Watched : Op {
    using State = typename Op::State;
    using Look =
        std::function<void(const State& before, const State& after, const Population<Vector>& given)>;
    Look look;

    Population<Vector> operator()(Population<Vector> population, Context<Function>& context,
                                  State& state) const {
        const State before = state;
        const Population<Vector> given = population;
        auto next = Op::operator()(std::move(population), context, state);
        look(before, state, given);
        return next;
    }
};

template <class Op>
Watched<Op> watched(Op op, typename Watched<Op>::Look look) {
    return {std::move(op), std::move(look)};
}

} // namespace

TEST_CASE("every run of BIPOP-CMA-ES begins round, at its own share of the first step") {
    int large = 0, small = 0;
    const auto cma = watched(cma_es(0.2), [&](const CmaEs::State&, const CmaEs::State& now, const auto&) {
        if (now.cloud.learnt > 0)
            return;
        CHECK(now.cloud.sigma == Approx(0.2 * now.run.shrink));
        CHECK(now.cloud.covariance == Eigen::MatrixXd::Identity(3, 3));
        CHECK(now.record.spent == 0);
        (now.run.shrink < 1 ? small : large) += 1;
    });
    const Function flat{3, [](const Vector&) { return 1.0; }}; // where every run is over soon
    run(Stage<Function>(sample(1)) | score() | Stage<Function>(repeat(100, Stage<Function>(cma) | score())),
        flat, nobody);
    CHECK(large > 2);
    CHECK(small > 2);
}

TEST_CASE("the path of C stands still where the first step is longer than by chance") {
    // In the first generation the path of sigma is sqrt(mu_eff) times the step's part (Hansen's tutorial, Eq.
    // 43 and h_sigma below Eq. 45): it is long above (1.4 + 2 / (n + 1)) E|N|.
    const CmaConstants c(4, 8);
    const double limit = (1.4 + 2.0 / 5) * c.chi / std::sqrt(c.mu_eff);
    for (const double part : {0.999, 1.001}) { // of that length
        Cloud cloud(Eigen::VectorXd::Zero(4), 1);
        cloud.learn(c, part * limit * Eigen::Vector4d(0.5, -0.5, 0.5, 0.5) * Eigen::RowVectorXd::Ones(8));
        CHECK((cloud.path_c.norm() > 0) == (part < 1));
    }
}

TEST_CASE("the archive of L-SHADE holds the parents that were beaten, as many as it has room for") {
    std::vector<Vector> beaten; // all there ever were
    std::size_t fullest = 0;
    auto adapting = l_shade();
    adapting.archive = 2;
    const auto l_shade = watched(adapting, [&](const LShade::State& before, const LShade::State& now,
                                               const Population<Vector>& given) {
        std::size_t more = 0;
        for (const LShade::Trial& trial : before.trials)
            for (const auto& child : given)
                if (child.identity == trial.child && child.value() < trial.merit * -1) {
                    beaten.push_back(trial.parent);
                    ++more;
                }
        CHECK(now.beaten.size() == std::min(before.beaten.size() + more, 2 * given.size()));
        for (const Vector& each : now.beaten)
            CHECK(std::find(beaten.begin(), beaten.end(), each) != beaten.end());
        fullest = std::max(fullest, now.beaten.size());
    });
    run(Stage<Function>(sample(10)) | score() |
            Stage<Function>(repeat(30, Stage<Function>(l_shade) | score() | duel())),
        Function{3, functions::sphere}, nobody);
    CHECK(fullest == 20);
}

TEST_CASE("L-SHADE takes for a success whoever is nearer to holding its constraints, or holds them") {
    /// The sphere, whose values above 20 violate by a hundredth of the rest.
    struct Fenced : Function {
        double violation(const double& y) const { return (y - 20) / 100; }
    };
    struct Look : LShade {
        std::shared_ptr<std::vector<std::size_t>> seen = std::make_shared<std::vector<std::size_t>>();
        Population<Vector> operator()(Population<Vector> population, Context<Fenced>& context,
                                      State& state) const {
            std::size_t more = 0, entered = 0;
            for (const Trial& trial : state.trials)
                for (const auto& child : population)
                    if (child.identity == trial.child) {
                        const double parent = functions::sphere(trial.parent), own = child.value();
                        more += own < parent ? 1 : 0;
                        entered += own < parent && parent > 20 && own <= 20 ? 1 : 0;
                    }
            const std::size_t before = state.beaten.size();
            auto next = LShade::operator()(std::move(population), context, state);
            CHECK(state.beaten.size() == before + more);
            seen->push_back(entered);
            return next;
        }
    } look;
    look.archive = 100; // room for all
    run(Stage<Fenced>(sample(20)) | score() |
            Stage<Fenced>(repeat(10, Stage<Fenced>(look) | score() | duel())),
        Fenced{{3, functions::sphere}}, nobody);
    CHECK(std::accumulate(look.seen->begin(), look.seen->end(), std::size_t{0}) > 2);
}

TEST_CASE("fewer children than were drawn teach by the weights they have, and axes follow at once") {
    const CmaConstants c(2, 6);
    REQUIRE(c.every == 1);
    const Eigen::Vector2d step(0.5, -0.25);
    Cloud cloud(Eigen::Vector2d(1, 2), 0.5);
    cloud.learn(c, step); // one: the mean goes all the way to it
    CHECK((cloud.mean - Eigen::Vector2d(1.25, 1.875)).norm() < 1e-15);
    const Eigen::MatrixXd again = cloud.axes * cloud.scales.cwiseAbs2().asDiagonal() * cloud.axes.transpose();
    CHECK((again - cloud.covariance).norm() < 1e-14);
    CHECK((cloud.covariance - Eigen::Matrix2d::Identity()).norm() > 0.01);
}

TEST_CASE("a bad child that was altered teaches nothing, and a good one all") {
    const CmaConstants c(2, 6);
    Eigen::MatrixXd steps(2, 6);
    steps << 1, 0.3, -0.2, 0.9, -1.5, 0.1, 0.5, -1, 0.4, 1.1, 0.2, 2;
    const auto learnt = [&](const Eigen::MatrixXd& from, const std::vector<bool>& altered) {
        Cloud cloud(Eigen::Vector2d(1, 2), 0.5);
        cloud.learn(c, from, altered);
        return cloud;
    };
    const Cloud whole = learnt(steps, {});
    CHECK(learnt(steps, {true, true, true, false, false, false}).covariance == whole.covariance);
    // What is taken away is c_mu |w| (n y y' / |y|^2 - C): Eq. 46 and 47 from C = I.
    const Eigen::Vector2d y = steps.col(4);
    const double w = c.c_mu * c.weights[4];
    const Eigen::Matrix2d less = w * (2 * y * y.transpose() / y.squaredNorm() - Eigen::Matrix2d::Identity());
    const Cloud without = learnt(steps, {false, false, false, false, true});
    CHECK((without.covariance - (whole.covariance - less)).norm() < 1e-15);
    CHECK(without.mean == whole.mean);
    CHECK(without.sigma == whole.sigma);
}

TEST_CASE("whatever begets children leaves the population unscored") {
    const auto leaves = [](const auto& op) {
        CheckState known;
        known.objectives = {"f"};
        known.scored = known.start_scored = "f";
        known.in_generation = true;
        op.check(known);
        return known.scored.has_value();
    };
    CHECK_FALSE(leaves(cma_es()));
    CHECK_FALSE(leaves(l_shade()));
    CHECK_FALSE(leaves(differential_evolution()));
    CHECK_FALSE(leaves(self_adaptive()));
    CHECK_FALSE(leaves(emit(1, {"x"})));
    CHECK_FALSE(leaves(sample(1)));
    CHECK_FALSE(leaves(mutate(0.1)));
    CHECK_FALSE(leaves(cross(uniform())));
    CHECK(leaves(duel()));
    CHECK(leaves(crowding()));
    CHECK(leaves(map_elites({"x"})));
}

TEST_CASE("of many children's parents sigma is damped by Eq. 55") {
    const CmaConstants c(2, 200);
    REQUIRE(c.mu_eff > 4); // (mu_eff - 1) / (n + 1) is above 1
    CHECK(c.d_sigma == Approx(1 + 2 * (std::sqrt((c.mu_eff - 1) / 3) - 1) + c.c_sigma).epsilon(1e-14));
}

TEST_CASE("a step size is inherited from oneself: its logarithm walks on with every generation") {
    int generation = 0;
    const auto walk = watched(self_adaptive(0.001, "one"), [&](const SelfAdaptive::State& before,
                                                               const SelfAdaptive::State& now, const auto&) {
        double square = 0, count = 0;
        for (const auto& [identity, size] : now.sizes)
            if (!before.sizes.count(identity)) {
                square += std::pow(size[0] - std::log(0.001), 2);
                ++count;
            }
        CHECK(count == 2000);
        CHECK(square / count == Approx(++generation / 8.0).epsilon(0.15)); // t^2 = 1/n each
    });
    run(Stage<Function>(sample(2000)) | score() | Stage<Function>(repeat(3, Stage<Function>(walk) | score())),
        Function{8, functions::sphere}, nobody);
    CHECK(generation == 3);
}

TEST_CASE("a run that stopped inside an operator that learns is resumed to the uninterrupted result") {
    const tests::Folder folder;
    const Function steps{3, [](const Vector& x) { return std::floor(functions::sphere(x)); }};
    const Stage<Function> pipeline =
        Stage<Function>(sample(1)) | score() | Stage<Function>(repeat(90, cma_es() | score()));
    const auto whole = run(pipeline, steps, nobody);
    Checkpoints<Function> kept(folder / "run", "", false), resumed(folder / "run", "", true);
    const std::size_t one = sizeof(Individual<Vector>) + 3 * sizeof(double);
    const auto part = run(pipeline, steps, nobody, {.population_bytes = 10 * one}, {}, &kept);
    CHECK(part.stopped == "pipeline/repeat.1/cma-es.1: a population of 14 exceeds the 0 MB for one");
    CHECK(part.counters.asked < whole.counters.asked);
    const auto rest = run(pipeline, steps, nobody, {}, {}, &resumed);
    CHECK(json(rest.population) == json(whole.population));
    CHECK(json(*rest.best) == json(*whole.best));
    CHECK(json(rest.counters) == json(whole.counters));
}

TEST_CASE("a checkpoint of what learns is refused where it does not fit, though its seal is whole") {
    const tests::Folder folder;
    const Function f{3, functions::sphere};
    const auto refused = [&](const Stage<Function>& pipeline, const std::vector<std::string>& places,
                             const std::vector<json>& values, const std::string& place_of,
                             const json& as_it_is) {
        Checkpoints<Function> write(folder / "run", "", false);
        run(pipeline, f, nobody, {.budget = {.evaluations = 40}}, {}, &write);
        const json good = json::from_cbor(opened(folder / "run"));
        const auto resumed_with = [&](const std::string& place, const json& value) {
            json altered = good;
            for (auto& frame : altered["snapshot"][0])
                for (auto& state : frame[4])
                    state[json::json_pointer(place)] = value;
            const auto bytes = json::to_cbor(altered);
            seal(folder / "run", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
            Checkpoints<Function> resume(folder / "run", "", true);
            return run(pipeline, f, nobody, {}, {}, &resume);
        };
        for (const std::string& place : places)
            for (const json& value : values) {
                CAPTURE(place, value);
                CHECK_THROWS_WITH(resumed_with(place, value),
                                  "the checkpoint does not fit its pipeline; expected "
                                  "one that was written by it");
            }
        CHECK(resumed_with(place_of, as_it_is).stopped.empty());
    };
    refused(Stage<Function>(sample(1)) | score() | Stage<Function>(repeat(30, cma_es() | score())),
            {"/0", "/1", "/2", "/2/0", "/2/2", "/2/3", "/2/4", "/2/5", "/2/6", "/3", "/8"},
            {Vector{1, 2}, Vector(10, 1.0), "text"}, "/7", false);
    refused(Stage<Function>(sample(1)) | score() | Stage<Function>(repeat(30, cma_es() | score())), {"/8"},
            {std::vector<bool>(2), std::vector<bool>(50)}, "/7", false);
    const auto shade =
        Stage<Function>(sample(10)) | score() | Stage<Function>(repeat(30, l_shade() | score() | duel()));
    refused(shade, {"/0", "/1"}, {Vector{1, 2}, Vector(7, 1.0), Vector(), "text"}, "/5", 10);
    refused(shade, {"/2"}, {6, "text"}, "/5", 10);
}

TEST_CASE("CMA-ES that gets no whole child of its own back draws from the same cloud again") {
    /// Others in everybody's place.
    struct Strangers : Operator {
        std::string text() const { return "strangers"; }
        void check(CheckState&) const {}
        Population<Vector> operator()(Population<Vector> population, Context<Function>& context) const {
            for (auto& each : population)
                context.make_child(each, Parents());
            return population;
        }
    };
    const Function sphere{3, functions::sphere};
    const auto check = [&](const auto& between) {
        int looked = 0;
        const auto cma =
            watched(cma_es(), [&](const CmaEs::State& before, const CmaEs::State& now, const auto&) {
                if (before.moving.empty())
                    return;
                CHECK(now.cloud.mean == before.cloud.mean);
                CHECK(now.cloud.covariance == before.cloud.covariance);
                CHECK(now.cloud.sigma == before.cloud.sigma);
                CHECK(now.record.spent == 0);
                CHECK(now.children != before.children);
                ++looked;
            });
        const auto result = run(Stage<Function>(sample(1)) | score() |
                                    Stage<Function>(repeat(5, Stage<Function>(cma) | between | score())),
                                sphere, nobody);
        CHECK(looked == 4);
        return result.population.front().genome.size();
    };
    CHECK(check(Strangers()) == 3);
    CHECK(check(transform("cut", [](Vector x) { return x.resize(2), x; })) == 2);
}

TEST_CASE("a stage that is left with too few, or nobody it can use, ends the run and says how many it had") {
    Function f{2, functions::sphere};
    f.features = {{"none", [](const Vector&) { return std::nan(""); }, -1, 1}};
    const Combine<Vector> none{"none", [](const auto&, const auto&) { return std::optional<Vector>(); }};
    const auto ends = [&](const Stage<Function>& stage, const std::string& message) {
        CHECK_THROWS_WITH(run(Stage<Function>(sample(3)) | score() | stage | score(), f, nobody),
                          "pipeline/" + message);
        CHECK_THROWS_AS(run(Stage<Function>(sample(3)) | score() | stage | score(), f, nobody), NothingLeft);
    };
    const auto again = [](const auto& op) { return Stage<Function>(repeat(2, op | score())); };
    ends(islands(4, {}, Stage<Function>(score())),
         "islands.1: 3 individuals for 4 islands; expected one each at least");
    ends(again(l_shade()), "repeat.1/l-shade.1: 3 individuals; expected 4 at least");
    ends(differential_evolution(), "de.1: 3 individuals; expected 4 at least");
    ends(pair(Stage<Function>(score()) | best(2), Stage<Function>(score()), none),
         "pair.1: 2 and 3 individuals gave no child by none");
    ends(again(map_elites({"none"})), "repeat.1/map-elites.1: nobody has descriptors that are numbers");
    f.f = [](const Vector& x) { return x[0] > 50 ? std::nan("") : x[0]; };
    f.list.push_back({"g", [](const double& y) { return -y; }, true});
    const auto away = transform("away", [](const Vector&) { return Vector{99, 99}; });
    ends(Stage<Function>(away) | pareto({"f", "g"}) | front(),
         "front.1: every one of 3 individuals failed; the first: fitness f is nan");
}

TEST_CASE("where no gene may move, differential evolution leaves genomes as they are and CMA-ES says so") {
    const auto start = population<Vector>({{1, 2}, {3, 4}, {5, 6}, {7, 8}});
    const auto after = run(Stage<Function>(score()) | differential_evolution() | score(),
                           Function{0, functions::sphere}, start)
                           .population;
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(after[i].genome == start[i].genome);
    CHECK_THROWS_WITH(run(Stage<Function>(score()) | Stage<Function>(repeat(2, cma_es() | score())),
                          Function{2, functions::sphere, 1, 1}, start),
                      "cma-es: the genome has no gene that may move");
    CHECK_THROWS_WITH(cma_es(0.3, "bipop", 1),
                      "stage 'cma-es': population is '1'; expected 0, or 2 at least");
}
