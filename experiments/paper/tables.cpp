#include "domain/profile/spectrum.hpp"
#include "domain/text/json.hpp"
#include "experiments/paper/paper.hpp"

#include <boost/algorithm/string/case_conv.hpp>

namespace app {
namespace {

using nlohmann::json;

bool is_papers(const std::string& name) { return name == "sog" || name == "gco" || name == "cco"; }

/// Whether figures show an answer: all except the minimax forms.
bool is_shown(const std::string& name) { return !name.ends_with("-minimax"); }

/// "SOG, minimax" for "sog-minimax"; the name itself for a variant of the .ini file.
std::string shown_name(const std::string& name) {
    const std::string algorithm = name.substr(0, name.find("-minimax"));
    if (!is_papers(algorithm)) return name;
    return boost::to_upper_copy(algorithm) + (name == algorithm ? "" : ", minimax");
}

void add_database_tables(const PaperRun& run, Findings& found) {
    Csv &genomes = found.table("genomes.csv", "id,H,gamma,phase_column,chromosomes,amplitude_after_rescaling"),
        &curves = found.table("database.csv", "id,pressure_MPa,stiffness_MPa_per_mm", 8);
    for (std::size_t i = 0; i < run.database.size(); ++i) {
        const auto& series = run.database[i].genome.series.front();
        genomes.row(i, series.H, series.gamma, i % static_cast<std::size_t>(run.layout.phase_columns) + 1,
                    series.chromosomes.size(), series.A * run.database[i].genome.scale);
        const rough::Curve K = to_its_end(secant_stiffness(run.database[i].response));
        curves.points(K.x, K.y, i);
    }
}

/// Scores of the database, stages, refinements and the best similarity known after each stage.
void add_search_tables(const TargetRun& target, const std::string& place, Findings& found) {
    Csv& scores = found.table(place + "scores.csv", "id,similarity,similarity_low,similarity_high");
    for (std::size_t i = 0; i < target.database.size(); ++i)
        scores.row(i, target.database[i].all, target.database[i].low, target.database[i].high);

    Csv &stages = found.table(place + "stages.csv", "variant,path,id,parent1,parent2,similarity"),
        &refined = found.table(place + "refinements.csv", "variant,rank,id,stage,similarity"),
        &convergence = found.table(place + "convergence.csv", "variant,name,spent,best_similarity");
    for (const VariantRun& variant : target.variants) {
        double best = unknown;
        for (const StageRecord& stage : variant.stages) {
            for (const Candidate& one : stage.candidates) {
                const auto parent = [&](std::size_t i) {
                    return i < one.parents.size() ? std::to_string(one.parents[i]) : std::string();
                };
                stages.row(variant.name, stage.path, one.id, parent(0), parent(1), one.similarity);
                best = std::fmax(best, one.similarity);
            }
            if (std::isfinite(best)) convergence.row(variant.name, shown_name(variant.name), stage.spent, best);
        }
        const auto candidates = refinements(variant);
        for (std::size_t rank = 0; rank < candidates.size(); ++rank)
            for (std::size_t stage = 0; stage < 3; ++stage)
                refined.row(variant.name, rank + 1, candidates[rank].id, stage, candidates[rank].similarity[stage]);
    }
    for (const json& row : target.thresholds)
        found
            .table(place + "thresholds.csv",
                   "p_bar_MPa,variant,U1,U2,at_least_used,children,share_above,best_child,similarity")
            .add(row);
}

/// Curves, heights and spectra of the answers.
void add_answer_tables(const PaperRun& run, const TargetRun& target, const std::string& place, Findings& found) {
    Csv &curves = found.table(place + "curves.csv", "variant,displacement_mm,pressure_MPa,contact_fraction,"
                                                    "tangent_stiffness_MPa_per_mm,kkt_residual"),
        &stiffness = found.table(place + "stiffness.csv", "variant,pressure_MPa,stiffness_MPa_per_mm", 8),
        &heights = found.table(place + "heights.csv", "variant,x_mm,height_mm", 8),
        &spectra = found.table(place + "spectra.csv", "variant,wavenumber_rad_per_mm,density_mm3", 8),
        &lines = found.table(place + "lines.csv", "variant,wavenumber_rad_per_mm,power_mm2,density_mm3", 8);
    for (const VariantRun& variant : target.variants) {
        const rough::Response& response = variant.answer.response;
        for (rough::Index j = 0; j < response.steps(); ++j)
            curves.row(variant.name, response.displacement[j], response.pressure[j], response.contact_fraction[j],
                       response.tangent_stiffness[j], response.kkt_residual[j]);
        if (!is_shown(variant.name)) continue;
        const rough::Curve K = to_its_end(secant_stiffness(response));
        stiffness.points(K.x, K.y, variant.name);
        const rough::Profile profile = sample(variant.answer.genome, run.model.grid);
        heights.points(positions(profile), profile.heights.array() - profile.heights.mean(), variant.name);
        const rough::Spectrum spectrum = continuous_spectrum(profile);
        spectra.points(spectrum.wave_number, spectrum.density, variant.name);
        // The peak of a cosine's density under a Hann window; its mean square is 1.5 times its squared mean.
        for (const rough::SpectralLine& line : discrete_spectrum(variant.answer.genome))
            lines.row(variant.name, line.wave_number, line.power, line.power / (1.5 * spectrum.wave_number[0]));
    }
    found.table(place + "target.csv", "pressure_MPa,stiffness_MPa_per_mm").points(target.target.x, target.target.y);
}

/// The runs on one target as the page shows them.
json target_page(const TargetRun& target, const std::string& folder) {
    json result = {{"title", target.title},
                   {"folder", folder},
                   {"shown", folder},
                   {"runs", json::array()},
                   {"parts", json::array()}};
    double best = unknown;
    for (const VariantRun& variant : target.variants) {
        best = std::fmax(best, variant.similarity);
        if (is_shown(variant.name)) {
            result["shown"] = result["shown"].get<std::string>() + " " + variant.name;
            result["shown_variants"].push_back(
                {{"title", shown_name(variant.name)}, {"on", target.title}, {"figure", variant.name + " " + folder}});
        }
        const Candidate& answer = variant.stages.back().candidates.front();
        std::string descent;
        for (const std::uint64_t parent : answer.parents)
            descent += (descent.empty() ? "" : " + ") + std::to_string(parent);
        if (descent.empty()) descent = std::to_string(answer.id);
        const auto candidates = refinements(variant);
        json row = variant;
        row.update({{"name", shown_name(variant.name)},
                    {"before", candidates.empty() ? json() : json(candidates[0].similarity[0])},
                    {"genomes", descent}});
        result["runs"].push_back(std::move(row));
    }
    result["best_similarity"] = best;
    const VariantRun *const sog = find_variant(target, "sog"), *const gco = find_variant(target, "gco");
    result["one_surface"] =
        sog && gco &&
        gap(area_against_pressure(sog->answer.response), area_against_pressure(gco->answer.response)) < 1e-9;
    std::string parts = folder;
    for (const auto& [place, part] : {std::pair("below", &Scores::low), {"above", &Scores::high}})
        if (const auto genome = best_in_part(target, part)) {
            const Scores& scores = target.database[*genome];
            parts += " " + std::to_string(*genome);
            result["parts"].push_back({{"genome", *genome},
                                       {"part", place},
                                       {"similarity_all", scores.all},
                                       {"similarity_part", scores.*part}});
        }
    result["part_figure"] = parts;
    return result;
}

} // namespace

Findings findings_of(const PaperRun& run, const Studies& studies) {
    Findings found = studies.found;
    add_claims(found, run, studies);
    json& page = found.result;
    page["seconds"] = run.seconds;
    page["database_size"] = run.database.size();
    const auto dominant = [&](auto value) { return genome_column(studies, &GenomeStudy::dominant, value); };
    page["dominance"] = {{"similarity", rough::median(dominant(&Reduction::similarity))},
                         {"kept", rough::mean(dominant(&Reduction::kept))},
                         {"only_best", std::ranges::count(dominant(&Reduction::only_best), 1.0)}};
    std::string target_figure;
    for (const TargetRun& target : run.targets) {
        const bool first = &target == &run.targets.front();
        const std::string place = first ? "" : "heldout/", shown = first ? "./" : place;
        page["targets"].push_back(target_page(target, shown));
        target_figure += shown + " " + target.title + " ";
        add_search_tables(target, place, found);
        add_answer_tables(run, target, place, found);
        json result = result_json(run.origin, paper_setup(run.model, target.target, run.max_pressure, run.p_bar),
                                  target.variants);
        result["threshold_MPa"] = run.p_bar;
        if (first)
            page.update(result);
        else
            found.files[place + "result.json"] = rough::json_text(result) + "\n";
    }
    page["target_figure"] = target_figure;
    add_database_tables(run, found);
    return found;
}

} // namespace app
