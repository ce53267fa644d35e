#include "apps/commands/design/settings.hpp"

#include "apps/prompt/goals.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/report/units.hpp"
#include "domain/database/starts.hpp"
#include "domain/design/like.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/unreachable.hpp"
#include "domain/errors.hpp"
#include "domain/problem/setup.hpp"
#include "domain/text/words.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace app {

namespace {

std::vector<rough::Target> goals_from(const Settings& settings, const rough::Model& model) {
    std::vector<rough::Target> goals;
    for (const std::string& file : rough::listed(settings.text("target")))
        goals.push_back(goal_from(settings, file, model));
    if (settings.has("weights")) {
        const auto weights = rough::listed(settings.text("weights"));
        if (weights.size() != goals.size())
            throw rough::InputError("--weights: " + std::to_string(weights.size()) + " given, expected " +
                                    std::to_string(goals.size()) + ", one a target");
        double largest = 0;
        for (std::size_t i = 0; i < goals.size(); ++i) {
            goals[i].weight = rough::number_from(weights[i], "--weights");
            if (!(goals[i].weight > 0))
                throw rough::InputError("--weights: " + weights[i] +
                                        " given, expected numbers greater than 0");
            largest = std::max(largest, goals[i].weight);
        }
        for (rough::Target& goal : goals)
            goal.weight /= largest;
    }
    return goals;
}

/// --NAME-from and --NAME-to, each between `least` and `greatest`.
void take_range(const Settings& settings, const std::string& name, double& from, double& to, double least,
                double greatest) {
    const auto shown = [&](const std::string& flag, double value) {
        return "--" + flag + ": " +
               (settings.has(flag) ? settings.text(flag) + " given" : readable(value, 6) + " by itself");
    };
    for (const auto& [flag, value] : {std::pair(name + "-from", &from), std::pair(name + "-to", &to)})
        if (settings.has(flag))
            *value = settings.number(flag, least, greatest);
    if (from > to)
        throw rough::InputError(shown(name + "-from", from) + ", " + shown(name + "-to", to) +
                                ", expected from no greater than to");
}

void take_bounds(const Settings& settings, rough::DesignSetup& setup) {
    rough::GeneBounds& bounds = setup.bounds;
    take_range(settings, "hurst", bounds.H_from, bounds.H_to, std::numeric_limits<double>::min(), 10);
    take_range(settings, "gamma", bounds.gamma_from, bounds.gamma_to, 1.001, 100);
    bounds = completed(bounds, setup.model.grid.length);
    take_range(settings, "lambda", bounds.lambda_from, bounds.lambda_to, 1e-12, 1e12);
    rough::MakingLimits& limits = setup.limits;
    for (const auto& [name, limit] :
         {std::pair("shortest-wave", &limits.shortest_wave), std::pair("max-slope", &limits.max_slope),
          std::pair("max-height", &limits.max_height), std::pair("min-radius", &limits.min_radius)})
        if (settings.has(name))
            *limit = settings.positive(name);
    setup = placing(settings, "", [&] { return completed(setup); });
}

void take_errors(const Settings& settings, rough::DesignSetup& setup) {
    rough::MakingErrors& errors = setup.errors;
    for (const auto& [name, value] : {std::pair("noise", &errors.noise), std::pair("tilt", &errors.tilt)})
        if (settings.has(name))
            *value = settings.positive(name);
    const rough::Grid& grid = setup.model.grid;
    if (settings.has("noise-length"))
        errors.noise_length =
            settings.number("noise-length", std::min(grid.widest_spacing(), grid.length / 60), grid.length);
}

} // namespace

std::vector<Setting> design_settings() {
    const rough::GeneBounds usual;
    const std::vector<Setting> settings{
        {"target", "", "target file (CSV); several with commas between"},
        {"weights", "", "how much each target counts, with commas between [1 each]"},
        {"like", "",
         "measured profile whose own response is the target, or with --spacing DXxDY a map, a text matrix"},
        {"quantity", "both",
         "of the scan's response: both (stiffness and contact area), stiffness, area or "
         "interface_stiffness"},
        {"points", "20", "points of the target that --like gives"},
        {"resistivity", "",
         "rho1 + rho2 of a conductance target, C = 2 K_i/(E* (rho1 + rho2)) of the interface stiffness K_i"},
        {"max-pressure", "",
         "rescale every genome to this mean pressure at full approach (Eq. 11), MPa [amplitude is a gene]"},
        {"database", "", "genome database whose stored curves nearest to the target the search begins from"},
        {"from", "",
         "genome (JSON) of a surface in production: the least change of --control brings it back to the "
         "target"},
        {"control", "", "the chromosomes of --from whose phases may move, SERIES:CHROMOSOME, e.g. 1:3,1:5"},
        {"largest-change", "0.05", "largest change of such a phase, as a share of a turn, up to 0.5"},
        {"variant", "",
         "how to search: a named pipeline (rugosa operators) [default; on an area maps; with --database "
         "in-line; for a scan's contact area like; with --noise or --tilt made]"},
        {"pipeline", "", "how to search: a pipeline as text, in place of a variant"},
        {"seconds", "",
         "wall time of the whole program; an area that there is no time to verify is said to be not verified "
         "[until the pipeline ends]"},
        {"reach-similarity", "",
         "the similarity that an answer must have at its worst, which the variants default and like begin "
         "anew "
         "for; exit 3 if none has [0.99]"},
        {"evaluations", "", "end after so many curves and gradients [when the pipeline ends]"},
        {"alternatives", "",
         "different answers to return [" + std::to_string(rough::SearchOptions().alternatives) +
             "; of an area, where each is verified at length: 1]"},
        {"out", "", "folder for the results [out/design, or out/design-2 and on]"},
        {"force", "", "write over an existing result", true},
        {"resume", "",
         "continue the design in the folder given by --out that was interrupted, killed or out of time",
         true},
        {"pictures", "on", "off leaves out the report"},
        {"seed", "1", "seed of the random numbers"},
        {"threads", "0", "threads; 0 takes all"},
        {"ridges", "", "ridges of each chromosome of drawn genomes [1; an area, their directions: 8]"},
        {"shortest-wave", "", "shortest wave that can be made, mm [8 node distances]"},
        {"max-slope", "", "largest slope that can be made"},
        {"max-height", "", "largest height range, mm"},
        {"min-radius", "", "smallest radius of curvature, mm"},
        {"hurst-from", "", "least H [" + brief(usual.H_from, 15) + "]"},
        {"hurst-to", "", "largest H [" + brief(usual.H_to, 15) + "]"},
        {"gamma-from", "", "least gamma [" + brief(usual.gamma_from, 15) + "]"},
        {"gamma-to", "", "largest gamma [" + brief(usual.gamma_to, 15) + "]"},
        {"lambda-from", "", "least longest wave of a series, mm [L/4]"},
        {"lambda-to", "", "largest longest wave of a series, mm [4 L]"},
        {"noise", "",
         "rms of the height noise under which 95 % of the draws must hold, mm: a profile is searched for "
         "under "
         "it, an area verified under it [none]"},
        {"noise-length", "", "correlation length of height noise, mm [L/60]"},
        {"tilt", "", "height over the length that the answer may be tilted by, mm, as --noise [none]"},
        {"hardness", "", "hardness that no node bears more than, MPa, to verify the answer under [none]"},
    };
    return joined(
        {settings, scan_settings(), {resolution_setting()}, model_settings(), {accuracy_setting()}});
}

namespace {

/// What --from, --control and --largest-change ask for; nothing without --from.
std::optional<Production> production_from(const Settings& settings) {
    const std::vector<Setting> own{{"control", "", ""}, {"largest-change", "", ""}};
    if (!settings.has("from")) {
        expect_none(settings, own, "given without --from, expected the genome of a surface in production");
        return std::nullopt;
    }
    std::vector<Setting> of_a_search;
    for (const char* flag : {"variant", "pipeline", "database", "resume", "alternatives", "evaluations",
                             "hurst-from", "hurst-to", "gamma-from", "gamma-to", "lambda-from", "lambda-to"})
        of_a_search.push_back({flag, "", ""});
    expect_none(settings, of_a_search, "given with --from, expected without: nothing is searched");
    Production from{settings.text("from"), rough::read_genome(settings.text("from")), {}, 0};
    from.control =
        placing(settings, "", [&] { return rough::chromosomes_from(settings.text("control"), from.genome); });
    from.largest_change = settings.number("largest-change", std::numeric_limits<double>::min(), 0.5);
    return from;
}

std::vector<std::string> names_of(const ga::Variants& variants) {
    std::vector<std::string> names;
    for (const auto& [name, text] : variants)
        names.push_back(name);
    return names;
}

} // namespace

DesignRun design_from(const Settings& settings) {
    if (settings.has("target") == settings.has("like"))
        throw rough::InputError("design: expected either --target or --like");
    DesignRun run;
    run.from = production_from(settings);
    rough::DesignSetup& setup = run.setup;
    if (run.from)
        setup.phases = rough::PhaseReach{0, 2 * std::numbers::pi * run.from->largest_change};
    if (settings.has("max-pressure"))
        setup.max_pressure = settings.pressure("max-pressure");
    if (settings.has("ridges"))
        setup.ridges = static_cast<int>(settings.whole("ridges", 1, 64));
    const bool area = asks_for_area(settings);
    for (const char* name : {"database", "from"})
        if (area && settings.has(name))
            throw rough::InputError(settings.place(name) +
                                    ": given with an area, expected none: it is for profiles alone");
    const auto likeness = [&] {
        return rough::likeness_named(
            rough::names_of_likeness()[settings.one_of("quantity", rough::names_of_likeness())]);
    };
    const long points = settings.whole("points", 2, 100000);
    if (settings.has("like") && area) {
        const AreaScene scene = area_from(settings, "like");
        run.accounts = scene.notes;
        setup = like(setup, scene.map, scene.model, settings.text("like"), likeness(), points, 0,
                     // A map's band would take most of the time.
                     settings.given("resolution") ? resolution_from(settings) : rough::Resolution::off);
    } else if (settings.has("like")) {
        const rough::Source scan = scan_from(settings.text("like"), settings, 0);
        run.accounts.push_back(scan.account);
        rough::Model own = model_from(settings, scan);
        own.grid.nodes = scan.measured.nodes();
        setup = like(setup, scan.on(own.grid), own, scan.name, likeness(), points, nodes_from(settings, 0),
                     resolution_from(settings));
    } else {
        expect_none(
            settings,
            joined({scan_settings(), {resolution_setting(), {"points", "", ""}, {"quantity", "", ""}}}),
            "given with --target, expected with --like only");
        setup.model = run.from ? model_from(settings, rough::open_genome(run.from->file))
                               : surface_model_from(settings);
        setup.targets = goals_from(settings, setup.model);
        if (area && setup.model.body.kernel == rough::Kernel::free)
            run.accounts.emplace_back(no_datum_note);
    }
    for (const rough::Target& goal : setup.targets)
        if (setup.max_pressure && goal.against_pressure() && goal.last() > *setup.max_pressure * (1 + 1e-9))
            throw rough::InputError("--max-pressure: " + settings.text("max-pressure") +
                                    " MPa given, expected at least the last pressure of " + goal.name + ", " +
                                    readable(goal.last(), 6) + " MPa");
    for (const auto& note : without_effect(settings, rough::listed(settings.text("target"))))
        run.accounts.push_back(note);
    for (const auto& note : carried_notes(setup.targets, setup.model))
        run.accounts.push_back(note);
    take_errors(settings, setup);
    take_bounds(settings, setup);
    for (const char* limit : {"shortest-wave", "max-slope", "max-height", "min-radius"})
        run.limits_given = run.limits_given || settings.has(limit);
    run.searched = setup;
    run.searched.model.accuracy = accuracy_from(settings);

    if (settings.given("variant") && settings.given("pipeline"))
        throw rough::InputError("design: expected either --variant or --pipeline");
    rough::SearchOptions& options = run.options;
    options.pipeline = settings.has("variant")    ? settings.text("variant")
                       : settings.has("pipeline") ? settings.text("pipeline")
                                                  : usual_variant(setup, settings.has("database"));
    if (settings.has("variant") && !rough::design_variants().count(options.pipeline))
        throw rough::InputError("--variant: unknown variant '" + options.pipeline + "'" +
                                ga::suggestion(options.pipeline, names_of(rough::design_variants())));
    options.seed = settings.seed("seed");
    options.threads = settings.threads("threads");
    if (settings.has("alternatives"))
        options.alternatives = static_cast<std::size_t>(settings.whole("alternatives", 1, 100));
    else if (area)
        options.alternatives = 1;
    if (settings.has("seconds"))
        options.seconds = settings.positive("seconds");
    if (settings.has("reach-similarity"))
        setup.required_similarity = run.searched.required_similarity =
            settings.number("reach-similarity", -1, 1);
    if (settings.has("evaluations"))
        options.evaluations = settings.whole("evaluations", 1, 1'000'000'000);

    run.tolerance_options = {
        .seed = options.seed, .threads = options.threads, .fixed_draws = settings.has("evaluations")};
    if (settings.has("hardness"))
        run.trust_options.hardness = settings.positive("hardness");
    run.trust_options.seed = options.seed;
    run.trust_options.threads = options.threads;
    if (run.from)
        run.trust_options.phase_draws = 0; // other phases are another surface

    if (settings.has("database")) {
        const auto store = rough::GenomeStore::open(settings.text("database"));
        options.starts = rough::stored_starts(store, setup, 100, options.threads);
        if (options.starts.empty())
            throw rough::InputError(settings.text("database") +
                                    ": no stored curve reaches as far as the target");
        run.accounts.push_back(settings.text("database") + ": " + std::to_string(store.stored()) +
                               " stored curves screened, the search begins from the nearest " +
                               std::to_string(options.starts.size()));
    }

    const rough::Unreachable beyond = rough::unreachable(
        setup, settings.has("reach-similarity") ? setup.required_similarity : rough::exact_enough);
    run.out_of_reach = beyond.reasons;
    run.bound = beyond.bound;
    return run;
}

} // namespace app
