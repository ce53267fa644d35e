#include "apps/experiments/script.hpp"
#include "apps/prompt/model_settings.hpp"
#include "experiments/paper/paper.hpp"

namespace app {

Experiment readings_experiment() {
    return {
        .kind = "readings",
        .settings = joined(
            {{Setting("readings.quick", "off",
                      "on tries one choice at a time and two databases: 3 minutes of processor time")
                  .of({"off", "on"}),
              ga::whole("readings.databases", "20", 0, "databases with other phases, tried under our reading")
                  .up_to(1000),
              max_pressure_setting("readings.", "1.6e-4")},
             model_settings("model.")}),
        .files = {"cells.csv", "claims.csv", "shares.csv", "readings.json", "targets"},
        .run =
            [](const Settings& settings, const RunConditions& conditions) {
                expect_none(settings, {"model.kernel", "model.datum", "model.reach"},
                            "cannot be set, because the readings try several values; omit it");
                model_from(settings, "model.");
                nlohmann::json claims;
                for (const Claim& claim : paper_claims())
                    if (claim.rule() != "cannot be decided")
                        claims.push_back(
                            {{"id", claim.id}, {"place", claim.place}, {"says", claim.sentence}});
                return findings_of_script(settings, conditions, {{"claims", claims}});
            },
        .resumes = true};
}

} // namespace app
