#include "apps/experiments/stability/reference.hpp"
#include "apps/prompt/model_settings.hpp"
#include "tests/apps/program.hpp"

#include <catch2/catch.hpp>

#include <set>

using app::testing::Folder;
using app::testing::rugosa;

TEST_CASE("no solver claims a wrong curve, and the automatic and nested ones solve whatever has a solution") {
    for (const app::StabilityScene& scene : app::stability_scenes()) {
        if (scene.profile.nodes() > 1000)
            continue; // rugosa stability tries them
        app::StabilityReference reference(scene);
        for (std::size_t method = 0; method < rough::solver_names().size(); ++method) {
            rough::ContactOptions options;
            options.solver = static_cast<rough::Solver>(method);
            app::ContactTrial trial = try_contact(scene, options, 30);
            reference.judge(trial, app::promised_tolerance(trial.curve, options));
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

TEST_CASE("rugosa stability writes its table and its page") {
    const Folder folder;
    const auto ended = rugosa("stability --scene spike --out s", folder.path());
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    const std::string table = rough::read_whole(folder / "s" / "stability.csv");
    CHECK(table.rfind("scene,kernel,method,outcome,kkt_residual,iterations,seconds,message\n", 0) == 0);
    CHECK(std::count(table.begin(), table.end(), '\n') == 16);
    CHECK_THAT(rough::read_whole(folder / "s" / "stability.html"), Catch::Contains("15 solved"));
    CHECK(rugosa("stability --scene spike --out s", folder.path()).code == 2);
    const auto unknown = rugosa("stability --scene spice", folder.path());
    CHECK(unknown.code == 2);
    CHECK(unknown.error_lines() == 1);
    CHECK_THAT(unknown.err, Catch::Contains("did you mean 'spike'"));
}
