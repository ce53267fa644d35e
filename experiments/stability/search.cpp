#include "apps/external/problem.hpp"
#include "experiments/stability/stability.hpp"
#include "ga/observers/hall_of_fame.hpp"

namespace app {
namespace {

constexpr std::size_t gene_count = 14, old_gene_count = 11;
constexpr std::size_t worst = 10; ///< scenes of a search that are tried by every solver
const std::string mark = "bred ";

using HardScenes = OutsideProblem<std::vector<double>>;

const Genes thousandths{.count = gene_count, .parts = {{gene_count, 0, 1000, true}}};

/// The work of the solver `auto`: its products with H per load step. It is more than any work if `auto` fails
/// or another solver contradicts it.
Evaluation work_of(const std::vector<double>& genome, const std::atomic<bool>& stop) {
    constexpr double wrong = 2e6, failed = 1e6;
    ContactScene scene;
    try {
        scene = bred_scene(bred_name(genome));
    } catch (const rough::InputError&) { // waves that the grid cannot show
        return {{0}};
    }
    rough::ContactOptions options;
    options.stop = [&stop] { return stop.load(); };
    ContactTrial trial = try_contact(scene, options);
    if (stop) throw ga::Stopped{"stop requested"};
    verify(scene, trial);
    if (trial.outcome == Outcome::wrong) return {{wrong}};
    if (trial.outcome == Outcome::not_converged) return {{failed}};
    return {{static_cast<double>(trial.curve.iterations) / static_cast<double>(scene.steps())}};
}

} // namespace

std::string bred_name(const std::vector<double>& genome) {
    std::string name = mark;
    for (const double gene : rounded(thousandths, genome)) name += (name == mark ? "" : ",") + ga::number(gene / 1000);
    return name;
}

bool is_bred(const std::string& name) { return name.starts_with(mark); }

ContactScene bred_scene(const std::string& name) {
    std::vector<double> gene;
    for (const std::string& word : rough::listed(name.substr(mark.size()))) {
        const auto number = ga::Arguments::parsed(word);
        if (!number || *number < 0 || *number > 1)
            throw rough::InputError("'" + word + "' is not a gene; give numbers from 0 to 1", "scene");
        gene.push_back(*number);
    }
    if (gene.size() == old_gene_count) gene.resize(gene_count, 0.0);
    if (gene.size() != gene_count)
        throw rough::InputError(
            "a bred scene has " + std::to_string(gene.size()) + " genes; give " + std::to_string(gene_count), "scene");
    const auto side = [](double u) { return static_cast<rough::Index>(std::round(8 * std::exp2(3 * u))); };
    const auto between = [](double from, double to, double u) { return from * std::pow(to / from, u); };
    rough::Body body;
    body.kernel = gene[2] < 0.4 ? rough::Kernel::free : rough::Kernel::periodic;
    if (gene[2] > 0.7) // a layer, on a rigid base if the next gene is below 1/2
        body.layering = {.layers = {{between(0.01, 0.3, gene[6]), between(0.1, 10, gene[7]), 0.499 * gene[6]}},
                         .rigid_base = gene[7] < 0.5};
    const SelfAffineMap roughness{
        .hurst = 0.1 + 0.85 * gene[3],
        .shortest = between(2, 16, gene[4]),
        .seed = static_cast<std::uint64_t>(std::round(1000 * gene[5])),
        .shape = static_cast<MapShape>(std::min(static_cast<int>(map_shapes * gene[11]), map_shapes - 1)),
        .stretch = gene[12] > 0.5 ? between(0.1, 10, 2 * gene[12] - 1) : 1};
    const double contact = 1 / (1 + std::exp(7 - 16 * gene[8]));
    ContactScene scene = map_scene(name, body, {side(gene[0]), side(gene[1])}, roughness, contact);
    if (gene[13] > 0.7 && body.kernel == rough::Kernel::periodic) // from 0.1 to 1e-7 below full contact
        scene.pressures[0] = (1 - between(0.1, 1e-7, (gene[13] - 0.7) / 0.3)) * full_contact_load(scene.profile, body);
    const double pressure = scene.pressures[0];
    const int steps = 1 + static_cast<int>(4 * gene[9]);
    scene.pressures = even_steps(pressure, steps);
    if (gene[10] > 0.5) scene.body.hardness = pressure * between(1.2, 100, 2 * gene[10] - 1);
    return scene;
}

std::vector<ContactScene> bred_scenes(long evaluations, std::uint64_t seed, int threads,
                                      const std::atomic<bool>& stop) {
    const auto breeding = ga::Parser<HardScenes>(ga::whole_vocabulary<HardScenes>())
                              .parse("sample 40 | score | repeat 1000000 { tournament 3 | cross uniform | "
                                     "mutate 0.2 | score | elite 5 }");
    HardScenes problem(OutsideSearch{.genes = thousandths}, {false});
    problem.answer = [&stop](const std::vector<double>& genome) { return work_of(genome, stop); };
    const ga::RunOptions options{.seed = seed, .threads = threads, .budget = {.evaluations = evaluations}};
    ga::HallOfFame<HardScenes> hardest(problem, 20 * worst); // some genes of a scene have no effect
    for (const auto& individual : ga::run(breeding, problem, {}, options, {hardest.observer()}).population)
        hardest.offer(individual); // the budget may end before a stage does
    std::vector<ContactScene> scenes;
    for (const auto& individual : hardest.members) {
        if (!(individual.value() > 0)) // no scene, or nothing to solve
            continue;
        ContactScene scene = bred_scene(bred_name(individual.genome));
        if (scenes.size() < worst && std::ranges::none_of(scenes, [&](const ContactScene& other) {
                return std::ranges::equal(other.profile.heights, scene.profile.heights) &&
                       other.pressures == scene.pressures;
            }))
            scenes.push_back(std::move(scene));
    }
    return scenes;
}

} // namespace app
