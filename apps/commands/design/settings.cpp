#include "apps/commands/design/run.hpp"
#include "apps/prompt/model_settings.hpp"
#include "apps/prompt/targets.hpp"
#include "apps/report/surface.hpp"
#include "domain/database/screen.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/problem/prices.hpp"

#include <numbers>

namespace app {
namespace {

/// The parameters that the set-up of a design holds.
Bindings bindings_of(rough::DesignSetup& setup) {
    rough::MakingLimits& limits = setup.limits;
    Bindings bindings{
        {max_pressure_setting(), setup.max_pressure},
        {ga::number("reach-similarity", "", -1, 1,
                    "similarity that an answer must have in all checks. The variants default and like "
                    "restart a few times if it is not reached. Exit code 3 if no answer has it [0.99]"),
         setup.required_similarity},
        {whole("ridges", "", 1, 64, "ridges of each chromosome of drawn genomes [1; for a map, their directions: 8]"),
         setup.ridges},
        {positive("shortest-wave", "", "shortest wavelength that can be made, mm [8 node spacings]"),
         limits.shortest_wave},
        {positive("max-slope", "", "largest slope that can be made"), limits.max_slope},
        {positive("max-height", "", "largest height range, mm"), limits.max_height},
        {positive("min-radius", "", "smallest radius of curvature, mm"), limits.min_radius},
        {ga::number("lambda-from", "", 1e-12, 1e12, "lower bound of the longest wavelength of a series, mm [L/4]"),
         setup.bounds.lambda_from},
        {ga::number("lambda-to", "", 1e-12, 1e12, "upper bound of the longest wavelength of a series, mm [4 L]"),
         setup.bounds.lambda_to},
        {positive("noise", "",
                  "rms height noise, mm, under which 95 % of the draws must have the similarity. Profiles "
                  "are searched under it, and maps are verified under it [none]"),
         setup.errors.noise},
        {positive("noise-length", "", "correlation length of height noise, mm [L/60]"), setup.errors.noise_length},
        {positive("tilt", "",
                  "tilt, as a height over the length, mm, under which the answer must have the similarity [none]"),
         setup.errors.tilt},
    };
    return with_bounds(std::move(bindings), setup.bounds);
}

/// The surface in production of --from, --control and --largest-change; nothing without --from.
std::optional<Production> production_from(const Settings& settings) {
    if (!settings.has("from")) {
        expect_none(settings, {"control", "largest-change"},
                    "given without --from; give the genome of a surface in production");
        return std::nullopt;
    }
    expect_none(settings,
                {"variant", "pipeline", "database", "resume", "alternatives", "evaluations", "hurst-from", "hurst-to",
                 "gamma-from", "gamma-to", "lambda-from", "lambda-to"},
                "given with --from; omit it, as nothing is searched");
    Production from{settings.text("from"), rough::read_genome(settings.text("from")), {}, 0};
    from.control =
        placing(settings, "", [&] { return rough::chromosomes_from(settings.text("control"), from.genome); });
    from.largest_change = settings.number("largest-change");
    return from;
}

/// Throws rough::InputError on values that contradict each other.
void expect_consistent(const Settings& settings, const rough::DesignSetup& setup) {
    const rough::Grid& grid = setup.model.grid;
    for (const rough::Target& target : setup.targets)
        if (setup.max_pressure && target.against_pressure() && target.last() > *setup.max_pressure * (1 + 1e-9))
            settings.refuse("max-pressure", settings.text("max-pressure"),
                            " MPa is too low; give at least the last pressure of ", target.name, ", ",
                            readable(target.last(), 6), " MPa");
    const double shortest = std::min(grid.widest_spacing(), grid.length / 60);
    if (const double length = setup.errors.noise_length;
        settings.has("noise-length") && (length < shortest || length > grid.length))
        settings.refuse("noise-length", settings.text("noise-length"), " is out of range; give a number from ",
                        readable(shortest, 6), " to ", readable(grid.length, 6));
    expect_in_order(settings.with({{"lambda-from", ga::number(setup.bounds.lambda_from)},
                                   {"lambda-to", ga::number(setup.bounds.lambda_to)}}),
                    {"hurst", "gamma", "lambda"});
    placing(settings, "", [&] { validate(setup); });
}

} // namespace

std::vector<Setting> search_settings() {
    rough::DesignSetup setup;
    rough::SearchOptions options;
    const std::vector<Setting> settings{
        Setting("quantity", "both", "target from the response of --like; both: stiffness and contact area")
            .of(rough::names_of_likeness()),
        whole("points", "20", 2, 1e5, "number of points of the target from --like"),
        {"database", "", "genome database; the search begins from its curves nearest to the target"},
        {"variant", "",
         "name of the pipeline to run (rugosa operators) [default, or maps for a map, in-line or maps-in-line with "
         "--database, like or maps-like for a scan's or map's contact area, made with --noise or --tilt]"},
        {"pipeline", "", "text of the pipeline to run, instead of a variant"},
        positive("hardness", "",
                 "hardness that limits the pressure of each node when the answer is verified, MPa [that of "
                 "--material]"),
        whole("draws", "", 20, 1e6, "draws of noise for the tolerance [as many as cost as much as the search]"),
    };
    return joined({settings, settings_of(bindings_of(options)), settings_of(bindings_of(setup)), model_settings()});
}

std::vector<Setting> design_settings() {
    const std::vector<Setting> settings{
        {"target", "", "target file (CSV), or several with commas between"},
        positive("weights", "", "weight of each target, with commas between [1 each]").several(),
        {"like", "", "measured profile, or map (a text matrix with --spacing); its response becomes the target"},
        {"from", "",
         "genome (JSON) of a surface in production; the phases of --control are changed as little as is "
         "necessary to meet the target"},
        {"control", "", "chromosomes of --from whose phases may change, SERIES:CHROMOSOME, e.g. 1:3,1:5"},
        ga::number("largest-change", "0.05", ga::above_zero, 0.5,
                   "largest change of a phase, as a share of a turn, up to 0.5"),
        {"out", "", "folder for the results [out/design, or out/design-2 and on]"},
        force_setting(),
        Setting("resume", "",
                "continue the design in the folder given by --out, which was interrupted, killed or out of time", true),
        pictures_setting(),
    };
    return joined(
        {settings, scale_settings(), search_settings(), asperity_settings(), scan_settings(), {resolution_setting()}});
}

std::vector<rough::Target> targets_from(const Settings& settings, const rough::Model& model) {
    std::vector<rough::Target> targets;
    for (const std::string& file : rough::listed(settings.text("target")))
        targets.push_back(target_from(settings, file, model));
    if (settings.has("weights")) {
        const auto weights = settings.numbers("weights");
        if (weights.size() != targets.size())
            settings.refuse("weights", weights.size(), " given; give ", targets.size(), ", one per target");
        for (std::size_t i = 0; i < targets.size(); ++i) targets[i].weight = weights[i] / std::ranges::max(weights);
    }
    return targets;
}

std::string pipeline_from(const Settings& settings, const std::map<std::string, std::string>& variants,
                          const std::string& usual) {
    if (settings.given("variant") && settings.given("pipeline"))
        rough::refuse("design: two pipelines are given; give either ", settings.place("variant"), " or ",
                      settings.place("pipeline"));
    if (!settings.has("variant")) return settings.has("pipeline") ? settings.text("pipeline") : usual;
    const auto names = names_of(variants);
    return names[settings.one_of("variant", names)];
}

rough::DesignSetup setup_like(const rough::Profile& surface, const rough::Model& model, const std::string& name,
                              const Settings& settings, rough::Resolution resolution) {
    auto nodes = surface.is_2d() ? cells_from(settings) : std::nullopt;
    if (!surface.is_2d() && settings.has("nodes")) nodes = rough::Extent{settings.whole<rough::Index>("nodes")};
    std::optional<double> max_pressure;
    settings.take("max-pressure", max_pressure);
    return design_like(surface, model, name, rough::likeness_named(settings.text("quantity")),
                       settings.whole<rough::Index>("points"), nodes, resolution, max_pressure);
}

DesignRequest request_from(const Settings& settings) {
    the_given(settings, {"target", "like"}, "design");
    const bool is_like = settings.has("like"), is_map = asks_for_map(settings);
    DesignRequest request;
    request.from = production_from(settings);
    if (is_like) {
        // The nodes are those of the design.
        const Scene scene = scene_from(settings.with({{"nodes", ""}}), "like", is_map);
        request.accounts = scene.notes;
        // The band of a map would take most of the time.
        request.setup =
            setup_like(scene.surface, scene.model, settings.text("like"), settings,
                       is_map && !settings.given("resolution") ? rough::Resolution::off : resolution_from(settings));
    } else {
        std::vector<std::string> of_a_scan = names_of(scan_settings());
        of_a_scan.insert(of_a_scan.end(), {"resolution", "points", "quantity"});
        expect_none(settings, of_a_scan, "given with --target; give it with --like only");
        const rough::Model model = request.from && !is_map ? model_from(settings, open_genome(request.from->file))
                                                           : surface_model_from(settings);
        request.setup = {.model = model, .targets = targets_from(settings, model)};
        if (is_map && model.body.kernel == rough::Kernel::free) request.accounts.emplace_back(no_datum_note);
    }
    const auto of_files = is_like ? std::vector<rough::Target>() : request.setup.targets;
    std::ranges::copy(notes_on(settings, request.setup.model, of_files), std::back_inserter(request.accounts));
    return request;
}

bool is_judged_on_grid(const DesignRun& run) { return run.morphed && !run.setup.model.grid.is_2d(); }

rough::DesignSetup toleranced(const DesignRun& run) {
    return is_judged_on_grid(run) ? run.setup : as_verified(run.setup, run.found.best);
}

rough::ToleranceOptions priced_tolerance(const DesignRun& run, const rough::DesignSetup& tried) {
    rough::ToleranceOptions options = run.tolerance_options;
    if (const double price = run.found.counters.price; price > 0) // no search ran for the phases of --from
        options.price = price / relative_price(tried.model, run.setup.model);
    return options;
}

DesignRun design_from(const Settings& settings, DesignRequest request, const ga::Stopwatch& clock) {
    DesignRun run;
    run.clock = clock;
    static_cast<DesignRequest&>(run) = std::move(request);
    rough::DesignSetup& setup = run.setup;
    if (run.from) {
        setup.phases = rough::PhaseReach{0, 2 * std::numbers::pi * run.from->largest_change};
        setup.limits = {};
    }
    take(settings, bindings_of(setup));
    expect_consistent(settings, setup);
    rough::SearchOptions& options = run.options;
    options.pipeline =
        pipeline_from(settings, rough::design_variants(), usual_variant(setup, settings.has("database")));
    if (setup.model.grid.is_2d()) options.alternatives = 1;
    take(settings, app::bindings_of(options));
    setup.model.contact.threads = ga::thread_count(options.threads);
    if (settings.has("database")) {
        const std::string& database = settings.text("database");
        const auto store = rough::GenomeStore::open(database);
        options.starts = rough::stored_starts(store, setup, 100, options.threads);
        if (options.starts.empty())
            rough::refuse(database, ": no stored curve reaches the end of the target; "
                                    "use a database with more genomes");
        run.accounts.push_back(database + ": " + std::to_string(store.stored()) +
                               " stored curves screened, the search begins from the nearest " +
                               std::to_string(options.starts.size()));
    }
    run.unreachable =
        rough::unreachable(setup, settings.has("reach-similarity") ? setup.required_similarity : rough::exact_enough);
    if (!run.unreachable.reasons.empty())
        options.evaluations = std::min(options.evaluations, rough::enough_for_the_nearest);
    run.trust_options.seed = run.tolerance_options.seed = options.seed;
    run.trust_options.threads = run.tolerance_options.threads = options.threads;
    settings.take("hardness", run.trust_options.hardness);
    if (!run.trust_options.hardness && settings.has("material"))
        run.trust_options.hardness = elastic_limit(settings, setup.model.body);
    if (run.from) run.trust_options.phase_draws = 0; // with other phases it is another surface
    run.tolerance_options.fixed_draws = settings.has("evaluations");
    settings.take("draws", run.tolerance_options.draws);
    if (setup.measured) {
        rough::Model model = setup.model;
        model.contact.spots = true;
        run.warning = resolution_warning(respond(*setup.measured, model));
    }
    for (const char* limit : {"shortest-wave", "max-slope", "max-height", "min-radius"})
        run.limits_given |= settings.has(limit);
    return run;
}

} // namespace app
