#include "ga/adaptation/adaptation.hpp"
#include "tests/ga/functions.hpp"

#include <catch2/catch.hpp>

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
    for (const double part : {0.999, 1.001}) {
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
