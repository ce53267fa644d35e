#include "apps/cluster/evaluator.hpp"
#include "domain/design/explore.hpp"
#include "domain/design/pipelines.hpp"
#include "domain/design/starts.hpp"
#include "domain/mwm/response.hpp"
#include "domain/problem/prices.hpp"
#include "tests/apps/results.hpp"
#include "tests/domain/design/setups.hpp"

#include <fstream>
#include <mutex>
#include <set>

namespace rough {

/// The linker sends every call of solve_contact() from another file to the second function
/// (tests/CMakeLists.txt).
#define SOLVE_CONTACT "_ZN5rough13solve_contactERKNS_7ProfileERKNS_4BodyERKSt6vectorIdSaIdEERKNS_14ContactOptionsE"
ContactCurve solve_uncounted(const Profile&, const Body&, const std::vector<double>&,
                             const ContactOptions&) asm("__real_" SOLVE_CONTACT);
ContactCurve solve_counted(const Profile&, const Body&, const std::vector<double>&,
                           const ContactOptions&) asm("__wrap_" SOLVE_CONTACT);

namespace {

Model unit;        ///< whose curve has the price 1
double solved = 0; ///< price of all solved curves
std::mutex guard;

} // namespace

ContactCurve solve_counted(const Profile& profile, const Body& body, const std::vector<double>& displacements,
                           const ContactOptions& options) {
    Model model;
    model.grid.nodes = profile.shape().columns;
    model.grid.rows = profile.shape().rows;
    model.grid.width = profile.is_2d();
    model.loading.steps = static_cast<int>(displacements.size());
    {
        const std::lock_guard lock(guard);
        const bool is_for_derivative = options.states && displacements.size() > 1;
        solved += (is_for_derivative ? 1.4 : 1) * relative_price(model, unit);
    }
    return solve_uncounted(profile, body, displacements, options);
}

namespace {

/// A small design. It may have a scan, two targets, or an amplitude that Eq. 11 does not set.
DesignSetup setup_for(bool is_map, const std::string& variant, bool free_amplitude) {
    DesignSetup setup = testing::drawn(is_map ? 16 : 48, is_map);
    setup.model.loading.steps = 5;
    setup.errors.noise = setup.errors.tilt = 1e-7;
    if (variant == "like" || variant == "maps-like")
        setup.measured = sample(shaped_start(setup, ga::Stream(7)), setup.model.grid);
    if (variant == "mcco" || variant == "nsga2")
        setup.targets.push_back(target_at(Quantity::area_at_pressure, "second", PointPlacement{}.up_to(testing::p_max),
                                          [](double p) { return 0.3 * p / testing::p_max; }));
    if (free_amplitude) setup.max_pressure.reset();
    unit = setup.model;
    return setup;
}

/// The price that a run of a variant reports, and the price of the curves that were solved for it.
struct Paid {
    double reported = 0, solved = 0;
    long requested = 0;
};

Paid run_of(const std::string& variant, const DesignSetup& setup, SearchOptionsOf<DesignProblem> options,
            std::vector<ga::Observer<Genome>> observers = {}) {
    const DesignProblem problem(setup);
    const DesignPipeline pipeline = design_pipeline(setup, variant);
    std::vector<Genome> starts;
    for (std::uint64_t seed = 1; seed <= (pipeline.begins() ? 1 : 12); ++seed)
        starts.push_back(shaped_start(setup, ga::Stream(seed)));
    Exploration<DesignProblem> exploration(problem, 3, "verified");
    solved = 0;
    exploration.run(pipeline, variant, starts, options, HUGE_VAL, std::move(observers));
    const ga::Counters& counters = exploration.spent.counters;
    return {counters.price, solved, counters.requested};
}

} // namespace

TEST_CASE("the price of each variant is that of the curves that were solved") {
    for (const auto& [variant, text] : design_variants()) {
        for (const bool is_map : {false, true})
            for (const int threads : {1, 3}) {
                // On a map each kind of stage once, because its starts take seconds.
                if (!is_map && variant == "maps-like") continue;
                if (is_map &&
                    (threads == 1 || !std::set<std::string>{"maps", "maps-like", "made", "cco"}.contains(variant)))
                    continue;
                DYNAMIC_SECTION(variant << (is_map ? ", map, " : ", line, ") << threads) {
                    const Paid paid = run_of(variant, setup_for(is_map, variant, false),
                                             {.threads = threads, .evaluations = is_map ? 40 : 300});
                    INFO(text);
                    Model finer = unit; // the scan is solved once in finer load steps, which makes the target
                    finer.loading.steps *= 4;
                    const double target = variant == "like" ? relative_price(finer, unit) : 0;
                    CHECK(paid.requested > 0);
                    CHECK(paid.reported + target == Approx(paid.solved).epsilon(1e-9));
                }
            }
    }
    for (const char* text : {"sample 5 | score | best 2 | refine lm 2", "shape 4 | fit | score",
                             "pair(score | best 2, score | best 3, unite) | score | best 2"}) {
        const Paid paid = run_of(text, setup_for(false, "", true), {.threads = 2});
        INFO(text);
        CHECK(paid.reported == Approx(paid.solved).epsilon(1e-9));
    }
}

TEST_CASE("a search that is stopped and resumed pays once for each curve") {
    const tests::Folder folder;
    for (const char* variant : {"cco", "default", "maps"}) {
        const DesignSetup setup = setup_for(variant == std::string("maps"), variant, false);
        const Paid whole = run_of(variant, setup, {.threads = 2, .evaluations = 300});
        std::atomic<bool> stop = false;
        SearchOptionsOf<DesignProblem> options{.threads = 2, .evaluations = 300};
        options.stop = &stop;
        options.checkpoints = {folder / "run.cbor", false, {}, 0, ""};
        double before = 0;
        int stages = 0;
        const Paid cut = run_of(variant, setup, options, {[&](const auto&) { stop = ++stages >= 3; }});
        before = cut.solved;
        CHECK(cut.reported < whole.reported);
        stop = false;
        options.checkpoints->resume = true;
        const Paid resumed = run_of(variant, setup, options);
        INFO(variant);
        CHECK(resumed.reported == whole.reported);
        // A block on another grid restarts, because its evaluations are not stored.
        CHECK(before + resumed.solved >= resumed.reported * (1 - 1e-9));
        if (variant != std::string("maps")) CHECK(before + resumed.solved <= resumed.reported * (1 + 1e-9));
    }
}

TEST_CASE("one of two ranks counts the curves that it solves", "[.][counted-rank]") {
    namespace cluster = app::cluster;
    const DesignSetup setup = setup_for(false, "", false);
    const bool is_worker = cluster::join({{"designs", app::designs_under}});
    if (!is_worker) {
        const auto evaluator = app::design_evaluator(1);
        const Paid paid = run_of("cco", setup, {.evaluator = evaluator.get(), .evaluations = 300});
        std::ofstream("reported") << std::setprecision(17) << paid.reported;
    }
    std::ofstream("solved-" + std::to_string(getpid())) << std::setprecision(17) << solved;
    cluster::leave(0);
}

} // namespace rough
