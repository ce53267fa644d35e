#include "apps/experiments/paper/page.hpp"

#include "apps/experiments/paper/claims.hpp"
#include "apps/experiments/paper/figures.hpp"
#include "apps/experiments/paper/lookup.hpp"
#include "apps/experiments/paper/readings_section.hpp"
#include "apps/report/units.hpp"

#include <algorithm>

namespace app {

namespace {

const char* const verdict_names[] = {"reproduced", "contradicted", "undecidable"};

Html badge(Verdict verdict) {
    const std::string name = verdict_names[static_cast<int>(verdict)];
    return Html::raw("<span class=\"badge " + name + "\">" + name + "</span>");
}

std::string count_of(const std::vector<Claim>& claims, Verdict verdict) {
    return std::to_string(std::count_if(claims.begin(), claims.end(),
                                        [&](const Claim& claim) { return claim.verdict == verdict; }));
}

/// "Figure 8A" as a link to Figure 8
Html linked(const std::string& place) {
    if (!place.starts_with("Figure "))
        return place;
    const std::string number = place.substr(7, place.find_first_not_of("0123456789", 7) - 7);
    return Html::raw("<a href=\"#figure-" + number + "\">") + place + Html::raw("</a>");
}

Table claims_table(const PaperRun& run, const std::vector<Claim>& claims) {
    Table table{"", {"Where", "The paper says", "Measured here", "Verdict"}, {}, {}, true};
    if (!run.other_readings.empty())
        table.header.emplace_back("Other readings");
    for (const Claim& claim : claims) {
        table.rows.push_back({linked(claim.place), Html::raw(claim.says),
                              Html::raw(claim.measured + "<span class=\"rule\">" + claim.rule + "</span>"),
                              badge(claim.verdict)});
        if (const auto other = run.other_readings.find(claim.says); other != run.other_readings.end())
            table.rows.back().push_back(other->second);
        else if (!run.other_readings.empty())
            table.rows.back().push_back("hangs on none");
    }
    return table;
}

/// The database genome that the answer is, or the two that it comes from.
std::string descent_of(const VariantRun& variant) {
    if (variant.stages.empty() || variant.stages.back().candidates.empty())
        return "–";
    const Candidate& answer = variant.stages.back().candidates.front();
    std::string words;
    for (std::uint64_t parent : answer.parents)
        words += (words.empty() ? "" : " + ") + std::to_string(parent);
    return words.empty() ? std::to_string(answer.id) : words;
}

Table runs_table(const TargetRun& target) {
    Table table{"Runs on the " + target.title + " target",
                {"Algorithm", "Similarity", "on the fine grid", "at worst", "before GCMMA",
                 "genome or parents", "curves", "gradients", "seconds"},
                {},
                {false, true, true, true, true, true, true, true, true}};
    for (const VariantRun& variant : target.variants) {
        const auto candidates = refinements(variant);
        table.rows.push_back({shown_name(variant.name), readable(variant.similarity, 4),
                              readable(variant.similarity_refined, 4), readable(variant.similarity_worst, 4),
                              candidates.empty() ? "–" : readable(candidates.front().similarity[0], 4),
                              descent_of(variant), std::to_string(variant.curves),
                              std::to_string(variant.gradients), readable(variant.seconds, 2)});
    }
    return table;
}

double best_similarity(const TargetRun& target) {
    double best = unset;
    for (const VariantRun& variant : target.variants)
        best = std::fmax(best, variant.similarity);
    return best;
}

void add_glance(Page& page, const PaperRun& run, const std::vector<Claim>& claims) {
    std::vector<std::pair<std::string, std::string>> tiles;
    for (const TargetRun& target : run.targets)
        tiles.emplace_back("best similarity, " + target.title + " target",
                           readable(best_similarity(target), 3));
    tiles.emplace_back("claims reproduced", count_of(claims, Verdict::reproduced));
    tiles.emplace_back("contradicted", count_of(claims, Verdict::contradicted));
    tiles.emplace_back("undecidable", count_of(claims, Verdict::undecidable));
    tiles.emplace_back("the whole run, " + std::to_string(run.origin.threads) + " threads",
                       readable(run.seconds, 2) + " s");
    page.tiles(tiles);
}

void add_runs(Page& page, const PaperRun& run) {
    page.section("The runs");
    page.prose(
        "Similarity is 1 − the largest relative misfit over the target's points (Eq. 12). The fine grid has "
        "four elements for each of the run's: an answer that is good on one grid only is tuned to that grid. "
        "The minimax forms are the same algorithms with all points of the target seen by GCMMA at once.");
    for (const TargetRun& target : run.targets)
        page.table(runs_table(target));
    page.figure(convergence_figure(run));
}

void add_repeat(Page& page, const PaperRun& run) {
    page.section("Repeat it");
    page.prose("The same seed gives the same bits, whatever the number of threads.");
    page.code(run.origin.command);
    page.prose(
        "rugosa " + run.origin.version + ", seed " + std::to_string(run.origin.seed) + ", " +
        std::to_string(run.model.grid.nodes) + " nodes over " + readable(run.model.grid.length, 5) + " mm, " +
        std::to_string(run.model.loading.steps) +
        " load steps. After P. Cinat, G. Gnecco and M. Paggi (2020), "
        "“Multi-scale surface roughness optimization through genetic algorithms”, Frontiers in Mechanical "
        "Engineering 6:29.");
}

} // namespace

std::string paper_page(const PaperRun& run) {
    const Studies studies = studies_of(run);
    const std::vector<Claim> claims = paper_claims(run, studies);
    Page page("Rough surfaces with a given contact stiffness",
              "Three genetic algorithms design the profile of a rough surface so that its contact stiffness "
              "follows a target. This page repeats the experiment of Cinat, Gnecco and Paggi (2020) and sets "
              "every claim of the paper beside what was measured here.");
    add_glance(page, run, claims);
    page.section("The answers");
    page.figure(answers_figure(run));
    page.figure(profiles_figure(run));
    page.figure(spectra_figure(run));
    add_runs(page, run);
    page.section("Every claim");
    page.prose("Each verdict is computed from this run by the rule under its numbers. Undecidable is what "
               "holds on one target and "
               "not on the other, and what cannot be tested without the authors' data.");
    page.table(claims_table(run, claims));
    page.section("The search");
    page.figure(stages_figure(run));
    page.figure(thresholds_figure(run));
    page.section("Model and database");
    page.figure(chromosomes_figure(run.origin.seed));
    page.figure(ridges_figure(studies.ridges));
    page.figure(fractal_figure(studies.fractals.front()));
    page.figure(parts_figure(run));
    page.figure(pairs_figure(run));
    page.figure(database_figure(run));
    add_readings(page, run, studies.readings);
    add_repeat(page, run);
    return page.html();
}

} // namespace app
