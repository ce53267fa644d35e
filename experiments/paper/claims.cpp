#include "apps/report/render.hpp"
#include "domain/profile/spectrum.hpp"
#include "experiments/paper/paper.hpp"

namespace app {
namespace {

using Run = const PaperRun&;
using Target = const TargetRun&;
using All = const Studies&;
using Variant = const VariantRun&;
/// A number of the run, or one for each target.
using Measure = std::variant<std::function<Finding(Run, All)>, std::function<Finding(Run, Target)>>;

using nlohmann::json;
using rough::column;
using rough::median;
using Numbers = std::vector<double>;

/// The least or greatest number; NaN if the list is empty or a number is unknown.
double lowest(const Numbers& numbers) {
    const bool is_known =
        !numbers.empty() && std::ranges::none_of(numbers, [](double number) { return std::isnan(number); });
    return is_known ? std::ranges::min(numbers) : unknown;
}
double highest(const Numbers& numbers) { return -lowest(column(numbers, std::negate<>())); }
double sum(const Numbers& numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }
double spread(const Numbers& numbers) { return highest(numbers) - lowest(numbers); }

/// A column of the variant's rows of thresholds.
Numbers over_thresholds(Target target, const std::string& variant, const char* name) {
    Numbers numbers;
    for (const json& row : target.thresholds)
        if (row.at("variant") == variant) numbers.push_back(row.at(name));
    return numbers;
}

Finding spread_of_best(Target target, const std::string& variant) {
    const Numbers answers = over_thresholds(target, variant, "similarity");
    return {spread(over_thresholds(target, variant, "best_child")), {{"of the answers after GCMMA", spread(answers)}}};
}

/// A change of the median over the database without one half of the waves, over that without the other.
Finding governed(All all, double Removal::*change, bool coarse) {
    const double without_coarse = median(genome_column(all, &GenomeStudy::without_coarse, change)),
                 without_fine = median(genome_column(all, &GenomeStudy::without_fine, change));
    return {coarse ? without_coarse / without_fine : without_fine / without_coarse,
            {{"change without the longer half", without_coarse}, {"without the shorter half", without_fine}}};
}

Finding over_alloys(All all, double FractalStudy::*value) {
    const Numbers numbers = column(all.fractals, value);
    return {median(numbers), {{"least", lowest(numbers)}, {"greatest", highest(numbers)}}};
}

Finding in_part(Target target, double Scores::*part) {
    const auto best = best_in_part(target, part);
    if (!best) return {};
    const Scores& scores = target.database[*best];
    return {scores.*part, {{"over all pressures", scores.all}}};
}

Finding among_curves(Run run, Target target) {
    const rough::Index points = run.database.empty() ? 0 : target.target.points();
    int inside = 0;
    for (rough::Index k = 0; k < points; ++k) {
        const Numbers there = column(run.database, [&](const Answered& member) {
            return secant_stiffness(member.response).at(target.target.x[k]);
        });
        inside += target.target.y[k] >= lowest(there) && target.target.y[k] <= highest(there);
    }
    return points ? inside / static_cast<double>(points) : unknown;
}

/// How much the best candidate of an algorithm gains from both refinements.
double gain(Run, Variant variant) {
    const auto best = [candidates = refinements(variant)](std::size_t stage) {
        return highest(column(candidates, [&](const Refinement& one) { return one.similarity[stage]; }));
    };
    return best(2) - best(0);
}

/// log10 of the power in each octave. Octave o has the bins 2^o to 2^(o+1) - 1. Octaves make series of
/// different gamma comparable, whose lines never coincide.
struct Octaves {
    Eigen::VectorXd continuous, discrete; ///< from the sampled heights; from the genome's waves, or NaN
    rough::Index half() const { return continuous.size() / 2; }
};

Octaves octaves_of(Run run, Variant variant) {
    const rough::Spectrum spectrum = continuous_spectrum(sample(variant.answer.genome, run.model.grid));
    const double first = spectrum.wave_number[0];
    const auto lines = discrete_spectrum(variant.answer.genome);
    const int count = std::ilogb(spectrum.density.size() + 1);
    Octaves octaves{Eigen::VectorXd(count), Eigen::VectorXd(count)};
    for (int o = 0; o < count; ++o) {
        const int bin = 1 << o;
        octaves.continuous[o] = std::log10(spectrum.density.segment(bin - 1, bin).sum() * first);
        double power = 0;
        for (const rough::SpectralLine& line : lines)
            if (line.wave_number >= (bin - 0.5) * first && line.wave_number < (2 * bin - 0.5) * first)
                power += line.power;
        octaves.discrete[o] = power > 0 ? std::log10(power) : unknown;
    }
    return octaves;
}

/// Factor between a genome's continuous and discrete spectrum. It is the geometric mean over the octaves of
/// the upper or lower half that have a wave.
double off_its_waves(Run run, Variant variant, bool high) {
    const Octaves octaves = octaves_of(run, variant);
    const Eigen::VectorXd apart = (octaves.continuous - octaves.discrete).cwiseAbs();
    const auto half = high ? apart.tail(octaves.half()) : apart.head(apart.size() - octaves.half());
    return std::pow(10, rough::mean({half.begin(), half.end()}));
}

/// Exponent of the power law of wavenumber that fits the upper half of the octaves' densities best.
double high_exponent(Run run, Variant variant) {
    const Octaves octaves = octaves_of(run, variant);
    const Eigen::Index half = octaves.half();
    if (half < 2) return unknown;
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(half, 0, static_cast<double>(half - 1)) * std::log10(2);
    // An octave's power is its density times its width.
    return rough::slope(x, octaves.continuous.tail(half)) - 1;
}

/// The factor by which CCO's power over SOG's scatters in the lower half of the octaves: its standard
/// deviation on a logarithmic scale. 1: proportional.
Finding proportion(Run run, Target target) {
    const VariantRun *const sog = find_variant(target, "sog"), *const cco = find_variant(target, "cco");
    if (!sog || !cco) return {};
    const Octaves a = octaves_of(run, *sog), b = octaves_of(run, *cco);
    const Eigen::Index low = a.continuous.size() - a.half();
    if (low < 2) return {};
    const Eigen::ArrayXd ratio = (b.continuous - a.continuous).head(low).array();
    return {std::pow(10, std::sqrt((ratio - ratio.mean()).square().mean())),
            {{"mean factor", std::pow(10, ratio.mean())}}};
}

/// Number of peaks of a continuous spectrum without a wave of the genome within two wavenumbers (the width of
/// the window). A peak is at least twice as high as two wavenumbers to either side.
double peaks_without_waves(Run run, Variant variant) {
    const rough::Spectrum spectrum = continuous_spectrum(sample(variant.answer.genome, run.model.grid));
    const Eigen::VectorXd& density = spectrum.density;
    const double floor = 1e-12 * density.maxCoeff(); // below it is rounding
    const auto lines = discrete_spectrum(variant.answer.genome);
    double peaks = 0;
    for (Eigen::Index k = 2; k + 2 < density.size(); ++k) {
        const bool peak = density[k] > density[k - 1] && density[k] > density[k + 1] &&
                          density[k] > std::max(2 * std::max(density[k - 2], density[k + 2]), floor);
        peaks += peak && std::ranges::none_of(lines, [&](const rough::SpectralLine& line) {
                     return std::abs(line.wave_number - spectrum.wave_number[k]) <= 2 * spectrum.wave_number[0];
                 });
    }
    return peaks;
}

/// The value of an expression like "least similarity of sog gco cco". After "of" stand answers; "pairs" is
/// each two of the three. The quantity of each is reduced to one number.
Finding over_answers(const std::string& words, Run run, Target target) {
    static const std::map<std::string, double (*)(const Numbers&)> reductions{
        {"least", lowest},
        {"greatest", highest},
        {"sum", sum},
        {"ratio", [](const Numbers& n) { return n[1] / n[0]; }},
        {"last", [](const Numbers& n) { return n.back(); }},
        {"nearer", [](const Numbers& n) {
             return n[0] - lowest({n[1], n[2]}) / 2;
         }}};
    static const std::map<std::string, double (*)(Run, Variant)> of_one{
        {"similarity", [](Run, Variant one) { return one.similarity; }},
        {"error", [](Run, Variant one) { return 1 - one.similarity; }},
        {"seconds", [](Run, Variant one) { return one.seconds; }},
        {"gain", gain},
        {"chromosomes", [](Run, Variant one) { return static_cast<double>(waves(one.answer.genome).size()); }},
        {"off-high", [](Run of, Variant one) { return off_its_waves(of, one, true); }},
        {"off-low", [](Run of, Variant one) { return off_its_waves(of, one, false); }},
        {"peaks", peaks_without_waves},
        {"exponent", high_exponent}};
    static const std::map<std::string, double (*)(Run, Variant, Variant)> of_two{
        {"area-gap",
         [](Run, Variant a, Variant b) {
             return gap(area_against_pressure(a.answer.response), area_against_pressure(b.answer.response));
         }},
        {"correlation", [](Run of, Variant a, Variant b) {
             return rough::pearson(sample(a.answer.genome, of.model.grid).heights,
                                   sample(b.answer.genome, of.model.grid).heights);
         }}};
    std::istringstream text(words);
    std::string reduction, quantity, name;
    std::vector<std::string> names;
    for (text >> reduction >> quantity >> name; text >> name;) names.push_back(name);
    const bool is_of_pairs = names.front() == "pairs";
    if (is_of_pairs) names = {"sog", "gco", "cco"};
    std::vector<const VariantRun*> answers;
    for (const std::string& one : names)
        if (answers.push_back(find_variant(target, one)); !answers.back()) return {};
    Finding finding;
    Numbers numbers;
    const auto add = [&](const std::string& of, double number) {
        finding.parts.emplace_back(of, numbers.emplace_back(number));
    };
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!is_of_pairs)
            add(names[i], of_one.at(quantity)(run, *answers[i]));
        else
            for (std::size_t j = i + 1; j < names.size(); ++j)
                add(names[i] + "–" + names[j], of_two.at(quantity)(run, *answers[i], *answers[j]));
    finding.number = reductions.at(reduction)(numbers);
    return finding;
}

/// All other numbers, by their names.
const std::map<std::string, Measure>& measures() {
    static const std::map<std::string, Measure> all{
        {"nesting",
         [](Run, All all) {
             const double nodes = sum(genome_column(all, &GenomeStudy::contacts, &Contacts::nodes)),
                          lost = sum(genome_column(all, &GenomeStudy::contacts, &Contacts::lost));
             return Finding(nodes > 0 ? lost : unknown, {{"nodes in contact", nodes}});
         }},
        {"one-wave", [](Run, All all) { return highest(column(all.chromosomes, &ChromosomeExample::misfit)); }},
        {"wavelength",
         [](Run, All all) { return all.chromosomes.empty() ? unknown : 1e3 * all.chromosomes.back().wave_length; }},
        {"condition",
         [](Run, All all) {
             const Numbers printed = column(all.ridges, &RidgeCount::as_printed),
                           slipped = column(all.ridges, &RidgeCount::last_missing);
             const Numbers within = column(printed, [](double s) { return s >= 0.885 && s <= 0.98 ? 1. : 0.; });
             return Finding(rough::mean(within), {{"share as printed, mean", rough::mean(printed)},
                                                  {"last pair missing, mean", rough::mean(slipped)},
                                                  {"least", lowest(slipped)},
                                                  {"greatest", highest(slipped)}});
         }},
        {"arccos", [](Run, All all) { return rough::mean(column(all.ridges, &RidgeCount::right_phase)); }},
        {"part-suffices",
         [](Run, All all) {
             const Numbers alike = genome_column(all, &GenomeStudy::dominant, &Reduction::similarity);
             const double kept = rough::mean(genome_column(all, &GenomeStudy::dominant, &Reduction::kept));
             return Finding(kept < 1 ? median(alike) : unknown, {{"share of chromosomes kept", kept}});
         }},
        {"coarse-stiffness", [](Run, All all) { return governed(all, &Removal::stiffness, true); }},
        {"fine-area", [](Run, All all) { return governed(all, &Removal::area, false); }},
        {"alloy-stiffness", [](Run, All all) { return over_alloys(all, &FractalStudy::similarity); }},
        {"alloy-area", [](Run, All all) { return over_alloys(all, &FractalStudy::area_gap); }},
        {"low-part", [](Run, Target target) { return in_part(target, &Scores::low); }},
        {"high-part", [](Run, Target target) { return in_part(target, &Scores::high); }},
        {"trend", among_curves},
        {"max-pressure",
         [](Run run, All) {
             const Numbers unscaled = column(run.database, [&](const Answered& member) {
                 return run.max_pressure / std::abs(member.genome.scale);
             });
             return Finding(run.max_pressure / highest(unscaled),
                            {{"genomes' least, MPa", lowest(unscaled)}, {"greatest, MPa", highest(unscaled)}});
         }},
        {"threshold-units", [](Run, All) { return unknown; }},
        {"gco-varies", [](Run, Target target) { return spread_of_best(target, "gco"); }},
        {"cco-steady", [](Run, Target target) { return spread_of_best(target, "cco"); }},
        {"cco-parents",
         [](Run, Target target) {
             std::set<std::set<std::uint64_t>> pairs;
             for (const json& row : target.thresholds)
                 if (row.at("variant") == "cco") pairs.insert(row.at("parents"));
             return pairs.empty() ? unknown : static_cast<double>(pairs.size());
         }},
        {"size-varies",
         [](Run, Target target) {
             const Numbers sizes = over_thresholds(target, "gco", "U3");
             return Finding(highest(sizes) / lowest(sizes), {{"smallest", lowest(sizes)}, {"largest", highest(sizes)}});
         }},
        {"size-equal",
         [](Run, Target target) {
             const Numbers gco = over_thresholds(target, "gco", "U3"), cco = over_thresholds(target, "cco", "U3");
             Numbers equal;
             for (std::size_t i = 0; gco.size() == cco.size() && i < gco.size(); ++i) equal.push_back(gco[i] == cco[i]);
             return rough::mean(equal);
         }},
        {"efficient",
         [](Run, Target target) {
             const auto mean = [&](const char* variant, const char* name) {
                 return rough::mean(over_thresholds(target, variant, name));
             };
             const double gco = mean("gco", "similarity"), cco = mean("cco", "similarity");
             return Finding(gco - cco, {{"gco", gco},
                                        {"cco", cco},
                                        {"share of U₃ above 0.95, gco", mean("gco", "share_above")},
                                        {"cco", mean("cco", "share_above")}});
         }},
        {"cco-proportional", proportion},
    };
    return all;
}

/// Whether a number meets a condition, comparison after comparison.
bool meets(const std::string& condition, double number) {
    if (condition == "never") return false;
    std::istringstream words(condition);
    std::string comparison, conjunction;
    for (double bound = 0; words >> comparison >> bound; words >> conjunction)
        if (!(comparison == "<"    ? number < bound
              : comparison == "<=" ? number <= bound
              : comparison == ">"  ? number > bound
              : comparison == ">=" ? number >= bound
                                   : number == bound))
            return false;
    return true;
}

} // namespace

std::vector<Finding> findings_of(const Claim& claim, const PaperRun& run, const Studies& studies) {
    const auto found = measures().find(claim.number);
    if (found != measures().end() && found->second.index() == 0) return {std::get<0>(found->second)(run, studies)};
    std::vector<Finding> findings;
    for (const TargetRun& target : run.targets) {
        findings.push_back(found == measures().end() ? over_answers(claim.number, run, target)
                                                     : std::get<1>(found->second)(run, target));
        findings.back().on = target.title;
    }
    return findings;
}

const std::vector<Claim>& paper_claims() {
    static const std::vector<Claim> claims = [] {
        std::vector<Claim> all;
        auto rows = csv_rows(builtin_files().at("claims.csv"));
        for (auto r = rows.begin() + 1; r != rows.end(); ++r)
            all.push_back({r->at(0), r->at(1), r->at(2), r->at(3), r->at(4), r->at(5), r->at(6), r->at(7)});
        return all;
    }();
    return claims;
}

std::string Claim::rule() const {
    return reproduced == "never" && contradicted == "never"
               ? "cannot be decided"
               : "reproduced if " + reproduced + ", contradicted " +
                     (contradicted == "otherwise" || contradicted == "never" ? "" : "if ") + contradicted;
}

std::string verdict_of(const Claim& claim, const std::vector<double>& numbers) {
    const auto all = [&](const auto& holds) {
        return !numbers.empty() &&
               std::ranges::all_of(numbers, [&](double number) { return !std::isnan(number) && holds(number); });
    };
    if (all([&](double number) { return meets(claim.reproduced, number); })) return "reproduced";
    return all([&](double number) {
        return claim.contradicted == "otherwise" ? !meets(claim.reproduced, number) : meets(claim.contradicted, number);
    })
               ? "contradicted"
               : "undecidable";
}

void add_claims(Findings& found, const PaperRun& run, const Studies& studies) {
    Csv& table = found.table("claims.csv", "id,figure,sentence,measure,rule,verdict,number,number_heldout");
    json &claims = found.result["claims"] = json::array(),
         &counts = found.result["verdicts"] = {{"reproduced", 0}, {"contradicted", 0}, {"undecidable", 0}};
    for (const Claim& claim : paper_claims()) {
        const std::vector<Finding> findings = findings_of(claim, run, studies);
        std::vector<double> known = rough::column(findings, &Finding::number);
        const std::string verdict = verdict_of(claim, known);
        counts[verdict] = counts[verdict].get<int>() + 1;
        json numbers = json::array();
        for (const Finding& finding : findings) {
            numbers.push_back({{"on", finding.on},
                               {"number", finding.number},
                               {"known", !std::isnan(finding.number)},
                               {"verdict", verdict_of(claim, {finding.number})},
                               {"parts", json::array()}});
            for (const auto& [name, value] : finding.parts)
                numbers.back()["parts"].push_back({{"name", name}, {"value", value}});
        }
        known.resize(2, unknown);
        table.row(claim.id, claim.place, claim.sentence, claim.measure, claim.rule(), verdict, known[0], known[1]);
        const auto other = run.other_readings.find(claim.id);
        const std::string figure =
            claim.place.starts_with("Figure ") ? claim.place.substr(7, claim.place.find_last_of("0123456789") - 6) : "";
        claims.push_back({{"id", claim.id},
                          {"place", claim.place},
                          {"figure_number", figure},
                          {"sentence", claim.sentence},
                          {"measure", claim.measure},
                          {"rule", claim.rule()},
                          {"remark", claim.remark},
                          {"verdict", verdict},
                          {"numbers", std::move(numbers)},
                          {"other_readings", other == run.other_readings.end() ? "" : other->second}});
    }
}

const VariantRun* find_variant(const TargetRun& target, const std::string& name) {
    const auto found = std::ranges::find(target.variants, name, &VariantRun::name);
    return found == target.variants.end() ? nullptr : &*found;
}

std::vector<Refinement> refinements(const VariantRun& variant) {
    const auto& stages = variant.stages;
    const auto is_refinement = [](const StageRecord& stage) {
        return stage.path.compare(stage.path.rfind('/') + 1, 6, "refine") == 0;
    };
    const auto similarity_of = [](const StageRecord& stage, std::uint64_t id) {
        const auto found = std::ranges::find(stage.candidates, id, &Candidate::id);
        return found == stage.candidates.end() ? unknown : found->similarity;
    };
    const auto first = std::ranges::find_if(stages, is_refinement);
    if (first == stages.end() || first == stages.begin()) return {};
    const auto second = std::find_if(first + 1, stages.end(), is_refinement);
    const StageRecord& last = second == stages.end() ? *first : *second;
    std::vector<Refinement> result;
    for (const Candidate& start : (first - 1)->candidates)
        result.push_back(
            {start.id, {start.similarity, similarity_of(*first, start.id), similarity_of(last, start.id)}});
    std::ranges::stable_sort(result, std::greater<>(), [](const Refinement& one) { return one.similarity[0]; });
    return result;
}

std::optional<std::size_t> best_in_part(const TargetRun& target, double Scores::*part) {
    const std::vector<Scores>& scores = target.database;
    std::optional<std::size_t> best;
    for (std::size_t genome = 0; genome < scores.size(); ++genome)
        if (scores[genome].all <= 0.95 && (!best || scores[genome].*part > scores[*best].*part)) best = genome;
    return best;
}

} // namespace app
