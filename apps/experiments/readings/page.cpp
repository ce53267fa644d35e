#include "apps/report/page.hpp"

#include "apps/experiments/readings/cross.hpp"
#include "apps/experiments/study.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

bool from_sobol(const ReadingCell& cell) { return cell.database == 0; }

/// "strip, K by load step": what is not ours in a reading.
std::string named(const Reading& reading) {
    std::string words;
    for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
        if (reading[axis] != 0)
            words += (words.empty() ? "" : "; ") + reading_axes()[axis].name + ": " +
                     reading_axes()[axis].values[reading[axis]];
    return words.empty() ? "ours" : words;
}

/// A claim's number and words.
std::string numbered(const ReadingCross& cross, std::size_t claim) {
    return std::to_string(claim + 1) + " (" + cross.claims[claim].first + ": " + cross.claims[claim].second +
           ")";
}

/// How a claim's share spreads over the values of a choice.
struct Spread {
    double width = 0; ///< greatest share less least
    std::size_t axis = 0, least = 0, most = 0;
    double least_share = 0, most_share = 0;
};

/// Of the choice that a claim hangs on most; of width 0 where it hangs on none.
Spread widest(const ReadingCross& cross, std::size_t claim) {
    Spread best;
    for (std::size_t axis = 0; axis < reading_axes_count; ++axis) {
        Spread spread{0, axis, 0, 0, 2, -1};
        for (std::size_t value = 0; value < reading_axes()[axis].values.size(); ++value) {
            const double share = cross.share(claim, [&](const ReadingCell& cell) {
                return from_sobol(cell) && cell.reading[axis] == value;
            });
            if (share < spread.least_share)
                spread.least = value, spread.least_share = share;
            if (share > spread.most_share)
                spread.most = value, spread.most_share = share;
        }
        spread.width = spread.most_share - spread.least_share;
        if (spread.width > best.width)
            best = spread;
    }
    return best;
}

std::string hangs_on(const ReadingCross& cross, std::size_t claim) {
    const Spread spread = widest(cross, claim);
    if (spread.width < 0.05)
        return "";
    const ReadingAxis& axis = reading_axes()[spread.axis];
    return axis.name + ": " + axis.values[spread.most] + " " + percent(spread.most_share, 2) + ", " +
           axis.values[spread.least] + " " + percent(spread.least_share, 2);
}

std::string listed(const ReadingCross& cross, const std::vector<std::size_t>& claims) {
    std::string words;
    for (const std::size_t claim : claims)
        words += (words.empty() ? "" : "; ") + numbered(cross, claim);
    return words.empty() ? "none" : words;
}

/// Claims by the values of all choices: the colour says in which share of the readings with that value it
/// holds.
Plot shares_plot(const ReadingCross& cross) {
    Plot plot;
    plot.alt =
        "For each claim and each value of a choice, the share of readings and targets in which it holds";
    plot.x = {"Claim (numbers as in the table)", false, 0, static_cast<double>(cross.claims.size()) + 1};
    plot.height = 560;
    plot.key += " maxcols 2";
    const std::array<std::tuple<const char*, double, Colour>, 5> bins{{{"never", 0, Colour::red},
                                                                       {"< 50 %", 0.5, Colour::orange},
                                                                       {"< 90 %", 0.9, Colour::sky},
                                                                       {"< 100 %", 1, Colour::blue},
                                                                       {"always", 2, Colour::green}}};
    std::array<std::vector<std::pair<double, double>>, 5> points;
    double row = 0;
    for (std::size_t axis = reading_axes_count; axis-- > 0;) {
        for (std::size_t value = reading_axes()[axis].values.size(); value-- > 0;) {
            plot.y.ticks.emplace_back(++row, reading_axes()[axis].values[value]);
            for (std::size_t c = 0; c < cross.claims.size(); ++c) {
                const double share = cross.share(c, [&](const ReadingCell& cell) {
                    return from_sobol(cell) && cell.reading[axis] == value;
                });
                const std::size_t bin = share <= 0    ? 0
                                        : share < 0.5 ? 1
                                        : share < 0.9 ? 2
                                        : share < 1   ? 3
                                                      : 4;
                if (!std::isnan(share))
                    points[bin].emplace_back(static_cast<double>(c + 1), row);
            }
        }
        plot.guides.push_back({row + 0.5, true});
    }
    plot.y.from = 0, plot.y.to = row + 1;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        const auto& [label, upper, colour] = bins[bin];
        if (!points[bin].empty())
            plot.series.push_back(series_of(points[bin], {label, {}, {}, colour, Style::points, 2.5}));
    }
    return plot;
}

std::string share_words(double share) { return std::isnan(share) ? "–" : percent(share, 3); }

Table claims_table(const ReadingCross& cross) {
    const Reading ours{}, best = cross.ranked().front();
    Table table{"",
                {"", "Where", "The paper says", "Ours", "Best reading", "Every reading", "Other phases, ours",
                 "Hangs most on"},
                {},
                {true, false, false, true, true, true, true, false},
                true};
    for (std::size_t c = 0; c < cross.claims.size(); ++c) {
        const auto under = [&](const Reading& reading, bool drawn) {
            return share_words(cross.share(c, [&](const ReadingCell& cell) {
                return (cell.database > 0) == drawn && cell.reading == reading;
            }));
        };
        table.rows.push_back({std::to_string(c + 1), cross.claims[c].first, cross.claims[c].second,
                              under(ours, false), under(best, false), share_words(cross.share(c, from_sobol)),
                              under(ours, true), hangs_on(cross, c)});
    }
    return table;
}

} // namespace

std::string claim_words(const ReadingCross& cross, std::size_t claim) {
    std::array<double, 2> shares{}; // holds, undecidable
    double cells = 0;
    for (const ReadingCell& cell : cross.cells)
        if (from_sobol(cell)) {
            ++cells;
            shares[0] += cell.holds[claim] == '1', shares[1] += cell.holds[claim] == '?';
        }
    const std::string by = hangs_on(cross, claim);
    return "holds in " + percent(shares[0] / cells, 3) +
           (shares[1] > 0 ? ", is undecidable in " + percent(shares[1] / cells, 3) : "") + " of " +
           std::to_string(cross.ranked().size()) + " readings on " + std::to_string(cross.targets.size()) +
           " targets" + (by.empty() ? "" : "; depends most on " + by);
}

std::vector<std::string> readings_words(const ReadingCross& cross) {
    const auto ranked = cross.ranked();
    const double all = static_cast<double>(cross.claims.size());
    std::vector<std::size_t> never, always, either;
    for (std::size_t c = 0; c < cross.claims.size(); ++c) {
        const double share = cross.share(c, from_sobol);
        if (!std::isnan(share))
            (share == 0 ? never : share == 1 ? always : either).push_back(c);
    }
    std::vector<std::string> words{
        "Most claims hold at once under this reading: " + named(ranked.front()) + ". It keeps " +
            readable(cross.holding(ranked.front())) + " of the " + brief(all) +
            " claims that hang on a reading, in the mean over " + std::to_string(cross.targets.size()) +
            " targets; ours keeps " + readable(cross.holding({})) + ", the worst of " +
            std::to_string(ranked.size()) + " keeps " + readable(cross.holding(ranked.back())),
        "No reading rescues: " + listed(cross, never),
        "Whatever the reading, these hold: " + listed(cross, always)};
    std::array<int, reading_axes_count> hang{};
    for (const std::size_t claim : either)
        if (const Spread spread = widest(cross, claim); spread.width >= 0.05)
            ++hang[spread.axis];
    std::string by;
    for (std::size_t axis = 0; axis < reading_axes_count; ++axis)
        if (hang[axis] > 0)
            by += (by.empty() ? "" : ", ") + reading_axes()[axis].name + " (" + std::to_string(hang[axis]) +
                  ")";
    words.push_back("The other " + std::to_string(either.size()) +
                    " hang on the reading or on the target; the choice that decides most of each: " +
                    (by.empty() ? "none" : by));
    // Equal in count, far apart in what they say: how clear the first place is.
    std::size_t near = 0;
    for (const Reading& reading : ranked)
        near += cross.holding(reading) >= cross.holding(ranked.front()) - 0.25;
    words.push_back(std::to_string(near) + (near == 1 ? " reading is" : " readings are") +
                    " within a quarter of a claim of the best, so that the count singles out " +
                    (near == 1 ? "this one" : "a group and not one reading"));
    if (cross.databases > 0) {
        std::vector<double> spread;
        for (std::size_t c = 0; c < cross.claims.size(); ++c) {
            const double share = cross.share(c, [](const ReadingCell& cell) {
                return cell.database > 0 && deviations(cell.reading) == 0;
            });
            spread.push_back(std::min(share, 1 - share));
        }
        const auto firm = std::count_if(spread.begin(), spread.end(), [](double s) { return s <= 0.05; });
        words.push_back(
            "From " + std::to_string(cross.databases) + " databases with other phases, read as ours, " +
            std::to_string(firm) +
            " claims come out the same in at least 95 % of the runs; the verdict of the others hangs "
            "on the draw or on the target");
    }
    words.emplace_back(
        "Slips in the text explain the rest: Figure 2 (the last pair missing from g<sub>3</sub>, a negative "
        "radicand read as 0), Eq. 8 (arccos loses a sign), p<sub>max</sub> above every genome's own (A in "
        "another "
        "unit than mm), the units of p̄, “Algorithm 2” for 1 in SOG and “GCO” for CCO in section 4.5");
    return words;
}

void fill_readings_page(Page& page, const ReadingCross& cross) {
    page.figure({"claims-by-readings",
                 "Which claim holds under which reading.",
                 "A dot is a claim under one value of a choice, over all values of the other choices and all "
                 "targets. The first value of each choice (the upper) is ours.",
                 {shares_plot(cross)}});
    page.section("The claims");
    page.prose(
        "Shares of targets under one reading, or of readings and targets. “Other phases” are runs from "
        "databases with other phases. An undecidable claim counts as one that does not hold.");
    page.table(claims_table(cross));
    page.section("The readings");
    nlohmann::json best;
    for (const Reading& reading : cross.ranked())
        if (best.size() < 10)
            best.push_back({{"reading", named(reading)}, {"hold", cross.holding(reading)}});
    page.table(shown(best, {{"reading", "Reading (where not ours)"}, {"hold", "Claims that hold", 3}},
                     "The ten that keep most claims"));
    page.section("How it was tried");
    page.prose(
        "Targets are made on each body: smoothed quantiles (median, lower and upper quartile) of the Sobol "
        "database's curves there, and the curve of a genome outside it. Units of pressure and amplitude "
        "change no score and are not crossed. A contact curve is solved once a body and genome; readings "
        "share it. “By load step” compares K of the whole and of the chromosome alone by the number of the "
        "step, “raw tangents” the solver's dP/dΔ. CCO reduces the parents before the sum, or the children "
        "after it.");
    page.prose(std::to_string(cross.searches) + " searches asked for " + std::to_string(cross.curves) +
               " curves and gradients.");
}

} // namespace app
