#include "apps/prompt/model_settings.hpp"
#include "domain/contact/kernel.hpp"
#include "experiments/stability/stability.hpp"
#include "tests/apps/results.hpp"
#include "tests/domain/contact/oracle.hpp"

using namespace app::testing;

TEST_CASE("no solver claims a wrong curve, and the automatic and nested ones solve whatever has a solution") {
    for (const app::ContactScene& scene : app::stability_scenes()) {
        if (scene.profile.nodes() > 1000) continue; // rugosa stability tries them
        for (std::size_t method = 0; method < rough::solver_names().size(); ++method) {
            rough::ContactOptions options;
            options.solver = static_cast<rough::Solver>(method);
            app::ContactTrial trial = try_contact(scene, options, 30);
            verify(scene, trial);
            INFO(scene.name << ", " << rough::name_of(scene.body.kernel) << ", " << rough::solver_names()[method]
                            << ": " << trial.message);
            CHECK(trial.outcome != app::Outcome::wrong);
            const bool direct = options.solver == rough::Solver::automatic || options.solver == rough::Solver::nested;
            if (direct)
                CHECK((trial.outcome == app::Outcome::solved) ==
                      (scene.has_solution && !(scene.body.yields() && options.solver == rough::Solver::nested)));
        }
    }
}

TEST_CASE("the oracle in extended precision agrees with the curves of the stability scenes") {
    for (const app::ContactScene& scene : app::stability_scenes()) {
        if (scene.profile.nodes() > 1000 || !scene.has_solution || !scene.pressures.empty()) continue;
        INFO(scene.name << ", " << rough::name_of(scene.body.kernel));
        const rough::ContactCurve curve = try_contact(scene, {}).curve;
        const double largest = largest_displacement(scene.profile, scene.body), tolerance = 1e-9;
        for (const rough::LoadStep& step : curve.steps) {
            // First touch is compared at a small displacement. A node that just touches may count or not.
            const double range = scene.profile.heights.maxCoeff() - scene.profile.heights.minCoeff(),
                         at = step.displacement > 0 ? step.displacement : 1e-9 * range;
            const rough::Oracle oracle = consult_oracle(
                scene.profile, scene.body, {at * (1 - tolerance), std::min(at * (1 + tolerance), largest)});
            const auto expect_between = [&](double found, double low, double high) {
                const double slack = tolerance * std::max(std::abs(low), std::abs(high));
                CHECK(found >= std::min(low, high) - slack);
                CHECK(found <= std::max(low, high) + slack);
            };
            if (step.displacement > 0) expect_between(step.pressure, oracle.pressure[0], oracle.pressure[1]);
            expect_between(step.tangent_stiffness, oracle.tangent_stiffness[0], oracle.tangent_stiffness[1]);
            CHECK(step.contact_nodes >= oracle.contact_nodes[0]);
            CHECK(step.contact_nodes <= oracle.contact_nodes[1]);
        }
    }
}

namespace {

app::ContactScene parabola() {
    constexpr rough::Index nodes = 40;
    app::ContactScene scene;
    scene.profile = {Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes - 1)};
    for (rough::Index i = 0; i < nodes; ++i)
        scene.profile.heights[i] = -std::pow(static_cast<double>(i) * scene.profile.spacing - 0.47, 2);
    scene.body = completed(rough::Body{}, 1);
    scene.displacements = {0.02, 0.05, 0.1};
    return scene;
}

} // namespace

TEST_CASE("stability's verifier passes half a tolerance of error, and names twice as much") {
    constexpr double tolerance = 1e-4;
    const app::ContactScene scene = parabola();
    app::ContactTrial right = try_contact(scene, {.solver = rough::Solver::nested});
    right.tolerance = tolerance;
    const auto message = [&](auto corrupt) {
        app::ContactTrial trial = right;
        corrupt(trial.curve.steps[1]);
        verify(scene, trial);
        CHECK((trial.outcome == app::Outcome::wrong) == !trial.message.empty());
        return trial.message;
    };
    // Pressure is verified a tolerance of displacement to either side, which moves it by K Delta/P of that.
    const rough::LoadStep& step = right.curve.steps[1];
    const double twice = 2 + step.tangent_stiffness * step.displacement / step.pressure;
    for (const double off : {-tolerance, tolerance}) {
        CHECK(message([&](rough::LoadStep& one) { one.tangent_stiffness *= 1 + off / 2; }).empty());
        CHECK(message([&](rough::LoadStep& one) { one.pressure *= 1 + off / 2; }).empty());
        CHECK_FALSE(message([&](rough::LoadStep& one) { one.tangent_stiffness *= 1 + 2 * off; }).empty());
        CHECK_THAT(message([&](rough::LoadStep& one) { one.pressure *= 1 + twice * off; }),
                   Catch::Contains("pressure of step 2"));
        CHECK_THAT(message([&](rough::LoadStep& one) { one.contact_nodes += off > 0 ? 1 : -1; }),
                   Catch::Contains("contact nodes of step 2"));
    }
}

TEST_CASE("under a load a displacement, a stiffness or a load that is off is named") {
    for (const rough::Kernel kernel : {rough::Kernel::free, rough::Kernel::periodic}) {
        rough::Body body;
        body.kernel = kernel;
        const app::ContactScene scene = app::map_scene("map", body, {24, 20}, {0.8, 6, 1}, 0.3);
        const app::ContactTrial right = try_contact(scene, {});
        const auto message = [&](auto corrupt) {
            app::ContactScene verified = scene;
            app::ContactTrial trial = right;
            corrupt(trial.curve.steps[0], verified.pressures[0]);
            verify(verified, trial);
            CHECK((trial.outcome == app::Outcome::wrong) == !trial.message.empty());
            return trial.message;
        };
        CHECK(message([](const rough::LoadStep&, double) {}).empty());
        for (const double off : {0.999, 1.001}) {
            CHECK_THAT(message([&](rough::LoadStep& step, double) { step.displacement *= off; }),
                       Catch::Contains("pressure of step 1"));
            CHECK_THAT(message([&](const rough::LoadStep&, double& load) { load *= off; }),
                       Catch::Contains("pressure of step 1"));
            CHECK_THAT(message([&](rough::LoadStep& step, double) { step.tangent_stiffness *= off; }),
                       Catch::Contains("stiffness of step 1"));
        }
    }
}

TEST_CASE("stability's verdict names wrong curves first, then what auto failed on") {
    using Row = std::tuple<const char*, const char*, const char*, bool>; // scene, method, outcome, has a solution
    const auto verdict = [](const std::vector<Row>& rows) {
        nlohmann::json table = nlohmann::json::array();
        std::set<std::string> unsolvable;
        for (const auto& [scene, method, outcome, has_solution] : rows) {
            table.push_back({{"scene", scene}, {"kernel", "free"}, {"method", method}, {"outcome", outcome}});
            if (!has_solution) unsolvable.insert(std::string(scene) + " (free)");
        }
        return app::stability_verdict(table, unsolvable);
    };
    CHECK(verdict({}) == "No scene with a solution was tried.");
    CHECK(verdict({{"nan", "auto", "refused", false}}) == "No scene with a solution was tried.");
    CHECK(verdict({{"spike", "auto", "solved", true}, {"nan", "auto", "refused", false}}) ==
          "auto, the default, failed on none of the 1 scene with a solution, and no solver gave a wrong "
          "curve.");
    CHECK(verdict({{"spike", "auto", "solved", true},
                   {"spike", "nnls", "refused", true},
                   {"flat", "auto", "not-converged", true},
                   {"flat", "nnls", "solved", true}}) ==
          "auto, the default, failed on 1 of 2 scenes with a solution: flat (free), and no solver gave a wrong "
          "curve. Scenes without a right curve, with those refused: nnls 1.");
    CHECK(verdict({{"spike", "nnls", "wrong", true}, {"spike", "auto", "solved", true}}) ==
          "Wrong curves: nnls on spike (free). auto, the default, failed on none of the 1 scene with a "
          "solution. "
          "Scenes without a right curve, with those refused: nnls 1.");
    CHECK(verdict({{"nan", "auto", "wrong", false}}) ==
          "Wrong curves: auto on nan (free). No scene with a solution was tried.");
}

TEST_CASE("rugosa stability writes its table and its page") {
    const Folder folder;
    const auto ended = rugosa("stability --scene spike --out s", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    const std::string table = rough::read_whole(folder / "s" / "stability.csv");
    CHECK(table.rfind("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message\n", 0) == 0);
    CHECK(std::ranges::count(table, '\n') == 16);
    const std::string page = rough::read_whole(folder / "s" / "stability.html");
    CHECK(found(page, "(<tr><td>spike</td>)").size() == 3); // one row per kernel
}

TEST_CASE("a bred scene is pressed again from its name, and wrong names are refused") {
    const std::vector<double> genes{300, 350, 900, 600, 500, 123.4, 400, 700, 500, 300, 800, 0, 0, 0};
    const std::string name = app::bred_name(genes);
    CHECK(name == "bred 0.3,0.35,0.9,0.6,0.5,0.123,0.4,0.7,0.5,0.3,0.8,0,0,0");
    const app::ContactScene scene = app::bred_scene(name),
                            again = app::bred_scene(name.substr(0, name.size() - 6)); // a name with 11 genes
    CHECK(again.profile.heights == scene.profile.heights);
    CHECK(again.pressures == scene.pressures);
    CHECK(again.body.hardness == scene.body.hardness);
    CHECK(scene.steps() == 2);
    const app::ContactScene nearly_full = app::bred_scene("bred 0.3,0.35,0.5,0.6,0.5,0.123,0.4,0.7,0.5,0,0,0.3,1,1");
    CHECK(nearly_full.profile.row_spacing == Approx(10 * nearly_full.profile.spacing));
    CHECK(nearly_full.pressures[0] / full_contact_load(nearly_full.profile, nearly_full.body) ==
          Approx(1 - 1e-7).epsilon(1e-9));
    CHECK_THROWS_WITH(app::bred_scene("bred 0.3,0.35"), "a bred scene has 2 genes; give 14");
    CHECK_THROWS_WITH(app::bred_scene("bred 0.3,x"), "'x' is not a gene; give numbers from 0 to 1");
}

TEST_CASE("rugosa stability breeds scenes, and every solver tries the worst") {
    const Folder folder;
    const auto ended = rugosa("stability --search 30 --out s", folder.path());
    CAPTURE(ended.err);
    CHECK(ended.code == 0);
    const std::string table = rough::read_whole(folder / "s" / "stability.csv");
    CHECK(std::ranges::count(table, '\n') == 1 + 10 * 5);
    CHECK_THAT(table, Catch::Contains("bred 0."));
}
