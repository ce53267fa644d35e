#include "experiments/paper/paper.hpp"

#include <Eigen/QR>

#include <numbers>

namespace app {
namespace {

/// `difference` of the two curves at each point of `a` within the range of `b`.
template <class Difference>
std::vector<double> differences(const rough::Curve& a, const rough::Curve& b, Difference difference) {
    std::vector<double> all;
    for (Eigen::Index i = 0; i < a.x.size(); ++i)
        if (a.x[i] >= b.from && a.x[i] <= b.to && a.y[i] != 0) all.push_back(difference(a.y[i], b.at(a.x[i])));
    return all;
}

/// Mean relative difference |b - a|/a at the points of `a` within the range of `b`; NaN without such points.
double relative_gap(const rough::Curve& a, const rough::Curve& b) {
    return rough::mean(differences(a, b, [](double here, double there) { return std::abs(there / here - 1); }));
}

constexpr double g1_rounding = 1e-12; ///< times M: if |g1| = R, rounding must not affect the result

bool holds(double g1, double radicand, double ridges) {
    return std::abs(g1) <= std::sqrt(std::max(radicand, 0.0)) + g1_rounding * ridges;
}

/// g3 = sum over pairs m < l of cos(phi_m - phi_l), as running sums of cosines and sines.
double pair_sum(const std::vector<double>& phases) {
    double g3 = 0, cosines = 0, sines = 0;
    for (double phase : phases) {
        const double c = std::cos(phase), s = std::sin(phase);
        g3 += cosines * c + sines * s;
        cosines += c;
        sines += s;
    }
    return g3;
}

constexpr double hurst = 0.8; ///< H of fracture surfaces (Bouchaud, Lapasset and Planes 1990)
constexpr double rms = 1e-3;  ///< mm; a profile's K does not depend on its amplitude

/// Studies a profile; writes its tables to `found` unless that is null.
FractalStudy study_of(const PaperRun& run, std::uint64_t seed, Findings* found) {
    const auto answer = [&](const rough::Profile& profile) {
        return respond(profile, run.model.body, run.model.loading, run.model.contact);
    };
    const rough::Profile whole = rough::fractal_profile(run.model.grid, hurst, rms, seed);
    const rough::Response whole_response = answer(whole);
    const std::vector<rough::Band> bands = rough::octave_bands(whole);
    std::vector<std::optional<rough::Curve>> alone;
    for (const rough::Band& band : bands) alone.push_back(secant_stiffness(answer({band.heights, whole.spacing})));
    const auto dominant = dominant_parts(secant_stiffness(whole_response), alone).dominant;
    rough::Profile reduced{Eigen::VectorXd::Zero(whole.nodes()), whole.spacing};
    for (std::size_t b = 0; b < bands.size(); ++b)
        if (dominant[b]) reduced.heights += bands[b].heights;
    const rough::Response reduced_response = answer(reduced);
    if (found) {
        Csv &heights = found->table("fractal-heights.csv", "x_mm,whole_mm,reduced_mm", 8),
            &octaves = found->table("fractal-bands.csv", "longest_mm,shortest_mm,dominant"),
            &curves = found->table("fractal-curves.csv", "profile,quantity,pressure_MPa,value", 8);
        for (Eigen::Index i = 0; i < whole.nodes(); ++i)
            heights.row(static_cast<double>(i) * whole.spacing, whole.heights[i], reduced.heights[i]);
        for (std::size_t b = 0; b < bands.size(); ++b)
            octaves.row(bands[b].longest, bands[b].shortest, dominant[b] ? 1 : 0);
        for (const auto& [name, response] : {std::pair("whole", &whole_response), {"reduced", &reduced_response}})
            for (const auto& [quantity, curve] :
                 {std::pair("stiffness", secant_stiffness(*response)), {"area", area_against_pressure(*response)}})
                curves.points(curve.x, curve.y, name, quantity);
    }
    return {similarity(secant_stiffness(whole_response), secant_stiffness(reduced_response)),
            relative_gap(area_against_pressure(whole_response), area_against_pressure(reduced_response))};
}

using rough::Curve;
using rough::Genome;

Reduction reduction_of(const Answered& member, const PaperRun& run, const rough::Dominance& dominance) {
    const Genome kept = reduced(member.genome, dominance);
    const rough::Response response = respond(kept, run.model);
    const Curve rescaled = stretched(secant_stiffness(response),
                                     run.max_pressure / response.pressure[response.steps() - 1]); // Eq. 11
    return {static_cast<double>(waves(kept).size()) / static_cast<double>(waves(member.genome).size()),
            similarity(secant_stiffness(member.response), rescaled), dominance.only_best};
}

/// The coarser (longer) or the finer half of a genome's waves alone.
Genome half_of(const Genome& genome, bool coarse) {
    return filtered(
        genome, [&](std::size_t s, std::size_t c) { return (2 * c < genome.series[s].chromosomes.size()) == coarse; });
}

/// Change of the curves from the whole genome to the remaining one; NaN if that is flat at the nodes.
Removal removal(const rough::Response& whole, const Genome& left, const rough::Model& model) {
    const rough::Profile profile = sample(left, model.grid);
    if (is_flat(profile, left)) return {};
    const rough::Response rest = respond(profile, model.body, model.loading, model.contact);
    return {relative_gap(secant_stiffness(whole), secant_stiffness(rest)),
            relative_gap(area_against_pressure(whole), area_against_pressure(rest))};
}

/// Compares the contact set of each load step of a genome with the next.
Contacts contacts_of(const Answered& member, const rough::Model& model) {
    const Eigen::VectorXd& steps = member.response.displacement;
    rough::ContactOptions options = model.contact;
    options.states = true;
    const auto states = solve_contact(sample(member.genome, model.grid), model.body,
                                      {steps.data(), steps.data() + steps.size()}, options)
                            .states;
    Contacts contacts;
    for (std::size_t j = 0; j + 1 < states.size(); ++j) {
        const std::set<int> next(states[j + 1].nodes.begin(), states[j + 1].nodes.end());
        contacts.nodes += static_cast<double>(states[j].nodes.size());
        for (const int node : states[j].nodes) contacts.lost += !next.contains(node);
    }
    return contacts;
}

/// Chromosome n, of which the table gets the sum (ridge 0) and the ridges.
ChromosomeExample chromosome_example(int n, std::uint64_t seed, Csv& table) {
    const rough::Series series{1e-2, 0.8, 1.5, 0.1, {}};
    constexpr std::size_t count = 8;
    const double k = rough::wave_number(series, n), G = rough::amplitude(series, n, count);
    ga::Stream random(ga::fold(ga::fold(seed, "chromosomes"), static_cast<std::uint64_t>(n)));

    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(201, 0, 0.1);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(x.size());
    std::vector<Eigen::VectorXd> ridges;
    for (std::size_t m = 0; m < count; ++m) {
        const double phase = random.uniform(0, 2 * std::numbers::pi);
        ridges.push_back(G * (std::cos(phase) - (k * x.array() + phase).cos())); // Eq. 1
        sum += ridges.back();
    }
    table.points(x, sum, n, 0);
    for (std::size_t m = 0; m < count; ++m) table.points(x, ridges[m], n, m + 1);
    Eigen::MatrixXd cosine(x.size(), 3);
    cosine << Eigen::VectorXd::Ones(x.size()), (k * x.array()).cos().matrix(), (k * x.array()).sin().matrix();
    const Eigen::VectorXd best = cosine * cosine.colPivHouseholderQr().solve(sum);
    return {rough::wave_length(series, n), (sum - best).cwiseAbs().maxCoeff() / (sum.maxCoeff() - sum.minCoeff())};
}

} // namespace

std::vector<RidgeCount> ridge_study(const std::vector<int>& ridge_counts, int sets, std::uint64_t seed) {
    std::vector<RidgeCount> counts;
    for (int M : ridge_counts) {
        ga::Stream random(ga::fold(ga::fold(seed, "ridges"), static_cast<std::uint64_t>(M)));
        const double ridges = M;
        int printed = 0, missing = 0, right = 0;
        for (int set = 0; set < sets; ++set) {
            std::vector<double> phases(static_cast<std::size_t>(M));
            for (double& phase : phases) phase = random.uniform(0, 2 * std::numbers::pi);
            const rough::Ridge ridge = rough::collapsed(phases);
            const double g3 = pair_sum(phases);
            const double last = std::cos(phases[phases.size() - 2] - phases.back());
            printed += holds(ridge.g1, ridges + 2 * g3, ridges); // Eq. 10
            missing += holds(ridge.g1, ridges + 2 * (g3 - last), ridges);
            const double by_arccos = std::acos(std::clamp(ridge.g1 / ridge.R, -1.0, 1.0)); // Eq. 8
            right += std::abs(std::remainder(by_arccos - ridge.theta, 2 * std::numbers::pi)) < 1e-6;
        }
        const auto share = [&](int count) { return static_cast<double>(count) / sets; };
        counts.push_back({M, share(printed), share(missing), share(right)});
    }
    return counts;
}

Studies studies_of(const PaperRun& run) {
    constexpr int phase_sets = 1000; // as many as the paper's Figure 2
    const std::vector<int> ridges = {2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024};
    const std::uint64_t seed = run.origin.seed;
    Studies studies{.ridges = ridge_study(ridges, phase_sets, seed), .fractals = std::vector<FractalStudy>(20)};
    Csv& chromosomes = studies.found.table("chromosomes.csv", "n,ridge,x_mm,height_mm", 8);
    for (const int n : {1, 2}) studies.chromosomes.push_back(chromosome_example(n, seed, chromosomes));
    Csv& shares = studies.found.table("ridges.csv", "ridges,as_printed,last_missing,right_phase");
    for (const RidgeCount& row : studies.ridges)
        shares.row(row.ridges, row.as_printed, row.last_missing, row.right_phase);
    ga::parallel_for(studies.fractals.size(), run.origin.threads, [&](std::size_t i) {
        studies.fractals[i] = study_of(run, ga::fold(seed, i), i == 0 ? &studies.found : nullptr);
    });
    const rough::DominanceRule rule(run.model);
    studies.genomes.resize(run.database.size());
    ga::parallel_for(studies.genomes.size(), run.origin.threads, [&](std::size_t i) {
        const Answered& member = run.database[i];
        studies.genomes[i] = {reduction_of(member, run, rule(member.genome)),
                              removal(member.response, half_of(member.genome, false), run.model),
                              removal(member.response, half_of(member.genome, true), run.model),
                              contacts_of(member, run.model)};
    });
    return studies;
}

double gap(const Curve& a, const Curve& b) {
    const auto all = differences(a, b, [](double here, double there) { return std::abs(there - here); });
    return all.empty() ? unknown : std::ranges::max(all);
}

} // namespace app
