#include "apps/commands/design/run.hpp"

namespace app {
namespace {

using rough::line_of;
using rough::Quantity;

/// An interface stiffer than this many E* per mm is in full contact, apart from rounding.
constexpr double nearly_rigid = 1e6;

std::string in_words(Quantity quantity) {
    static const std::array words{"stiffness", "contact area", "contact area", "load", "interface stiffness"};
    return words[static_cast<std::size_t>(quantity)];
}

std::string in_words(const rough::Target& target) {
    return columns_of(target).y.starts_with("conductance") ? "conductance" : in_words(target.quantity);
}

/// A similarity with at least 4 digits, and as many as show that it is below another.
std::string below(double value, double other) {
    return readable(value, std::max(4, static_cast<int>(std::ceil(-std::log10(other - value)))));
}

void join(std::string& all, const std::string& more, const char* between = "; ") {
    if (!all.empty() && !more.empty()) all += between;
    all += more;
}

std::string in_unit(double length) {
    const Unit unit = length_unit(length);
    return readable(unit.factor * length) + " " + unit.name;
}

/// The similarity that the verdict is about, under all conditions; -infinity if one of them has no response.
/// That of a profile in production is on the grid and in the load steps of its target.
double verified_of(const DesignRun& run) {
    if (is_judged_on_grid(run)) return run.found.best.similarity;
    const double lowest = run.found.best.lowest();
    const auto decides = [](const rough::Check& check) { return check.decides; };
    if (!run.trust || std::ranges::none_of(run.trust->checks, decides)) return lowest;
    return std::isnan(run.trust->under) ? -HUGE_VAL : std::min(lowest, run.trust->under);
}

/// Whether the answer was checked under the noise, tilt and hardness that were given.
bool is_verified(const DesignRun& run) {
    const bool has_conditions = run.setup.errors.any() || run.trust_options.hardness;
    return !has_conditions || (run.trust && run.trust->all_decided);
}

std::string verdict_of(const DesignRun& run) {
    const double designed = run.found.best.similarity, required = run.setup.required_similarity,
                 verified = verified_of(run);
    const bool is_enough = verified >= required, found = is_found(run);
    const std::string wanted = brief(required, 15) + " is required",
                      surface = run.setup.model.grid.is_2d() ? "map" : "profile";
    std::string conditions = "on finer grids and in finer load steps", line;
    if (run.trust)
        conditions +=
            line_of(run.setup.errors.noise > 0 ? ", under noise" : "", run.setup.errors.tilt > 0 ? ", tilted" : "",
                    run.trust_options.hardness ? ", under the hardness" : "");
    if (!run.unreachable.reasons.empty())
        line = run.unreachable.reasons.front().verdict() + "; no " + surface + " has a similarity above " +
               readable(run.unreachable.bound, 4) + "; the best design found has " +
               (std::isnan(verified) ? readable(designed, 4) + " as designed" : readable(verified, 4));
    else if (std::isnan(verified))
        line = "not verified: similarity " + readable(designed, 4) + " as designed, " + wanted + "; " +
               (run.interrupted ? "the design was interrupted before the checks on finer grids and load steps"
                                : "the time did not suffice for the checks on finer grids and load steps");
    else if (run.morphed)
        line = (found ? "restored: similarity " : "not restored: similarity ") +
               (is_enough ? readable(verified, 5) : below(verified, required)) + ", before " +
               readable(run.morphed->before, 4) + "; " + wanted +
               (is_judged_on_grid(run) ? "; lowest similarity " + readable(run.found.best.lowest(), 4) : "") + ", " +
               conditions;
    else if (is_enough)
        line = (found              ? "found"
                : is_verified(run) ? missed_by(run.found)
                                   : "not verified") +
               (": lowest similarity " + readable(verified, 5)) + ", " + conditions +
               (is_verified(run) ? "" : ", but the time did not suffice for the given noise, tilt or hardness");
    else
        line = (run.interrupted ? "not found before the interrupt" : missed_by(run.found)) + ": the best design has " +
               (std::isinf(verified) ? "no response in one of the checks"
                                     : "a lowest similarity of " + below(verified, required)) +
               ", " + conditions + "; " + wanted;
    return line + (run.found.best.within_limits ? "" : "; no answer meets all limits on shape");
}

/// Whether misfits are those on the search grid, without an estimated error.
bool as_designed(const DesignRun& run) { return is_judged_on_grid(run) || !run.found.best.is_verified(); }

/// The largest misfit of an answer to a target with its estimated error, relative to the target, and the
/// index of its point.
std::pair<double, rough::Index> largest_misfit(const DesignRun& run, std::size_t t) {
    const Eigen::VectorXd misfits =
        (as_designed(run) ? misfits_of(run.setup, run.response) : run.found.best.largest)[t];
    rough::Index point = 0;
    misfits.cwiseAbs().maxCoeff(&point);
    return {misfits[point] / run.setup.targets[t].weight, point};
}

std::string matched(const DesignRun& run) {
    std::string all;
    for (std::size_t t = 0; t < run.setup.targets.size(); ++t) {
        const rough::Target& target = run.setup.targets[t];
        const double error = std::abs(largest_misfit(run, t).first);
        const std::string band = !target.has_band() ? "off" : "outside the band";
        join(all,
             in_words(target) + ": similarity " + readable(1 - target.weight * error, 4) +
                 (target.has_band() && error == 0 ? ", within the band" : ", " + band + " by up to " + percent(error)) +
                 (as_designed(run) ? " on the search grid" : " with the estimated error"));
    }
    return all;
}

std::string not_requested(const DesignRun& run) {
    if (!run.setup.measured)
        return "all other quantities; at the last load " +
               percent(run.response.responses.front().contact_fraction.tail(1)[0]) + " of the nodes touch";
    std::string all = run.unrequested_errors ? "" : "not verified";
    for (const auto& [name, share] : run.unrequested_errors.value_or(Shares()))
        join(all, name + " was not requested and is off by up to " + percent(share));
    return all;
}

std::string worst_case(const DesignRun& run) {
    const rough::Answer& best = run.found.best;
    const rough::Refinement by = rough::verified_refinement(run.setup.model.grid);
    const auto known = [](double similarity) {
        return std::isnan(similarity) ? "not verified" : readable(similarity, 4);
    };
    std::string all = "similarity " + known(best.similarity) + " on the search grid, " + known(best.refined) +
                      " on a grid " + std::to_string(by.nodes) + " times finer, " + known(best.more_steps) + " in " +
                      std::to_string(by.steps) + " times the load steps, " + known(best.both) + " with both; " +
                      (best.is_verified() ? "less the estimated error of the last, " +
                                                readable(best.both - best.worst, 3) + ", it is " + known(best.worst)
                                          : "so the verdict is not known");
    if (!run.trust) return all + (run.interrupted ? "" : "; the time did not suffice to verify more");
    for (const rough::Check& check : run.trust->checks)
        if (check.decides || check.name.find("datum") != std::string::npos)
            join(all, "similarity " + readable(check.similarity, 4) + " with " + check.name);
    if (!run.trust->left_out.empty())
        join(all, "no time was left for " + std::to_string(run.trust->left_out.size()) + " checks");
    return all;
}

/// The largest errors of the machine under which the answer keeps a similarity, one error at a time.
std::string machine(const DesignRun& run) {
    if (!run.tolerance) return "";
    const rough::Tolerance& tolerance = *run.tolerance;
    std::string all, missed;
    for (const rough::ToleranceLevel& level : tolerance.levels) {
        const std::string at = brief(level.similarity, 15);
        if (level.similarity > tolerance.similarity)
            join(missed, at, ", ");
        else if (!std::isnan(level.scale) && (all.empty() || level.similarity == 0.95))
            all = "similarity stays at least " + at + " under one of these errors: " +
                  (std::isnan(level.noise_rms)
                       ? "noise (not known for lack of time)"
                       : "noise of " + in_unit(level.noise_rms) + " rms at a correlation length of " +
                             in_unit(tolerance.noise_length) + " (95 % of draws)") +
                  ", a tilt of " + in_unit(level.tilt) + ", or an error of scale of " + percent(level.scale);
    }
    if (!missed.empty())
        join(all, "not reached: " + missed + ", because without errors the similarity is " +
                      readable(tolerance.similarity, 5) + (as_designed(run) ? " on the search grid" : ""));
    if (!tolerance.complete)
        join(all, "some errors are not known, because the time did not suffice; set more --seconds");
    return all;
}

std::string yielding(const DesignRun& run) {
    if (!run.trust) return run.interrupted ? "not verified" : "not verified, because the time did not suffice";
    const std::optional<double> hardness = run.trust_options.hardness;
    const double peak = run.trust->peak_pressure;
    const Unit unit = pressure_unit(peak);
    const std::string highest = "the highest node pressure is " + readable(unit.factor * peak) + " " + unit.name +
                                " (" + percent(peak / run.setup.model.body.effective_modulus) + " of E*)";
    if (!hardness) return "assumed to be elastic; " + highest + "; give --hardness to verify this";
    return (peak <= *hardness ? "yes, " : "no, it yields: ") + highest + (peak <= *hardness ? ", at most" : ", above") +
           " the hardness, " + readable(pressure_unit(*hardness).factor * *hardness) + " " +
           pressure_unit(*hardness).name;
}

/// A quantity with its limit, e.g. "shortest wave 0.0146 mm (limit 0.0133 mm)".
std::string in_words(const rough::Margin& margin) {
    const std::string unit = margin.name.ends_with("_mm") ? " mm" : "";
    std::string name = margin.name.substr(0, margin.name.size() - unit.size());
    std::ranges::replace(name, '_', ' ');
    name += " " + readable(margin.value) + unit;
    if (!margin.is_limited()) return name;
    return name + (margin.holds() ? " (limit " : " (beyond the limit ") + readable(margin.limit) + unit + ")";
}

/// Whether the given limits are met. Without limits it is not known whether the surface can be made.
std::string making(const DesignRun& run) {
    std::string limited, free;
    for (rough::Margin margin : run.margins) {
        if (!run.limits_given && margin.is_lower) margin.limit = 0; // the default shortest wave is the grid's
        join(margin.is_limited() ? limited : free, in_words(margin), ", ");
    }
    if (!run.limits_given)
        return "not known, as no limit was given: " + free +
               "; give --max-slope, --min-radius, --max-height or --shortest-wave of your process";
    return (run.found.best.within_limits ? "yes, by the given limits: " : "no: ") + limited +
           (free.empty() ? "" : "; without a limit: " + free);
}

/// The lengths and datums for which each target's curve is valid.
std::string carries_over(const DesignRun& run) {
    const rough::Model& model = run.setup.model;
    const bool is_2d = model.grid.is_2d();
    const bool has_datum = model.body.kernel == rough::Kernel::free && !is_2d;
    std::string all;
    for (const rough::Target& target : run.setup.targets) {
        const Quantity quantity = target.quantity;
        std::string scope = "only for this length";
        if (quantity == Quantity::interface_stiffness)
            scope = line_of(is_2d ? "" : "for every datum, and ", "approximately for other lengths, at light loads");
        else if (is_2d)
            scope += " (a map has no datum)";
        else if (quantity == Quantity::area_at_pressure)
            scope = "for every datum, but " + scope;
        else if (has_datum)
            scope +=
                " and the datum " + brief(*model.body.datum, 5) + " mm" +
                (quantity == Quantity::stiffness ? " (a target of interface_stiffness does not depend on the datum)"
                                                 : "");
        if (const auto words = in_words(quantity) + " valid " + scope; all.find(words) == std::string::npos)
            join(all, words);
    }
    if (run.setup.measured && !run.accounts.empty()) join(all, "the scan as it was read: " + run.accounts.front());
    return "designed for the body '" + name_of(model.body.kernel) + "' (--kernel), length " +
           brief(model.grid.length, 5) + (is_2d ? " x " + brief(model.grid.width, 5) : "") + " mm; " + all;
}

/// The changes of the phases, and the similarities before and after them.
std::string moved(const rough::Morphed& morphed) {
    std::string all = "similarity " + readable(morphed.before, 4) + " before, " + readable(morphed.after, 4) + " after";
    for (const rough::PhaseChange& change : morphed.changes)
        join(all, std::to_string(change.place.series + 1) + ":" + std::to_string(change.n) + " by " +
                      readable(change.after - change.before) + " rad" +
                      (change.at_limit ? " (the largest permitted change)" : ""));
    return all;
}

/// A position on a target's x axis, e.g. " at 12.0 kPa".
std::string at(const rough::Target& target, double x) {
    const Unit unit = target.against_pressure() ? pressure_unit(target.last()) : length_unit(target.last());
    return " at " + readable(unit.factor * x) + " " + unit.name;
}

/// Nodes of a grid of this shape with `factor` times as many, as --nodes takes them.
std::string nodes_for(const rough::Grid& grid, double factor) {
    const double side = grid.is_2d() ? std::sqrt(factor) : factor;
    const auto more = [&](rough::Index nodes) { return brief(std::ceil(side * static_cast<double>(nodes)), 9); };
    return more(grid.nodes) + (grid.is_2d() ? "x" + more(grid.rows) : "");
}

/// Reasons why no answer was found: the largest misfit, then its possible causes.
std::string obstacles(const DesignRun& run) {
    const auto& targets = run.setup.targets;
    std::size_t worst = 0;
    const auto weighted = [&](std::size_t t) { return targets[t].weight * std::abs(largest_misfit(run, t).first); };
    for (std::size_t t = 1; t < targets.size(); ++t)
        if (weighted(t) > weighted(worst)) worst = t;
    const rough::Target& target = targets[worst];
    const auto [misfit, point] = largest_misfit(run, worst);
    const double allowed = 1 - run.setup.required_similarity;
    std::string all;
    if (weighted(worst) > allowed)
        join(all,
             "the largest misfit is " + percent(misfit) + " of the " + in_words(target) + at(target, target.x[point]));
    if (run.morphed) {
        const std::size_t missed = run.morphed->missed.size();
        join(all, missed == 0 ? ""
                              : "no change was found that matches " + std::to_string(missed) +
                                    " points; name more chromosomes, or permit a larger --largest-change");
        return all;
    }
    if (run.unreachable.bound < run.setup.required_similarity)
        join(all,
             line_of(run.setup.model.grid.is_2d() ? "no map " : "no profile ",
                     run.unreachable.reasons.empty() || run.unreachable.reasons.front().on_this_grid ? "on this grid "
                                                                                                     : "",
                     "has a similarity above ", readable(run.unreachable.bound, 4)));
    const double nodes = static_cast<double>(run.setup.model.grid.shape().nodes()), wanted = target.y[point] * nodes;
    if (is_contact_fraction(target.quantity) && 0.5 / wanted > allowed)
        join(all, "the requested area" + at(target, target.x[point]) + " is " + readable(wanted) + " of " +
                      brief(nodes, 9) + " nodes, so half a node changes it by " + percent(0.5 / wanted) +
                      ": give --nodes " + nodes_for(run.setup.model.grid, 0.5 / wanted / allowed));
    for (const rough::Margin& margin : run.margins)
        if (margin.is_limited() && margin.margin() < 0.05)
            join(all, in_words(margin) + (margin.holds() ? " is close to its limit" : " violates its limit"));
    const std::string longer = std::isfinite(run.options.seconds)
                                   ? ": give --resume --seconds " + readable(2 * run.options.seconds)
                                   : ": give --resume";
    if (run.interrupted)
        join(all, "the design was interrupted: give --resume");
    else if (!run.found.stopped.empty())
        join(all, "the search ended early, " + run.found.stopped + longer);
    else if (!run.found.best.is_verified())
        join(all, "the time did not suffice to verify the answer" + longer);
    else if (run.unreachable.reasons.empty())
        join(all, "the search ended without success: give --seed " + std::to_string(run.options.seed + 1) +
                      " or another --variant");
    return all;
}

} // namespace

Shares unrequested_errors(const rough::DesignSetup& design, const rough::Genome& genome) {
    Shares all;
    const auto& requested = design.targets;
    if (!design.measured || !requested.front().against_pressure()) return all;
    rough::DesignSetup setup = design;
    setup.targets.clear();
    for (const Quantity quantity : {Quantity::stiffness, Quantity::area_at_pressure, Quantity::interface_stiffness}) {
        if (std::ranges::any_of(requested, [&](const rough::Target& target) { return target.quantity == quantity; }))
            continue;
        rough::Target target = requested.front();
        target.quantity = quantity;
        target.lower = target.upper = {}; // a band of the requested quantity
        setup.targets.push_back(std::move(target));
    }
    setup = rough::in_finer_steps(std::move(setup), 1); // sets the values of the scan's response
    const std::vector<double> each = similarities(setup, respond(setup, genome, setup.model));
    for (std::size_t t = 0; t < each.size(); ++t)
        if (setup.targets[t].y.maxCoeff() < nearly_rigid * design.model.body.effective_modulus)
            all[in_words(setup.targets[t].quantity)] = 1 - each[t];
    return all;
}

void say_unreachable(const rough::Unreachable& found, const std::string& of_what) {
    if (!found.reasons.empty())
        say("note: out of reach of " + of_what + ": " + found.reasons.front().reason + "; no similarity is above " +
            readable(found.bound, 4) + "; the search is short, for the nearest");
}

bool is_found(const DesignRun& run) {
    return verified_of(run) >= run.setup.required_similarity && is_verified(run) && run.unreachable.reasons.empty() &&
           run.found.best.within_limits;
}

Summary summary_of(const DesignRun& run) {
    Summary summary{is_found(run), verified_of(run), verdict_of(run), {}};
    summary.facts = {
        {"warning", "Warning", run.warning},          {"moved", "Change", run.morphed ? moved(*run.morphed) : ""},
        {"matched", "Requested", matched(run)},       {"not_requested", "Not requested", not_requested(run)},
        {"worst_case", "Checks", worst_case(run)},    {"machine", "Tolerance", machine(run)},
        {"yielding", "Elastic", yielding(run)},       {"making", "Can be made", making(run)},
        {"carries_over", "Valid", carries_over(run)}, {"obstacles", "Obstacles", summary.found ? "" : obstacles(run)}};
    return summary;
}

} // namespace app
