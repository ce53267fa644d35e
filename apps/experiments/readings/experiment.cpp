#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/readings/cross.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/csv.hpp"
#include "apps/report/output.hpp"
#include "apps/report/result.hpp"
#include "apps/report/units.hpp"
#include "domain/text/atomic_file.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

using nlohmann::json;

std::vector<Setting> readings_settings() {
    return joined({{{"readings.quick", "off", "on tries one choice at a time and two databases: a minute"},
                    {"readings.databases", "20",
                     "databases with other phases, from each of which one choice at a "
                     "time is tried"},
                    {"readings.max-pressure", "1.6e-4", "p_max of Eq. 11, MPa"}},
                   model_settings("model.")});
}

bool is_from_sobol(const ReadingCell& cell) { return cell.database == 0; }

double share_with(const ReadingCross& cross, std::size_t claim, std::size_t axis, std::size_t value) {
    return cross.share(
        claim, [&](const ReadingCell& cell) { return is_from_sobol(cell) && cell.reading[axis] == value; });
}

/// The spread of a claim's share over the values of one choice.
struct Spread {
    std::size_t axis = 0, lowest = 0, highest = 0;
    double lowest_share = 2, highest_share = -1;
    double width() const { return highest_share - lowest_share; }
};

/// The spread over the choice that decides most of a claim; none if no choice moves the share by 0.05.
std::optional<Spread> widest(const ReadingCross& cross, std::size_t claim) {
    std::optional<Spread> widest;
    for (std::size_t axis = 0; axis < reading_axes_count; ++axis) {
        Spread spread{.axis = axis};
        for (std::size_t value = 0; value < reading_axes()[axis].values.size(); ++value) {
            const double share = share_with(cross, claim, axis, value);
            if (share < spread.lowest_share)
                spread.lowest = value, spread.lowest_share = share;
            if (share > spread.highest_share)
                spread.highest = value, spread.highest_share = share;
        }
        if (spread.width() >= 0.05 && (!widest || spread.width() > widest->width()))
            widest = spread;
    }
    return widest;
}

/// What the readings make of a claim, in words: the column "Other readings" of the paper's page.
std::string claim_words(const ReadingCross& cross, std::size_t claim) {
    double holds = 0, undecidable = 0, cells = 0;
    for (const ReadingCell& cell : cross.cells)
        if (is_from_sobol(cell))
            ++cells, holds += cell.holds[claim] == '1', undecidable += cell.holds[claim] == '?';
    std::string words = "holds in " + percent(holds / cells, 3) +
                        (undecidable > 0 ? ", is undecidable in " + percent(undecidable / cells, 3) : "") +
                        " of " + std::to_string(cross.ranked().size()) + " readings on " +
                        std::to_string(cross.targets.size()) + " targets";
    if (const auto spread = widest(cross, claim)) {
        const ReadingAxis& axis = reading_axes()[spread->axis];
        words += "; depends most on " + axis.name + ": " + axis.values[spread->highest] + " " +
                 percent(spread->highest_share, 2) + ", " + axis.values[spread->lowest] + " " +
                 percent(spread->lowest_share, 2);
    }
    return words;
}

/// One row per cell, one column per claim (1 holds, 0 does not, empty is undecidable).
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

/// The share of readings and targets in which a claim holds, for each value of each choice.
Csv claims_table(const ReadingCross& cross) {
    Csv table("claim,place,says,choice,value,share_holds");
    for (std::size_t c = 0; c < cross.claims.size(); ++c)
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
            for (std::size_t value = 0; value < reading_axes()[axis].values.size(); ++value)
                table.row(c + 1, cross.claims[c].first, cross.claims[c].second, reading_axes()[axis].name,
                          reading_axes()[axis].values[value], share_with(cross, c, axis, value));
    return table;
}

/// One row per claim: the share of targets in which it holds under several readings, and the choice that
/// decides most of it.
Csv shares_table(const ReadingCross& cross) {
    Csv table("claim,place,says,ours,best,every,other_phases,choice,highest,highest_share,lowest,lowest_"
              "share");
    const Reading best = cross.ranked().front();
    for (std::size_t c = 0; c < cross.claims.size(); ++c) {
        const auto under = [&](const Reading& reading, bool is_sobol) {
            return cross.share(c, [&](const ReadingCell& cell) {
                return is_from_sobol(cell) == is_sobol && cell.reading == reading;
            });
        };
        const auto spread = widest(cross, c);
        const Spread shown = spread.value_or(Spread{});
        const ReadingAxis& axis = reading_axes()[shown.axis];
        const auto known = [&](const std::string& word) { return spread ? word : ""; };
        const auto share = [&](double value) { return spread ? value : NAN; };
        table.row(c + 1, cross.claims[c].first, cross.claims[c].second, under({}, true), under(best, true),
                  cross.share(c, is_from_sobol), under({}, false), known(axis.name),
                  known(axis.values[shown.highest]), share(shown.highest_share),
                  known(axis.values[shown.lowest]), share(shown.lowest_share));
    }
    return table;
}

/// The readings that were tried on Sobol phases, with most claims first; `differs` lists the choices that are
/// not ours.
json readings_json(const ReadingCross& cross) {
    json all = json::array();
    for (const Reading& reading : cross.ranked()) {
        json one{{"claims_hold", cross.holding(reading)}, {"differs", json::array()}};
        for (std::size_t axis = 0; axis < reading_axes_count; ++axis) {
            const auto& [name, values] = reading_axes()[axis];
            one[name] = values[reading[axis]];
            if (reading[axis] != 0)
                one["differs"].push_back({{"choice", name}, {"value", values[reading[axis]]}});
        }
        all.push_back(std::move(one));
    }
    return all;
}

/// The claims by what the readings make of them, and how clear the first place among the readings is.
json outcome_json(const ReadingCross& cross) {
    const auto ranked = cross.ranked();
    const double most = cross.holding(ranked.front());
    json never = json::array(), always = json::array(), deciding = json::array();
    std::array<int, reading_axes_count> decided{};
    long depend = 0, firm = 0;
    for (std::size_t c = 0; c < cross.claims.size(); ++c) {
        const json claim{
            {"claim", c + 1}, {"place", cross.claims[c].first}, {"says", cross.claims[c].second}};
        const double share = cross.share(c, is_from_sobol);
        if (share == 0)
            never.push_back(claim);
        else if (share == 1)
            always.push_back(claim);
        else if (!std::isnan(share))
            ++depend;
        if (const auto spread = widest(cross, c); spread && share > 0 && share < 1)
            ++decided[spread->axis];
        const double drawn = cross.share(
            c, [](const ReadingCell& cell) { return !is_from_sobol(cell) && deviations(cell.reading) == 0; });
        firm += std::min(drawn, 1 - drawn) <= 0.05;
    }
    for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
        if (decided[axis] > 0)
            deciding.push_back({{"choice", reading_axes()[axis].name}, {"claims", decided[axis]}});
    return {
        {"claim_count", cross.claims.size()},
        {"target_count", cross.targets.size()},
        {"reading_count", ranked.size()},
        {"database_count", cross.databases},
        {"ours_hold", cross.holding({})},
        {"best_hold", most},
        {"worst_hold", cross.holding(ranked.back())},
        {"near_best", std::count_if(ranked.begin(), ranked.end(),
                                    [&](const Reading& one) { return cross.holding(one) >= most - 0.25; })},
        {"never", never},
        {"always", always},
        {"depend", depend},
        {"deciding", deciding},
        {"firm", firm},
        {"searches", cross.searches},
        {"curves", cross.curves}};
}

Findings run_readings(const Settings& settings, const Conditions& conditions) {
    const auto cross = std::make_shared<const ReadingCross>(tried_readings(settings, conditions));
    if (cross->cells.empty())
        return {};
    const auto write = [cross, folder = conditions.folder, origin = conditions.origin,
                        seconds = conditions.clock.seconds()] {
        const Csv claims = claims_table(*cross);
        rough::write_atomically(folder / "cells.csv", cells_csv(*cross));
        rough::write_atomically(folder / "runs.csv", run_columns() + "\n" + cross->runs);
        rough::write_atomically(folder / "claims.csv", claims.text());
        rough::write_atomically(folder / "shares.csv", shares_table(*cross).text());
        json result = origin_json(origin);
        result.update(outcome_json(*cross));
        result["readings"] = readings_json(*cross);
        result["claims"] = claims.rows();
        result["seconds"] = seconds;
        write_json(folder / "result.json", result);
        json told{{"command", origin.command}, {"version", origin.version}}; // for the paper's page
        std::size_t column = 0;
        for (const Claim& claim : paper_claims())
            if (claim.depends_on_reading)
                told["claims"][claim.id] = claim_words(*cross, column++);
        write_json(folder / "readings.json", told);
    };
    return {write, {}, "most claims hold at once: " + readable(cross->holding(cross->ranked().front()))};
}

} // namespace

Experiment readings_experiment() {
    return {.kind = "readings",
            .summary = "the paper's claims under every reading that its text allows",
            .settings = readings_settings(),
            .files = {"cells.csv", "claims.csv", "shares.csv", "runs.csv", "readings.json", "targets"},
            .run = run_readings,
            .resumes = true};
}

} // namespace app
