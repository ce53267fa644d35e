#include "domain/design/trust.hpp"

#include "domain/contact/names.hpp"
#include "domain/design/starts.hpp"
#include "domain/design/tolerance.hpp"
#include "domain/errors.hpp"
#include "domain/mwm/waves.hpp"
#include "domain/numerics/statistics.hpp"
#include "domain/plain_stream.hpp"
#include "domain/problem/setup.hpp"
#include "domain/problem/problem.hpp"
#include "ga/base/budget.hpp"
#include "ga/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace rough {

namespace {

const std::string in_finer_steps_too = "4 times the load steps, for the target too";
const std::string as_designed = "as designed";
/// A likeness that falls by more than this with the load steps is said to hang on them.
constexpr double unsettled = 0.01;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// 2 L/(pi E*) ln(factor): what a farther datum adds to a displacement for each unit of mean pressure.
double compliance_of_datum(const Model& model, double factor) {
    return 2 * model.grid.length / (std::numbers::pi * model.body.effective_modulus) * std::log(factor);
}

/// The set-up without Eq. 11: the genome's own amplitude, loaded as far as the targets go.
DesignSetup in_final_amplitude(const DesignSetup& setup) {
    DesignSetup final = setup;
    final.max_pressure.reset();
    return final;
}

Model with_kernel(Model model, Kernel kernel) {
    model.body.kernel = kernel;
    model.body.layering = {};
    model.loading.reach = std::min(model.loading.reach, completed(Loading(), kernel).reach);
    return completed(model);
}

template <class... Parts>
void flag(Trust& trust, const Parts&... parts) {
    PlainStream line;
    line.precision(3);
    (line << ... << parts);
    trust.flags.push_back(line.str());
}

/// Of an area: the root mean square gradient.
double gradient_of(const Genome& genome, const Grid& grid) {
    const auto all = surface_descriptors(grid);
    return std::pow(10, std::find_if(all.begin(), all.end(), [](const auto& each) {
                            return each.name == "slope";
                        })->of(genome));
}

void assess_strains(const DesignSetup& setup, const Genome& genome, const TrustOptions& options,
                    const DesignResponse& response, Trust& trust) {
    const Profile profile = sample(genome, setup.model.grid);
    const Index n = profile.nodes();
    trust.rms_slope = profile.is_2d() ? gradient_of(genome, setup.model.grid)
                                      : (profile.heights.tail(n - 1) - profile.heights.head(n - 1)).norm() /
                                            (profile.spacing * std::sqrt(static_cast<double>(n - 1)));
    double displacement = 0;
    for (const Response& one : response.responses)
        displacement = std::max(displacement, one.displacement.tail(1)[0]);
    ContactOptions contact = setup.model.contact;
    contact.states = true;
    trust.last = solve_contact(profile, setup.model.body, {displacement}, contact).states.front();
    const ContactState& state = trust.last;
    trust.peak_pressure = state.pressure.maxCoeff();
    const auto [columns, rows] = profile.shape();
    trust.contact_at_ends =
        setup.model.body.kernel != Kernel::periodic &&
        std::any_of(state.nodes.begin(), state.nodes.end(), [columns = columns, rows = rows](int node) {
            const Index i = node % columns, j = node / columns;
            return i == 0 || i == columns - 1 || (rows > 1 && (j == 0 || j == rows - 1));
        });
    trust.shortest_wave_nodes = shortest_wave(genome) * (1 + 1e-12) / setup.model.grid.widest_spacing();

    if (trust.rms_slope > 0.1)
        flag(trust, "rms slope ", trust.rms_slope,
             " is above 0.1: ", profile.is_2d() ? "half-space" : "half-plane",
             " theory supposes small slopes");
    if (options.hardness > 0 && trust.peak_pressure > options.hardness)
        flag(trust, "peak pressure ", trust.peak_pressure, " MPa is above the hardness, ", options.hardness,
             " MPa: the peaks would flow");
    if (trust.shortest_wave_nodes < 8 * (1 - 1e-9))
        flag(trust, "the shortest wave has ", trust.shortest_wave_nodes,
             " nodes, under 8: the grid is part of the answer");
    if (trust.contact_at_ends)
        flag(trust, "contact reaches the ", profile.is_2d() ? "area's edges" : "profile's ends",
             ", where a real surface would go on");
}

/// One question, asked of what it refers to; NaN where it has no answer.
struct Job {
    std::string name;
    std::function<double()> similarity;
    bool decides = false;

    double answer() const {
        try {
            return similarity();
        } catch (const std::exception&) {
            return unknown;
        }
    }
};

Job under(const DesignSetup& setup, const Genome& genome, const std::string& name, const Model& model) {
    return {name, [&setup, &genome, model] { return similarity(setup, respond(setup, genome, model)); }};
}

std::vector<Job> checks_of(const DesignSetup& setup, const Genome& genome, const TrustOptions& options,
                           Trust& trust, const Answer* verified) {
    std::vector<Job> jobs;
    const auto ask = [&](const std::string& name, const Model& model, double Answer::*known) {
        if (verified && known && setup.model.grid.is_2d() && std::isnan(verified->*known))
            trust.left_out.push_back(name);
        else if (verified && known && setup.model.grid.is_2d())
            jobs.push_back({name, [=] { return verified->*known; }});
        else
            jobs.push_back(under(setup, genome, name, model));
    };
    ask(as_designed, setup.model, &Answer::similarity);
    ask("2 times the nodes", refined(setup.model, 2), nullptr);
    ask("4 times the nodes", refined(setup.model, 4), &Answer::similarity_refined);
    Model steps = setup.model;
    steps.loading.steps *= 4;
    ask("4 times the load steps", steps, &Answer::similarity_stepped);
    if (setup.like)
        jobs.push_back({in_finer_steps_too, [&setup, &genome] {
                            const DesignSetup finer = in_finer_steps(setup);
                            return similarity(finer, respond(finer, genome, finer.model));
                        }});
    if (setup.model.body.kernel == Kernel::free && !setup.model.grid.is_2d()) {
        DesignSetup far = in_final_amplitude(setup);
        far.targets = with_datum(setup.targets, setup.model, 4);
        far.model.body.datum *= 4;
        if (!far.targets.empty())
            jobs.push_back({"4 times the datum, the target moved with it",
                            [far, &genome] { return similarity(far, respond(far, genome, far.model)); }});
    }
    const auto [noise, noise_length, tilt] = setup.errors;
    const auto made = [&setup, &genome, &options](const MakingErrors& errors) {
        return [&, errors] {
            DesignSetup with = setup;
            with.errors = errors;
            return similarity_when_made(with, genome, {.seed = options.seed, .threads = 1});
        };
    };
    if (noise > 0)
        jobs.push_back({line_of("height noise of ", noise, " mm rms, 95 % of the draws"),
                        made({noise, noise_length, 0}), true});
    if (tilt > 0)
        jobs.push_back(
            {line_of("tilt of ", tilt, " mm over the length"), made({0, noise_length, tilt}), true});
    if (trust.peak_pressure > options.hardness && options.hardness > 0)
        jobs.push_back({"nodes held at the hardness",
                        [&setup, &genome, &options] {
                            DesignSetup yields = in_final_amplitude(setup);
                            yields.model.body.hardness = options.hardness;
                            for (const Target& target : setup.targets)
                                if (target.against_pressure())
                                    yields.model.loading.to_pressure =
                                        std::max(yields.model.loading.to_pressure, target.last());
                            yields = in_finer_steps(std::move(yields), 1); // a measured target's nodes, too
                            return similarity(yields, respond(yields, genome, yields.model));
                        },
                        true});
    return jobs;
}

std::vector<Job> kernels_of(const DesignSetup& setup, const Genome& genome) {
    std::vector<Job> jobs;
    for (const Kernel kernel : {Kernel::free, Kernel::periodic, Kernel::strip})
        if (kernel != setup.model.body.kernel && !(setup.model.grid.is_2d() && kernel == Kernel::strip))
            jobs.push_back(under(setup, genome, name_of(kernel), with_kernel(setup.model, kernel)));
    return jobs;
}

/// Of the same spectrum: a ridge's amplitude stays, its place moves.
std::vector<Job> redrawn_phases(const DesignSetup& setup, const Genome& genome, const TrustOptions& options) {
    std::vector<Job> jobs;
    for (int draw = 0; draw < options.phase_draws; ++draw)
        jobs.push_back({"", [&, draw] {
                            ga::Stream random(
                                ga::fold(ga::fold(options.seed, "phases"), static_cast<std::uint64_t>(draw)));
                            Genome redrawn = genome;
                            for (Series& series : redrawn.series)
                                for (Chromosome& chromosome : series.chromosomes) {
                                    const double turn = random.uniform(0, 2 * std::numbers::pi);
                                    for (double& phase : chromosome.phases)
                                        phase += turn;
                                }
                            return similarity(setup, with_fitting_amplitude(setup, redrawn));
                        }});
    return jobs;
}

} // namespace

std::vector<Target> with_datum(const std::vector<Target>& targets, const Model& model, double factor) {
    const double c = compliance_of_datum(model, factor);
    std::vector<Target> moved;
    for (Target target : targets) {
        const auto stiffer = [&](Eigen::VectorXd& K) { K = K.array() / (1 + c * K.array()); };
        if (target.quantity == Quantity::stiffness) {
            stiffer(target.y);
            if (target.has_band())
                stiffer(target.lower), stiffer(target.upper);
        } else if (target.quantity == Quantity::load_at_displacement && !target.has_band()) {
            target.x += c * target.y;
        } else if (target.quantity != Quantity::area_at_pressure &&
                   target.quantity != Quantity::interface_stiffness) {
            continue;
        }
        moved.push_back(std::move(target));
    }
    return moved;
}

Trust trust_in(const DesignSetup& given, const Genome& genome, const TrustOptions& options,
               const Answer* verified, const DesignResponse* own) {
    Trust trust;
    DesignSetup setup = completed(given);
    assess_strains(setup, genome, options, own ? *own : respond(setup, genome, setup.model), trust);
    const auto late = [watch = ga::Watch({std::numeric_limits<long>::max(), options.seconds, options.stop})] {
        return watch.expired();
    };
    setup.model.contact.stop = late;
    std::vector<Job> jobs = checks_of(setup, genome, options, trust, verified);
    const std::size_t checks = jobs.size();
    for (Job& job : kernels_of(setup, genome))
        jobs.push_back(std::move(job));
    const std::size_t kernels = jobs.size();
    for (Job& job : redrawn_phases(setup, genome, options))
        jobs.push_back(std::move(job));
    std::vector<double> values(jobs.size(), unknown);
    std::vector<char> done(jobs.size(), 0);
    ga::parallel_for(jobs.size(), ga::thread_count(options.threads), [&](std::size_t i) {
        if (late())
            return;
        values[i] = jobs[i].answer();
        done[i] = std::isfinite(values[i]) || !late();
    });
    std::vector<double> checked, redrawn;
    for (std::size_t i = 0; i < kernels; ++i)
        if (!done[i]) {
            trust.left_out.push_back(jobs[i].name);
            trust.all_decided = trust.all_decided && !jobs[i].decides;
        } else {
            (i < checks ? trust.checks : trust.kernels).push_back({jobs[i].name, values[i], jobs[i].decides});
        }
    const auto worse = [](const Check& a, const Check& b) { // none is the worst
        return a.similarity < b.similarity || (std::isnan(a.similarity) && !std::isnan(b.similarity));
    };
    std::vector<Check> deciding;
    std::copy_if(trust.checks.begin(), trust.checks.end(), std::back_inserter(deciding),
                 [](const Check& check) { return check.decides; });
    if (!deciding.empty())
        trust.under = std::min_element(deciding.begin(), deciding.end(), worse)->similarity;
    for (const Check& check : trust.checks)
        checked.push_back(check.similarity);
    for (std::size_t i = kernels; i < jobs.size(); ++i)
        if (done[i])
            redrawn.push_back(values[i]);
    for (const Check& check : trust.checks)
        if (check.name == in_finer_steps_too && trust.checks[0].name == as_designed &&
            check.similarity < trust.checks[0].similarity - unsettled)
            flag(trust, "with ", in_finer_steps_too, ", the similarity is ", check.similarity,
                 ": the two curves agree less between the ", setup.model.loading.steps,
                 " steps than at them");
    if (!checked.empty()) {
        trust.median = quantile(checked, 0.5);
        trust.tenth = quantile(checked, 0.1);
    }
    trust.redrawn = static_cast<int>(redrawn.size());
    if (!redrawn.empty()) {
        trust.redrawn_best = quantile(redrawn, 1);
        trust.redrawn_median = quantile(redrawn, 0.5);
        trust.redrawn_tenth = quantile(redrawn, 0.1);
    }
    if (trust.redrawn < options.phase_draws)
        trust.left_out.push_back(std::to_string(options.phase_draws - trust.redrawn) +
                                 " of the phases drawn anew");
    return trust;
}

} // namespace rough
