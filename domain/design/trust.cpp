#include "domain/design/trust.hpp"

#include "domain/design/tolerance.hpp"
#include "domain/errors.hpp"
#include "domain/problem/drawn_start.hpp"

#include <numbers>

namespace rough {
namespace {

Model with_kernel(Model model, Kernel kernel) {
    model.body.kernel = kernel;
    model.body.layering = {};
    model.loading.reach = std::min(*model.loading.reach, reach_of({}, kernel));
    return completed(model);
}

template <class... Parts>
void flag(Trust& trust, const Parts&... parts) {
    trust.flags.push_back(line_with_digits(3, parts...));
}

void assess_strains(const DesignSetup& setup, const Genome& genome, const TrustOptions& options,
                    const DesignResponse& response, Trust& trust) {
    const Profile profile = sample(genome, setup.model.grid);
    const auto all = surface_descriptors(setup.model.grid);
    const auto slope = std::ranges::find(all, std::string("slope"), &ga::Descriptor<Genome>::name);
    trust.rms_slope = std::pow(10, slope->of(genome)); // on a map of the gradient
    double displacement = 0;
    for (const Response& one : response.responses) displacement = std::max(displacement, one.displacement.tail(1)[0]);
    ContactOptions contact = setup.model.contact;
    contact.states = true;
    trust.last = solve_contact(profile, setup.model.body, {displacement}, contact).states.front();
    trust.peak_pressure = trust.last.pressure.maxCoeff();
    const auto [columns, rows] = profile.shape();
    trust.contact_at_ends = setup.model.body.kernel != Kernel::periodic &&
                            std::ranges::any_of(trust.last.nodes, [columns = columns, rows = rows](int node) {
                                const Index i = node % columns, j = node / columns;
                                return i == 0 || i == columns - 1 || (rows > 1 && (j == 0 || j == rows - 1));
                            });
    trust.shortest_wave_nodes = shortest_wave(genome) * (1 + 1e-12) / setup.model.grid.widest_spacing();

    if (trust.rms_slope > 0.1)
        flag(trust, "rms slope ", trust.rms_slope, " is above 0.1: ", profile.is_2d() ? "half-space" : "half-plane",
             " theory assumes small slopes");
    if (options.hardness && trust.peak_pressure > *options.hardness)
        flag(trust, "peak pressure ", trust.peak_pressure, " MPa is above the hardness, ", *options.hardness,
             " MPa: the peaks would flow");
    if (trust.shortest_wave_nodes < 8 * (1 - 1e-9))
        flag(trust, "the shortest wave has ", trust.shortest_wave_nodes,
             " nodes, under 8: the grid is part of the answer");
    if (trust.contact_at_ends)
        flag(trust, "contact reaches the ", profile.is_2d() ? "area's edges" : "profile's ends",
             "; a real surface continues there");
}

/// One similarity to compute. It refers to the set-up, the genome and the options.
struct Job {
    std::vector<Check>* list; ///< receives the similarity; null: the redrawn phases do
    std::string name;
    std::function<double()> similarity;
    bool decides = false;
};

std::vector<Job> jobs_for(const DesignSetup& setup, const Genome& genome, const TrustOptions& options, Trust& trust,
                          const Answer* verified) {
    std::vector<Job> jobs;
    std::vector<Check>* const checks = &trust.checks;
    const auto under = [&](std::vector<Check>* list, const std::string& name, const Model& model) {
        jobs.push_back({list, name, [&, model] { return similarity(setup, respond(setup, genome, model)); }});
    };
    const auto ask = [&](const std::string& name, const Model& model, double Verification::*known) {
        if (!verified)
            under(checks, name, model);
        else if (std::isnan(verified->*known))
            trust.left_out.push_back(name);
        else
            jobs.push_back({checks, name, [=] { return verified->*known; }});
    };
    const Refinement by = verified_refinement(setup.model.grid);
    const auto times = [](auto factor, const char* of) { return std::to_string(factor) + " times the " + of; };
    ask("as designed", setup.model, &Verification::similarity);
    ask(times(by.nodes, "nodes"), refined(setup.model, by.nodes), &Verification::refined);
    Model steps = setup.model;
    steps.loading.steps *= by.steps;
    ask(times(by.steps, "load steps"), steps, &Verification::more_steps);
    DesignSetup unscaled = setup; // without Eq. 11: the genome's amplitude, loaded as far as the targets go
    unscaled.max_pressure.reset();
    if (setup.model.body.kernel == Kernel::free && !setup.model.grid.is_2d()) {
        DesignSetup far = unscaled;
        far.targets = with_datum(setup.targets, setup.model, 4);
        *far.model.body.datum *= 4;
        if (!far.targets.empty())
            jobs.push_back({checks, "4 times the datum, the target moved with it",
                            [&, far] { return similarity(far, respond(far, genome, far.model)); }});
    }
    const auto [noise, noise_length, tilt] = setup.errors;
    const auto under_errors = [&](const std::string& name, const MakingErrors& errors) {
        jobs.push_back({checks, name,
                        [&, errors] {
                            DesignSetup with = setup;
                            with.errors = errors;
                            return similarity_under_errors(with, genome, {.seed = options.seed, .threads = 1});
                        },
                        true});
    };
    if (noise > 0)
        under_errors(line_of("height noise of ", noise, " mm rms, 95 % of the draws"), {noise, noise_length, 0});
    if (tilt > 0) under_errors(line_of("tilt of ", tilt, " mm over the length"), {0, noise_length, tilt});
    if (options.hardness && trust.peak_pressure > *options.hardness) {
        DesignSetup yielding = unscaled;
        yielding.model.body.hardness = *options.hardness;
        for (const Target& target : setup.targets)
            if (target.against_pressure())
                yielding.model.loading.to_pressure =
                    std::max(yielding.model.loading.to_pressure.value_or(0), target.last());
        jobs.push_back({checks, "nodes held at the hardness",
                        [&, yielding] { // nodes of a measured target are held, too
                            const DesignSetup yielded = in_finer_steps(yielding, 1);
                            return similarity(yielded, respond(yielded, genome, yielded.model));
                        },
                        true});
    }
    for (const Kernel other : {Kernel::free, Kernel::periodic, Kernel::strip})
        if (other != setup.model.body.kernel && !(setup.model.grid.is_2d() && other == Kernel::strip))
            under(&trust.kernels, name_of(other), with_kernel(setup.model, other));
    for (int draw = 0; draw < options.phase_draws; ++draw)
        jobs.push_back({nullptr, "", [&, draw] { // each ridge keeps its amplitude and moves to another place
                            ga::Stream random(
                                ga::fold(ga::fold(options.seed, "phases"), static_cast<std::uint64_t>(draw)));
                            Genome moved = genome;
                            for (Series& series : moved.series)
                                for (Chromosome& chromosome : series.chromosomes) {
                                    const double turn = random.uniform(0, 2 * std::numbers::pi);
                                    for (double& phase : chromosome.phases) phase += turn;
                                }
                            const DesignSetup coarse = setup.model.grid.is_2d() ? on_coarser_grid(setup, 1) : setup;
                            return similarity(coarse, with_fitting_amplitude(coarse, moved));
                        }});
    return jobs;
}

} // namespace

std::vector<Target> with_datum(const std::vector<Target>& targets, const Model& model, double factor) {
    // The displacement that the farther datum adds per unit of mean pressure, mm/MPa.
    const double c = -datum_sensitivity(1, model.grid.length, model.body.effective_modulus) * std::log(factor);
    std::vector<Target> moved;
    for (Target target : targets) {
        const auto stiffer = [&](Eigen::VectorXd& K) { K = K.array() / (1 + c * K.array()); };
        if (target.quantity == Quantity::stiffness) {
            stiffer(target.y);
            if (target.has_band()) stiffer(target.lower), stiffer(target.upper);
        } else if (target.quantity == Quantity::load_at_displacement && !target.has_band()) {
            target.x += c * target.y;
        } else if (target.quantity != Quantity::area_at_pressure && target.quantity != Quantity::interface_stiffness) {
            continue;
        }
        moved.push_back(std::move(target));
    }
    return moved;
}

Trust trust_in(DesignSetup setup, const Genome& genome, const TrustOptions& options, const Answer* verified,
               const DesignResponse* designed) {
    Trust trust;
    assess_strains(setup, genome, options, designed ? *designed : respond(setup, genome, setup.model), trust);
    const auto late = ending_after(options.seconds, options.stop);
    setup.model.contact.stop = late;
    const std::vector<Job> jobs = jobs_for(setup, genome, options, trust, verified);
    std::vector<double> values(jobs.size());
    std::vector<char> done(jobs.size(), 0);
    ga::parallel_for(jobs.size(), ga::thread_count(options.threads), [&](std::size_t i) {
        if (late()) return;
        try {
            values[i] = jobs[i].similarity();
        } catch (const std::exception&) {
            values[i] = Trust::unknown;
        }
        done[i] = std::isfinite(values[i]) || !late();
    });
    std::vector<double> deciding;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto& [list, name, similarity, decides] = jobs[i];
        if (done[i] && !list) {
            trust.redrawn.push_back(values[i]);
        } else if (done[i]) {
            list->push_back({name, values[i], decides});
            if (decides) deciding.push_back(values[i]);
        } else if (list) {
            trust.left_out.push_back(name);
            trust.all_decided = trust.all_decided && !decides;
        }
    }
    if (!deciding.empty()) // a check without a response is the worst
        trust.under = *std::min_element(deciding.begin(), deciding.end(),
                                        [](double a, double b) { return a < b || (std::isnan(a) && !std::isnan(b)); });
    if (const int missing = options.phase_draws - static_cast<int>(trust.redrawn.size()); missing > 0)
        trust.left_out.push_back(std::to_string(missing) + " sets of redrawn phases");
    return trust;
}

} // namespace rough
