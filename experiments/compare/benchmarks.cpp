#include "apps/report/render.hpp"
#include "domain/design/search.hpp"
#include "experiments/compare/contest.hpp"
#include "experiments/compare/problems/problems.hpp"
#include "ga/text/nearest.hpp"

#include <regex>

namespace app {

const std::map<std::string, Contestants>& usual_contestants() {
    static const std::map<std::string, Contestants> all = [] {
        std::map<std::string, Contestants> all;
        const auto rows = csv_rows(builtin_files().at("usual.csv"));
        for (auto row = rows.begin() + 1; row != rows.end(); ++row)
            all[row->at(0)].emplace_back(row->at(1), row->at(2));
        for (const std::string& name : pagmo_variants()) all["real"].emplace_back(name, name);
        for (const std::string& name : pagmo_variants(true)) all["fronts"].emplace_back(name, name);
        return all;
    }();
    return all;
}

namespace {

/// A roughness problem. The searches for maps share curves, because each begins with the same database.
struct Roughness {
    rough::DesignSetup setup;
    std::shared_ptr<rough::ResponseMemory> memory;
};

/// A search for a surface: evaluations are the price of its curves, precision is 1 less the similarity. It
/// continues after its last target, so that all answers are verified alike.
Reached raced(const Roughness& roughness, const std::string& variant, const std::vector<double>& targets,
              const Attempt& attempt) {
    Tally tally(targets, attempt);
    rough::SearchOptions options;
    options.pipeline = variant;
    options.seed = attempt.seed;
    options.threads = 1;
    options.evaluations = attempt.budget;
    options.stop = attempt.stop;
    options.alternatives = options.verifying = 1;
    options.memory = roughness.memory;
    const ga::Name similarity("similarity");
    const auto note = [&](const ga::Counters& counters, double precision) {
        tally.note(std::min(attempt.budget, std::lround(counters.requested_price)), precision);
    };
    const auto watch = [&](const ga::Event<rough::Genome>& event) {
        double best = -HUGE_VAL;
        for (const auto& individual : event.population)
            if (individual.fitness.known(similarity) && !individual.fitness.has_failed())
                best = std::max(best, individual.fitness.value());
        note(event.counters, 1 - best);
    };
    const ga::Stopwatch clock;
    const rough::SearchResult found = rough::search(roughness.setup, options, {watch});
    note(found.counters, 1 - found.best.similarity);
    Reached reached = tally.reached();
    reached.surface = variant_run("", found, {}, clock.seconds());
    reached.surface["genome"] = genome_to_json(found.best.genome);
    if (roughness.setup.model.grid.is_2d())
        reached.surface["last_displacement_mm"] =
            response_of(roughness.setup, found.best).responses.front().displacement.tail(1)[0];
    return reached;
}

void expect_fits(const Roughness& roughness, const std::string& variant) {
    rough::expect_searchable(roughness.setup, variant);
}

/// A benchmark; `make` creates the instance of a number.
template <class Make>
Benchmark benchmark(const std::string& name, const std::string& group, const std::string& kind,
                    const std::vector<double>& targets, Make make) {
    Benchmark result{.name = name, .group = group, .kind = kind, .targets = targets, .check = {}, .run = {}};
    if constexpr (requires { make(1).genes; }) result.genes = make(1).genes;
    result.check = [make](const std::string& variant) { expect_fits(make(1), variant); };
    result.run = [make, targets](const std::string& variant, int number, const Attempt& attempt) {
        return raced(make(number), variant, targets, attempt);
    };
    return result;
}

Benchmark bbob_benchmark(int dimension, int function) {
    const std::string group = "bbob" + std::to_string(dimension);
    return benchmark(group + "-" + std::to_string(function), group, "real", precisions(1e2, 1e-8), [=](int number) {
        const Bbob f(function, dimension, number);
        RealInstance instance;
        instance.genes = static_cast<std::size_t>(dimension);
        for (std::size_t i = 0; i < instance.genes; ++i) instance.box.push_back({i, -5, 5});
        instance.best = f.value();
        instance.evaluate = [f](const std::vector<double>& x) { return Evaluation{{f(x)}}; };
        return instance;
    });
}

/// All benchmarks except BBOB's functions and roughness.
std::vector<Benchmark> fixed_benchmarks() {
    std::vector<Benchmark> all;
    for (const std::string& name : front_problems())
        all.push_back(benchmark(name, name.substr(0, name.find_first_of("1234567")), "fronts", precisions(1e1, 1e-4),
                                [name](int) { return front_instance(name); }));
    for (const std::string& name : constrained_problems())
        all.push_back(benchmark(name, "cec2006", "constrained", precisions(1e2, 1e-4),
                                [name](int) { return constrained_instance(name); }));
    const auto seed = [](int number) { return static_cast<std::uint64_t>(number); };
    for (const std::size_t things : {50u, 200u})
        all.push_back(benchmark("knapsack" + std::to_string(things), "knapsack", "bits", precisions(1, 1e-4),
                                [=](int number) { return knapsack_instance(things, seed(number)); }));
    all.push_back(benchmark("tsp14", "tsp", "tours", precisions(1e1, 1e-4),
                            [=](int number) { return scattered_instance(14, seed(number)); }));
    const auto relative = precisions(1, 1e-4);
    all.push_back(benchmark("berlin52", "instances", "tours", relative, [](int) { return berlin_instance(); }));
    for (const std::size_t side : {10u, 16u})
        all.push_back(benchmark("grid" + std::to_string(side * side), "instances", "tours", relative,
                                [=](int) { return grid_instance(side); }));
    all.push_back(benchmark("ft10", "instances", "tours", relative, [](int) { return job_shop_instance(); }));
    return all;
}

/// The dimension and function (0: all) of "bbob5" or "bbob5-8", or nothing.
std::optional<std::pair<int, int>> bbob_named(const std::string& name) {
    static const std::regex form("bbob(\\d{1,2})(-(\\d{1,2}))?");
    std::smatch parts;
    if (!std::regex_match(name, parts, form)) return {};
    const int dimension = std::stoi(parts[1]), function = parts[2].matched ? std::stoi(parts[3]) : 0;
    if (dimension < 2 || dimension > 40 || function > Bbob::functions || (parts[2].matched && function < 1)) return {};
    return std::pair(dimension, function);
}

} // namespace

std::vector<double> precisions(double from, double to) {
    constexpr int count = 51;
    std::vector<double> all;
    for (int i = 0; i < count; ++i) all.push_back(from * std::pow(to / from, i / (count - 1.0)));
    return all;
}

std::vector<Benchmark> benchmarks(const std::vector<std::string>& names,
                                  const std::vector<rough::DesignSetup>& roughness) {
    const std::vector<Benchmark> fixed = fixed_benchmarks();
    std::vector<Benchmark> all;
    for (const std::string& name : names) {
        const std::size_t before = all.size();
        if (const auto bbob = bbob_named(name)) {
            for (int function = 1; function <= Bbob::functions; ++function)
                if (bbob->second == 0 || bbob->second == function) all.push_back(bbob_benchmark(bbob->first, function));
        } else if (name == "roughness" && roughness.empty()) {
            rough::refuse("roughness: has no target; give its file (CSV)");
        }
        for (const rough::DesignSetup& setup : roughness) {
            const std::string of_target = "roughness" + (roughness.size() == 1 ? "" : "-" + setup.targets[0].name);
            if (name != "roughness" && name != of_target) continue;
            const Roughness problem{setup,
                                    setup.model.grid.is_2d() ? std::make_shared<rough::ResponseMemory>() : nullptr};
            all.push_back(
                benchmark(of_target, of_target, "surfaces", precisions(1, 1e-3), [problem](int) { return problem; }));
            all.back().setup = setup;
        }
        for (const Benchmark& each : fixed)
            if (each.name == name || each.group == name) all.push_back(each);
        if (all.size() == before) {
            std::vector<std::string> known{"bbob5", "bbob20", "bbob5-1", "roughness"};
            for (const Benchmark& each : fixed) known.insert(known.end(), {each.name, each.group});
            rough::refuse("\"", name,
                          "\" is not a problem; give bbobN, bbobN-F (N of 2 to 40, F of 1 to 24), "
                          "zdt, dtlz, cec2006, knapsack, tsp, instances, a problem of theirs or roughness",
                          ga::suggestion(name, known));
        }
    }
    std::set<std::string> given;
    for (const Benchmark& each : all)
        if (!given.insert(each.name).second) rough::refuse("\"", each.name, "\" is given twice; give it once");
    return all;
}

} // namespace app
