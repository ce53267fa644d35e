#include "apps/experiments/paper/readings_section.hpp"

#include "apps/experiments/paper/lookup.hpp"
#include "apps/report/units.hpp"
#include "domain/numerics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace app {

namespace {

/// One reading of Algorithm 1: what it keeps of the database and what the three algorithms reach with it.
std::string dominance_words(const PaperRun& run, const Readings& readings, rough::DominanceReading reading) {
    const bool same_pressure = reading == rough::DominanceReading::same_pressure;
    const auto& rows = same_pressure ? readings.same_pressure : readings.same_step;
    const auto alone =
        std::count_if(rows.begin(), rows.end(), [](const Reduction& row) { return row.only_best; });
    std::string words =
        std::string(same_pressure ? "At equal pressures" : "By load step") +
        ": s(reduced, whole) = " + readable(rough::median(rough::column(rows, &Reduction::similarity))) +
        " in the median with " + percent(rough::mean(rough::column(rows, &Reduction::kept)), 2) +
        " of the chromosomes; for " + std::to_string(alone) + " of " + std::to_string(rows.size()) +
        " genomes none passes 0.95, and the best is kept. Answers";
    for (const TargetRun& target : run.targets) {
        words += (&target == &run.targets.front() ? ", " : "; ") + target.title + " target:";
        const auto& variants = reading == run.dominance ? target.variants : target.other_reading;
        const char* before = " ";
        for (const VariantRun& variant : variants)
            for (const Algorithm& algorithm : algorithms)
                if (variant.name == algorithm.name) {
                    words += before + (algorithm.title + (" " + readable(variant.similarity)));
                    before = ", ";
                }
    }
    return words + ".";
}

/// What another datum does to the database's curves and scores.
std::string datum_words(const PaperRun& run, const Readings& readings) {
    const auto [least, most] =
        std::minmax_element(readings.datum_similarity.begin(), readings.datum_similarity.end());
    std::string words = "With " + readable(readings.datum_factor, 1) +
                        " times that distance a genome's own K(p) has a similarity of only " +
                        readable(*least, 2) + "–" + readable(*most, 2) + " with itself. Best of the database";
    for (std::size_t t = 0; t < run.targets.size(); ++t) {
        double here = unset;
        for (const Scores& scores : run.targets[t].database)
            here = std::fmax(here, scores.all);
        words += (t ? "; " : ", ") + run.targets[t].title + " target: " + readable(readings.datum_best[t]) +
                 " in place of " + readable(here);
    }
    return words + ".";
}

} // namespace

void add_readings(Page& page, const PaperRun& run, const Readings& readings) {
    using enum rough::DominanceReading;
    page.section("What rests on our reading");
    page.prose("The paper leaves some choices open. These are ours, with what the other choice gives.");
    Table table{"", {"Choice", "Ours", "The other reading"}, {}, {}, true};
    if (run.model.body.kernel == rough::Kernel::free)
        table.rows.push_back({"Datum of the half-plane",
                              "d = " + readable(run.model.body.datum, 5) +
                                  " mm. In plane strain a displacement has no meaning without a datum.",
                              datum_words(run, readings)});
    table.rows.push_back(
        {"Correlation of Algorithm 1", dominance_words(run, readings, run.dominance),
         dominance_words(run, readings, run.dominance == same_pressure ? same_step : same_pressure)});
    table.rows.push_back(
        {Html::raw("Units of p̄ and p<sub>max</sub>"),
         Html::raw("p̄ as a share of p<sub>max</sub> = ") + readable(run.max_pressure, 2) +
             " MPa, to which every genome is rescaled by Eq. 11.",
         Html::raw("Stiffness does not depend on amplitude, so similarities are the same for any "
                   "p<sub>max</sub>.")});
    table.rows.push_back(
        {"Target",
         "The paper's is not published; one is drawn in its spirit (the smoothed median of the database).",
         "The held-out one is the curve of a genome outside the database, so that a perfect answer exists. "
         "Every figure shows both."});
    table.rows.push_back(
        {"Shortest wave", "The grid's spacing (Eq. 4).",
         "Waves under eight nodes are poorly resolved: see “on the fine grid” in the runs."});
    page.table(table);
    page.prose(Html::raw(
        "Slips in the paper's text that we read as follows: in SOG, “determined by Algorithm 2” means "
        "Algorithm 1; in section 4.5, “GCO … smaller set” means CCO; the number of chromosomes is "
        "n<sub>f</sub> − n<sub>s</sub> + 1, one more than its third line."));
}

} // namespace app
