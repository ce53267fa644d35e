#include "ga/adaptation/adaptation.hpp"
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

TEST_CASE("whatever begets children leaves the population unscored") {
    const auto leaves = [](const auto& op) {
        Known known;
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
