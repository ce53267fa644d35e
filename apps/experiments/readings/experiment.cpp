#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/readings/cross.hpp"
#include "apps/experiments/study.hpp"
#include "apps/prompt/model_settings.hpp"
#include "domain/text/json.hpp"

namespace app {

namespace {

std::vector<Setting> readings_settings() {
    return joined({{{"readings.quick", "off", "on tries one choice at a time and two databases: a minute"},
                    {"readings.databases", "20",
                     "databases with other phases, from each of which one choice at a "
                     "time is tried"},
                    {"readings.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                   model_settings("model.")});
}

/// A row a cell, a column a claim (1 holds, 0 does not, empty cannot be said).
std::string cells_csv(const ReadingCross& cross) {
    std::string text;
    for (const ReadingAxis& axis : reading_axes())
        text += axis.name + ",";
    text += "database,target";
    for (std::size_t c = 0; c < cross.claims.size(); ++c)
        text += ",claim_" + std::to_string(c + 1);
    for (const ReadingCell& cell : cross.cells) {
        text += "\n";
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
            text += "\"" + reading_axes()[axis].values[cell.reading[axis]] + "\",";
        text += std::to_string(cell.database) + "," + cell.target;
        for (const char sign : cell.holds)
            text += sign == '?' ? std::string(",") : std::string(",") + sign;
    }
    return text + "\n";
}

Study study_of(const ReadingCross& cross) {
    Csv claims("claim,place,says,choice,value,share_holds");
    for (std::size_t c = 0; c < cross.claims.size(); ++c)
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
            for (std::size_t value = 0; value < reading_axes()[axis].values.size(); ++value)
                claims.row(c + 1, cross.claims[c].first, cross.claims[c].second, reading_axes()[axis].name,
                           reading_axes()[axis].values[value], cross.share(c, [&](const ReadingCell& cell) {
                               return cell.database == 0 && cell.reading[axis] == value;
                           }));
    Study study{.words = readings_words(cross), .marked_up = true};
    study.tables.push_back({"claims.csv", "claims", claims});
    study.result = {{"searches", cross.searches}, {"curves", cross.curves}};
    for (const Reading& reading : cross.ranked()) {
        nlohmann::json one{{"claims_hold", cross.holding(reading)}};
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
            one[reading_axes()[axis].name] = reading_axes()[axis].values[reading[axis]];
        study.result["readings"].push_back(std::move(one));
    }
    study.files = {{"cells.csv", cells_csv(cross)}, {"runs.csv", run_columns() + "\n" + cross.runs}};
    return study;
}

Findings run_readings(const Settings& settings, const Conditions& conditions) {
    const ReadingCross cross = tried_readings(settings, conditions);
    if (cross.cells.empty())
        return {};
    Study study = study_of(cross);
    nlohmann::json told{{"command", conditions.origin.command}, {"version", conditions.origin.version}};
    std::size_t column = 0;
    for (const Claim& claim : paper_claims())
        if (claim.depends_on_reading)
            told["claims"][claim.id] = claim_words(cross, column++);
    study.files.emplace_back("readings.json", rough::json_text(told) + "\n"); // what the paper's page takes
    return findings_of(conditions, "The paper under every reading", std::move(study),
                       [cross](Page& page) { fill_readings_page(page, cross); });
}

} // namespace

Experiment readings_experiment() {
    return {.kind = "readings",
            .summary = "the paper's claims under every reading that its text allows",
            .settings = readings_settings(),
            .files = {"cells.csv", "claims.csv", "runs.csv", "readings.json", "targets"},
            .run = run_readings,
            .resumes = true};
}

} // namespace app
