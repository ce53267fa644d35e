#include "apps/experiments/solvers/stability.hpp"
#include "apps/prompt/model_settings.hpp"
#include "tests/apps/found.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace app::testing;

TEST_CASE("no solver claims a wrong curve, and the automatic and nested ones solve whatever has a solution") {
    for (const app::StabilityScene& scene : app::stability_scenes()) {
        if (scene.profile.nodes() > 1000)
            continue; // rugosa stability tries them
        app::StabilityReference reference(scene);
        for (std::size_t method = 0; method < rough::solver_names().size(); ++method) {
            rough::ContactOptions options;
            options.solver = static_cast<rough::Solver>(method);
            app::ContactTrial trial = try_contact(scene, options, 30);
            reference.verifier(trial, app::promised_tolerance(trial.curve, options));
            INFO(scene.name << ", " << rough::name_of(scene.body.kernel) << ", "
                            << rough::solver_names()[method] << ": " << trial.message);
            CHECK(trial.outcome != app::Outcome::wrong);
            const bool direct =
                options.solver == rough::Solver::automatic || options.solver == rough::Solver::nested;
            if (direct)
                CHECK((trial.outcome == app::Outcome::solved) == scene.has_solution);
        }
    }
}

namespace {

app::StabilityScene parabola(rough::Index nodes) {
    app::StabilityScene scene;
    scene.profile = {Eigen::VectorXd(nodes), 1.0 / static_cast<double>(nodes - 1)};
    for (rough::Index i = 0; i < nodes; ++i)
        scene.profile.heights[i] = -std::pow(static_cast<double>(i) * scene.profile.spacing - 0.47, 2);
    scene.body = completed(rough::Body{}, 1);
    scene.displacements = {0.02, 0.05, 0.1};
    return scene;
}

} // namespace

TEST_CASE(
    "stability's verifier passes what is wrong by half a tolerance and names what is wrong by twice it") {
    constexpr double tolerance = 1e-4;
    for (const rough::Index nodes : {40, 300}) { // the oracle verifies, or another solver
        const app::StabilityScene scene = parabola(nodes);
        rough::ContactOptions options;
        options.solver = rough::Solver::nested;
        const app::ContactTrial right = try_contact(scene, options);
        app::StabilityReference reference(scene);
        const auto verified = [&](auto corrupt) {
            app::ContactTrial trial = right;
            corrupt(trial.curve.steps[1]);
            reference.verifier(trial, tolerance);
            return trial;
        };
        for (const double sign : {-1.0, 1.0}) {
            const auto pressure = [&](double by) {
                return verified([&](rough::LoadStep& step) { step.pressure *= 1 + sign * by * tolerance; });
            };
            const auto stiffness = [&](double by) {
                return verified(
                    [&](rough::LoadStep& step) { step.tangent_stiffness *= 1 + sign * by * tolerance; });
            };
            INFO(nodes << " nodes, " << sign);
            CHECK(pressure(0.5).outcome == app::Outcome::solved);
            CHECK(stiffness(0.5).outcome == app::Outcome::solved);
            CHECK(stiffness(2).outcome == app::Outcome::wrong);
            // The oracle is asked a tolerance to either side, which moves the pressure by K Delta/P of it.
            const rough::LoadStep& step = right.curve.steps[1];
            const double steepness = step.tangent_stiffness * step.displacement / step.pressure;
            const app::ContactTrial wrong = pressure(2 + steepness);
            CHECK(wrong.outcome == app::Outcome::wrong);
            CHECK_THAT(wrong.message, Catch::Contains("pressure of step 2"));
            const app::ContactTrial miscounted =
                verified([&](rough::LoadStep& one) { one.contact_nodes += sign > 0 ? 1 : -1; });
            CHECK(miscounted.outcome == app::Outcome::wrong);
            CHECK_THAT(miscounted.message, Catch::Contains("contact nodes of step 2"));
        }
        for (const std::size_t j : {0u, 2u}) {
            app::ContactTrial trial = right;
            trial.curve.steps[j].pressure *= 1.01;
            reference.verifier(trial, tolerance);
            CHECK_THAT(trial.message, Catch::Contains("pressure of step " + std::to_string(j + 1)));
        }
        app::ContactTrial refused = right;
        refused.outcome = app::Outcome::refused;
        refused.curve.steps[0].pressure *= 2;
        reference.verifier(refused, tolerance);
        CHECK(refused.outcome == app::Outcome::refused);
    }
}

TEST_CASE("first touch has no pressure and the stiffness of the nodes that touch, by which it is verified") {
    app::StabilityScene scene = parabola(40);
    scene.displacements = {0, 0.05};
    app::StabilityReference reference(scene);
    const app::ContactTrial right = try_contact(scene, {});
    app::ContactTrial trial = right;
    reference.verifier(trial, 1e-6);
    CHECK(trial.outcome == app::Outcome::solved);
    trial.curve.steps[0].tangent_stiffness *= 1 + 2e-6;
    reference.verifier(trial, 1e-6);
    CHECK(trial.outcome == app::Outcome::wrong);
    trial = right;
    trial.curve.steps[0].pressure = 1e-15;
    reference.verifier(trial, 1e-6);
    CHECK(trial.outcome == app::Outcome::wrong);
}

TEST_CASE("a trial's residual is the worst of its steps, and one out of time says so") {
    app::ContactTrial trial;
    CHECK(trial.kkt_residual() == 0);
    trial.curve.steps.resize(3);
    trial.curve.steps[0].kkt_residual = 1e-12;
    trial.curve.steps[1].kkt_residual = 3e-10;
    CHECK(trial.kkt_residual() == 3e-10);
    const app::ContactTrial late = try_contact(parabola(300), {}, -1);
    CHECK(late.outcome == app::Outcome::not_converged);
    CHECK(late.message == "stopped after -1 s");
    CHECK(try_contact(parabola(300), {}, 1000).message.empty());
}

TEST_CASE("direct solvers are held to 1e-9 whatever was asked for, iterative ones to ten times that") {
    rough::ContactCurve curve;
    rough::ContactOptions options;
    options.tolerance = 1e-5;
    const auto promised = [&](rough::Solver solver) {
        curve.solver = solver;
        return app::promised_tolerance(curve, options);
    };
    CHECK(promised(rough::Solver::nested) == 1e-9);
    CHECK(promised(rough::Solver::nnls) == 1e-9);
    CHECK(promised(rough::Solver::active_set) == Approx(1e-4));
    CHECK(promised(rough::Solver::polonsky_keer) == Approx(1e-4));
}

TEST_CASE("the stability table names all its scenes") {
    std::set<std::string> names;
    for (const app::StabilityScene& scene : app::stability_scenes())
        names.insert(scene.name);
    for (const char* name : {"first-touch",    "two-equal-summits", "plateau",
                             "flat",           "full-contact",      "near-full-contact",
                             "zero-approach",  "one-node-out",      "nyquist-wave",
                             "beyond-nyquist", "heights-1e-12",     "heights-1e12",
                             "offset-1e6",     "datum-above-limit", "datum-below-limit",
                             "datum-below-L",  "modulus-1e-6",      "modulus-1e12",
                             "nodes-2",        "nodes-3",           "nodes-65536",
                             "step-1e-6",      "single-step",       "spike",
                             "saw-tooth",      "denormal",          "nan",
                             "infinity",       "periodic-jump",     "narrow-strip"})
        CHECK(names.erase(name) == 1);
    CHECK(names.empty());
}

TEST_CASE("scenes of another scale, offset or spike are as high and as far off as their names say") {
    const auto scenes = app::stability_scenes();
    const auto heights = [&](const std::string& name) {
        for (const auto& scene : scenes)
            if (scene.name == name)
                return scene.profile.heights;
        FAIL("no scene " << name);
        return Eigen::VectorXd();
    };
    const auto range = [](const Eigen::VectorXd& z) { return z.maxCoeff() - z.minCoeff(); };
    CHECK(range(heights("heights-1e-12")) == Approx(1e-12));
    CHECK(range(heights("heights-1e12")) == Approx(1e12));
    CHECK(heights("offset-1e6").minCoeff() > 0.99e6);
    Eigen::VectorXd spike = heights("spike");
    Eigen::Index at = 0;
    const double top = spike.maxCoeff(&at);
    spike[at] = spike.minCoeff();
    CHECK(top - spike.maxCoeff() == Approx(10 * range(spike)).epsilon(0.01));
}

TEST_CASE("rugosa stability writes its table and its page") {
    const Folder folder;
    const auto ended = rugosa("stability --scene spike --out s", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    const std::string table = rough::read_whole(folder / "s" / "stability.csv");
    CHECK(table.rfind("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message\n", 0) == 0);
    CHECK(std::count(table.begin(), table.end(), '\n') == 16);
    const std::string page = rough::read_whole(folder / "s" / "stability.html");
    CHECK(found(page, "(<tr><td>spike</td>)").size() == 3); // one row per kernel
    CHECK_THAT(page, Catch::Contains("15 solved") && Catch::Contains("in extended precision"));
    CHECK(app::testing::outline(page) ==
          app::testing::Outline{"table Outcomes of each method over all scenes", "# Outcome of each scene",
                                "table "});
    CHECK(rugosa("stability --scene spike --out s", folder.path()).code == 2);
    check_refused(rugosa("stability --scene spice", folder.path()), "did you mean 'spike'");
}

TEST_CASE("a rough scene repeats, and a fault is told in digits that show it") {
    for (const auto& scene : app::stability_scenes())
        if (scene.name == "modulus-1e-6") {
            // Whole numbers of waves, the shortest of four nodes: nothing is in the grid's own.
            const Eigen::VectorXd& z = scene.profile.heights;
            double alternating = 0;
            for (rough::Index k = 0; k < z.size(); ++k)
                alternating += k % 2 ? -z[k] : z[k];
            CHECK(std::abs(alternating) < 1e-12 * z.cwiseAbs().sum());
        }
    const app::StabilityScene scene = parabola(40);
    app::ContactTrial trial = try_contact(scene, {});
    trial.curve.steps[1].pressure = 0.123456789012;
    app::StabilityReference(scene).verifier(trial, 1e-6);
    CHECK_THAT(trial.message, Catch::Contains("is 0.123456789012 where"));
    const double before = app::processor_seconds();
    const app::ContactTrial timed = try_contact(scene, {});
    CHECK(timed.seconds >= 0);
    CHECK(timed.seconds <= app::processor_seconds() - before);
}
